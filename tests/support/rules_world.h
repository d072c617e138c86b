// A world with rules of scripts, stepped by hand: without a network, with persons that are there by name.
#pragma once

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "server/rules/rules.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"

namespace scree {

/// Writes a mod's init.lua, and returns its folder.
inline std::string write_mod(const TestFolder& folder, const std::string& name, const std::string& text) {
  const std::filesystem::path path(folder / name);
  std::filesystem::create_directories(path);
  std::ofstream(path / "init.lua") << text;
  return path.string();
}

class RulesWorld {
 public:
  explicit RulesWorld(const std::string& text, const WorldConfig& config = flat_world())
      : RulesWorld(std::vector<std::string>{text}, config) {}
  /// A mod each: "first", "second", "third".
  explicit RulesWorld(const std::vector<std::string>& texts, const WorldConfig& config = flat_world())
      : world(std::make_unique<World>(config)) {
    static constexpr const char* names[] = {"first", "second", "third"};
    for (size_t i = 0; i < texts.size(); ++i)
      options.folders.push_back(write_mod(folder, names[i], texts[i]));
    options.percent = limits::rules_percent_max;  // a test's machine may be slow
    options.log = [this](const std::string& line, bool /*is_fault*/) {
      const std::scoped_lock lock(mutex);
      logged.push_back(line);
    };
    load();
  }

  void load() {
    auto loaded = Rules::load(options);
    ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
    rules = std::move(*loaded);
    HostActs acts;
    acts.send = [this](uint64_t session, ServerMessage message) {
      sent.emplace_back(session, std::move(message));
    };
    acts.set_role = [this](uint64_t session, Role role) { roles[session] = role; };
    acts.kick = [this](uint64_t session, const std::string& reason) { kicked[session] = reason; };
    rules->start(acts);
  }

  /// A person comes. Returns the session.
  uint64_t join(const std::string& name, Role role = Role::builder) {
    JoinedPerson person;
    person.session = next_session++;
    person.name = name;
    person.role = role;
    person.meets = true;
    rules->join(person);
    return person.session;
  }

  /// A tick with these commands, and what the recording would have of it.
  std::shared_ptr<const TickDelta> step(std::vector<Command> commands = {}) {
    // As of persons who share an address with somebody who has left.
    for (Command& command : commands)
      if (command.session != 0 && command.party == 0) command.party = 1000 + command.session;
    TickCommands tick(std::move(commands));
    rules->before(*world, tick);
    refused = tick.refused();
    asked = tick.let_through();
    last = world->step(asked);
    rules->after(*last);
    EXPECT_EQ(last->ledger.error(), 0);
    return last;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }

  bool has_logged(const std::string& words) const {
    const std::scoped_lock lock(mutex);
    for (const std::string& line : logged)
      if (line.find(words) != std::string::npos) return true;
    return false;
  }
  std::string all_logged() const {
    const std::scoped_lock lock(mutex);
    std::string all;
    for (const std::string& line : logged) all += line + "\n";
    return all;
  }

  TestFolder folder;
  RulesOptions options;
  std::unique_ptr<World> world;
  std::unique_ptr<Rules> rules;
  std::shared_ptr<const TickDelta> last;
  std::vector<Reply> refused;
  std::vector<Command> asked;
  std::vector<std::pair<uint64_t, ServerMessage>> sent;
  std::map<uint64_t, Role> roles;
  std::map<uint64_t, std::string> kicked;
  uint64_t next_session = 1;

 private:
  mutable std::mutex mutex;
  std::vector<std::string> logged;
};

}  // namespace scree
