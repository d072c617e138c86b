#include "studies/peers/viewers.h"

#include <chrono>

namespace scree {

namespace {

constexpr std::chrono::milliseconds look_every{5};
constexpr std::chrono::seconds join_within{20};

}  // namespace

Viewers::Viewers(uint16_t port, glm::vec3 eye_m, float interest_m)
    : hello_{protocol_version, "viewer", eye_m, interest_m} {
  server_.port = port;
  thread_ = std::thread([this] { run(); });
}

Viewers::~Viewers() {
  stopping_ = true;
  thread_.join();
}

Result<void> Viewers::add() {
  auto connected = Connection::connect(server_, hello_, join_within);
  if (!connected) return fail(connected.error().message);
  auto mirror = std::make_unique<Mirror>((*connected)->welcome());
  const std::lock_guard lock(mutex_);
  viewers_.push_back({std::move(*connected), std::move(mirror)});
  return {};
}

void Viewers::carve(const CarveRequest& request) {
  const std::lock_guard lock(mutex_);
  viewers_.front().connection->send(CarveMessage{request, ++requests_});
}

std::vector<uint64_t> Viewers::received_bytes() const {
  const std::lock_guard lock(mutex_);
  std::vector<uint64_t> bytes;
  for (const Viewer& viewer : viewers_) bytes.push_back(viewer.connection->counters().received_bytes);
  return bytes;
}

uint64_t Viewers::checks() const {
  const std::lock_guard lock(mutex_);
  uint64_t sum = 0;
  for (const Viewer& viewer : viewers_) sum += viewer.mirror->counters().checks;
  return sum;
}

uint64_t Viewers::mismatches() const {
  const std::lock_guard lock(mutex_);
  uint64_t sum = 0;
  for (const Viewer& viewer : viewers_) sum += viewer.mirror->mismatches();
  return sum;
}

std::string Viewers::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void Viewers::receive(Viewer& viewer, bool first) {
  for (const Received& received : viewer.connection->poll()) {
    if (const auto applied = viewer.mirror->apply(received.message); !applied)
      failure_ = applied.error().message;
    if (const auto* reply = std::get_if<ReplyMessage>(&received.message))
      refused_ += reply->refusal.empty() ? 0 : 1;
    if (const auto* status = std::get_if<StatusMessage>(&received.message); status != nullptr && first)
      pieces_ = status->pieces;
  }
}

void Viewers::run() {
  while (!stopping_) {
    std::this_thread::sleep_for(look_every);
    const std::lock_guard lock(mutex_);
    for (Viewer& viewer : viewers_) receive(viewer, &viewer == &viewers_.front());
  }
}

}  // namespace scree
