// nginx with the cache of docs/host.md: the page's large files come from the server once.
#include <gtest/gtest.h>

#include "tests/proxy/proxy_fixture.h"
#include "tests/support/patience.h"

namespace scree {
namespace {

class ProxyCacheTest : public ProxyTest {
 protected:
  void run_caching_nginx() {
    const std::string conf = documented("nginx", 1);
    ASSERT_TRUE(holds(conf, "proxy_cache scree;"));
    run_nginx(std::regex_replace(conf, std::regex("/var/cache/nginx/scree"), files / "cache"));
  }
};

TEST_F(ProxyCacheTest, a_file_with_a_hash_in_its_name_is_sent_by_the_server_once) {
  page.write("large.0123abcd.bin", std::string(300'000, 'x'));
  open();
  run_caching_nginx();
  for (int user = 1; user <= users; ++user)
    for (int again = 0; again < 5; ++again) {
      HttpClient browser(by_proxy(user));
      const HttpAnswer answer = browser.get("/large.0123abcd.bin");
      EXPECT_EQ(answer.status, 200);
      EXPECT_EQ(answer.body.size(), 300'000U);
    }
  EXPECT_EQ(server->stats().web.requests, 1U);
  EXPECT_LT(server->stats().web.bytes_sent, 310'000U);
}

TEST_F(ProxyCacheTest, pages_are_fresh_and_people_join_through_it) {
  open();
  run_caching_nginx();
  HttpClient browser(by_proxy(1));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(browser.get("/").status, 200);
  // The counts that others see follow a moment later.
  for (const Within time(60.0); server->stats().web.requests < 3U && !time.over();) wait_a_moment();
  EXPECT_EQ(server->stats().web.requests, 3U) << "index.html has no hash in its name";
  for (int user = 1; user <= users; ++user) {
    WebSocketClient person(by_proxy(user));
    ASSERT_TRUE(person.open());
    EXPECT_EQ(join(person), "");
  }
}

}  // namespace
}  // namespace scree
