// What a host keeps for its administrators: lines that they read, and what they did. Called on the network
// thread.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "proto/lines_message.h"

namespace scree {

/// Each may be empty: then there is nothing to read, or nothing is kept.
struct HostRecords {
  /// Objects of JSON without line feeds, the oldest first.
  std::function<std::vector<std::string>(LinesOf)> lines;
  /// Takes an act that was carried out, or handed on, and who did it, both in words.
  std::function<void(const std::string& who, const std::string& act)> acted;
};

}  // namespace scree
