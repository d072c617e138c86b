#include "server/net/queries.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/net/limits.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

tl::expected<void, Refused> try_pass(const QueryMessage& query, SessionEntry& entry, Publisher& publisher) {
  const auto count = static_cast<double>(std::max<size_t>(1, query.questions.size()));
  if (!entry.queries.try_spend(steady_now_s(), count))
    return refuse(Refusal::queries_per_second,
                  fmt::format("more than {:g} questions a second: ask again more slowly",
                              limits::queries_per_second_max));
  return publisher.ask_query(entry.session->id(), query);
}

}  // namespace

void pass_query(const QueryMessage& query, ClientSession& session, SessionTable& sessions,
                Publisher& publisher, NetStats& counts) {
  const auto passed = try_pass(query, sessions.at(session.id()), publisher);
  if (passed) return;
  counts.refusals.add(passed.error().reason);
  AnswerMessage refused;
  refused.query = query.query;
  refused.refusal = passed.error().message;
  refused.refusal_name = std::string(name_of(passed.error().reason));
  session.send(ServerMessage(std::move(refused)));
}

}  // namespace scree
