#include "client/session/client.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <thread>
#include <type_traits>
#include <utility>

#include "client/session/limits.h"
#include "proto/limits.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"

namespace scree {

Client::Client(std::unique_ptr<Connector> connector, const ClientOptions& options)
    : rejoin_(options.cache), connector_(std::move(connector)), delayed_(options.delayed) {}

Client::~Client() {
  connector_.reset();
  rejoin_.finish(channel_ ? mirror_.get() : nullptr);
  if (channel_) channel_->leave();
}

void Client::join(const HelloMessage& hello, double now_s) {
  CHECK(!joining());
  drop();
  eye_m_ = hello.eye_m;
  radius_m_ = hello.interest_radius_m;
  connector_->begin(rejoin_, hello, now_s);
}

void Client::drop() {
  if (!channel_) return;
  rejoin_.store(*mirror_);
  counters_ = channel_->counters();
  channel_.reset();
  over_ = false;
  answered_ = true;
}

Client::Lost Client::lose(const ConnectionEnd& end) {
  drop();
  return {end};
}

void Client::wait(std::chrono::milliseconds within) {
  if (channel_ && !delayed_ && !playback_.empty()) return;  // it has come with the welcome
  if (channel_) return channel_->await(within);
  if (joining()) return connector_->await(within);
  std::this_thread::sleep_for(within);
}

void Client::poll(double now_s) {
  now_s_ = now_s;
  if (!channel_) return;
  answer();  // if the owner did not take all events
  receive();
}

/// A channel may close with messages left, so its end counts when it was closed before nothing came.
void Client::receive() {
  answered_ = false;
  const bool open = channel_->connected();
  std::vector<Received> arrived = channel_->poll();
  over_ = !open && arrived.empty();
  for (Received& received : arrived) playback_.push(std::move(received));
}

std::optional<Client::Event> Client::next() {
  if (!channel_) {
    std::optional<Connector::Attempt> attempt = joining() ? connector_->poll(now_s_) : std::nullopt;
    if (!attempt) return std::nullopt;
    if (!attempt->channel) return Lost{attempt->end};
    return begin(std::move(attempt->channel));
  }
  if (std::optional<Received> received = next_due()) return apply(std::move(*received));
  if (over_) return lose(channel_->end());
  answer();
  return std::nullopt;
}

std::optional<Received> Client::next_due() {
  return delayed_ ? playback_.pop_next(now_s_) : playback_.take_first();
}

Client::Joined Client::begin(std::unique_ptr<ServerChannel> channel) {
  channel_ = std::move(channel);
  predictions_.reset();
  mirror_ = rejoin_.begin(*channel_);
  if (rejoin_.content().is_current()) mirror_->set_palette(rejoin_.content().palette());
  eye_m_ = rejoin_.eye_m();
  predictions_ = std::make_unique<Predictions>(*mirror_);
  playback_.start(channel_->welcome());
  acknowledged_ = 0;
  last_chunk_s_ = now_s_;
  const uint64_t world = channel_->welcome().world;
  receive();
  return {std::exchange(world_, world) != world};
}

Client::Event Client::apply(Received received) {
  const ServerMessage& message = received.message;
  if (std::holds_alternative<ChunkMessage>(message) ||
      std::holds_alternative<UnchangedChunksMessage>(message) ||
      std::holds_alternative<ResetMessage>(message))
    last_chunk_s_ = now_s_;
  const Result<void> taken = rejoin_.before(message, *mirror_);
  Result<MirrorChanges> changes = taken ? mirror_->apply(message) : tl::unexpected(taken.error());
  if (!changes) return lose({{"the server's data cannot be applied: " + changes.error().message}, {}});
  take_content(message, *changes);
  for (const PieceId id : changes->props_added)
    if (const auto prop = mirror_->props().find(id);
        prop != mirror_->props().end() && prop->second.prop->model)
      rejoin_.want_model(*prop->second.prop->model);
  predictions_->notice(message);
  rejoin_.after(message, *mirror_, *channel_);
  while (const std::optional<RepairMessage> repair = mirror_->next_repair_request()) channel_->send(*repair);
  return Applied{std::move(received), std::move(*changes)};
}

void Client::take_content(const ServerMessage& message, MirrorChanges& changes) {
  const std::optional<Digest> whole = rejoin_.take_content(message);
  const ReceivedContent& content = rejoin_.content();
  if (content.is_current() && content.palette() != mirror_->palette()) {
    mirror_->set_palette(content.palette());
    changes.palette = true;
  } else {
    if (whole && content.find(*whole)) changes.image = whole;
  }
}

/// Once after each poll().
void Client::answer() {
  if (std::exchange(answered_, true)) return;
  if (now_s_ >= next_ack_s_) {
    next_ack_s_ = now_s_ + limits::acknowledge_interval_s;
    if (mirror_->tick() > acknowledged_) {
      acknowledged_ = mirror_->tick();
      channel_->send(AckMessage{acknowledged_});
    }
  }
  rejoin_.tend(now_s_, *mirror_, *channel_);
}

void Client::send(const ClientMessage& message) {
  if (channel_) channel_->send(message);
}

void Client::ask(const Request& request, uint32_t number, double now_s) {
  if (!channel_) return;
  std::visit(Overloaded{[&](const auto& asked) {
                          channel_->send(RequestMessage<std::decay_t<decltype(asked)>>{asked, number});
                        },
                        [](const SettingsRequest&) { CHECK(!"a request of clients"); },
                        [](const LeaveRequest&) { CHECK(!"a request of clients"); }},
             request);
  if (predict_) foresee(request, number, now_s);
}

uint32_t Client::query(std::vector<Question> questions, Tick as_of) {
  if (!channel_) return 0;
  CHECK(questions.size() <= limits::questions_max);
  if (++queries_ == 0) ++queries_;
  channel_->send(QueryMessage{queries_, as_of, std::move(questions)});
  return queries_;
}

void Client::follow(glm::vec3 eye_m, float radius_m) {
  CHECK(channel_ != nullptr);
  eye_m_ = eye_m;
  radius_m_ = radius_m;
  rejoin_.follow(eye_m, radius_m, *mirror_, *channel_);
}

/// Where everything that the request reads has arrived, and where it can be hoped to be carried out.
void Client::foresee(const Request& request, uint32_t number, double now_s) {
  const WelcomeMessage& welcome = channel_->welcome();
  const Role role = std::holds_alternative<CarveRequest>(request) ? Role::carver : Role::builder;
  if (welcome.replay || !may_act_as(welcome.role, role)) return;
  const float radius_m = std::min(radius_m_, welcome.interest_radius_m);
  const float side_m = static_cast<float>(chunk_size) * mirror_->terrain().voxel_size_m;
  const auto known = [&](ChunkCoord chunk) {
    if (!is_here(mirror_->terrain(), chunk)) return false;
    if (mirror_->held_chunks().contains(chunk)) return true;
    if (!loaded(now_s)) return false;  // it may be on its way
    const glm::vec3 lo_m = glm::vec3(chunk.x, chunk.y, chunk.z) * side_m;
    return glm::distance(eye_m_, glm::clamp(eye_m_, lo_m, lo_m + side_m)) <= radius_m;
  };
  predictions_->foresee(number, request, now_s, known);
}

void Client::settle(double now_s, MirrorChanges& changes) {
  if (!predictions_) return;
  if (!channel_ || !predict_) predictions_->revert();
  predictions_->settle(now_s, changes);
}

bool Client::loaded(double now_s) const {
  return channel_ != nullptr && mirror_->tick() > 0 && now_s - last_chunk_s_ >= limits::loaded_quiet_s;
}

}  // namespace scree
