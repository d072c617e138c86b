// Files of the page, asked for again and again by requests of a few bytes: an address gets what its budget
// has, others do not notice, and what a browser or a proxy has already is not sent again.
#include <gtest/gtest.h>
#include <thread>

#include "shared/base/timing.h"
#include "tests/support/attack_fixture.h"
#include "tests/support/web_client.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

constexpr double per_second = 1.0e6;
constexpr size_t file_bytes = 400'000;

std::string from(const std::string& ip) {
  return "X-Forwarded-For: " + ip + "\r\n";
}

class WebBytesTest : public AttackTest {
 protected:
  void open_web(const BytesOut::Rules& rules) {
    folder.write("large.bin", std::string(file_bytes, 'x'));
    open([&](NetConfig& config) {
      config.web.folder = folder.path();
      config.proxies = *Proxies::parse({"127.0.0.1"});
      config.bytes_out = rules;
      config.door.requests_burst = 10000.0;
    });
  }
  /// Bytes of bodies that one address gets by eight connections in a second, more or less.
  double draw(double& seconds) {
    const double begin_s = steady_now_s();
    std::atomic<size_t> bytes = 0;
    std::vector<std::thread> attackers;
    for (int i = 0; i < 8; ++i)
      attackers.emplace_back([&] {
        HttpClient attacker(server->port());
        while (steady_now_s() < begin_s + 1.0 && bytes < 100'000'000)
          bytes += attacker.get("/large.bin", from("203.0.113.1")).body.size();
      });
    expect_served(begin_s);
    for (std::thread& attacker : attackers) attacker.join();
    seconds = steady_now_s() - begin_s;
    return static_cast<double>(bytes);
  }
  /// Meanwhile, somebody else gets the page, and a large file, at once.
  void expect_served(double begin_s) {
    while (steady_now_s() < begin_s + 0.5) tick();
    HttpClient honest(server->port());
    const double asked_s = steady_now_s();
    EXPECT_EQ(honest.get("/", from("203.0.113.2")).status, 200);
    EXPECT_EQ(honest.get("/large.bin", from("203.0.113.2")).body.size(), file_bytes);
    EXPECT_LT(steady_now_s() - asked_s, 5.0) << "much less; this machine may be busy";
  }

  WebFolder folder;
};

TEST_F(WebBytesTest, an_address_draws_files_by_its_budget_and_others_do_not_notice) {
  open_web({per_second, 0.0});
  double seconds = 0.0;
  const double drawn = draw(seconds);
  EXPECT_LE(drawn, per_second * (seconds + limits::bytes_out_saved_s) + 8.0 * limits::http_write_bytes_max);
  EXPECT_GT(server->stats().bytes_out_held, 0U);
  expect_honest_served();
}

TEST_F(WebBytesTest, files_are_drawn_without_end_where_there_is_no_budget) {
  open_web({0.0, 0.0});
  double seconds = 0.0;
  EXPECT_GT(draw(seconds), 20.0e6);
}

TEST_F(WebBytesTest, a_file_larger_than_the_budget_comes_whole_without_ticks_too) {
  open_web({0.2e6, 0.0});
  const std::string text = from("203.0.113.3");
  HttpClient slow(server->port());
  for (int i = 0; i < 3; ++i) {
    const HttpAnswer answer = slow.get("/large.bin", text);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.body, std::string(file_bytes, 'x'));
  }
}

TEST_F(WebBytesTest, what_a_browser_or_a_proxy_has_is_not_sent_again) {
  open_web({per_second, 0.0});
  HttpClient browser(server->port());
  const HttpAnswer named = browser.get("/client.0123abcd.wasm", from("203.0.113.1"));
  EXPECT_EQ(named.field("Cache-Control"), "public, max-age=31536000, immutable");
  const HttpAnswer page = browser.get("/large.bin", from("203.0.113.1"));
  EXPECT_EQ(page.field("Cache-Control"), "no-cache") << "may be kept, and is asked about";
  const auto ask_again = [&] {
    const std::string has = "If-None-Match: " + page.field("ETag") + "\r\n";
    return browser.get("/large.bin", from("203.0.113.1") + has).status;
  };
  ASSERT_EQ(ask_again(), 304);  // what came before is charged by now
  const uint64_t before = server->stats().bytes_out;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(ask_again(), 304);
  EXPECT_LT(server->stats().bytes_out - before, 100U * 1500U);
}

/// A WebSocket that says it was relayed, where no proxy is trusted, is charged to its own address
/// nevertheless.
TEST_F(WebBytesTest, who_says_himself_that_he_was_relayed_has_the_budget_of_his_address) {
  constexpr double little = 1.0e3;
  open([](NetConfig& config) {
    config.bytes_out = {little, 0.0};
    config.door.loopback_is_shared = true;
  });
  for (int i = 0; i < 24; ++i)
    tick(
        {source.carve({4.0F * static_cast<float>(i % 6), 0.0F, 4.0F * static_cast<float>(i / 6)}, 2.0F, 12)});
  const uint64_t before = server->stats().bytes_out;
  const double begin_s = steady_now_s();
  WebSocketClient attacker(server->port(), "Via: 1.1 nobody\r\n");
  ASSERT_TRUE(attacker.open());
  ASSERT_TRUE(attacker.send(hello()));
  while (steady_now_s() < begin_s + 1.0) {
    tick();
    std::this_thread::sleep_for(
        std::chrono::milliseconds(10));  // frames are charged, too, and never held back
  }
  EXPECT_LE(static_cast<double>(server->stats().bytes_out - before), 30.0e3) << "the rubble has more";
}

}  // namespace
}  // namespace scree
