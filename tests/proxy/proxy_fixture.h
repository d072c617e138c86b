// A server on loopback, Debian's nginx or haproxy before it, and users with addresses of their own, all in a
// network of this process' own. The proxies' configurations are those of docs/host.md, with this test's
// places.
#pragma once

#include <fstream>
#include <regex>
#include <sstream>

#include "tests/support/background_program.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/own_network.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"
#include "tests/support/web_client.h"
#include "tests/support/web_folder.h"

namespace scree {

inline const std::string proxy_address = "203.0.113.100";
constexpr uint16_t proxy_port = 8080;

class ProxyTest : public NetServerTest {
 protected:
  static void SetUpTestSuite() {
    if (has_network_) return;
    std::vector<std::string> addresses{proxy_address};
    for (int user = 1; user <= users; ++user) addresses.push_back(address_of(user));
    has_network_ = enter_own_network(addresses);
  }
  void SetUp() override {
    if (!has_network_) GTEST_SKIP() << "this system allows no network of a process' own (unshare)";
  }

  static std::string address_of(int user) { return "203.0.113." + std::to_string(user); }
  static Route by_proxy(int user, uint16_t port = proxy_port) {
    return {port, proxy_address, address_of(user)};
  }

  /// The server, which trusts the proxy.
  void open(const std::function<void(NetConfig&)>& change = {}) {
    start([&](NetConfig& config) {
      config.web.folder = page.path();
      config.proxies = *Proxies::parse({"127.0.0.1"});
      config.service.sessions_max = 1000;
      config.admin_token = the_admin_token;
      if (change) change(config);
    });
  }

  /// The n-th block of docs/host.md in this language, for this test's places.
  static std::string block(const std::string& language, size_t number) {
    std::ifstream file(std::string(SCREE_SOURCE_DIR) + "/docs/host.md");
    std::string text(std::istreambuf_iterator<char>(file), {});
    const std::string fence = "```" + language + "\n";
    size_t at = text.find(fence);
    for (size_t i = 0; i < number && at != text.npos; ++i) at = text.find(fence, at + 1);
    EXPECT_NE(at, text.npos) << "docs/host.md has no such block of " << language;
    if (at == text.npos) return {};
    at += fence.size();
    text = text.substr(at, text.find("```", at) - at);
    const std::string place = proxy_address + ":" + std::to_string(proxy_port);
    text = std::regex_replace(text, std::regex("listen [0-9]+"), "listen " + place);
    return std::regex_replace(text, std::regex("bind :[0-9]+"), "bind " + place);
  }
  /// The same for this test's server.
  std::string documented(const std::string& language, size_t number = 0) const {
    return std::regex_replace(block(language, number), std::regex("127\\.0\\.0\\.1:4177"),
                              "127.0.0.1:" + std::to_string(server->port()));
  }

  /// `servers`: what stands in http { }.
  void run_nginx(const std::string& servers) {
    std::string conf = "daemon off; master_process off; pid " + (files / "nginx.pid") +
                       "; error_log stderr;\n" +
                       "events { worker_connections 2048; }\nhttp { access_log off;\n";
    for (const char* kind : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
      conf += std::string(kind) + "_temp_path " + (files / kind) + ";\n";
    run("nginx", {"nginx", "-p", files / "", "-e", files / "nginx.err", "-c", files / "nginx.conf"},
        conf + servers + "}\n");
  }
  void run_haproxy(const std::string& sections) {
    run("haproxy", {"haproxy", "-db", "-f", files / "haproxy.conf"}, "global\n  maxconn 2000\n" + sections);
  }

  /// Says hello, and waits for the answer; empty: it has joined.
  template <typename Client>
  static std::string join(Client& client, const std::string& token = "") {
    HelloMessage first = hello();
    first.token = token;
    if (!client.send(first)) return "the connection is over";
    while (auto message = client.receive()) {
      if (std::holds_alternative<WelcomeMessage>(*message)) return {};
      if (const auto* refusal = std::get_if<RefusalMessage>(&*message)) return refusal->name;
    }
    return "no answer";
  }

  static constexpr int users = 4;
  static constexpr const char* the_admin_token = "the-admin-token";
  WebFolder page;
  TestFolder files;
  std::unique_ptr<BackgroundProgram> proxy;

 private:
  void run(const std::string& name, const std::vector<std::string>& command, const std::string& conf) {
    std::ofstream(files / (name + ".conf")) << conf;
    proxy = std::make_unique<BackgroundProgram>(command, files / (name + ".said"));
    for (const Within within(30.0); !LoopbackSocket({proxy_port, proxy_address, proxy_address}).connected();)
      if (within.over()) {
        std::ifstream said(files / (name + ".said"));
        std::ostringstream all;
        all << said.rdbuf();
        FAIL() << name << " does not listen: " << all.str();
      }
  }

  static inline bool has_network_ = false;
};

}  // namespace scree
