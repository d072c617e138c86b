// What makers of rules use: scree-rules new, check, test, types and reference.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"
#include "tools/rules/check_folder.h"
#include "tools/rules/new_folder.h"
#include "tools/rules/reference_text.h"
#include "tools/rules/types_text.h"
#include "tools/rules/written_file.h"

namespace scree {
namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write(const std::string& path, const std::string& text) {
  const auto written = write_new_file(path, text, Existing::replaced);
  ASSERT_TRUE(written) << written.error().message;
}

std::pair<int, std::string> rules(const std::string& arguments) {
  return run_program(SCREE_RULES_PROGRAM " " + arguments);
}

class RulesTools : public ::testing::Test {
 protected:
  /// A folder of rules with this init.lua.
  std::string folder_with(const std::string& init) {
    const std::string folder = folder_ / "game";
    write(folder + "/init.lua", init);
    return folder;
  }
  std::vector<FolderFault> faults_of(const std::string& folder) {
    const auto faults = check_folder(folder);
    EXPECT_TRUE(faults) << faults.error().message;
    return faults ? *faults : std::vector<FolderFault>();
  }

  TestFolder folder_;
};

TEST_F(RulesTools, a_new_folder_has_no_faults_and_its_tests_pass) {
  const std::string folder = folder_ / "mine";
  const auto [made, said] = rules("new " + folder);
  ASSERT_EQ(made, 0) << said;
  EXPECT_EQ(faults_of(folder), std::vector<FolderFault>());
  const auto [status, tested] = rules("test " + folder);
  EXPECT_EQ(status, 0) << tested;
  EXPECT_NE(tested.find("3 passed, 0 failed"), std::string::npos) << tested;
}

TEST_F(RulesTools, a_folder_that_is_there_stays_as_it_is) {
  const std::string folder = folder_with("-- mine\n");
  const auto [status, said] = rules("new " + folder);
  EXPECT_EQ(status, 2);
  EXPECT_NE(said.find("is there already"), std::string::npos) << said;
  EXPECT_EQ(text_of_file(folder + "/init.lua"), "-- mine\n");
}

TEST_F(RulesTools, names_that_rules_cannot_have_are_refused) {
  const auto [status, said] = rules("new '" + (folder_ / "my game") + "'");
  EXPECT_EQ(status, 2);
  EXPECT_NE(said.find("'my game' is no name of rules"), std::string::npos) << said;
}

TEST_F(RulesTools, check_finds_unknown_functions_and_handlers_with_their_lines) {
  const auto faults = faults_of(
      folder_with("on.start(function()\n  log(world.rey(vec(0, 9, 0), vec(0, -1, 0)))\nend)\n"
                  "on.join(function() sey(\"hello\") end)\nif false then on.jion(function() end) end\n"));
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].file, "init.lua");
  EXPECT_EQ(faults[0].line, 2);
  EXPECT_NE(faults[0].words.find("'rey'"), std::string::npos) << faults[0].words;
  EXPECT_EQ(faults[1].line, 4);
  EXPECT_NE(faults[1].words.find("'sey'"), std::string::npos) << faults[1].words;
  EXPECT_EQ(faults[2].line, 5);
  EXPECT_NE(faults[2].words.find("'jion'"), std::string::npos) << faults[2].words;
}

TEST_F(RulesTools, check_finds_what_the_sandbox_leaves_out) {
  const auto faults = faults_of(folder_with("on.tick(function() print(os.time()) end)\n"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].words.find("'os'"), std::string::npos) << faults[0].words;
}

TEST_F(RulesTools, check_finds_misspelt_fields_and_methods) {
  const auto faults = faults_of(
      folder_with("on.carve(function(e)\n  world.carve{ at = e.at, raduis = 2 }\n"
                  "  world.build({ { at = vec(0, 1, 0), raduis = 2 } }, { at = e.at })\n"
                  "  log(e.plase)\n  e.by:stnad(e.at)\n  local own = {}\n"
                  "  function own:dance() return self end\n  own:dance()\nend)\n"
                  "regions.set{ name = \"a\", at = { x = 1, yy = 2, z = 3 }, [\"half\"] = vec(1, 1, 1) }\n"));
  ASSERT_GE(faults.size(), 5U);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(faults[i].file, "init.lua");
  EXPECT_EQ(faults[0].line, 2);
  EXPECT_NE(faults[0].words.find("carve has no field 'raduis': there are "), std::string::npos);
  EXPECT_EQ(faults[1].line, 3);
  EXPECT_EQ(faults[2].line, 4);
  EXPECT_NE(faults[2].words.find("on.carve gives no 'plase'"), std::string::npos) << faults[2].words;
  EXPECT_EQ(faults[3].line, 5);
  EXPECT_NE(faults[3].words.find("no method 'stnad'"), std::string::npos) << faults[3].words;
  EXPECT_EQ(faults[4].line, 10);
  EXPECT_NE(faults[4].words.find("'yy'"), std::string::npos) << faults[4].words;
}

TEST_F(RulesTools, check_lets_pass_what_a_handler_puts_into_its_event_or_calls_anew) {
  const auto faults =
      faults_of(folder_with("on.carve(function(e)\n  e.mine = 1\n  log(e.mine)\nend)\n"
                            "on.merge(function(e)\n  local e = { mine = e }\n  log(e.mine)\nend)\n"
                            "log((\"%d\"):rep(2):upper())\n"
                            "on.join(function(e) world.carve(e) end)\n"));
  EXPECT_TRUE(faults.empty()) << faults[0].words;
}

TEST_F(RulesTools, check_finds_wrong_syntax_once) {
  const auto faults = faults_of(folder_with("on.start(function()\n  local = 3\nend)\n"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].line, 2);
}

TEST_F(RulesTools, check_runs_the_files_as_a_server_loads_them) {
  const auto faults = faults_of(folder_with("local t = {}\nlog(\"a\")\nt.none.field = 1\n"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].file, "init.lua");
}

TEST_F(RulesTools, check_looks_at_files_that_are_required_and_at_tests) {
  const std::string folder = folder_with("require(\"more\")\n");
  write(folder + "/more.lua", "on.start(function() world.dgi{} end)\n");
  write(folder + "/tests/one.lua", "test(\"a\", function(t) expct(true) end)\n");
  const auto faults = faults_of(folder);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].file, "more.lua");
  EXPECT_EQ(faults[1].file, "tests/one.lua");
}

TEST_F(RulesTools, check_says_what_it_found_by_status_and_as_json) {
  const std::string folder = folder_with("on.start(function() world.rey() end)\n");
  const auto [status, said] = rules("check --json " + folder);
  EXPECT_EQ(status, 1);
  const auto json = nlohmann::json::parse(said);
  ASSERT_EQ(json["faults"].size(), 1U);
  EXPECT_EQ(json["faults"][0]["line"], 1);
  EXPECT_EQ(rules("check " + (folder_ / "none")).first, 2);
  write(folder + "/init.lua", "on.start(function() end)\n");
  EXPECT_EQ(rules("check " + folder).first, 0);
}

TEST_F(RulesTools, a_test_that_passes_says_what_it_printed_where_that_is_asked_for) {
  const std::string folder = folder_with("on.start(function() log(\"begun\") end)\n");
  write(folder + "/tests/one.lua", "test(\"a\", function(t) t:step(1) print(\"here\") end)\n");
  const auto [status, said] = rules("test " + folder);
  EXPECT_EQ(status, 0) << said;
  EXPECT_EQ(said.find("said:"), std::string::npos) << said;
  const std::string all = rules("test --log " + folder).second;
  EXPECT_NE(all.find("begun"), std::string::npos) << all;
  EXPECT_NE(all.find("here"), std::string::npos) << all;
}

TEST_F(RulesTools, a_test_that_fails_is_told_with_its_line) {
  const std::string folder = folder_with("on.start(function() end)\n");
  write(folder + "/tests/one.lua",
        "test(\"good\", function(t) equal({ 1, { a = 2 } }, { 1, { a = 2 } }) end)\n"
        "test(\"bad\", function(t)\n  equal(1 + 1, 3)\nend)\n");
  const auto [status, said] = rules("test " + folder);
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("tests/one.lua:3: 2 is not 3"), std::string::npos) << said;
  EXPECT_NE(said.find("1 passed, 1 failed"), std::string::npos) << said;
  EXPECT_EQ(rules("test " + folder + " good").first, 0);
  EXPECT_EQ(rules("test " + folder + " nothing-of-that-name").first, 2);
}

TEST_F(RulesTools, a_handler_that_fails_fails_the_test_unless_it_is_expected) {
  const std::string folder = folder_with("on.say(function(e) error(\"a mistake\") end)\n");
  write(folder + "/tests/one.lua",
        "test(\"silent\", function(t) t:say(t:join(\"anna\"), \"x\") end)\n"
        "test(\"expected\", function(t) t:say(t:join(\"anna\"), \"x\") equal(t:faults(), 1) end)\n");
  const auto [status, said] = rules("test " + folder);
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("a mistake"), std::string::npos) << said;
  EXPECT_NE(said.find("1 passed, 1 failed"), std::string::npos) << said;
}

TEST_F(RulesTools, an_endless_test_ends) {
  const std::string folder = folder_with("on.start(function() end)\n");
  write(folder + "/tests/one.lua", "test(\"endless\", function(t) while true do end end)\n");
  const auto [status, said] = rules("test " + folder);
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("too long"), std::string::npos) << said;
}

TEST_F(RulesTools, annotations_name_every_function) {
  const std::string text = types_text();
  for (const char* line : {"function world.ray(from, direction, most, mask) end",
                           "function person:say(text) end", "---@class carve", "---@field radius?",
                           "function on.fall(handler) end", "---@param handler fun(e: on_join)"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
  const auto [status, said] = rules("types --out " + (folder_ / "any"));
  EXPECT_EQ(status, 0) << said;
  EXPECT_EQ(text_of_file((folder_ / "any") + "/types/scree.lua"), text);
}

TEST(RulesReference, is_as_the_page_in_the_sources) {
  EXPECT_TRUE(text_of_file(SCREE_SOURCE_DIR "/docs/rules-reference.md") == reference_text())
      << "./scree rules reference > docs/rules-reference.md";
}

}  // namespace
}  // namespace scree
