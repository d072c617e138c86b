#include "bench/wire/askers.h"

#include <cmath>
#include <cstring>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <optional>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bench/support/scenes.h"
#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Tags of ServerMessage's kinds (proto/scree.proto).
constexpr uint8_t frame_tag = 0x1A, reply_tag = 0x3A;

template <typename Message>
bool send_all(int socket, const Message& message) {
  const std::vector<uint8_t> bytes = encode(ClientMessage(message));
  return ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

}  // namespace

struct Askers::Viewer {
  int socket = -1;
  glm::vec3 place_m{0.0F};
  double next_s = 0.0;  ///< its next turn; before the start: after the start
  FrameReader reader;
  uint32_t requests = 0;
  uint32_t random_seed = 0;  ///< of its last carve
  double sent_s = 0.0;
  bool unseen = false;  ///< the last carve's operation has not come
  bool unanswered = false;
  bool counted = false;
  glm::vec3 towards{1.0F, 0.0F, 0.0F};  ///< it walks, of unit length
  double walked_s = 0.0;                ///< when it took its last step
};

Askers::Askers(const AskersConfig& config) : config_(config), epoll_(epoll_create1(0)) {}

Askers::~Askers() {
  stop();
  for (const auto& viewer : viewers_)
    if (viewer->socket >= 0) close(viewer->socket);
  close(epoll_);
}

/// On the ground.
glm::vec3 Askers::place_m(size_t viewer) {
  glm::vec3 at_m{0.0F};
  if (config_.apart_m > 0.0F) {
    const auto side = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(config_.viewers))));
    const auto along = [&](size_t step) {
      return (static_cast<float>(step) - 0.5F * static_cast<float>(side - 1)) * config_.apart_m;
    };
    at_m = {along(viewer % side), 0.0F, along(viewer / side)};
  } else {
    const auto around = [&] { return (random_.unit() * 2.0F - 1.0F) * config_.spread_m; };
    at_m = {around(), 0.0F, around()};
  }
  at_m.y = ground_height_m(config_.terrain, at_m.x, at_m.z);
  return at_m;
}

Result<std::unique_ptr<Askers>> Askers::connect(const AskersConfig& config) {
  std::unique_ptr<Askers> askers(new Askers(config));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(config.port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (size_t i = 0; i < config.viewers; ++i) {
    auto viewer = std::make_unique<Viewer>();
    viewer->place_m = askers->place_m(i);
    viewer->next_s = config.seconds_per_carve * static_cast<double>(askers->random_.unit());
    viewer->socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int on = 1;
    setsockopt(viewer->socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const HelloMessage hello{protocol_version, "asker", viewer->place_m, config.interest_m};
    if (viewer->socket < 0 ||
        ::connect(viewer->socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0 ||
        !send_all(viewer->socket, hello))
      return fail(std::string("a viewer cannot connect: ") + std::strerror(errno));
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    epoll_ctl(askers->epoll_, EPOLL_CTL_ADD, viewer->socket, &event);
    askers->viewers_.push_back(std::move(viewer));
  }
  return askers;
}

void Askers::start() {
  CHECK(!thread_.joinable());
  thread_ = std::thread([this] { run(); });
}

void Askers::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

/// Turns come at their times whatever the server and this thread do.
void Askers::begin_turn(Viewer& viewer) {
  viewer.next_s += config_.seconds_per_carve * (0.5 + static_cast<double>(random_.unit()));
  if (config_.carves_max != 0 && asked_ == config_.carves_max) return;
  const bool counted = counting_;
  if (counted) ++times_.turns;
  if (viewer.unanswered) return;  // an honest person waits
  ++asked_;
  const float around_m = config_.anywhere ? config_.spread_m : 6.0F;
  const auto near = [&](float at_m) {
    return (config_.anywhere ? 0.0F : at_m) + (random_.unit() * 2.0F - 1.0F) * around_m;
  };
  viewer.random_seed = random_.next();
  const CarveRequest blow = blow_at(config_.terrain, near(viewer.place_m.x), near(viewer.place_m.z),
                                    config_.radius_m, config_.seeds, viewer.random_seed);
  viewer.counted = counted;
  viewer.unseen = viewer.unanswered = true;
  viewer.sent_s = steady_now_s();
  if (!send_all(viewer.socket, CarveMessage{blow, ++viewer.requests})) return lose(viewer);
  if (!counted) return;
  ++times_.asked;
  ++counted_open_;
}

/// Ten steps a second; at the edge it turns back.
void Askers::walk(Viewer& viewer, double now_s) {
  constexpr double seconds_per_step = 0.1;
  if (config_.speed_m_s <= 0.0F || now_s < viewer.walked_s + seconds_per_step) return;
  viewer.walked_s = now_s;
  glm::vec3& at_m = viewer.place_m;
  at_m += viewer.towards * config_.speed_m_s * static_cast<float>(seconds_per_step);
  if (std::abs(at_m.x) > config_.spread_m) viewer.towards.x = at_m.x > 0.0F ? -1.0F : 1.0F;
  at_m.y = ground_height_m(config_.terrain, at_m.x, at_m.z);
  if (!send_all(viewer.socket, InterestMessage{at_m, config_.interest_m})) lose(viewer);
}

/// False when it cannot be decoded. Decodes what tells of the viewer's own carve, and nothing else.
bool Askers::receive(Viewer& viewer, std::span<const uint8_t> body, double now_s) {
  const bool wanted = !body.empty() && (body[0] == reply_tag || (body[0] == frame_tag && viewer.unseen));
  if (!wanted) return true;
  const auto message = decode_server(body);
  if (!message) return false;
  const double ms = (now_s - viewer.sent_s) * 1000.0;
  if (const auto* reply = std::get_if<ReplyMessage>(&*message)) {
    viewer.unanswered = false;
    ++answered_;
    if (!reply->refusal.empty()) viewer.unseen = false;
    if (!viewer.counted) return true;
    --counted_open_;
    times_.reply.push_back({ms, reply->latency});
    times_.refused += reply->refusal.empty() ? 0 : 1;
    return true;
  }
  for (const Operation& operation : std::get<FrameMessage>(*message).operations) {
    const auto* carve = std::get_if<CarveOperation>(&operation);
    if (carve == nullptr || !viewer.unseen || carve->random_seed != viewer.random_seed) continue;
    viewer.unseen = false;
    if (viewer.counted) times_.applied.push_back(ms);
  }
  return true;
}

void Askers::lose(Viewer& viewer) {
  ++lost_;
  epoll_ctl(epoll_, EPOLL_CTL_DEL, viewer.socket, nullptr);
  close(viewer.socket);
  viewer.socket = -1;
}

void Askers::run() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);  // they stand for machines of their own
  std::vector<epoll_event> events(256);
  std::vector<uint8_t> buffer(size_t{64} << 10U);
  const double start_s = steady_now_s();
  for (const auto& viewer : viewers_) viewer->next_s += start_s;
  while (!stopping_) {
    const int ready = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), 1);
    for (int i = 0; i < ready; ++i) {
      Viewer& viewer = *viewers_[events[static_cast<size_t>(i)].data.u64];
      const ssize_t got = recv(viewer.socket, buffer.data(), buffer.size(), MSG_DONTWAIT);
      const double now_s = steady_now_s();
      if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      bool sound = got > 0;
      if (sound) viewer.reader.push(std::span<const uint8_t>(buffer.data(), static_cast<size_t>(got)));
      while (sound) {
        const auto body = viewer.reader.next();
        sound = body.has_value() && (!body->has_value() || receive(viewer, **body, now_s));
        if (!sound || !body->has_value()) break;
      }
      if (!sound) lose(viewer);
    }
    const double now_s = steady_now_s();
    for (const auto& viewer : viewers_)
      if (viewer->socket >= 0) walk(*viewer, now_s);
    for (const auto& viewer : viewers_)
      if (viewer->socket >= 0 && now_s >= viewer->next_s) begin_turn(*viewer);
    finished_ = (config_.carves_max != 0 && answered_ == config_.carves_max) || lost_ == viewers_.size();
  }
}

}  // namespace scree
