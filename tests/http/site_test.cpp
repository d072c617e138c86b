// What a site answers: the page's files and nothing else, handshakes of WebSockets, by whose page asks.
#include "server/web/site.h"

#include <array>
#include <climits>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "server/web/limits.h"
#include "tests/support/holds.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

class SiteTest : public ::testing::Test {
 protected:
  HttpResponse ask(const std::string& path, const std::function<void(HttpRequest&)>& change = {},
                   bool from_here = false) {
    HttpRequest request;
    request.path = path;
    request.host = "game.example:4177";
    if (change) change(request);
    WebConfig names;
    names.origins = origins;
    names.hosts = {"game.example"};
    return Site(*WebFiles::load(folder.path()), WebNames(names)).answer(request, {from_here, "192.0.2.7"});
  }
  /// Status of the answer to a handshake.
  int open_websocket(const std::function<void(HttpRequest&)>& change = {}, bool from_here = false) {
    return ask(
               "/session",
               [&](HttpRequest& request) {
                 request.wants_websocket = true;
                 request.websocket_version = "13";
                 request.websocket_key = "dGhlIHNhbXBsZSBub25jZQ==";
                 if (change) change(request);
               },
               from_here)
        .status;
  }
  static std::string field(const HttpResponse& response, const std::string& name) {
    for (const auto& [key, value] : response.fields)
      if (key == name) return value;
    return "";
  }

  WebFolder folder;
  std::vector<std::string> origins;
};

TEST_F(SiteTest, gives_the_page_and_its_files_by_their_types) {
  EXPECT_TRUE(holds(*ask("/").body, "page"));
  EXPECT_TRUE(holds(*ask("/status").body, "status"));
  EXPECT_EQ(field(ask("/"), "Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(field(ask("/main.js"), "Content-Type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(field(ask("/parts/style.css"), "Content-Type"), "text/css; charset=utf-8");
  EXPECT_EQ(field(ask("/client.0123abcd.wasm"), "Content-Type"), "application/wasm");
  EXPECT_EQ(*ask("/client.0123abcd.wasm").body, std::string("\0asm", 4));
  EXPECT_EQ(ask("/nothing.js").status, 404);
}

TEST_F(SiteTest, says_how_the_administrators_page_is_built_where_it_is_not) {
  EXPECT_EQ(ask("/admin").status, 404);
  EXPECT_TRUE(holds(*ask("/admin").body, "./scree web"));
  folder.write("admin.html", "administration");
  EXPECT_EQ(*ask("/admin").body, "administration");
}

TEST_F(SiteTest, sends_the_compressed_file_to_who_takes_it) {
  const auto with_gzip = [](HttpRequest& request) { request.accepts_gzip = true; };
  const HttpResponse wasm = ask("/client.0123abcd.wasm", with_gzip);
  EXPECT_EQ(*wasm.body, "compressed wasm");
  EXPECT_EQ(field(wasm, "Content-Encoding"), "gzip");
  EXPECT_EQ(field(wasm, "Content-Type"), "application/wasm");
  EXPECT_EQ(field(wasm, "Vary"), "Accept-Encoding");
  EXPECT_EQ(field(ask("/main.js", with_gzip), "Content-Encoding"), "");
  EXPECT_EQ(ask("/client.0123abcd.wasm.gz").status, 404) << "it is no file of its own";
}

TEST_F(SiteTest, lets_browsers_keep_what_never_changes_and_ask_again_for_the_rest) {
  EXPECT_EQ(field(ask("/client.0123abcd.wasm"), "Cache-Control"), "public, max-age=31536000, immutable");
  EXPECT_EQ(field(ask("/"), "Cache-Control"), "no-cache");
  const std::string etag = field(ask("/"), "ETag");
  const auto again = [&](const std::string& known) {
    return ask("/", [&](HttpRequest& request) { request.if_none_match = known; });
  };
  EXPECT_EQ(again(etag).status, 304);
  EXPECT_EQ(again(etag).body, nullptr);
  EXPECT_EQ(again("\"other\", " + etag).status, 304);
  EXPECT_EQ(again("\"other\"").status, 200);
  folder.write("index.html", "another page");
  EXPECT_EQ(again(etag).status, 200);
}

TEST_F(SiteTest, answers_nothing_but_get_and_head) {
  const auto other = [](HttpRequest& request) { request.method = HttpMethod::other; };
  EXPECT_EQ(ask("/", other).status, 405);
  EXPECT_EQ(field(ask("/", other), "Allow"), "GET, HEAD");
  EXPECT_EQ(ask("/session", other).status, 405);
}

TEST_F(SiteTest, leads_no_path_out_of_the_folder) {
  std::filesystem::create_directories(folder.beside("outside"));
  std::ofstream(folder.beside("outside/secret.txt")) << "secret";
  std::filesystem::create_symlink(folder.beside("outside/secret.txt"), folder.path() + "link.txt");
  std::filesystem::create_directory_symlink(folder.beside("outside"), folder.path() + "linked");
  folder.write(".hidden", "hidden");
  folder.write(".git/config", "hidden");
  for (const char* path :
       {"/../secret.txt", "/parts/../../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/.hidden",
        "/.git/config", "/link.txt", "/linked/secret.txt", "//etc/passwd", "/etc/passwd", "/..\\secret.txt",
        "/parts", "/parts/", "/./index.html", "/index.html/", "/Index.html"})
    EXPECT_EQ(ask(path).status, 404) << path;
  EXPECT_EQ(ask(std::string("/index.html\0.js", 15)).status, 404);
}

TEST_F(SiteTest, follows_links_within_the_folder) {
  std::filesystem::create_symlink("main.js", folder.path() + "other.js");
  EXPECT_EQ(*ask("/other.js").body, "let a = 1;");
}

TEST_F(SiteTest, says_what_to_do_without_a_page) {
  Site site(std::make_shared<const WebFiles>(), WebNames());
  HttpRequest request;
  request.path = "/";
  EXPECT_EQ(site.answer(request, {true}).status, 404);
  EXPECT_TRUE(holds(*site.answer(request, {true}).body, "./scree web"));
  request.path = "/session.json";
  EXPECT_EQ(site.answer(request, {true}).status, 200);
}

TEST_F(SiteTest, bounds_what_a_folder_may_hold) {
  EXPECT_FALSE(WebFiles::load(folder.path() + "nothing"));
  EXPECT_FALSE(WebFiles::load(folder.path() + "main.js"));
  std::string deep = "a/";
  for (int depth = 0; depth < limits::web_folders_max; ++depth) deep += "a/";
  folder.write(deep + "deep.js", "deep");
  EXPECT_EQ(ask("/" + deep + "deep.js").status, 404);
  folder.write("whole.bin", "");
  std::filesystem::resize_file(folder.path() + "whole.bin", limits::web_bytes_max);
  EXPECT_FALSE(WebFiles::load(folder.path())) << "there are others beside it";
  std::filesystem::remove(folder.path() + "whole.bin");
  EXPECT_TRUE(WebFiles::load(folder.path()));
  for (size_t i = 0; i < limits::web_files_max; ++i) folder.write("f" + std::to_string(i) + ".txt", "");
  EXPECT_FALSE(WebFiles::load(folder.path()));
}

TEST_F(SiteTest, opens_a_websocket_by_the_rules) {
  EXPECT_EQ(open_websocket(), 101);
  EXPECT_EQ(open_websocket([](HttpRequest& r) { r.wants_websocket = false; }), 426);
  EXPECT_EQ(open_websocket([](HttpRequest& r) { r.websocket_version = "8"; }), 426);
  EXPECT_EQ(open_websocket([](HttpRequest& r) { r.method = HttpMethod::head; }), 405);
  for (const char* key : {"", "dGhlIHNhbXBsZSBub25jZQ=", "dGhlIHNhbXBsZSBub25jZQ==x",
                          "dGhlIHNhbXBsZSBub25j!Q==", "dGhlIHNhbXBsZSBub25jZQAA"})
    EXPECT_EQ(open_websocket([&](HttpRequest& r) { r.websocket_key = key; }), 400) << key;
  // The example of RFC 6455, 1.3.
  const HttpResponse response = ask("/session", [](HttpRequest& r) {
    r.wants_websocket = true;
    r.websocket_version = "13";
    r.websocket_key = "dGhlIHNhbXBsZSBub25jZQ==";
  });
  EXPECT_EQ(field(response, "Sec-WebSocket-Accept"), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

TEST_F(SiteTest, lets_its_own_pages_join_and_those_of_named_sites) {
  const auto from = [&](const std::string& origin, const std::string& host, bool from_here = false) {
    return open_websocket(
        [&](HttpRequest& r) {
          r.origin = origin;
          r.host = host;
        },
        from_here);
  };
  EXPECT_EQ(from("http://game.example:4177", "game.example:4177"), 101);
  EXPECT_EQ(from("https://Game.example", "game.example:443"), 101);
  EXPECT_EQ(from("http://game.example", "game.example"), 101);
  for (const char* origin :
       {"http://evil.example", "null", "", "http://game.example", "http://game.example:4178",
        "ftp://game.example:4177", "http://game.example:4177.evil.example",
        "http://evil.example/game.example:4177"})
    EXPECT_EQ(from(origin, "game.example:4177"), 403) << origin;
  origins = {"https://other.example"};
  EXPECT_EQ(from("https://other.example", "game.example:4177"), 101);
  EXPECT_EQ(from("http://other.example", "game.example:4177"), 403);
}

TEST_F(SiteTest, distrusts_names_that_lead_from_this_machine_to_itself) {
  const auto from = [&](const std::string& host) {
    return open_websocket(
        [&](HttpRequest& r) {
          r.origin = "http://" + host;
          r.host = host;
        },
        true);
  };
  for (const char* host : {"localhost:4177", "127.0.0.1:4177", "[::1]:4177", "192.168.0.7"})
    EXPECT_EQ(from(host), 101) << host;
  std::array<char, HOST_NAME_MAX + 1> own{};
  ASSERT_EQ(gethostname(own.data(), own.size() - 1), 0);
  EXPECT_EQ(from(std::string(own.data()) + ":4177"), 101) << "its own name";
  EXPECT_EQ(from("rebound.example:4177"), 403);
  EXPECT_EQ(open_websocket({}, true), 101) << "a program that is no browser";
  origins = {"http://rebound.example:4177"};
  EXPECT_EQ(from("rebound.example:4177"), 101);
}

TEST_F(SiteTest, tells_a_page_what_was_missing_and_gives_it_a_pass_for_its_address) {
  Site site(*WebFiles::load(folder.path()), WebNames());
  const auto ask_for = [&](const std::string& path, const std::string& query, const WebPeer& peer,
                           const std::function<void(HttpRequest&)>& change = {}) {
    HttpRequest request;
    request.path = path;
    request.query = query;
    request.host = "127.0.0.1:4177";
    request.origin = "http://192.0.2.5";
    request.wants_websocket = request.names_upgrade = request.connection_upgrade = true;
    request.websocket_version = "13";
    request.websocket_key = "dGhlIHNhbXBsZSBub25jZQ==";
    if (change) change(request);
    return site.answer(request, peer);
  };
  const std::string first = "attempt=" + std::string(32, 'a'), second = "attempt=" + std::string(32, 'b');
  const WebPeer ann{false, "198.51.100.1"}, ben{false, "198.51.100.2"};
  EXPECT_TRUE(holds(*ask_for("/session.json", first, ann).body, "\"seen\":false"));
  EXPECT_EQ(ask_for("/session", first, ann).status, 403);
  const std::string told = *ask_for("/session.json", first, ann).body;
  const size_t at = told.find("\"pass\":\"");
  ASSERT_NE(at, told.npos) << told;
  const std::string pass = "&pass=" + told.substr(at + 8, 32);
  EXPECT_EQ(ask_for("/session", second + pass, ann).status, 101);
  EXPECT_EQ(ask_for("/session", second + pass, ben).status, 403) << "it is not his";
  EXPECT_EQ(ask_for("/session", pass.substr(1), {true, "198.51.100.1"}).status, 101) << "a number is no name";
  EXPECT_EQ(ask_for("/session", pass.substr(1), {true, "198.51.100.1"},
                    [](HttpRequest& r) { r.origin = "http://rebound.example"; })
                .status,
            403);
  const auto without_upgrade = [](HttpRequest& r) { r.wants_websocket = r.names_upgrade = false; };
  EXPECT_EQ(ask_for("/session", second, ann, without_upgrade).status, 426);
  const std::string lines = *ask_for("/session.json", second, ann).body;
  EXPECT_TRUE(holds(lines, "proxy_set_header Upgrade $http_upgrade;")) << lines;
  EXPECT_FALSE(holds(lines, "proxy_http_version") || holds(lines, "pass\":")) << lines;
  for (size_t i = 0; i < limits::socket_attempts_max; ++i)
    ask_for("/session", "attempt=" + std::string(32, 'c'), ben, without_upgrade);
  EXPECT_TRUE(holds(*ask_for("/session.json", second, ann).body, "\"seen\":false")) << "it is forgotten";
}

TEST_F(SiteTest, tells_of_an_origin_that_is_no_text_by_text) {
  Site site(*WebFiles::load(folder.path()), WebNames());
  HttpRequest request;
  request.path = "/session";
  request.query = "attempt=" + std::string(32, 'a');
  request.host = "game.example";
  request.wants_websocket = true;
  request.websocket_version = "13";
  request.websocket_key = "dGhlIHNhbXBsZSBub25jZQ==";
  for (const std::string& origin : {std::string("http://\xff\xc3"), "http://" + std::string(5000, 'a')}) {
    request.origin = origin;
    EXPECT_EQ(site.answer(request, {}).status, 403);
    HttpRequest asks = request;
    asks.path = "/session.json";
    const std::string told = *site.answer(asks, {}).body;
    EXPECT_TRUE(holds(told, "\"seen\":true,\"words\":\"pages of http://")) << told;
    EXPECT_LT(told.size(), 1000U);
  }
}

TEST(WebNames, know_numbers_and_this_machine_and_what_the_operator_names) {
  WebConfig config;
  config.hosts = {"play.example.org"};
  config.origins = {"https://game.example:8443"};
  const WebNames names(config);
  const std::string own = own_host_name();
  for (const std::string host : {"127.0.0.1", "192.168.0.7:4177", "[::1]:4177", "[2001:db8::7]", "localhost",
                                 "LocalHost:80", "a.localhost", "localhost.", "play.example.org",
                                 "Play.Example.ORG.:4177", "game.example", own.c_str(), ""})
    EXPECT_TRUE(names.knows_host(host)) << host;
  EXPECT_TRUE(names.knows_host(own_host_name() + ".local:4177"));
  for (const char* host : {"evil.example",
                           "evil.example:4177",
                           "127.0.0.1.evil.example",
                           "localhost.evil.example",
                           "evillocalhost",
                           ".localhost",
                           "play.example.org.evil.example",
                           "a.play.example.org",
                           "example.org",
                           "[::1].evil.example",
                           "[evil.example]",
                           "0x7f.1.evil",
                           "1.2.3",
                           "1.2.3.4.5",
                           ":4177",
                           ".",
                           "[",
                           "[]",
                           "evil.example\0localhost",
                           "evil.example localhost",
                           "evil.example@localhost"})
    EXPECT_FALSE(names.knows_host(host)) << host;
  EXPECT_TRUE(names.knows_site("https://play.example.org"));
  for (const char* site : {"https://evil.example", "null", "", "file://localhost", "http://", "localhost"})
    EXPECT_FALSE(names.knows_site(site)) << site;
}

TEST(WebNames, say_what_shows_a_stranger_on_a_connection_from_this_machine) {
  const auto shows = [](const std::string& host, const std::string& fields = "") {
    return shows_strangers(*parse_http_head("GET / HTTP/1.1\r\nHost: " + host + "\r\n" + fields + "\r\n"));
  };
  for (const char* own : {"localhost:4177", "127.0.0.1:4177", "127.0.1.1", "[::1]:4177"})
    EXPECT_FALSE(shows(own));
  EXPECT_FALSE(shows("localhost:4177", "Origin: http://localhost:4177\r\n"));
  for (const char* other : {"play.example.org", "192.168.0.7", "[2001:db8::7]", "", "evil127.0.0.1"})
    EXPECT_TRUE(shows(other)) << other;
  for (const char* field : {"Origin: http://play.example.org", "Origin: null", "Via: 1.1 a",
                            "Forwarded: for=1.2.3.4", "X-Real-IP: 1.2.3.4", "X-Forwarded-For: 1.2.3.4",
                            "x-forwarded-proto: https", "X-Forwarded-Port: 443", "CF-Connecting-IP: 1.2.3.4"})
    EXPECT_TRUE(shows("localhost:4177", std::string(field) + "\r\n")) << field;
}

TEST_F(SiteTest, says_that_a_proxy_left_its_path_in) {
  EXPECT_TRUE(holds(*ask("/scree/main.js").body, "has to take that path away"));
  EXPECT_TRUE(holds(*ask("/scree/session").body, "has to take that path away"));
  EXPECT_TRUE(holds(*ask("/scree").body, "has to take that path away")) << "as of `location /scree`";
  EXPECT_FALSE(holds(*ask("/nothing.js").body, "path"));
  EXPECT_FALSE(holds(*ask("/scree/nothing.js").body, "path"));
  EXPECT_EQ(ask("/scree/main.js").status, 404);
}

TEST(WebFileNames, hold_a_hash_between_two_dots) {
  for (const char* name : {"a.0123abcd.js", "a.b.0123456789abcdef.wasm"})
    EXPECT_TRUE(holds_hash(name)) << name;
  for (const char* name :
       {"index.html", "a.0123abc.js", "0123abcd.js", "a.0123abcd", "a.0123abcg.js", "a.20261231.js"})
    EXPECT_FALSE(holds_hash(name)) << name;
}

TEST(Origins, are_schemes_with_hosts) {
  for (const char* good : {"https://game.example", "http://localhost:8080", "http://[::1]:80801"})
    EXPECT_TRUE(is_origin(good)) << good;
  for (const char* bad : {"game.example", "https://game.example/", "https://", "*", "https://*.example",
                          "https://a b", "http://a:80", "https://a:443", "ftp://a", "null"})
    EXPECT_FALSE(is_origin(bad)) << bad;
}

}  // namespace
}  // namespace scree
