// The options of a server's rules: folders of Lua, or a game that comes with Scree.
#pragma once

#include <string>
#include <vector>

#include "server/rules/rules.h"

namespace CLI {
class App;
}

namespace scree {

class RulesFlags {
 public:
  /// `options` is filled in by the program's parse and by complete().
  void declare(CLI::App& app, RulesOptions& options);
  /// The folders of games that were named. Throws CLI::ValidationError where there is none of a name.
  void complete(RulesOptions& options) const;

 private:
  std::vector<std::string> games_;
};

/// Where the games that come with Scree lie: beside the program (../share/scree/games), or in the sources of
/// a build tree (../../../games). Empty: in neither.
std::string games_folder();
/// Their names, in order.
std::vector<std::string> game_names();

}  // namespace scree
