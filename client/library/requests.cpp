// From a program's struct to a request. A kind is a row: what it has that says nothing, and how it is made.
#include <array>
#include <string>

#include "client/library/call.h"
#include "client/library/handle.h"
#include "shared/base/timing.h"
#include "shared/fracture/seed_pattern.h"

namespace scree {
namespace {

Result<Shape> shape_of(const scree_shape& given) {
  const auto kind = static_cast<ShapeKind>(given.kind);
  if (given.kind > UINT8_MAX) return fail("there is no such shape");
  TRY(validate_kind(kind, "shape"));
  Shape shape{kind, vec3_of(given.a_m), {}, given.radius_m};
  if (traits_of(kind).has_b) shape.b = vec3_of(given.b_m);
  TRY(validate(shape));
  return shape;
}

std::optional<Material> material_of(const scree_request& given) {
  if (given.material == SCREE_NO_MATERIAL) return std::nullopt;
  return static_cast<Material>(given.material);
}

glm::quat turn_of(const scree_request& given) {
  const float* const r = given.rotation;
  return {r[3], r[0], r[1], r[2]};
}

/// A request is made of what the struct has, or of an error in words.
using Made = Result<Request>;

Made carve(const scree_request& given) {
  const auto pattern = static_cast<SeedPattern>(given.pattern);
  if (given.pattern > UINT8_MAX || !is_known(pattern) || !asks_no_points(pattern))
    return fail("there is no such pattern, or it needs points");
  return CarveRequest{.shape = TRY(shape_of(given.shape)),
                      .pattern = pattern,
                      .seeds = given.seeds,
                      .random_seed = given.random_seed,
                      .impact_m = vec3_of(given.place_m),
                      .blast_speed_m_s = given.speed_m_s,
                      .piece = given.body};
}
Made fill(const scree_request& given) {
  return FillRequest{TRY(shape_of(given.shape)), material_of(given)};
}
Made paint(const scree_request& given) {
  const std::optional<Material> material = material_of(given);
  if (!material) return fail("a paint needs a material");
  return PaintRequest{TRY(shape_of(given.shape)), *material};
}
Made blast(const scree_request& given) {
  return BlastRequest{vec3_of(given.place_m), given.energy_j, given.random_seed};
}
Made dig(const scree_request& given) {
  return DigRequest{.shape = TRY(shape_of(given.shape)), .piece = given.body};
}
Made place(const scree_request& given) {
  const std::optional<Material> material = material_of(given);
  if (!material) return fail("a place needs a material");
  return PlaceRequest{
      .shape = TRY(shape_of(given.shape)), .material = *material, .solid = (given.flags & 1U) != 0};
}
Made cut_out(const scree_request& given) {
  return CutOutRequest{TRY(shape_of(given.shape))};
}
Made release(const scree_request& given) {
  return ReleaseRequest{given.body};
}
Made break_piece(const scree_request& given) {
  return BreakRequest{given.body, vec3_of(given.place_m), given.seeds, given.random_seed};
}
Made push(const scree_request& given) {
  return PushRequest{given.body, vec3_of(given.vector), vec3_of(given.place_m)};
}

/// A prop of one part, about the middle of the shape.
Made add_body(const scree_request& given) {
  const Shape shape = TRY(shape_of(given.shape));
  PropPart part;
  switch (shape.kind) {
    case ShapeKind::sphere:
      part.kind = PropPartKind::sphere;
      part.half_m = glm::vec3(shape.radius_m);
      break;
    case ShapeKind::box:
      part.half_m = shape.b;
      break;
    default:
      return fail("a body is a sphere or a box");
  }
  if (given.motion > static_cast<uint32_t>(PropMotion::fixed)) return fail("there is no such motion");
  Prop prop{.parts = {part}, .motion = static_cast<PropMotion>(given.motion), .mass_kg = given.mass_kg};
  if (const std::optional<Material> material = material_of(given)) prop.material = *material;
  prop.tag = given.tag;
  TRY(validate(prop));
  return AddPropRequest{.prop = prop,
                        .place_m = vec3_of(given.place_m),
                        .turn = turn_of(given),
                        .velocity_m_s = vec3_of(given.vector)};
}
Made remove_body(const scree_request& given) {
  return RemovePropRequest{given.body};
}
Made move_body(const scree_request& given) {
  return MovePropRequest{.prop = given.body,
                         .place_m = vec3_of(given.place_m),
                         .turn = turn_of(given),
                         .velocity_m_s = vec3_of(given.vector)};
}
Made stand(const scree_request& given) {
  return StandRequest{.away = (given.flags & 1U) != 0};
}
Made give(const scree_request&) {
  return TransferRequest{.from = {.kind = StoreKind::own}, .to = {.kind = StoreKind::world}};
}

struct RequestRow {
  uint32_t kind;
  Made (*make)(const scree_request&);
};
constexpr std::array request_rows{
    RequestRow{SCREE_CARVE, carve},
    RequestRow{SCREE_FILL, fill},
    RequestRow{SCREE_PAINT, paint},
    RequestRow{SCREE_BLAST, blast},
    RequestRow{SCREE_DIG, dig},
    RequestRow{SCREE_PLACE, place},
    RequestRow{SCREE_CUT_OUT, cut_out},
    RequestRow{SCREE_RELEASE, release},
    RequestRow{SCREE_BREAK, break_piece},
    RequestRow{SCREE_PUSH, push},
    RequestRow{SCREE_ADD_BODY, add_body},
    RequestRow{SCREE_REMOVE_BODY, remove_body},
    RequestRow{SCREE_MOVE_BODY, move_body},
    RequestRow{SCREE_STAND, stand},
    RequestRow{SCREE_GIVE, give},
};

const RequestRow* row_of_kind(uint32_t kind) {
  for (const RequestRow& row : request_rows)
    if (row.kind == kind) return &row;
  return nullptr;
}

bool is_finite_request(const scree_request& given) {
  const float single[] = {given.shape.radius_m, given.speed_m_s, given.energy_j, given.mass_kg};
  return is_finite(given.shape.a_m, 3) && is_finite(given.shape.b_m, 3) && is_finite(given.place_m, 3) &&
         is_finite(given.rotation, 4) && is_finite(given.vector, 3) && is_finite(single, std::size(single));
}

Made made_of(const scree_request& given) {
  const RequestRow* const row = row_of_kind(given.kind);
  if (row == nullptr) return fail("there is no request of that kind");
  if (!is_finite_request(given)) return fail("a number of the request is not finite");
  if (given.material != SCREE_NO_MATERIAL && given.material >= materials_max)
    return fail("no palette has so many materials");
  return row->make(given);
}

}  // namespace

}  // namespace scree

using namespace scree;

uint32_t scree_client::ask(const Request& request, const ReplyWish& wish) {
  if (++requests_ == 0) requests_ = first_request;
  wishes_[requests_] = wish;
  client.ask(request, requests_, steady_now_s());
  return requests_;
}

extern "C" {

scree_result scree_request_init(scree_request* request, uint32_t size, uint32_t kind) {
  if (row_of_kind(kind) == nullptr) return fail(SCREE_INVALID, "there is no request of that kind");
  const CarveRequest usual;
  scree_request value{};
  value.kind = kind;
  value.material = SCREE_NO_MATERIAL;
  value.pattern = static_cast<uint32_t>(usual.pattern);
  value.seeds = kind == SCREE_BREAK ? BreakRequest{}.seeds : usual.seeds;
  value.rotation[3] = 1.0F;
  value.speed_m_s = usual.blast_speed_m_s;
  value.energy_j = BlastRequest{}.energy_j;
  return init_struct(request, size, value) ? done : fail(SCREE_INVALID, "no release has such a request");
}

scree_result scree_client_request(scree_client* client, const scree_request* request,
                                  scree_reply_function reply, void* user, uint32_t* number) {
  return guarded([&] {
    const std::optional<scree_request> given = read_struct(request);
    if (client == nullptr || !given) return fail(SCREE_INVALID, "a client and a request are needed");
    const Made made = made_of(*given);
    if (!made) return fail(SCREE_INVALID, made.error().message);
    if (const std::string fault = fault_of(*made); !fault.empty()) return fail(SCREE_INVALID, fault);
    if (!client->client.connected()) return fail(SCREE_NOT_CONNECTED, "there is no connection");
    const uint32_t asked = client->ask(*made, {reply, user});
    if (number != nullptr) *number = asked;
    return done;
  });
}

scree_result scree_find_pattern(const char* name, uint32_t* pattern) {
  return guarded([&] {
    if (name == nullptr || pattern == nullptr) return fail(SCREE_INVALID, "a name and a place are needed");
    const std::optional<SeedPattern> found = kind_named<SeedPattern>(name);
    if (!found) return nothing;
    *pattern = static_cast<uint32_t>(*found);
    return done;
  });
}
}
