// Every example of the reference runs as it says: within on.start() of a flat world, with a person.
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "server/rules/api.h"
#include "tests/support/test_folder.h"
#include "tools/rules/check_folder.h"
#include "tools/rules/test_world.h"
#include "tools/rules/written_file.h"

namespace scree {
namespace {

/// Enough for replies, and replies to what they ask.
constexpr int ticks_for_replies = 60;
/// Enough for pieces to come to rest, and for on.save.
constexpr int ticks_for_events = 660;

class RulesExamples : public ::testing::Test {
 protected:
  /// What went wrong when the rules began with somebody there: empty if nothing did.
  std::string run(const std::string& init, int ticks) {
    const std::string folder = folder_ / "example";
    const auto write = [&](const std::string& text) {
      EXPECT_TRUE(write_new_file(folder + "/init.lua", text, Existing::replaced));
    };
    write("-- nothing yet\n");
    TestWorldOptions options{.folders = {folder}, .world = {}};
    options.world.terrain.kind = TerrainKind::flat;
    options.world.service.persons = Persons::walk;
    auto world = TestWorld::create(options);
    if (!world) return world.error().message;
    const uint64_t anna = (*world)->join("anna", Role::director, "red");
    (*world)->ask(anna, StandRequest{});
    for (int i = 0; i < 3; ++i) (*world)->step();
    write(init);
    if (const auto loaded = (*world)->reload(); !loaded) return loaded.error().message;
    act_as(**world, anna);
    for (int i = 0; i < ticks; ++i) (*world)->step();
    if ((*world)->faults() == 0) return {};
    std::string said;
    for (const std::string& line : (*world)->log()) said += line + "\n";
    return said;
  }

  /// Something for the handlers of events to hear of.
  static void act_as(TestWorld& world, uint64_t session) {
    world.ask(session, CarveRequest{.shape = sphere({3.0F, 0.0F, 0.0F}, 1.5F)});
    world.ask(session, FillRequest{.shape = sphere({-6.0F, 0.5F, 0.0F}, 1.0F)});
    world.ask(session, PaintRequest{.shape = sphere({-6.0F, 0.5F, 0.0F}, 1.0F)});
    world.ask(session, DigRequest{.shape = sphere({0.0F, 0.0F, 9.0F}, 1.0F), .store = {}});
    world.say(session, "/help");
    world.send(session, {"ping", {1, 2, 3}});
    world.leave(world.join("ben", Role::viewer, ""));
  }

  TestFolder folder_;
};

TEST_F(RulesExamples, of_every_function_runs) {
  for (const ApiFunction& row : all_api()) {
    if (row.table == "on") continue;
    ASSERT_FALSE(row.example.empty()) << row.table << row.name;
    EXPECT_EQ(run("on.start(function()\n" + std::string(row.example) + "\nend)\n", ticks_for_replies), "")
        << row.table << " " << row.name << ":\n"
        << row.example;
  }
}

TEST_F(RulesExamples, of_every_event_runs) {
  for (const ApiEvent& event : api_events())
    EXPECT_EQ(run(std::string(event.example), ticks_for_events), "") << event.example;
}

TEST_F(RulesExamples, are_without_fault_for_the_check) {
  std::string init;
  for (const ApiFunction& row : all_api()) init += "do\n" + std::string(row.example) + "\nend\n";
  for (const ApiEvent& event : api_events()) init += std::string(event.example) + "\n";
  ASSERT_TRUE(write_new_file((folder_ / "all") + "/init.lua", "on.start(function()\n" + init + "end)\n",
                             Existing::refused));
  const auto faults = check_folder(folder_ / "all");
  ASSERT_TRUE(faults) << faults.error().message;
  for (const FolderFault& fault : *faults) ADD_FAILURE() << fault.line << ": " << fault.words;
}

/// The blocks of Lua in a page.
std::vector<std::string> lua_blocks(const std::string& page) {
  static constexpr std::string_view begin = "```lua\n", end = "\n```\n";
  std::vector<std::string> blocks;
  for (size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    blocks.push_back(page.substr(at, page.find(end, at) - at));
  }
  return blocks;
}

TEST_F(RulesExamples, of_the_guide_run) {
  std::ifstream file(SCREE_SOURCE_DIR "/docs/rules.md");
  std::ostringstream page;
  page << file.rdbuf();
  int run_blocks = 0;
  for (const std::string& block : lua_blocks(page.str())) {
    if (block.starts_with("test(")) continue;  // the tests of the pages' commands run those
    EXPECT_EQ(run(block + "\n", ticks_for_replies), "") << block;
    ++run_blocks;
  }
  EXPECT_GE(run_blocks, 3);
}

TEST_F(RulesExamples, that_fails_would_be_found) {
  EXPECT_NE(run("on.start(function() error(\"a mistake\") end)\n", 1), "");
}

}  // namespace
}  // namespace scree
