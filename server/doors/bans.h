// Who is refused, for a time or until he is let in again: addresses, names and tokens (ban_target.h); kept in
// a file if there is one. Times are seconds since 1970. Not thread-safe.
//
// The file has a line for each: TARGET UNTIL REASON, where UNTIL 0 is for ever. Empty lines and lines that
// begin with # are for people. Each change reads the file again: lines that were added, changed or taken out
// by hand since then count, and all others, with the order and the comments, stay as they are.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/doors/ban_target.h"
#include "shared/base/result.h"

namespace scree {

struct Ban {
  uint64_t until_s = 0;  ///< 0: until it is lifted
  std::string reason;

  bool operator==(const Ban&) const = default;
};

/// A ban that refuses somebody.
struct FoundBan {
  Ban ban;
  BanTarget target;
};

class Bans {
 public:
  /// Without a path: kept nowhere. A file that is not there holds none; one that cannot be read is an error.
  /// A line that is no ban is not: a server that did not start would refuse everybody for it.
  static Result<Bans> open(const std::string& path);
  /// The first line of the file that is no ban, why, and how many more there are, as it was read last; empty:
  /// there is none.
  const std::string& fault() const { return fault_; }

  /// The error of these two: the file could not be written, and the ban holds until the server ends (is
  /// lifted until then); or there are limits::bans_max already. `key`: as of ban_key().
  Result<void> add(const std::string& key, const Ban& ban, uint64_t now_s);
  Result<void> lift(const std::string& key);
  /// Takes what was changed in the file by hand. The error names a line that is no ban; all others count.
  Result<void> read_again();

  /// Nothing: nobody bans them.
  std::optional<FoundBan> find(const BanSubject& subject, uint64_t now_s) const;
  /// By key; those that ended may still be among them.
  const std::map<std::string, Ban>& all() const { return bans_; }

 private:
  /// A line of the file, and the ban in it; a line without one has no key.
  struct Line {
    std::string text;
    std::string key{};
    Ban ban{};
  };
  struct File {
    bool is_there = false;
    std::vector<Line> lines{};
    std::string fault{};  ///< as of fault()
  };
  using List = std::map<std::string, Ban>;

  Result<File> read_file() const;
  void merge(const File& file);
  Result<void> write();

  std::string path_;
  std::string fault_;
  List bans_;
  List in_file_;  ///< as it was read or written last
  std::map<std::string, BanTarget> targets_;
};

}  // namespace scree
