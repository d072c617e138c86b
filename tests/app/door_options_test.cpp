// The options by which an operator says who may come in: proxies, limits of addresses, and the admin token
// that a first start makes.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sys/stat.h>

#include "auth/new_secret.h"
#include "server/app/server_options.h"
#include "shared/base/token.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

/// The exit code where there is nothing to run.
std::variant<ServerOptions, int> options_of(std::vector<std::string> words) {
  words.insert(words.begin(), "scree-server");
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  return parse_server_options(static_cast<int>(arguments.size()), arguments.data());
}

NetConfig net_of(const std::vector<std::string>& words) {
  const auto options = options_of(words);
  EXPECT_TRUE(std::holds_alternative<ServerOptions>(options));
  return std::holds_alternative<ServerOptions>(options) ? std::get<ServerOptions>(options).live.net
                                                        : NetConfig();
}

bool is_refused(const std::vector<std::string>& words) {
  const auto options = options_of(words);
  return std::holds_alternative<int>(options) && std::get<int>(options) == 2;
}

TEST(DoorOptions, name_the_owners_socket_which_is_no_other_file) {
  EXPECT_EQ(net_of({}).admin_socket, "");
  EXPECT_EQ(net_of({"--admin-socket", "s"}).admin_socket, "s");
  EXPECT_TRUE(is_refused({"--admin-socket", ""}));
  EXPECT_TRUE(is_refused({"--admin-socket", "s", "--world", "s"}));
}

TEST(DoorOptions, name_the_proxies_and_the_limits_of_an_address) {
  const NetConfig net = net_of({"--proxy", "10.0.0.0/8", "--proxy", "::1", "--connections-per-address", "200",
                                "--connects-per-second", "25"});
  EXPECT_TRUE(net.proxies.contains("10.1.2.3") && net.proxies.contains("::1"));
  EXPECT_FALSE(net.proxies.contains("127.0.0.1"));
  EXPECT_EQ(net.door.connections_max, 200U);
  EXPECT_EQ(net.door.connects_per_second, 25.0);
  EXPECT_EQ(net.door.connects_burst, 200.0) << "who may hold many may open them at once";
  EXPECT_TRUE(net_of({}).proxies.empty());
  EXPECT_EQ(net_of({"--connections-per-address", "4"}).door.connects_burst, limits::connects_burst_max);
  EXPECT_TRUE(is_refused({"--proxy", "my-proxy"}));
  EXPECT_TRUE(is_refused({"--proxy", "10.0.0.0/40"}));
  EXPECT_TRUE(is_refused({"--connections-per-address", "0"}));
}

TEST(DoorOptions, set_the_budgets_of_bytes_in_megabytes_a_second) {
  const NetConfig usual = net_of({});
  EXPECT_EQ(usual.bytes_out.per_address, limits::bytes_out_per_address);
  EXPECT_EQ(usual.bytes_out.all, limits::bytes_out_all);
  const NetConfig net = net_of({"--bytes-out", "0", "--bytes-out-per-address", "1.5"});
  EXPECT_EQ(net.bytes_out.per_address, 1.5e6);
  EXPECT_EQ(net.bytes_out.all, 0.0);
  EXPECT_TRUE(is_refused({"--bytes-out", "-1"}));
  EXPECT_TRUE(is_refused({"--bytes-out-per-address", "1000000"}));
}

TEST(DoorOptions, make_an_admin_token_once_that_only_the_owner_reads) {
  const TestFolder folder;
  const std::string file = folder / "admin.token";
  EXPECT_TRUE(is_refused({"--make-admin-token"})) << "in no file";
  const auto first = options_of({"--admin-token-file", file, "--make-admin-token"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(first));
  const auto& options = std::get<ServerOptions>(first);
  EXPECT_EQ(options.token_made, file);
  EXPECT_GE(options.live.net.admin_token.size(), 22U);
  EXPECT_EQ(read_token(file).value(), options.live.net.admin_token);
  struct stat is {};
  ASSERT_EQ(::stat(file.c_str(), &is), 0);
  EXPECT_EQ(is.st_mode & 0777U, 0600U);
  const auto second = options_of({"--admin-token-file", file, "--make-admin-token"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(second));
  EXPECT_EQ(std::get<ServerOptions>(second).token_made, "");
  EXPECT_EQ(std::get<ServerOptions>(second).live.net.admin_token, options.live.net.admin_token);
  EXPECT_FALSE(write_new_secret(file)) << "it is there";
  EXPECT_TRUE(is_refused({"--admin-token-file", folder / "none/admin.token", "--make-admin-token"}));
  std::ofstream(folder / "access") << "scree1." << std::string(100, 'x') << "\n";
  EXPECT_TRUE(is_refused({"--admin-token-file", folder / "access"})) << "an access token is no admin token";
  std::ofstream(folder / "empty") << "";
  EXPECT_TRUE(is_refused({"--admin-token-file", folder / "empty", "--make-admin-token"}))
      << "it is somebody's";
}

TEST(DoorOptions, new_secrets_differ_and_begin_with_a_letter) {
  const TestFolder folder;
  std::set<std::string> secrets;
  for (int i = 0; i < 50; ++i) {
    const std::string file = folder / std::to_string(i);
    ASSERT_TRUE(write_new_secret(file));
    const std::string secret = read_token(file).value();
    EXPECT_EQ(secret.front(), 'A');
    secrets.insert(secret);
  }
  EXPECT_EQ(secrets.size(), 50U);
}

TEST(DoorOptions, files_that_cannot_be_used_are_refused_with_the_reason) {
  const TestFolder folder;
  const auto words_for = [](const std::vector<std::string>& words) {
    ::testing::internal::CaptureStderr();
    EXPECT_TRUE(is_refused(words));
    return ::testing::internal::GetCapturedStderr();
  };
  const std::string missing = words_for({"--admin-token-file", folder / "none"});
  EXPECT_TRUE(holds(missing, "none cannot be read: No such file or directory")) << missing;
  EXPECT_TRUE(holds(missing, "--make-admin-token makes it")) << missing;
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  const std::string loop = words_for({"--admin-token-file", folder / "loop"});
  EXPECT_TRUE(holds(loop, "loop cannot be read: Too many levels of symbolic links")) << loop;
  EXPECT_FALSE(holds(loop, "--make-admin-token")) << loop;
  const std::string bans = words_for({"--bans", folder / "none/bans.txt"});
  EXPECT_TRUE(holds(bans, "--bans: bans cannot be kept")) << bans;
  EXPECT_TRUE(holds(bans, "No such file or directory")) << bans;
  const std::string kept = folder / "bans.txt";
  EXPECT_EQ(net_of({"--bans", kept}).access.bans_path, kept);
  EXPECT_FALSE(std::filesystem::exists(kept + ".new")) << "nothing is left behind";
}

}  // namespace
}  // namespace scree
