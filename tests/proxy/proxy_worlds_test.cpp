// Many worlds on one machine, behind one nginx or haproxy with a certificate, each under a path of its own:
// what docs/host.md says of that.
#include <array>
#include <gtest/gtest.h>

#include "tests/proxy/proxy_fixture.h"
#include "tests/support/certificates.h"

namespace scree {
namespace {

/// A world's server, which trusts the proxy.
struct ServedWorld {
  CommandQueue commands{4};
  TickSource source{flat_terrain};
  std::unique_ptr<NetServer> server;
};

class ProxyWorldsTest : public ProxyTest {
 protected:
  /// The page of each world has its name as title.
  void open_worlds() {
    certificate.write(files / "fullchain.pem", files / "privkey.pem");
    for (size_t i = 0; i < names.size(); ++i) {
      pages[i].write("index.html", "<!doctype html><title>" + names[i] + "</title>");
      NetConfig config;
      config.terrain = flat_terrain;
      config.world = i + 1;
      config.web.folder = pages[i].path();
      config.proxies = *Proxies::parse({"127.0.0.1"});
      config.admin_token = the_admin_token;
      auto listening = NetServer::listen(config, worlds[i].commands, worlds[i].source.keyframe());
      ASSERT_TRUE(listening) << listening.error().message;
      worlds[i].server = std::move(*listening);
    }
    auto made = TlsClientContext::make({files / "fullchain.pem", ""});
    ASSERT_TRUE(made) << made.error().message;
    tls = *made;
  }
  /// A block of the page, with this test's ports and files.
  std::string documented_worlds(const std::string& language, size_t number) const {
    std::string text = block(language, number);
    for (size_t i = 0; i < names.size(); ++i)
      text = std::regex_replace(text, std::regex("127\\.0\\.0\\.1:" + std::to_string(4177 + i)),
                                "127.0.0.1:" + std::to_string(worlds[i].server->port()));
    return std::regex_replace(text, std::regex("/etc/scree/play/"), files / "");
  }
  std::string target(size_t world) const { return "/worlds/" + names[world] + "/"; }

  void expect_every_world_under_its_path() {
    const std::string origin = "Origin: https://" + proxy_address + ":" + std::to_string(proxy_port) + "\r\n";
    std::vector<std::unique_ptr<WebSocketClient>> people;
    for (size_t i = 0; i < names.size(); ++i) {
      const int user = static_cast<int>(i) + 1;
      HttpClient browser(by_proxy(user), tls);
      EXPECT_TRUE(holds(browser.get(target(i)).body, "<title>" + names[i] + "</title>")) << names[i];
      EXPECT_EQ(browser.get(target(i) + "main.js").status, 200) << names[i];
      const HttpAnswer without = HttpClient(by_proxy(user), tls).get("/worlds/" + names[i]);
      EXPECT_EQ(without.status / 100, 3) << "the last slash is added";
      EXPECT_TRUE(without.field("Location").ends_with(target(i))) << without.field("Location");
      auto& person = people.emplace_back(
          std::make_unique<WebSocketClient>(by_proxy(user), origin, tls, 0, target(i) + "session"));
      ASSERT_EQ(person->handshake().status, 101) << names[i] << ": " << person->handshake().body;
      ASSERT_TRUE(person->send(hello()));
      const auto welcome = person->receive_as<WelcomeMessage>();
      ASSERT_TRUE(welcome) << names[i];
      EXPECT_EQ(welcome->world, i + 1) << names[i];
      EXPECT_EQ(addresses_in(i), std::vector<std::string>{address_of(user)}) << names[i];
    }
    const int elsewhere = HttpClient(by_proxy(1), tls).get("/worlds/nowhere/").status;
    EXPECT_GE(elsewhere, 400) << "there is no such world";
  }

  static inline const std::vector<std::string> names{"hill", "mine", "town"};
  const TestCertificate certificate{"DNS:localhost"};
  std::shared_ptr<const TlsClientContext> tls;
  std::array<ServedWorld, 3> worlds;
  std::array<WebFolder, 3> pages{WebFolder("hill"), WebFolder("mine"), WebFolder("town")};

 private:
  /// The addresses of the people in a world, as its administrator sees them, who is none of them.
  std::vector<std::string> addresses_in(size_t world) {
    RawClient admin(worlds[world].server->port());
    EXPECT_EQ(join(admin, the_admin_token), "");
    EXPECT_TRUE(admin.send(AdminMessage{1, "", ListSessionsRequest{}}));
    const auto list = admin.receive_as<AdminListMessage>();
    std::vector<std::string> addresses;
    if (!list) return addresses;
    for (const SessionRow& row : list->sessions)
      if (row.role != Role::admin) addresses.push_back(row.address);
    return addresses;
  }
};

TEST_F(ProxyWorldsTest, nginx_serves_three_worlds_by_one_port) {
  open_worlds();
  run_nginx(documented_worlds("nginx", 2));
  expect_every_world_under_its_path();
}

TEST_F(ProxyWorldsTest, haproxy_serves_three_worlds_by_one_port) {
  open_worlds();
  std::ifstream chain(files / "fullchain.pem"), key(files / "privkey.pem");
  std::ofstream(files / "both.pem") << chain.rdbuf() << key.rdbuf();
  run_haproxy(documented_worlds("haproxy", 2));
  expect_every_world_under_its_path();
}

}  // namespace
}  // namespace scree
