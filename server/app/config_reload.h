// What a file of options that was read again (SIGHUP) changes in a running server.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/app/server_options.h"

namespace scree {

struct OptionChanges {
  SettingValues settings;            ///< to be set, as an administrator would
  std::optional<std::string> level;  ///< of the log, where that differs
  LogConfig log;                     ///< as it is to be then
  /// What differs and holds from the next start on, a sentence each: options that are fixed, and settings
  /// that are not told any more.
  std::vector<std::string> later;
};

/// Between two readings of the same command line.
OptionChanges changes_between(const std::vector<OptionValue>& before, const std::vector<OptionValue>& now);

/// The options as they were read last, for the next reading.
class ConfigReload {
 public:
  ConfigReload(int argc, const char* const* argv, const ServerOptions& options);
  /// Reads the command line, its file and the environment again. Nothing: no file was named.
  Result<std::optional<OptionChanges>> read();

 private:
  std::vector<const char*> arguments_;
  bool has_file_;
  std::vector<OptionValue> values_;  ///< as they hold: fixed ones as the server started with them
};

}  // namespace scree
