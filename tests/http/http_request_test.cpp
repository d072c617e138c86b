// Heads of requests: what is taken from them, and which are refused.
#include "server/web/http_request.h"

#include <gtest/gtest.h>

#include "server/web/limits.h"

namespace scree {
namespace {

std::string get_head(const std::string& target, const std::string& fields = "Host: a\r\n") {
  return "GET " + target + " HTTP/1.1\r\n" + fields + "\r\n";
}

TEST(HttpRequests, say_what_is_asked_for) {
  const auto request = parse_http_head(
      "HEAD /a/b.js?c=d HTTP/1.1\r\nHost: example.org:4177\r\nOrigin: http://example.org:4177\r\n"
      "Accept-Encoding: br, gzip;q=0.5\r\nIf-None-Match: \"x\"\r\nAuthorization: Bearer t\r\n\r\n");
  ASSERT_TRUE(request) << request.error().message;
  EXPECT_EQ(request->method, HttpMethod::head);
  EXPECT_EQ(request->path, "/a/b.js");
  EXPECT_EQ(request->host, "example.org:4177");
  EXPECT_EQ(request->origin, "http://example.org:4177");
  EXPECT_TRUE(request->accepts_gzip && request->keep_alive && !request->wants_websocket);
  EXPECT_EQ(request->if_none_match, "\"x\"");
  EXPECT_EQ(request->authorization, "Bearer t");
}

TEST(HttpRequests, that_proxies_pass_on_are_known_where_that_shows) {
  EXPECT_FALSE(parse_http_head(get_head("/", "Host: a\r\n"))->relayed);
  EXPECT_TRUE(parse_http_head("GET / HTTP/1.0\r\nHost: a\r\n\r\n")->relayed);
  for (const char* field : {"Forwarded: for=1.2.3.4", "Via: 1.1 a", "x-forwarded-for: 1.2.3.4",
                            "X-Forwarded-Host: b", "X-Real-IP: 1.2.3.4"})
    EXPECT_TRUE(parse_http_head(get_head("/", "Host: a\r\n" + std::string(field) + "\r\n"))->relayed)
        << field;
}

TEST(HttpRequests, say_how_the_connection_goes_on) {
  EXPECT_FALSE(parse_http_head(get_head("/", "Host: a\r\nConnection: close\r\n"))->keep_alive);
  EXPECT_FALSE(parse_http_head("GET / HTTP/1.0\r\n\r\n")->keep_alive);
  const auto websocket =
      parse_http_head(get_head("/session",
                               "Host: a\r\nConnection: keep-alive, Upgrade\r\nUpgrade: WebSocket\r\n"
                               "Sec-WebSocket-Key: k\r\nSec-WebSocket-Version: 13\r\n"));
  ASSERT_TRUE(websocket);
  EXPECT_TRUE(websocket->wants_websocket);
  EXPECT_EQ(websocket->websocket_key, "k");
  EXPECT_EQ(websocket->websocket_version, "13");
}

TEST(HttpRequests, of_version_1_0_open_no_websocket) {
  const auto request =
      parse_http_head("GET /session HTTP/1.0\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\r\n");
  ASSERT_TRUE(request);
  EXPECT_FALSE(request->wants_websocket);
}

TEST(HttpRequests, take_gzip_unless_they_say_no) {
  const auto takes = [](const std::string& value) {
    return parse_http_head(get_head("/", "Host: a\r\nAccept-Encoding: " + value + "\r\n"))->accepts_gzip;
  };
  EXPECT_TRUE(takes("gzip"));
  EXPECT_TRUE(takes("deflate, GZIP"));
  EXPECT_FALSE(takes("gzip;q=0"));
  EXPECT_FALSE(takes("gzip;q=0.000, br"));
  EXPECT_FALSE(takes("br"));
}

TEST(HttpRequests, of_other_forms_are_refused) {
  for (const std::string& head : {get_head("http://a/"),
                                  get_head("*"),
                                  get_head("/", ""),
                                  get_head("/", "Host: a\r\nHost: b\r\n"),
                                  get_head("/", "Host: a:4300:80\r\n"),
                                  get_head("/", "Host: 127.0.0.1:0x10\r\n"),
                                  get_head("/", "Host: a:99999\r\n"),
                                  get_head("/", "Host: [::1\r\n"),
                                  get_head("/", "Host: a\r\nOrigin: http://a\r\nOrigin: http://b\r\n"),
                                  get_head("/", "Host: a\r\nContent-Length: 5\r\n"),
                                  get_head("/", "Host: a\r\nContent-Length: 1\r\nContent-Length: 2\r\n"),
                                  get_head("/", "Host: a\r\nTransfer-Encoding: chunked\r\n"),
                                  get_head("/", "Host : a\r\n"),
                                  get_head("/", "Host: a\r\n: b\r\n"),
                                  get_head("/", "Host: a\r\nX: a\rb\r\n"),
                                  get_head(std::string("/\0a", 3)),
                                  get_head("/ /"),
                                  get_head("/\x7f"),
                                  std::string("GET / HTTP/2.0\r\nHost: a\r\n\r\n"),
                                  std::string("GET / HTTP/0.9\r\nHost: a\r\n\r\n"),
                                  std::string("GET /\r\nHost: a\r\n\r\n"),
                                  std::string("\r\n\r\n"),
                                  std::string("G(T / HTTP/1.1\r\n\r\n"),
                                  std::string("GET / HTTP/1.1\nHost: a\n\r\n\r\n"),
                                  std::string("PRI * HTTP/2.0\r\n\r\n")})
    EXPECT_FALSE(parse_http_head(head)) << head;
  EXPECT_TRUE(parse_http_head(get_head("/", "Host: a\r\nContent-Length: 0\r\n")));
}

TEST(HttpRequests, that_are_cut_short_are_refused_at_every_byte) {
  const std::string whole = get_head("/session?a", "Host: a\r\nOrigin: http://a\r\nUpgrade: websocket\r\n");
  for (size_t bytes = 0; bytes < whole.size(); ++bytes)
    EXPECT_FALSE(parse_http_head(whole.substr(0, bytes))) << bytes;
  EXPECT_FALSE(parse_http_head(whole + "G"));
  EXPECT_FALSE(parse_http_head(
      get_head("/", "Host: a\r\nX: " + std::string(limits::http_head_bytes_max, 'x') + "\r\n")));
}

}  // namespace
}  // namespace scree
