#include "tests/support/session_support.h"

#include <algorithm>

#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "shared/base/timing.h"
#include "tests/support/patience.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// Ticks without a change after which a session is at rest.
constexpr int calm_ticks = 60;
constexpr int settle_ticks_max = 3600;

/// Ticks within which a request is answered: it is on its way while the server steps.
constexpr int reply_ticks_max = 2000;

}  // namespace

CarveMessage carve_message(const CarveRequest& carve, uint32_t request) {
  return {carve, request};
}

SessionClient::SessionClient(uint16_t port, glm::vec3 eye_m, float radius_m)
    : client_(std::make_unique<ServerConnector>(ServerEndpoint{.port = port}, patience)) {
  const auto joined = join_and_wait(client_, {protocol_version, "session test", eye_m, radius_m});
  if (!joined) failure = joined.error().message;
}

void SessionClient::note(const Client::Event& event, Tick before) {
  if (const auto* lost = std::get_if<Client::Lost>(&event)) failure = lost->end.message;
  const auto* applied = std::get_if<Client::Applied>(&event);
  if (applied == nullptr) return;
  const ServerMessage& message = applied->received.message;
  if (const auto* reply = std::get_if<ReplyMessage>(&message)) replies[reply->request] = *reply;
  if (const auto* frame = std::get_if<FrameMessage>(&message); frame != nullptr && frame->tick != before + 1)
    failure = "tick " + std::to_string(frame->tick) + " came after " + std::to_string(before);
}

bool SessionClient::follow_to(Tick tick) {
  const auto deadline = Clock::now() + patience;
  while (failure.empty() && mirror().tick() < tick) {
    if (Clock::now() > deadline) failure = "tick " + std::to_string(tick) + " does not come";
    client_.wait(100ms);
    client_.poll(steady_now_s());
    Tick before = mirror().tick();
    for (auto event = client_.next(); event && failure.empty(); event = client_.next()) {
      note(*event, before);
      before = mirror().tick();
    }
  }
  return failure.empty();
}

void SessionClient::abort() {
  static_cast<Connection&>(*client_.channel()).abort();
}

LoopbackSession::LoopbackSession(LiveConfig config) {
  config.net.port = 0;
  config.pacing = Pacing::by_hand;
  config.net.heartbeat_s = 0.0;  // clients follow to every tick
  auto started = LiveServer::start(config);
  if (!started) {
    failure = started.error().message;
    return;
  }
  server_ = std::move(*started);
}

SessionClient& LoopbackSession::join(glm::vec3 eye_m, float radius_m) {
  clients_.push_back(std::make_unique<SessionClient>(server_->port(), eye_m, radius_m));
  if (!clients_.back()->failure.empty()) failure = clients_.back()->failure;
  return *clients_.back();
}

void LoopbackSession::abort(const SessionClient& client) {
  const auto found = std::ranges::find(clients_, &client, &std::unique_ptr<SessionClient>::get);
  (*found)->abort();
  clients_.erase(found);
  const auto deadline = Clock::now() + patience;
  while (server_->report().net.sessions != clients_.size() && Clock::now() < deadline) wait_a_moment();
  if (server_->report().net.sessions != clients_.size()) failure = "the server does not notice the cut";
}

bool LoopbackSession::step() {
  if (!failure.empty()) return false;
  if (!server_->step_once()) {
    failure = "there is no tick after " + std::to_string(tick_);
    return false;
  }
  tick_ = server_->last_delta()->tick;
  for (const auto& client : clients_)
    if (!client->follow_to(tick_)) failure = client->failure;
  return failure.empty();
}

bool LoopbackSession::steps(int count) {
  for (int i = 0; i < count; ++i)
    if (!step()) return false;
  return true;
}

bool LoopbackSession::settle() {
  int calm = 0;
  for (int i = 0; i < settle_ticks_max && calm < calm_ticks; ++i) {
    if (!step()) return false;
    const auto delta = server_->last_delta();
    calm = delta->pieces.empty() && delta->operations.empty() ? calm + 1 : 0;
  }
  if (calm < calm_ticks)
    failure = std::to_string(server_->last_delta()->pieces.size()) + " pieces are alive after " +
              std::to_string(settle_ticks_max) + " ticks";
  return failure.empty();
}

const ReplyMessage* LoopbackSession::ask(SessionClient& client, const CarveMessage& carve) {
  client.send(carve);
  for (int i = 0; i < reply_ticks_max && !client.replies.contains(carve.request); ++i)
    if (!step()) return nullptr;
  const auto reply = client.replies.find(carve.request);
  if (reply != client.replies.end()) return &reply->second;
  failure = "request " + std::to_string(carve.request) + " is not answered";
  return nullptr;
}

}  // namespace scree
