// The parts of a recording that a recorder gave up, as on a full disk, and of which SQLite's log may lie
// beside the file. Once the disk works, the log is merged into its file, which then is whole by itself. Not
// thread-safe.
#pragma once

#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

class LeftParts {
 public:
  /// `family`: the path that was asked for.
  explicit LeftParts(std::string family) : family_(std::move(family)) {}

  void add(const std::string& part);
  /// Adds all parts of the family beside which a log lies now. The next reader of a part merges its log, and
  /// leaves no trace.
  void find();
  /// A new part has this name.
  void forget(const std::string& part);
  /// Closes those that can be closed now; the others stay for the next call.
  void close();
  /// For the end: closes these, and all parts of the family beside which a log lies. Returns a line for each
  /// log that is left. No part is tried after that time of the steady clock.
  std::vector<std::string> close_all(double until_s);

 private:
  std::string family_;
  std::vector<std::string> parts_;
};

}  // namespace scree
