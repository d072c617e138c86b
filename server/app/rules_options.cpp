#include "server/app/rules_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "shared/base/listed.h"
#include "shared/base/option_check.h"

namespace scree {

namespace fs = std::filesystem;

std::string games_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  for (const char* place : {"../share/scree/games", "../../../games"}) {
    const fs::path folder = (program.parent_path() / place).lexically_normal();
    if (fs::is_directory(folder, error)) return folder.string();
  }
  return {};
}

std::vector<std::string> game_names() {
  std::vector<std::string> names;
  std::error_code error;
  const std::string folder = games_folder();
  if (folder.empty()) return names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (fs::is_regular_file(entry.path() / "init.lua", error))
      names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

void RulesFlags::declare(CLI::App& app, RulesOptions& options) {
  app.add_option(
         "--rules", options.folders,
         "folder of rules in Lua, with init.lua (scree rules new makes one); repeatable: each is a mod, "
         "and they hear of things in this order")
      ->take_all()
      ->excludes(app.get_option("--replay"));
  app.add_option("--game", games_, "a game that comes with Scree, such as demolition; repeatable")
      ->take_all()
      ->excludes(app.get_option("--replay"));
  bounded(app.add_option("--rules-memory", options.memory_mb, "megabytes that the scripts of a mod may use"),
          whole_within(1, 256))
      ->capture_default_str();
  bounded(
      app.add_option("--rules-work", options.percent,
                     "percent of a tick's length that all rules may take; the simulation has so much less"),
      whole_within(1, limits::rules_percent_max))
      ->capture_default_str();
  app.add_flag("--rules-watch", options.watch, "reads rules again whenever one of their files changes");
}

void RulesFlags::complete(RulesOptions& options) const {
  const std::vector<std::string> known = game_names();
  const std::vector<std::string_view> words(known.begin(), known.end());
  for (const std::string& game : games_) {
    if (std::ranges::find(known, game) == known.end())
      throw CLI::ValidationError(
          "--game", "there is no game '" + game +
                        "': " + (known.empty() ? "none comes with this program" : listed(words)));
    options.folders.push_back((fs::path(games_folder()) / game).string());
  }
}

}  // namespace scree
