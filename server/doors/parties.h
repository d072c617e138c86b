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
  /// The party of a session with this in common with others.
  uint64_t join(const std::string& common, uint64_t session);
  /// One of its sessions has ended. The number stays the party's until the last has.
  void leave(const std::string& common);

 private:
  struct Party {
    uint64_t number = 0;
    size_t sessions = 0;
  };
  std::unordered_map<std::string, Party> parties_;
};

}  // namespace scree
