#include "server/rules/api/asking.h"

#include "server/rules/request_table.h"
#include "shared/base/check.h"

namespace scree {

const World& world_of(const RulesCall& call) {
  CHECK(call.moment.world != nullptr, "functions that ask the world are for handlers alone");
  return *call.moment.world;
}

Result<uint64_t> party_by(const ScriptValue& table) {
  const ReadScope scope(table);
  const ScriptValue by = TRY(table.field("by"));
  return by.is_nil() ? Result<uint64_t>(0) : read_person(by);
}

Result<void> ask_world(RulesCall& call, Request request, uint64_t party, int reply) {
  call.call.charge(work_of_request);
  ScriptFunction function;
  if (reply != 0)
    if (const ScriptValue value = call.argument(reply, "reply"); !value.is_nil())
      function = TRY(value.function());
  TRY(call.mod.ask(call.moment, std::move(request), party, std::move(function)));
  return {};
}

Result<void> ask_by_table(RulesCall& call, std::string_view kind) {
  const ScriptValue table = call.argument(1, kind);
  Request request = TRY(read_request(kind, table, call.moment));
  return ask_world(call, std::move(request), TRY(party_by(table)), 2);
}

Result<int64_t> length_within(const ScriptValue& list, int64_t most) {
  const int64_t length = TRY(list.length());
  if (length > most)
    return list.refuse(std::to_string(length) + " items are more than " + std::to_string(most));
  return length;
}

}  // namespace scree
