// What a service manager hears of a server: the program's notices on its socket, and pulses that end where
// the simulation stands still.
#include <array>
#include <atomic>
#include <csignal>
#include <gtest/gtest.h>
#include <mutex>
#include <sys/socket.h>
#include <sys/un.h>

#include "server/app/live_server.h"
#include "tests/support/background_program.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

/// As systemd listens.
class NoticeSocket {
 public:
  explicit NoticeSocket(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0) << path;
    const timeval most{patience.count(), 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  }
  ~NoticeSocket() { ::close(socket_); }
  NoticeSocket(const NoticeSocket&) = delete;
  NoticeSocket& operator=(const NoticeSocket&) = delete;

  /// The next notice that begins so; empty: none has come.
  std::string next(const std::string& begin) const {
    std::array<char, 512> buffer{};
    for (;;) {
      const ssize_t size = ::recv(socket_, buffer.data(), buffer.size(), 0);
      if (size <= 0) return {};
      if (std::string said(buffer.data(), static_cast<size_t>(size)); said.starts_with(begin)) return said;
    }
  }

 private:
  int socket_;
};

TEST(ServiceNotice, the_program_says_that_it_is_ready_lives_reads_again_and_stops) {
  const TestFolder folder;
  const NoticeSocket socket(folder / "notify");
  const BackgroundProgram server({"env", "NOTIFY_SOCKET=" + (folder / "notify"), SCREE_SERVER_PROGRAM,
                                  "--port", "0", "--terrain", "flat"},
                                 folder / "said");
  EXPECT_EQ(socket.next("READY=1"), "READY=1");
  const std::string pulse = socket.next("WATCHDOG=1");
  EXPECT_TRUE(holds(pulse, "\nSTATUS=tick ")) << pulse;
  EXPECT_TRUE(holds(pulse, ", 0 sessions, ")) << pulse;
  ::kill(server.number(), SIGHUP);
  const std::string reloading = socket.next("RELOADING=1");
  EXPECT_TRUE(holds(reloading, "\nMONOTONIC_USEC=")) << reloading;
  EXPECT_EQ(socket.next("READY=1"), "READY=1") << "also where a file was wrong: the old values stay in force";
  ::kill(server.number(), SIGTERM);
  EXPECT_TRUE(holds(socket.next("STOPPING=1"), "STATUS=")) << "before the world is saved";
}

TEST(ServiceNotice, a_simulation_that_stands_still_has_no_pulse) {
  std::mutex gate;
  std::unique_lock still(gate, std::defer_lock);
  std::atomic<uint64_t> pulses = 0;
  LiveConfig config;
  config.world.terrain = flat_terrain;
  config.sim_threads = 1;
  config.still_seconds = 0.3;
  config.hooks.before = [&](const World&, TickCommands&) { const std::scoped_lock pass(gate); };
  config.pulse = [&](const LivePulse& pulse) { pulses += pulse.tick > 0 ? 1 : 0; };
  auto server = LiveServer::start(config);
  ASSERT_TRUE(server) << server.error().message;
  const auto one_more = [&](double seconds) {
    const uint64_t before = pulses;
    for (const Within within(seconds); pulses == before && !within.over();) wait_a_moment();
    return pulses > before;
  };
  EXPECT_TRUE(one_more(60.0));
  still.lock();
  while (one_more(3.0)) {  // those that were due before
  }
  still.unlock();
  EXPECT_TRUE(one_more(60.0));
}

}  // namespace
}  // namespace scree
