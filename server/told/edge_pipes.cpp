#include "server/told/edge_pipes.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "proto/codec.h"
#include "server/told/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr const char* lost_words =
    "the connection to the simulating server was lost before its answer: what was asked may be done or not";

/// The reason of that name; one that this release does not know counts as the role's.
Refusal reason_named(std::string_view name) {
  for (size_t i = 0; i < refusal_reasons; ++i)
    if (name_of(static_cast<Refusal>(i)) == name) return static_cast<Refusal>(i);
  return Refusal::role;
}

bool needs_a_person(const ClientMessage& message) {
  return std::holds_alternative<StandMessage>(message) || std::holds_alternative<WalkMessage>(message);
}

}  // namespace

EdgePipes::EdgePipes(std::shared_ptr<Bus> bus, EdgePipesConfig config)
    : bus_(std::move(bus)), config_(std::move(config)), names_(config_.world) {}

EdgePipes::~EdgePipes() = default;

Result<std::unique_ptr<BusSubscription>> EdgePipes::open(NetServer& net) {
  net_ = &net;
  connections_ = bus_->connections();
  return bus_->subscribe(names_.down(config_.edge),
                         [this](const std::string&, std::span<const uint8_t> bytes) { heard(bytes); });
}

/// On a thread of the bus.
void EdgePipes::heard(std::span<const uint8_t> bytes) {
  auto message = decode_pipe_message(bytes);
  if (!message || waiting_ >= limits::edge_messages_waiting_max) {
    ++refused_;
    return;
  }
  ++waiting_;
  net_->post([this, taken = std::move(*message)] {
    --waiting_;
    take(taken);
  });
}

void EdgePipes::joined(uint64_t session, const HelloMessage& hello) {
  Person person;
  person.hello = hello;
  person.hello.interest_radius_m = 0.0F;
  person.hello.world = 0;
  person.hello.meets = person.hello.stones = person.hello.at_spawn = false;
  person.hello.ticket.clear();
  left(session);
  persons_.emplace(session, std::move(person));
}

void EdgePipes::left(uint64_t session) {
  const auto person = persons_.find(session);
  if (person == persons_.end()) return;
  person->second.waiting.clear();  // nobody is there to be answered
  end_pipe(session, person->second, {}, true);
  persons_.erase(person);
}

tl::expected<void, Refused> EdgePipes::ask(uint64_t session, glm::vec3 eye_m, uint32_t request,
                                           const ClientMessage& message) {
  if (needs_a_person(message))
    return refuse(
        Refusal::edge,
        "this server is an edge, where nobody is on foot: connect to the simulating server to walk");
  if (config_.is_away() || !bus_->is_connected())
    return refuse(Refusal::simulator_away, "the simulating server is away: ask again when it is back");
  if (bus_->connections() != connections_) check_time(steady_now_s());  // pipes of the lost connection end
  Person& person = persons_.at(session);
  if (steady_now_s() < person.shut_until_s) return tl::unexpected(person.shut);
  if (person.waiting.size() >= limits::edge_requests_waiting_max)
    return refuse(Refusal::commands_waiting,
                  fmt::format("{} of your requests wait for their answers (limits.edge_requests_waiting_max)",
                              person.waiting.size()));
  auto sent = person.pipe == 0 ? open_pipe(session, person, eye_m) : Result<void>();
  if (sent && person.eye_m != eye_m) {
    sent = send(person, InterestMessage{eye_m, 0.0F});
    person.eye_m = eye_m;
  }
  if (sent) sent = send(person, message);
  if (!sent) {
    end_pipe(session, person, {Refusal::simulator_away, lost_words}, true);
    return refuse(Refusal::simulator_away, "the simulating server cannot be asked: " + sent.error().message);
  }
  person.waiting[request] = steady_now_s();
  ++handed_on_;
  return {};
}

Result<void> EdgePipes::open_pipe(uint64_t session, Person& person, glm::vec3 eye_m) {
  person.pipe = next_pipe_++;
  person.sent = person.received = 0;
  person.reader = FrameReader();
  person.eye_m = eye_m;
  sessions_[person.pipe] = session;
  pipes_ = sessions_.size();
  HelloMessage hello = person.hello;
  hello.eye_m = eye_m;
  hello.ticket = std::exchange(person.ticket, {});
  return send(person, hello);
}

Result<void> EdgePipes::send(Person& person, const ClientMessage& message) {
  const std::vector<uint8_t> bytes = encode(message);
  for (size_t from = 0; from < bytes.size(); from += limits::pipe_bytes_max) {
    const size_t count = std::min(limits::pipe_bytes_max, bytes.size() - from);
    const auto part = std::span(bytes).subspan(from, count);
    TRY(bus_->send(names_.up(config_.edge),
                   encode(PipeMessage{
                       config_.edge_run, person.pipe, person.sent++, {part.begin(), part.end()}, false})));
  }
  return {};
}

/// What waits is answered by `why`.
void EdgePipes::end_pipe(uint64_t session, Person& person, const Refused& why, bool tell) {
  if (person.pipe == 0) return;
  if (tell)
    static_cast<void>(bus_->send(names_.up(config_.edge),
                                 encode(PipeMessage{config_.edge_run, person.pipe, person.sent, {}, true})));
  sessions_.erase(std::exchange(person.pipe, 0));
  pipes_ = sessions_.size();
  for (const auto& [request, since_s] : std::exchange(person.waiting, {})) {
    ++lost_;
    net_->send(session,
               ServerMessage(ReplyMessage{request, why.message, 0, std::string(name_of(why.reason))}));
  }
}

// ---- what comes back

void EdgePipes::take(const PipeMessage& message) {
  const auto pipe = sessions_.find(message.pipe);
  if (message.edge_run != config_.edge_run || pipe == sessions_.end()) return;  // it has ended here
  const uint64_t session = pipe->second;
  const auto person = persons_.find(session);
  if (person != persons_.end()) read(session, person->second, message);
}

void EdgePipes::read(uint64_t session, Person& person, const PipeMessage& message) {
  const Refused lost{Refusal::simulator_away, lost_words};
  const bool is_unknown_there = message.ends && message.number == 0 && message.bytes.empty();
  if (message.number != person.received && !is_unknown_there) {
    ++refused_;
    return end_pipe(session, person, lost, true);
  }
  ++person.received;
  person.reader.push(message.bytes);
  for (;;) {
    const auto body = person.reader.next();
    if (body && !body->has_value()) break;
    auto told = body ? decode_server(**body) : tl::unexpected(body.error());
    if (!told) {
      ++refused_;
      return end_pipe(session, person, lost, true);
    }
    if (!take(session, person, *told)) return;
  }
  if (message.ends) end_pipe(session, person, lost, true);
}

bool EdgePipes::take(uint64_t session, Person& person, const ServerMessage& message) {
  return std::visit(
      Overloaded{
          [&](const WelcomeMessage& welcome) {
            person.ticket = welcome.ticket;
            net_->set_own_store(session, welcome.session);
            return true;
          },
          [&](const ReplyMessage& reply) {
            if (person.waiting.erase(reply.request) == 0) return true;
            ++answered_;
            net_->send(session, message);
            return true;
          },
          [&](const RefusalMessage& refusal) {
            // In its own words, for the simulating server has the last one.
            person.shut = {reason_named(refusal.name), refusal.reason};
            person.shut_until_s = steady_now_s() + limits::edge_shut_s;
            for (const auto& [request, since_s] : std::exchange(person.waiting, {})) {
              ++answered_;
              net_->send(session, ServerMessage(ReplyMessage{request, refusal.reason, 0, refusal.name}));
            }
            const bool is_sent_away =
                refusal.name == name_of(Refusal::kicked) || refusal.name == name_of(Refusal::banned);
            if (is_sent_away) net_->kick(session, refusal.reason);
            end_pipe(session, person, {}, true);
            return false;
          },
          [](const auto&) { return true; }},
      message);
}

void EdgePipes::check_time(double now_s) {
  if (now_s >= alive_s_ + limits::edge_alive_s) {
    alive_s_ = now_s;
    static_cast<void>(
        bus_->send(names_.up(config_.edge), encode(PipeMessage{config_.edge_run, 0, 0, {}, false})));
  }
  const uint64_t connections = bus_->connections();
  const bool is_lost = config_.is_away() || std::exchange(connections_, connections) != connections;
  for (auto& [session, person] : persons_) {
    const bool hangs = std::ranges::any_of(person.waiting, [now_s](const auto& request) {
      return now_s > request.second + limits::edge_answer_s;
    });
    if (is_lost || hangs) end_pipe(session, person, {Refusal::simulator_away, lost_words}, true);
  }
}

EdgePipesStatus EdgePipes::status() const {
  return {pipes_, handed_on_, answered_, lost_, refused_};
}

}  // namespace scree
