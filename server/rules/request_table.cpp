#include "server/rules/request_table.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "server/rules/request_fields.h"
#include "shared/base/check.h"
#include "shared/base/random.h"

namespace scree {

namespace {

struct RequestKindRow {
  std::string_view name;
  const FieldTable* fields = nullptr;  ///< null: scripts see its name alone
  Request (*make)() = nullptr;
  size_t index = 0;
};

template <typename Kind, size_t Index = 0>
consteval size_t index_of_request() {
  if constexpr (std::is_same_v<std::variant_alternative_t<Index, Request>, Kind>)
    return Index;
  else
    return index_of_request<Kind, Index + 1>();
}

template <typename Kind>
constexpr RequestKindRow kind_row(std::string_view name, const FieldTable* fields = nullptr) {
  return {name, fields, [] { return Request(Kind{}); }, index_of_request<Kind>()};
}

/// By the request's index.
constexpr std::array kinds_of_requests{
    kind_row<CarveRequest>("carve", &carve_fields),
    kind_row<FillRequest>("fill", &fill_fields),
    kind_row<PaintRequest>("paint", &paint_fields),
    kind_row<SettingsRequest>("settings"),
    kind_row<LeaveRequest>("leave"),
    kind_row<AddPropRequest>("add_prop", &add_prop_fields),
    kind_row<RemovePropRequest>("remove_prop", &remove_prop_fields),
    kind_row<MovePropRequest>("move_prop", &move_prop_fields),
    kind_row<PushRequest>("push", &push_fields),
    kind_row<BreakRequest>("break", &break_fields),
    kind_row<BlastRequest>("blast", &blast_fields),
    kind_row<AddJointRequest>("add_joint", &add_joint_fields),
    kind_row<RemoveJointRequest>("remove_joint", &remove_joint_fields),
    kind_row<SetMotorRequest>("set_motor", &set_motor_fields),
    kind_row<CutOutRequest>("cut_out", &cut_out_fields),
    kind_row<ReleaseRequest>("release", &release_fields),
    kind_row<AddPieceRequest>("add_piece"),
    kind_row<SetRegionRequest>("set_region", &set_region_fields),
    kind_row<RemoveRegionRequest>("remove_region", &remove_region_fields),
    kind_row<StandRequest>("stand", &stand_fields),
    kind_row<WalkRequest>("walk"),
    kind_row<DigRequest>("dig", &dig_fields),
    kind_row<PlaceRequest>("place", &place_fields),
    kind_row<TransferRequest>("transfer", &transfer_fields),
    kind_row<RulesRequest>("rules"),
    kind_row<RestoreRequest>("restore"),
};
static_assert(kinds_of_requests.size() == std::variant_size_v<Request>);
static_assert([] {
  for (size_t i = 0; i < kinds_of_requests.size(); ++i)
    if (kinds_of_requests[i].index != i) return false;
  return true;
}());

const RequestKindRow& row_of_request(const Request& request) {
  return kinds_of_requests[request.index()];
}

void* body_of(Request& request) {
  return std::visit([](auto& body) -> void* { return &body; }, request);
}
const void* body_of(const Request& request) {
  return std::visit([](const auto& body) -> const void* { return &body; }, request);
}

/// A table may say its own kind, as that of on.request does.
Result<void> check_kind_field(std::string_view kind, const ScriptValue& table) {
  const ReadScope scope(table);
  const ScriptValue said = TRY(table.field("kind"));
  if (said.is_nil()) return {};
  if (said.is_text() && TRY(said.text()) == kind) return {};
  return said.refuse("the kind of a request stays '" + std::string(kind) + "'");
}

}  // namespace

std::string_view kind_of(const Request& request) {
  return row_of_request(request).name;
}

std::string_view kind_at(size_t index) {
  CHECK(index < kinds_of_requests.size());
  return kinds_of_requests[index].name;
}

Result<Request> read_request(std::string_view kind, const ScriptValue& table, const RulesMoment& moment) {
  const auto row = std::ranges::find(kinds_of_requests, kind, &RequestKindRow::name);
  CHECK(row != kinds_of_requests.end() && row->fields != nullptr);
  Request request = row->make();
  if (table.is_table()) TRY(check_kind_field(kind, table));
  TRY(read_fields(body_of(request), table, *row->fields, moment, {"kind", "by"}));
  return request;
}

void write_request(ScriptWriter& to, const Request& request, const RulesMoment& moment) {
  const RequestKindRow& row = row_of_request(request);
  if (row.fields != nullptr) write_fields(body_of(request), to, *row.fields, moment);
}

Result<Request> changed_request(const Request& before, const ScriptValue& table, const RulesMoment& moment) {
  const RequestKindRow& row = row_of_request(before);
  if (row.fields == nullptr)
    return fail("a request of the kind " + std::string(row.name) + " may be refused, but not changed");
  Request request = before;
  if (table.is_table()) TRY(check_kind_field(row.name, table));
  TRY(read_fields(body_of(request), table, *row.fields, moment, {"kind", "by"}, FieldsNeeded::none));
  return request;
}

std::span<const FieldTable* const> request_field_tables() {
  static constexpr std::array tables{
      &carve_fields,      &fill_fields,         &paint_fields,         &blast_fields,
      &dig_fields,        &place_fields,        &transfer_fields,      &cut_out_fields,
      &add_prop_fields,   &prop_part_fields,    &remove_prop_fields,   &move_prop_fields,
      &push_fields,       &break_fields,        &release_fields,       &add_joint_fields,
      &joint_side_fields, &joint_limits_fields, &joint_motor_fields,   &remove_joint_fields,
      &set_motor_fields,  &set_region_fields,   &remove_region_fields, &stand_fields,
  };
  return tables;
}

uint32_t random_seed_of(const RulesMoment& moment) {
  const uint64_t tick = moment.world != nullptr ? moment.world->tick() : 0;
  const uint64_t request = moment.next_request != nullptr ? *moment.next_request : 0;
  Random random(tick * 0x9E3779B97F4A7C15U + request);
  return random.next();
}

}  // namespace scree
