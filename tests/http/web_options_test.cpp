// What the server's command line says of HTTP.
#include <cstdlib>
#include <gtest/gtest.h>

#include "server/app/server_options.h"
#include "server/app/web_folder.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

/// Nothing when the command line is refused.
std::optional<WebConfig> web_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "scree-server");
  std::vector<const char*> raw;
  for (const std::string& argument : arguments) raw.push_back(argument.c_str());
  const auto parsed = parse_server_options(static_cast<int>(raw.size()), raw.data());
  const auto* options = std::get_if<ServerOptions>(&parsed);
  return options == nullptr ? std::nullopt : std::optional(options->live.net.web);
}

TEST(WebOptions, name_a_folder_or_none) {
  const WebFolder folder;
  EXPECT_TRUE(web_of({})->on);
  EXPECT_EQ(web_of({})->folder, web_folder_beside_program());
  EXPECT_EQ(web_of({"--web", folder.path()})->folder, folder.path());
  EXPECT_FALSE(web_of({"--web", "off"})->on);
  EXPECT_FALSE(web_of({"--web", folder.path() + "nowhere"}));
  EXPECT_FALSE(web_of({"--web", folder.path() + "parts"})) << "it has no index.html";
}

TEST(WebOptions, name_further_sites) {
  EXPECT_TRUE(web_of({})->origins.empty());
  EXPECT_EQ(web_of({"--web-origin", "https://a.example", "--web-origin", "http://b:81"})->origins,
            (std::vector<std::string>{"https://a.example", "http://b:81"}));
  EXPECT_FALSE(web_of({"--web-origin", "*"}));
  EXPECT_FALSE(web_of({"--web-origin", "a.example"}));
}

TEST(WebOptions, name_the_hosts_by_which_people_come) {
  EXPECT_TRUE(web_of({})->hosts.empty());
  EXPECT_EQ(web_of({"--web-host", "play.example.org,hill", "--web-host", "xn--hgel-0ra.example"})->hosts,
            (std::vector<std::string>{"play.example.org", "hill", "xn--hgel-0ra.example"}));
  for (const char* wrong : {"http://play.example.org", "play.example.org:4177", "play.example.org/", "*",
                            "*.example.org", "hügel.example", "play..org", ".org", "a b"})
    EXPECT_FALSE(web_of({"--web-host", wrong})) << wrong;
  ::setenv("SCREE_WEB_HOST", "play.example.org,hill", 1);
  const auto several = web_of({});
  ::setenv("SCREE_WEB_HOST", "", 1);
  const auto none = web_of({});
  ::unsetenv("SCREE_WEB_HOST");
  EXPECT_EQ(several->hosts, (std::vector<std::string>{"play.example.org", "hill"}));
  ASSERT_TRUE(none) << "docker/compose.yaml sets it so";
  EXPECT_TRUE(none->hosts.empty());
}

TEST(WebOptions, tell_a_person_where_the_page_is) {
  EXPECT_EQ(page_url("127.0.0.1", 4177, false), "http://127.0.0.1:4177/");
  EXPECT_EQ(page_url("0.0.0.0", 80, true), "https://localhost:80/");
  EXPECT_EQ(page_url("::1", 4177, false), "http://[::1]:4177/");
}

}  // namespace
}  // namespace scree
