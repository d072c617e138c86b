// What functions of several parts do alike: asking the world for something by a table, and paying for
// answers.
#pragma once

#include <string_view>
#include <utility>

#include "server/rules/api.h"
#include "server/rules/fields.h"
#include "server/rules/mod.h"
#include "server/rules/values.h"
#include "shared/query/query.h"

namespace scree {

/// Units of a script's work, of some 10 ns: a step of a question, which takes 0.02 to 0.2 µs; a chunk that it
/// came into; a body; a request. Ground that a question generates counts by the thread's time alone: 0.1 ms a
/// chunk, once.
inline constexpr int64_t work_of_step = 10, work_of_chunk = 100, work_of_body = 40, work_of_request = 200;

/// The world of a handler.
const World& world_of(const RulesCall& call);

/// Whose pieces and falls a request makes: those of the person in the field `by`; 0: nobody's.
Result<uint64_t> party_by(const ScriptValue& table);

/// Asks for it; argument number `reply`, if there is one, is the function that gets the reply.
Result<void> ask_world(RulesCall& call, Request request, uint64_t party = 0, int reply = 0);

/// Asks for what the table in argument 1 says, with the reply to argument 2.
Result<void> ask_by_table(RulesCall& call, std::string_view kind);

/// The answer to a question, for which the script pays.
template <typename T>
Result<T> paid(RulesCall& call, QueryResult<T> result) {
  if (!result) return tl::unexpected(std::move(result.error()));
  call.call.charge(work_of_request + work_of_step * result->cost.steps + work_of_chunk * result->cost.chunks);
  return std::move(result->answer);
}

/// The length of a list in argument, of at most so many items.
Result<int64_t> length_within(const ScriptValue& list, int64_t most);

}  // namespace scree
