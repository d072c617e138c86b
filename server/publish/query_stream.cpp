#include "server/publish/query_stream.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

QueryStream::QueryStream(const TerrainSource& source, uint32_t tick_rate_hz, const PublishedState& state)
    : state_(state),
      wait_ticks_(std::max<Tick>(1, static_cast<Tick>(limits::query_wait_s * tick_rate_hz))),
      scenes_(source, tick_rate_hz, state) {}

tl::expected<void, Refused> QueryStream::ask(uint64_t session, uint64_t party, const QueryMessage& query) {
  if (query.as_of != 0 && !scenes_.may_ask_for(query.as_of))
    return scree::refuse(
        Refusal::query_tick,
        fmt::format("tick {} cannot be asked for: the newest is {}, and ticks are kept for {:g} s",
                    query.as_of, state_.tick(), limits::query_past_s));
  if (waiting(session) + query.questions.size() > limits::queries_waiting_max)
    return scree::refuse(Refusal::queries_waiting,
                         fmt::format("more than {} questions wait for an answer: ask again later",
                                     limits::queries_waiting_max));
  Queue& queue = queues_[session];
  queue.party = party;
  queue.questions += query.questions.size();
  queue.messages.push_back({query, {query.query, query.as_of, {}}, state_.tick()});
  turns_.wait(session, party);
  return {};
}

void QueryStream::leave(uint64_t session) {
  queues_.erase(session);
  turns_.leave(session);
}

size_t QueryStream::waiting(uint64_t session) const {
  const auto queue = queues_.find(session);
  // A message without questions waits, too.
  return queue == queues_.end() ? 0 : queue->second.questions + queue->second.messages.size();
}

void QueryStream::begin_tick(const std::function<const ClientView*(uint64_t)>& reader) {
  for (auto& [session, queue] : queues_) {
    queue.credit_bytes =
        std::min(queue.credit_bytes + limits::query_bytes_per_tick, limits::query_bytes_per_tick);
    queue.view = reader(session);
  }
  turns_.begin();
}

tl::expected<void, Refused> QueryStream::check(const Question& question, const ClientView& view) const {
  if (std::holds_alternative<UnknownQuestion>(question.asks))
    return scree::refuse(Refusal::value_unknown, "this server does not know the kind of the question");
  if (const Result<void> valid = validate(question); !valid)
    return scree::refuse(Refusal::query_invalid, valid.error().message);
  const double reach_m = static_cast<double>(view.radius_m() * limits::interest_keep_factor);
  const double far_m = reach_from(question, glm::dvec3(view.eye_m()));
  if (far_m <= reach_m) return {};
  return scree::refuse(
      Refusal::query_far,
      fmt::format("the question reaches {:.0f} m from your eye; your interest reaches {:.0f} m: "
                  "go nearer, or ask for less",
                  far_m, reach_m));
}

void QueryStream::refuse(Waiting& waiting, const Refused& refused) {
  refusals_.push_back(refused.reason);
  QuestionReply reply;
  reply.refusal = refused.message;
  reply.refusal_name = std::string(name_of(refused.reason));
  waiting.answer.answers.push_back(std::move(reply));
  waiting.progress = 0.0F;
  waiting.needs.clear();
}

bool QueryStream::go_on(Waiting& waiting, const ClientView& view, uint64_t& cost) {
  const Question& question = waiting.query.questions[waiting.answer.answers.size()];
  if (waiting.answer.tick == 0) waiting.answer.tick = state_.tick();
  if (const auto may_ask = check(question, view); !may_ask) {
    refuse(waiting, may_ask.error());
    return true;
  }
  QueryScenes::Step step = scenes_.step(question, waiting.answer.tick, waiting.progress);
  cost += step.cost;
  switch (step.outcome) {
    case QueryScenes::Outcome::answered: {
      QuestionReply reply;
      reply.answer = std::move(step.answer);
      waiting.answer.answers.push_back(std::move(reply));
      waiting.progress = 0.0F;
      waiting.needs.clear();
      return true;
    }
    case QueryScenes::Outcome::goes_on:
      return true;
    case QueryScenes::Outcome::missing:
      if (state_.tick() < waiting.since + wait_ticks_) return false;
      refuse(waiting, {Refusal::query_later, "terrain there is being read from the disk: ask again"});
      return true;
    case QueryScenes::Outcome::gone:
      if (waiting.query.as_of == 0 && waiting.begun_anew < limits::query_anew_max) {
        waiting.answer = {waiting.query.query, 0, {}};
        waiting.progress = 0.0F;
        ++waiting.begun_anew;
        return true;
      }
      refuse(waiting, {Refusal::query_later, "what was there in that tick is not kept any more: ask again"});
      return true;
  }
  return true;
}

void QueryStream::want_missing(uint64_t session, Queue& queue, std::vector<WantedChunk>& wanted) {
  std::set<ChunkCoord>& needs = queue.messages.front().needs;
  for (const ChunkCoord chunk : scenes_.take_missing()) needs.insert(chunk);
  for (const ChunkCoord chunk : needs) {
    const auto found = state_.chunks().find(chunk);
    if (found != state_.chunks().end() && !found->second.is_whole())
      wanted.push_back({session, queue.party, chunk});
  }
}

std::vector<ChunkCoord> QueryStream::needed() const {
  std::vector<ChunkCoord> needed;
  for (const auto& [session, queue] : queues_)
    for (const ChunkCoord chunk : queue.messages.front().needs)
      if (state_.chunks().contains(chunk)) needed.push_back(chunk);
  return needed;
}

std::vector<WantedChunk> QueryStream::serve(const std::function<const ClientView*(uint64_t)>& reader,
                                            const std::function<bool(uint64_t, const SharedBytes&)>& send) {
  std::vector<WantedChunk> wanted;
  if (queues_.empty()) scenes_.rest();
  if (queues_.empty() || !scenes_.begin()) return wanted;
  begin_tick(reader);
  uint64_t spent = 0;
  while (!turns_.empty() && spent < limits::query_steps_per_tick) {
    const uint64_t session = turns_.next();
    Queue& queue = queues_.at(session);
    if (queue.view == nullptr || queue.credit_bytes <= 0) {
      turns_.pass_over();
      continue;
    }
    Waiting& first = queue.messages.front();
    uint64_t cost = 1;
    bool goes_on = true;
    if (first.answer.answers.size() < first.query.questions.size()) goes_on = go_on(first, *queue.view, cost);
    want_missing(session, queue, wanted);
    if (first.answer.answers.size() == first.query.questions.size()) {
      if (first.answer.tick == 0) first.answer.tick = state_.tick();
      const SharedBytes bytes = share(first.answer);
      queue.questions -= first.query.questions.size();
      queue.messages.pop_front();
      queue.credit_bytes -= size_of(bytes);
      goes_on = send(session, bytes);
    }
    spent += cost;
    turns_.charge(cost, queue.messages.empty() ? FairTurns::Then::leaves
                        : goes_on              ? FairTurns::Then::waits
                                               : FairTurns::Then::is_passed_over);
    if (queue.messages.empty()) queues_.erase(session);
  }
  turns_.end();
  return wanted;
}

}  // namespace scree
