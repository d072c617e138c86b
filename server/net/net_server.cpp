#include "server/net/net_server.h"

#include <asio/post.hpp>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <thread>
#include <utility>

#include "server/net/net_host.h"
#include "shared/base/check.h"

namespace scree {

struct NetServer::Impl {
  Impl(const NetConfig& net, CommandQueue& commands) : config(net), host(net, commands) {}

  /// Hands a job to the network thread; waits while too many wait there. Nothing happens after stop().
  /// `more`: another one waits behind it.
  void post(std::function<void(bool more)> job);

  const NetConfig config;
  NetHost host;
  std::thread thread;
  std::mutex mutex;
  std::condition_variable taken;
  Tick published = 0;    ///< the last tick; used by the simulation's thread
  size_t in_flight = 0;  ///< guarded by mutex
  bool stopped = false;  ///< guarded by mutex
  std::atomic<uint64_t> waits{0};
  NetLoad load;  ///< guarded by mutex
};

NetServer::NetServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

NetServer::~NetServer() {
  stop();
}

Result<std::unique_ptr<NetServer>> NetServer::listen(const NetConfig& config, CommandQueue& commands,
                                                     TickDelta keyframe) {
  auto impl = std::make_unique<Impl>(config, commands);
  TRY(impl->host.listen());
  impl->published = keyframe.tick;
  // The network thread runs this first, so nobody can join before it.
  impl->post([host = &impl->host, world = std::move(keyframe)](bool) { host->begin(world); });
  impl->thread = std::thread([host = &impl->host] { host->run(); });
  return std::unique_ptr<NetServer>(new NetServer(std::move(impl)));
}

uint16_t NetServer::port() const {
  return impl_->host.port();
}

void NetServer::Impl::post(std::function<void(bool more)> job) {
  {
    std::unique_lock lock(mutex);
    if (in_flight >= limits::deltas_in_flight_max) ++waits;
    taken.wait(lock, [&] { return stopped || in_flight < limits::deltas_in_flight_max; });
    if (stopped) return;
    ++in_flight;
  }
  asio::post(host.context(), [this, job = std::move(job)] {
    size_t now_in_flight = 0;
    {
      const std::scoped_lock lock(mutex);
      now_in_flight = in_flight;
    }
    job(now_in_flight > 1);
    {
      const std::scoped_lock lock(mutex);
      CHECK(in_flight > 0 && in_flight <= limits::deltas_in_flight_max);
      --in_flight;
    }
    taken.notify_all();
  });
}

void NetServer::publish(std::shared_ptr<const TickDelta> delta, const TickSpan& span) {
  CHECK(delta != nullptr);
  if (!impl_->config.replay)
    CHECK_EQ(delta->tick, impl_->published + 1,
             "publish every tick, in order: clients hold the world by its changes");
  impl_->published = delta->tick;
  impl_->post([impl = impl_.get(), delta = std::move(delta), span, posted_s = steady_now_s()](bool more) {
    const double taken_s = steady_now_s(), cpu_s = thread_cpu_s();
    impl->host.publish(*delta, span, more);
    const auto ms = [](double seconds) { return static_cast<float>(1e3 * seconds); };
    const NetLoad load{ms(taken_s - posted_s), ms(steady_now_s() - taken_s), ms(thread_cpu_s() - cpu_s)};
    const std::scoped_lock lock(impl->mutex);
    if (load.lag_ms + load.busy_ms >= impl->load.lag_ms + impl->load.busy_ms) impl->load = load;
  });
}

NetLoad NetServer::load() const {
  const std::scoped_lock lock(impl_->mutex);
  return std::exchange(impl_->load, NetLoad{});
}

Result<void> NetServer::reload() {
  auto access = Access::load(impl_->config.access, impl_->config.admin_token);
  TRY(access);
  auto files = web_files(impl_->config.web);
  TRY(files);
  asio::post(impl_->host.context(), [host = &impl_->host, access = std::move(*access), files = *files] {
    host->set_access(access);
    host->set_files(files);
  });
  return {};
}

void NetServer::send(uint64_t session, ServerMessage message) {
  asio::post(impl_->host.context(),
             [host = &impl_->host, session, message = std::move(message)] { host->send(session, message); });
}

void NetServer::set_role(uint64_t session, Role role) {
  asio::post(impl_->host.context(), [host = &impl_->host, session, role] { host->set_role(session, role); });
}

void NetServer::kick(uint64_t session, std::string reason) {
  asio::post(impl_->host.context(),
             [host = &impl_->host, session, reason = std::move(reason)] { host->kick(session, reason); });
}

void NetServer::set_own_store(uint64_t session, uint64_t of_session) {
  asio::post(impl_->host.context(),
             [host = &impl_->host, session, of_session] { host->set_own_store(session, of_session); });
}

void NetServer::post(std::function<void()> job) {
  asio::post(impl_->host.context(), std::move(job));
}

void NetServer::enter(std::shared_ptr<Transport> transport) {
  impl_->host.enter_apart(std::move(transport));
}

void NetServer::flush() {
  impl_->post([host = &impl_->host](bool) { host->flush(); });
  std::unique_lock lock(impl_->mutex);
  impl_->taken.wait(lock, [&] { return impl_->stopped || impl_->in_flight == 0; });
}

NetStats NetServer::stats() const {
  NetStats stats = impl_->host.figures().stats();
  stats.publish_waits = impl_->waits;
  return stats;
}

LatencyCounts NetServer::latency() const {
  return impl_->host.figures().latency();
}

std::vector<glm::vec3> NetServer::eyes_m() const {
  return impl_->host.figures().eyes_m();
}

std::vector<PlayerCursor> NetServer::cursors() const {
  return impl_->host.figures().cursors();
}

bool NetServer::wants_physics() const {
  return impl_->host.figures().wants_physics();
}

void NetServer::stop() {
  if (impl_->thread.joinable()) {
    asio::post(impl_->host.context(), [host = &impl_->host] { host->shut_down(); });
    impl_->thread.join();
  }
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->stopped = true;
  }
  impl_->taken.notify_all();
}

}  // namespace scree
