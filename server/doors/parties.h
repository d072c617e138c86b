// Which sessions share the server as one party (server/command/command.h): those with the same token, or,
// without one, of the same address. By more connections nobody gets more. Each program on the server's own
// machine is a party, as long as it is there. The next program takes over the party that was left last, with
// its debts, so that nobody gains by coming and going. A party is known by the number of its first session,
// so recordings hold neither addresses nor tokens. Not thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace scree {

class Parties {
 public:
  /// The party of a session with this in common with others, not empty. Seconds of any origin.
  uint64_t join(const std::string& common, uint64_t session, double now_s);
  /// The party of a session that shares with none that is there. `before`: the session's own, if it goes on
  /// after a lost connection; else 0. It shares with who has taken that one over since.
  uint64_t join_apart(uint64_t session, uint64_t before, double now_s);
  /// One of the party's sessions has ended. The number stays the party's for limits::party_memory_s after the
  /// last has, so that nobody becomes another party by coming again while his requests still wait.
  void leave(uint64_t party, double now_s);

 private:
  struct Party {
    std::string common;  ///< empty: of a session apart
    size_t sessions = 0;
    double left_s = 0.0;  ///< when the last session ended
  };

  void forget_the_old(double now_s);
  uint64_t enter(uint64_t party, const std::string& common);

  std::map<uint64_t, Party> parties_;
};

}  // namespace scree
