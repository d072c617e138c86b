// The file of a Unix socket on which a server listens: made for its owner alone, and removed again.
//
// A file that a server left behind, when it was killed, is replaced. Any other file stays, and is an error;
// so is a socket on which somebody listens. Servers that begin at the same moment do so one after the other,
// by a lock on the folder. Not thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "shared/base/result.h"

namespace scree {

class SocketFile {
 public:
  SocketFile() = default;
  /// Closes nothing: the descriptor is the caller's. Calls remove().
  ~SocketFile() { remove(); }
  SocketFile(const SocketFile&) = delete;
  SocketFile& operator=(const SocketFile&) = delete;

  /// Makes the file, of mode 0600 from the beginning. Returns the descriptor of the listening socket, which
  /// does not block. The error names the path and what is wrong. Called once.
  Result<int> listen(const std::string& path);
  /// Removes the file, unless another has taken its place.
  void remove();

 private:
  /// By which the file is known again.
  struct Identity {
    uint64_t device = 0;
    uint64_t inode = 0;

    bool operator==(const Identity&) const = default;
  };
  static std::optional<Identity> identity_at(const std::string& path);

  std::string path_;
  std::optional<Identity> made_;  ///< nothing: there is no file to remove
};

}  // namespace scree
