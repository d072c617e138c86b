#include "studies/peers/viewers.h"

#include <chrono>

#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr std::chrono::milliseconds look_every{5};
constexpr std::chrono::seconds join_within{20};

}  // namespace

Viewers::Viewers(uint16_t port, glm::vec3 eye_m, float interest_m)
    : port_(port), hello_{protocol_version, "viewer", eye_m, interest_m} {
  thread_ = std::thread([this] { run(); });
}

Viewers::~Viewers() {
  stopping_ = true;
  thread_.join();
}

Result<void> Viewers::add() {
  ServerEndpoint server;
  server.port = port_;
  auto viewer = std::make_unique<Client>(std::make_unique<ServerConnector>(server, join_within));
  if (const auto joined = join_and_wait(*viewer, hello_); !joined) return fail(joined.error().message);
  const std::lock_guard lock(mutex_);
  viewers_.push_back(std::move(viewer));
  return {};
}

void Viewers::carve(const CarveRequest& request) {
  const std::lock_guard lock(mutex_);
  viewers_.front()->send(CarveMessage{request, ++requests_});
}

std::vector<uint64_t> Viewers::received_bytes() const {
  const std::lock_guard lock(mutex_);
  std::vector<uint64_t> bytes;
  for (const auto& viewer : viewers_) bytes.push_back(viewer->counters().received_bytes);
  return bytes;
}

uint64_t Viewers::checks() const {
  const std::lock_guard lock(mutex_);
  uint64_t sum = 0;
  for (const auto& viewer : viewers_) sum += viewer->mirror()->counters().checks;
  return sum;
}

uint64_t Viewers::mismatches() const {
  const std::lock_guard lock(mutex_);
  uint64_t sum = 0;
  for (const auto& viewer : viewers_) sum += viewer->mirror()->mismatches();
  return sum;
}

std::string Viewers::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void Viewers::receive(Client& viewer, bool first) {
  viewer.poll(steady_now_s());
  while (const std::optional<Client::Event> event = viewer.next()) {
    if (const auto* lost = std::get_if<Client::Lost>(&*event)) failure_ = lost->end.message;
    const auto* applied = std::get_if<Client::Applied>(&*event);
    if (applied == nullptr) continue;
    if (const auto* reply = std::get_if<ReplyMessage>(&applied->received.message))
      refused_ += reply->refusal.empty() ? 0 : 1;
    if (const auto* status = std::get_if<StatusMessage>(&applied->received.message); status && first)
      pieces_ = status->pieces;
  }
}

void Viewers::run() {
  while (!stopping_) {
    std::this_thread::sleep_for(look_every);
    const std::lock_guard lock(mutex_);
    for (const auto& viewer : viewers_) receive(*viewer, viewer == viewers_.front());
  }
}

}  // namespace scree
