// Decides what a client may do: the grant for a hello, the admin token and wrong guesses at it, bans. No
// sockets. Times are arguments: seconds of steady_now_s() for guesses, seconds since 1970 for tokens and
// bans. Not thread-safe.
//
// open() comes before every other call.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/doors/access.h"
#include "server/doors/bans.h"
#include "server/doors/door.h"

namespace scree {

/// Where a client comes from.
struct Caller {
  std::string address;     ///< as of Door
  std::string ip;          ///< the IP address
  bool encrypted = false;  ///< by TLS
  bool relayed = false;    ///< by a proxy: not from where its address says
  bool is_owner = false;   ///< by the admin socket: who runs the server, whom the system vouches for
};

class Authorizer {
 public:
  /// `config` and `door` must outlive this object. `admin_token`: empty for none.
  Authorizer(const AccessConfig& config, const std::string& admin_token, Door& door)
      : config_(config), admin_token_(admin_token), door_(door) {}

  /// Reads certificate, keys, revoked tokens and bans. The error names the file.
  Result<void> open();
  /// Replaces certificate, keys and revoked tokens.
  void set_access(std::shared_ptr<const Access> access) { access_ = std::move(access); }
  const Access& access() const { return *access_; }
  Bans& bans() { return bans_; }
  const Bans& bans() const { return bans_; }

  bool has_admin_token() const { return !admin_token_.empty(); }
  /// Whether anybody could be an administrator here.
  bool knows_administrators() const { return has_admin_token() || access_->accepts_tokens(); }

  /// A wrong token ends the connection, so that each connection has one attempt, and its address must wait
  /// before the next one (Door). The right token waits, too: any answer meanwhile would answer a guess.
  tl::expected<void, Refused> check_admin_token(const std::string& address, const std::string& token,
                                                double now_s);
  /// The grant for a hello with this token, which may be empty, and this name of a person. The owner is an
  /// administrator, whatever the token.
  tl::expected<Grant, Refused> grant_to(const Caller& caller, const std::string& token,
                                        const std::string& name, double now_s, uint64_t unix_s);
  /// Whether a client with this role may administer without an admin token beside the request. `is_control`:
  /// the request controls a replay, which this machine's own programs may do where there are no
  /// administrators.
  tl::expected<void, Refused> may_administer(Role role, const Caller& caller, bool is_control) const;

 private:
  const AccessConfig& config_;
  const std::string admin_token_;
  Door& door_;
  std::shared_ptr<const Access> access_;
  Bans bans_;
};

/// Refuses a role that may not act as `needed`.
tl::expected<void, Refused> check_role(Role role, Role needed);

/// What somebody is told whom a ban refuses.
std::string words_of(const FoundBan& found);

/// `what`, and the reason behind it if there is one.
std::string with_reason(const std::string& what, const std::string& reason);

}  // namespace scree
