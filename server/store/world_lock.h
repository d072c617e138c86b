// Keeps a world to one process: the lock is on a file beside it, FILE-lock, and ends with the process,
// however that ends.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

class WorldLock {
 public:
  /// Refuses a world that another process holds, by that one's number; and a folder that cannot be written.
  static Result<WorldLock> acquire(const std::string& world_path);
  ~WorldLock();
  WorldLock(WorldLock&& other) noexcept;
  WorldLock& operator=(WorldLock&& other) noexcept;

 private:
  explicit WorldLock(int file) : file_(file) {}

  int file_ = -1;
};

}  // namespace scree
