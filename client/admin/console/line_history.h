// The lines that a person typed before, in a file that nobody else may read. Lines with a secret are not
// kept. Several consoles may keep lines in one file: each adds its own at the end. Not thread-safe.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scree {

class LineHistory {
 public:
  /// Reads the file; one that is not there has no lines. An empty path: lines are kept nowhere.
  explicit LineHistory(std::string path);

  /// The oldest first.
  const std::vector<std::string>& lines() const { return lines_; }
  /// Whether the line is kept, in the file where that can be written.
  bool add(const std::string& line);

 private:
  void read();
  void forget_the_oldest();

  std::string path_;
  std::vector<std::string> lines_;
};

/// $XDG_STATE_HOME/scree/admin_history or ~/.local/state/scree/admin_history. Empty: the environment does not
/// say where.
std::string admin_history_path();

/// Whether a line may have a token in it: it says so, or begins a word as an access token does.
bool may_hold_secret(std::string_view line);

}  // namespace scree
