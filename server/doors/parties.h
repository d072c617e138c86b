// Which sessions share the server as one party (server/work/command.h): those with the same token, or,
// without one, of the same address. By more connections nobody gets more. A party is known by the number of
// its first session, so recordings hold neither addresses nor tokens. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

namespace scree {

class Parties {
 public:
  /// The party of a session with this in common with others. Seconds of any origin.
  uint64_t join(const std::string& common, uint64_t session, double now_s);
  /// One of its sessions has ended. The number stays the party's for limits::party_memory_s after the last
  /// has, so that nobody becomes another party by coming again while his requests still wait.
  void leave(const std::string& common, double now_s);

 private:
  struct Party {
    uint64_t number = 0;
    size_t sessions = 0;
    double left_s = 0.0;  ///< when the last session ended
  };
  std::unordered_map<std::string, Party> parties_;
};

}  // namespace scree
