// The persons in the world and the lines that they say: who is in the list, who was told it, how much each
// may say. No sockets; time is an argument (seconds). On the network thread.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "proto/talk.h"
#include "shared/base/rate_limit.h"

namespace scree {

class Talk {
 public:
  /// `chat`: whether lines are passed on.
  explicit Talk(bool chat);

  /// A session whose client meets others (HelloMessage::meets); it may be there already. `party`: as of
  /// Command; an administrator is a party alone.
  void join(uint64_t session, uint64_t party, const std::string& name, Role role);
  /// Nothing, of a session that is not there.
  void rename(uint64_t session, const std::string& name);
  void set_role(uint64_t session, Role role);
  void leave(uint64_t session);

  /// What becomes of a line: said to all, or by the server to the speaker alone; nothing, of a line without
  /// words.
  struct Heard {
    SaidMessage line;
    bool by_all = false;
  };
  std::optional<Heard> say(uint64_t session, const std::string& text, double now_s);

  /// The sessions that are to be told the list now, if it is time.
  std::vector<uint64_t> untold(double now_s) const;
  /// What they are told.
  PersonsMessage list() const;
  void told(uint64_t session, double now_s);
  /// All sessions of the list, by number.
  std::vector<uint64_t> everybody() const;

 private:
  struct Entry {
    uint64_t party = 0;
    std::string name;
    Role role = Role::viewer;
    RateLimit lines;
    uint64_t told = 0;  ///< version_ that it knows
  };

  struct PartyLines {
    RateLimit lines;
    double said_s = 0.0;
  };
  bool may_say(Entry& speaker, double now_s);
  /// Lines that all together may say a second.
  double lines_per_second() const;

  bool chat_;
  std::map<uint64_t, Entry> persons_;
  std::map<uint64_t, PartyLines> parties_;  ///< that said something of late
  RateLimit all_lines_;
  uint64_t version_ = 0;
  double next_list_s_ = 0.0;
};

}  // namespace scree
