// A word that a program does not know is named, with the one that was meant; and lists for administrators are
// in units of people.
#include "shared/base/near_name.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "client/admin/admin.h"
#include "server/app/server_options.h"

namespace scree {
namespace {

/// What a program with commands, as scree-admin, says to these words.
std::string said_to(const std::vector<const char*>& words) {
  CLI::App app;
  app.require_subcommand(0, 1);
  app.fallthrough();
  bool json = false;
  uint32_t minutes = 0;
  app.add_flag("--json", json);
  app.add_subcommand("sessions", "");
  app.add_subcommand("ban", "")->add_option("--minutes", minutes);
  name_unknown_words<CLI::ExtrasError>(app);
  std::vector<const char*> arguments{"program"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  std::ostringstream out, err;
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::ParseError& error) {
    EXPECT_NE(app.exit(error, out, err), 0);
  }
  const std::string all = err.str();
  return all.substr(0, all.find('\n'));
}

TEST(NearName, unknown_words_are_named_with_those_that_were_meant) {
  EXPECT_EQ(said_to({"sesions"}), "there is no command 'sesions'; did you mean sessions?");
  EXPECT_EQ(said_to({"cheese"}), "there is no command 'cheese'");
  EXPECT_EQ(said_to({"sessions", "--jsno"}), "there is no option --jsno; did you mean --json?");
  EXPECT_EQ(said_to({"ban", "--minute=4"}), "there is no option --minute; did you mean --minutes?");
  EXPECT_EQ(said_to({"sessions", "more"}), "'more' is not expected");
  EXPECT_EQ(said_to({"--cheese", "more"}), "there is no option --cheese");
  EXPECT_EQ(said_to({"ban", "--minutes", "x"}).substr(0, 5), "Could") << "other mistakes are CLI11's to tell";
}

TEST(NearName, the_server_names_a_mistyped_option) {
  const std::array<const char*, 3> arguments{"scree-server", "--worldd", "x"};
  ::testing::internal::CaptureStderr();
  const auto parsed = parse_server_options(static_cast<int>(arguments.size()), arguments.data());
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::get<int>(parsed), 2);
  EXPECT_EQ(said.substr(0, said.find('\n')), "there is no option --worldd; did you mean --world?");
}

TEST(BanLines, say_how_long_a_ban_is_in_the_units_of_people) {
  const auto line_of = [](uint64_t left_s) { return bans_lines({{"10.0.0.1", left_s, ""}}); };
  EXPECT_EQ(line_of(0), "10.0.0.1, until it is lifted\n");
  EXPECT_EQ(line_of(42), "10.0.0.1, for 42 s\n");
  EXPECT_EQ(line_of(90), "10.0.0.1, for 2 min\n");
  EXPECT_EQ(line_of(3599), "10.0.0.1, for 1 h\n");
  EXPECT_EQ(line_of(3661), "10.0.0.1, for 1 h 2 min\n");
  EXPECT_EQ(line_of(86400), "10.0.0.1, for 1 d\n");
  EXPECT_EQ(line_of(12 * 86400 + 3 * 3600 + 1), "10.0.0.1, for 12 d 4 h\n");
}

}  // namespace
}  // namespace scree
