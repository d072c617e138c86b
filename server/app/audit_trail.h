// What administrators did, kept in a file beside the world, which may be removed at any time: a line of JSON
// for each act, with "time", "who" and "act". A file that grows beyond limits::audit_bytes_max is renamed to
// NAME.1, in the place of the one before. Not thread-safe.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/base/log_limit.h"
#include "shared/base/result.h"

namespace scree {

class AuditTrail {
 public:
  /// Goes on where the file ends. An empty path: nothing outlasts the process. The error is the system's.
  static Result<AuditTrail> open(std::string path);

  /// What cannot be written is kept in memory, and the log says it.
  void add(const std::string& who, const std::string& act);
  /// The newest, the oldest of them first; together at most limits::audit_kept_bytes.
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  explicit AuditTrail(std::string path) : path_(std::move(path)) {}

  Result<void> read();
  Result<void> append(const std::string& line);
  void keep(std::string line);

  std::string path_;
  std::vector<std::string> lines_;
  size_t kept_bytes_ = 0;
  bool torn_ = false;  ///< the file's last line has no end: a process died while it wrote
  LogLimit log_limit_;
};

}  // namespace scree
