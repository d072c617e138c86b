// Addresses that are refused, for a time or until they are let in again; kept in a file if there is one.
// Times are seconds since 1970. Not thread-safe.
//
// The file has a line for each: ADDRESS UNTIL REASON, where UNTIL 0 is for ever. It is written anew at each
// change.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "shared/base/result.h"

namespace scree {

struct Ban {
  uint64_t until_s = 0;  ///< 0: until it is lifted
  std::string reason;
};

/// What is banned with an address: an IPv4 address itself, also where it is written as IPv6; an IPv6 address
/// stands for its network of 64 bits, because who has one address has them all. As text; an error for what is
/// neither.
Result<std::string> ban_key(const std::string& address);

class Bans {
 public:
  /// Without a path: kept nowhere. A file that is not there holds none; one that cannot be read is an error,
  /// which names the line.
  static Result<Bans> open(const std::string& path);

  /// The error of these two: the file could not be written, and the ban holds until the server ends (is
  /// lifted until then); or there are limits::bans_max already.
  Result<void> add(const std::string& key, const Ban& ban, uint64_t now_s);
  Result<void> lift(const std::string& key);

  /// Null: not banned.
  const Ban* find(const std::string& address, uint64_t now_s) const;
  /// By key; those that ended may still be among them.
  const std::map<std::string, Ban>& all() const { return bans_; }

 private:
  Result<void> write() const;

  std::string path_;
  std::map<std::string, Ban> bans_;
};

}  // namespace scree
