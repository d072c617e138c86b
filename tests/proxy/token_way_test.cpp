// Tokens of clients on their way to another machine: without TLS no byte of one leaves, whichever program it
// is, until the person insists. To this machine they go as they are. The other machine is a bare listener on
// an address that is not loopback, in a network of this process' own.
#include <gtest/gtest.h>

#include "client/cache/join_server.h"
#include "client/connection/come_again.h"
#include "client/connection/connection.h"
#include "client/session/join_and_wait.h"
#include "tests/proxy/proxy_fixture.h"
#include "tests/support/certificates.h"
#include "tests/support/raw_server.h"
#include "tests/support/run_program.h"

namespace scree {
namespace {

constexpr const char* the_secret = "a-secret-that-nobody-may-read";

class TokenWayTest : public ProxyTest {
 protected:
  static ServerEndpoint endpoint(const RawServer& server, const std::string& host) {
    ServerEndpoint endpoint;
    endpoint.host = host;
    endpoint.port = server.port();
    endpoint.token = the_secret;
    return endpoint;
  }
  static ConnectionEnd connect(const ServerEndpoint& to) {
    const auto connected = Connection::connect(to, hello(), milliseconds(500));
    return connected ? ConnectionEnd() : connected.error();
  }
  /// What a program says that is to fail.
  static std::string run(const std::string& program, const RawServer& server, const std::string& arguments) {
    const auto [code, said] = run_program(program + " --port " + std::to_string(server.port()) + " --host " +
                                          proxy_address + " --token " + the_secret + " " + arguments);
    EXPECT_GT(code, 0) << program << said;
    return said;
  }
};

TEST_F(TokenWayTest, no_byte_goes_to_another_machine_in_the_clear) {
  RawServer other(proxy_address.c_str());
  const ConnectionEnd end = connect(endpoint(other, proxy_address));
  EXPECT_EQ(end.refusal, token_in_clear);
  EXPECT_FALSE(may_come_again(end.refusal)) << "trying again changes nothing";
  EXPECT_TRUE(holds(end.message, "--tls") && holds(end.message, "--insecure-token")) << end.message;
  Client client(std::make_unique<ServerConnector>(endpoint(other, proxy_address), milliseconds(500)));
  EXPECT_FALSE(join_and_wait(client, hello()));
  EXPECT_EQ(other.all_sent(), "");
}

TEST_F(TokenWayTest, it_goes_where_the_person_insists_and_on_this_machine) {
  RawServer other(proxy_address.c_str()), here;
  ServerEndpoint insists = endpoint(other, proxy_address);
  insists.insecure_token = true;
  EXPECT_EQ(connect(insists).refusal, "");
  EXPECT_TRUE(holds(other.all_sent(), the_secret));
  for (const char* name : {"127.0.0.1", "localhost", "::ffff:127.0.0.1"}) {
    EXPECT_EQ(connect(endpoint(here, name)).refusal, "") << name;
    EXPECT_TRUE(holds(here.all_sent(), the_secret)) << name;
  }
  ServerEndpoint without = endpoint(other, proxy_address);
  without.token.clear();
  EXPECT_EQ(connect(without).refusal, "");
  EXPECT_TRUE(holds(other.all_sent(), "test")) << "a hello without a token is no secret";
}

TEST_F(TokenWayTest, by_tls_it_goes_as_before) {
  const TestCertificate certificate("IP:" + proxy_address);
  certificate.write(files / "certificate", files / "key");
  start([&](NetConfig& config) {
    config.bind = "0.0.0.0";
    config.access.tls_certificate_path = files / "certificate";
    config.access.tls_key_path = files / "key";
    config.admin_token = the_secret;
  });
  ServerEndpoint by_tls;
  by_tls.host = proxy_address;
  by_tls.port = server->port();
  by_tls.token = the_secret;
  EXPECT_EQ(connect(by_tls).refusal, token_in_clear) << "the server has TLS, and nobody asked for it";
  by_tls.tls = true;
  by_tls.trust.ca_path = files / "certificate";
  const auto connected = Connection::connect(by_tls, hello(), patience);
  ASSERT_TRUE(connected) << connected.error().message;
  EXPECT_EQ((*connected)->welcome().role, Role::admin);
}

TEST_F(TokenWayTest, programs_say_so_and_end) {
  RawServer other(proxy_address.c_str());
  const std::string admin(SCREE_ADMIN_PROGRAM), bot(SCREE_BOT_PROGRAM), exporting(SCREE_EXPORT_PROGRAM);
  for (const std::string act : {"show", "sessions", "set impacts=true", "kick 1", "status", "replay --pause"})
    EXPECT_TRUE(holds(run(admin, other, act), "the token was not sent")) << act;
  EXPECT_TRUE(holds(run(bot, other, "--carves 0"), "the token was not sent"));
  EXPECT_EQ(other.all_sent(), "");
  const auto [code, said] =
      run_program(exporting + " --server " + proxy_address + ":" + std::to_string(other.port()) +
                  " --token " + the_secret + " --out " + (files / "terrain.obj"));
  EXPECT_GT(code, 0);
  EXPECT_TRUE(holds(said, "the token was not sent")) << said;
  EXPECT_EQ(other.all_sent(), "");
  run(admin, other, "--timeout 1 health");
  const std::string asked = other.all_sent();
  EXPECT_FALSE(asked.empty()) << "health is asked for without a token";
  EXPECT_FALSE(holds(asked, the_secret));
}

}  // namespace
}  // namespace scree
