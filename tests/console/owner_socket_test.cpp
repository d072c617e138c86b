// The server's own socket for administrators: who comes in by it, and its file.
#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "client/admin/admin.h"
#include "server/doors/limits.h"
#include "server/doors/socket_file.h"
#include "tests/support/captured_log.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

constexpr const char* the_admin_token = "the-admin-token";
constexpr uid_t nobody = 65534;

class OwnerSocket : public NetServerTest {
 protected:
  void listen(const std::function<void(NetConfig&)>& change = {}) {
    start([&](NetConfig& config) {
      config.admin_socket = path;
      config.access.anonymous = Role::viewer;
      if (change) change(config);
    });
  }
  AdminServer owner() const {
    AdminServer owner;
    owner.socket = path;
    owner.within = patience;
    return owner;
  }
  std::unique_ptr<RawClient> connect() const { return std::make_unique<RawClient>(Route::to_file(path)); }
  std::unique_ptr<RawClient> join() const {
    auto client = connect();
    EXPECT_TRUE(client->send(hello()));
    const auto welcome = client->receive_as<WelcomeMessage>();
    EXPECT_TRUE(welcome && welcome->role == Role::admin);
    return client;
  }
  /// Why a server does not start with this socket; empty: it does.
  static std::string fault(const std::string& at) {
    SocketFile file;
    const auto listening = file.listen(at);
    if (!listening) return listening.error().message;
    ::close(*listening);
    return "";
  }
  /// A socket whose server was killed.
  static void leave_behind(const std::string& at) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{AF_UNIX, {}};
    at.copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(socket);
  }

  const TestFolder folder;
  const std::string path = folder / "admin.sock";
};

bool is_there(const std::string& path) {
  struct stat there {};
  return ::lstat(path.c_str(), &there) == 0;
}

TEST_F(OwnerSocket, makes_an_administrator_of_the_servers_user_without_a_token) {
  listen([](NetConfig& config) {
    config.admin_token = the_admin_token;
    config.access.anonymous = Role::viewer;
  });
  const auto sessions = list_sessions(owner());
  ASSERT_TRUE(sessions) << sessions.error().message;
  const auto found = std::ranges::find(*sessions, Role::admin, &SessionRow::role);
  ASSERT_NE(found, sessions->end());
  EXPECT_EQ(found->address, "unix:uid=" + std::to_string(::geteuid()));
  EXPECT_EQ(sessions->size(), 2U) << "the other is the witness";
  const auto health = read_health(owner());
  EXPECT_TRUE(health) << health.error().message;
  EXPECT_TRUE(ban_address(owner(), {0, "203.0.113.9", 1, ""}));
  expect_witness_unmoved();
}

TEST_F(OwnerSocket, a_token_that_comes_by_it_means_nothing) {
  listen([](NetConfig& config) { config.admin_token = the_admin_token; });
  const auto client = connect();
  HelloMessage with_token = hello();
  with_token.token = "another-token-than-the-servers";
  ASSERT_TRUE(client->send(with_token));
  const auto welcome = client->receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome);
  EXPECT_EQ(welcome->role, Role::admin);
}

TEST_F(OwnerSocket, its_session_cannot_be_banned_by_its_address) {
  listen();
  const auto client = join();
  const auto sessions = list_sessions(owner());
  ASSERT_TRUE(sessions);
  for (const SessionRow& row : *sessions) {
    if (row.role != Role::admin) continue;
    const auto banned = ban_address(owner(), {row.session, "", 1, ""});
    ASSERT_FALSE(banned);
    EXPECT_TRUE(holds(banned.error().message, "is not an IPv4 or IPv6 address") ||
                holds(banned.error().message, "there is no session"))
        << banned.error().message;
  }
  EXPECT_TRUE(list_sessions(owner()));
}

TEST_F(OwnerSocket, comes_in_though_all_places_of_administrators_are_taken) {
  listen([](NetConfig& config) { config.admin_token = the_admin_token; });
  std::vector<std::unique_ptr<RawClient>> others;
  for (size_t i = 0; i < limits::administrators_max; ++i) {
    others.push_back(std::make_unique<RawClient>(server->port()));
    HelloMessage with_token = hello();
    with_token.token = the_admin_token;
    ASSERT_TRUE(others.back()->send(with_token));
    ASSERT_TRUE(others.back()->receive_as<WelcomeMessage>());
  }
  EXPECT_TRUE(list_sessions(owner()));
  HelloMessage one_more = hello();
  one_more.token = the_admin_token;
  RawClient refused(server->port());
  ASSERT_TRUE(refused.send(one_more));
  EXPECT_TRUE(refused.receive_as<RefusalMessage>()) << "the owner's took no place of theirs";
}

TEST_F(OwnerSocket, holds_a_few_connections_and_the_idlest_goes_for_the_next) {
  listen();
  std::vector<std::unique_ptr<RawClient>> held;
  for (size_t i = 0; i < limits::owner_connections_max; ++i) {
    held.push_back(join());
    std::this_thread::sleep_for(milliseconds(2));  // so that one is the idlest
  }
  const auto next = join();
  const auto refusal = held.front()->receive_as<RefusalMessage>();
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->name, "idle_made_room");
  EXPECT_TRUE(held.front()->closed_within(seconds(10)));
  ASSERT_TRUE(held.back()->send(AdminMessage{1, "", ListBansRequest{}}));
  EXPECT_TRUE(held.back()->receive_as<AdminListMessage>());
  expect_witness_unmoved();
}

TEST_F(OwnerSocket, a_crowd_that_does_not_close_is_closed) {
  const CapturedLog log;
  listen();
  std::vector<std::unique_ptr<RawClient>> crowd;
  for (size_t i = 0; i < 100; ++i) crowd.push_back(connect());
  await(*server, &NetStats::turned_away, uint64_t{50});
  expect_witness_unmoved();
  crowd.clear();
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!list_sessions(owner()) && std::chrono::steady_clock::now() < end) wait_a_moment();
  EXPECT_TRUE(list_sessions(owner()));
  server->stop();
  EXPECT_LE(log.count("too many connections by the admin socket"), 20U);
}

TEST_F(OwnerSocket, limits_hold_for_it_too) {
  listen();
  const auto client = join();
  const std::vector<uint8_t> ack = encode(ClientMessage(AckMessage{1}));
  std::vector<uint8_t> flood;
  for (int i = 0; i < 5000; ++i) flood.insert(flood.end(), ack.begin(), ack.end());
  client->send_bytes(flood);
  const auto refusal = client->receive_as<RefusalMessage>();
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->name, "messages_per_second");
  expect_witness_unmoved();
}

TEST_F(OwnerSocket, garbage_is_refused_and_nobody_else_notices) {
  listen([](NetConfig& config) { config.hello_seconds = 1.0; });
  const uint32_t seed = 20261130;
  std::mt19937 random(seed);
  const std::vector<uint8_t> whole = encode(ClientMessage(hello()));
  std::vector<std::vector<uint8_t>> inputs{
      {'G', 'E', 'T', ' ', '/', ' ', 'H', 'T', 'T', 'P', '/', '1', '.', '1', '\r', '\n', '\r', '\n'},
      {0x16, 0x03, 0x01, 0x02, 0x00, 0x01, 0x00, 0x01, 0xFC, 0x03, 0x03},
      {0xFF, 0xFF, 0xFF, 0xFF, 1, 2, 3},
      {0, 0, 0, 0},
      {}};
  for (size_t i = 0; i < whole.size(); i += 5) inputs.emplace_back(whole.begin(), whole.begin() + i);
  for (int i = 0; i < 100; ++i) {
    std::vector<uint8_t> bytes(random() % 300);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    inputs.push_back(bytes);
  }
  for (const std::vector<uint8_t>& input : inputs) {
    const auto client = connect();
    if (!client->connected()) continue;
    client->send_bytes(input);
    client->finish_sending();
    EXPECT_TRUE(client->closed_within(seconds(10))) << "seed " << seed;
  }
  const auto garbled = join();
  garbled->send_bytes(inputs.back());
  expect_witness_unmoved();
  EXPECT_TRUE(list_sessions(owner()));
}

/// A child of another user connects; how many bytes it reads before the end of the stream, 255: it cannot
/// connect.
int read_as_nobody(const std::string& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::setgid(nobody) != 0 || ::setuid(nobody) != 0) ::_exit(254);
    RawClient client(Route::to_file(path));
    if (!client.connected()) ::_exit(255);
    client.send(hello());
    ::_exit(client.receive(seconds(10)) ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(OwnerSocket, other_users_are_kept_out_by_the_file_and_by_who_they_are) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  const CapturedLog log;
  listen();
  EXPECT_EQ(read_as_nobody(path), 255) << "the file's mode";
  ::chmod(path.c_str(), 0666);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(read_as_nobody(path), 0) << "nothing is said to a stranger";
  await(*server, &NetStats::turned_away, uint64_t{20});
  EXPECT_TRUE(list_sessions(owner()));
  server->stop();
  EXPECT_GE(log.count("the user 65534 is neither the server's nor root"), 1U);
  EXPECT_LT(log.count("the user 65534 is neither the server's nor root"), 20U);
}

TEST_F(OwnerSocket, its_file_is_its_owners_alone_and_goes_with_the_server) {
  const mode_t before = ::umask(0);
  listen();
  ::umask(before);
  struct stat there {};
  ASSERT_EQ(::lstat(path.c_str(), &there), 0);
  EXPECT_TRUE(S_ISSOCK(there.st_mode));
  EXPECT_EQ(there.st_mode & 07777, 0600U);
  server->stop();
  EXPECT_FALSE(is_there(path));
}

TEST_F(OwnerSocket, what_a_killed_server_left_is_replaced) {
  leave_behind(path);
  listen();
  EXPECT_TRUE(list_sessions(owner()));
}

TEST_F(OwnerSocket, a_live_socket_and_any_other_file_stay_and_are_named) {
  listen();
  EXPECT_TRUE(holds(fault(path), "another server listens there"));
  EXPECT_TRUE(list_sessions(owner())) << "it goes on";
  std::ofstream(folder / "file") << "text";
  EXPECT_TRUE(holds(fault(folder / "file"), "a file is there that is no socket"));
  EXPECT_EQ(std::filesystem::file_size(folder / "file"), 4U);
  std::filesystem::create_symlink(path, folder / "link");
  EXPECT_TRUE(holds(fault(folder / "link"), "a file is there that is no socket"));
  EXPECT_TRUE(holds(fault(folder / "no/such.sock"), "No such file"));
  EXPECT_TRUE(holds(fault("/" + std::string(200, 'x')), "at most 107 bytes"));
  EXPECT_TRUE(holds(fault(folder / "file/below"), "Not a directory"));
  EXPECT_EQ(fault(folder / "other.sock"), "");
}

TEST_F(OwnerSocket, a_file_that_took_its_place_stays) {
  listen();
  ASSERT_EQ(::unlink(path.c_str()), 0);
  std::ofstream(path) << "another's";
  server->stop();
  EXPECT_TRUE(is_there(path));
}

TEST_F(OwnerSocket, a_server_that_cannot_have_it_does_not_start) {
  std::ofstream(path) << "text";
  NetConfig config;
  config.terrain = flat_terrain;
  config.admin_socket = path;
  const auto listening = NetServer::listen(config, commands, source.keyframe());
  ASSERT_FALSE(listening);
  EXPECT_EQ(listening.error().message,
            "cannot listen on " + path + ": a file is there that is no socket (--admin-socket)");
}

TEST_F(OwnerSocket, a_client_says_why_it_cannot_come_in) {
  EXPECT_TRUE(holds(list_sessions(owner()).error().message, "does a server with this --admin-socket run?"));
  leave_behind(path);
  EXPECT_TRUE(holds(list_sessions(owner()).error().message, path + ": cannot connect: Connection refused"));
  AdminServer too_long = owner();
  too_long.socket = "/" + std::string(200, 'x');
  EXPECT_TRUE(holds(list_sessions(too_long).error().message, "at most 107 bytes"));
  EXPECT_TRUE(holds(read_health(too_long).error().message, "at most 107 bytes"));
}

}  // namespace
}  // namespace scree
