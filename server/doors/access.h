// Who may come in and do what: the server's certificate, the key that signs access tokens, the revoked ones,
// and the role of those who come without. Immutable; loaded again as a whole. Times are seconds since 1970.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "auth/access_token.h"
#include "crypto/tls_context.h"
#include "server/command/refusal.h"
#include "shared/operation/request.h"

namespace scree {

/// Files are PEM; an empty path: none.
struct AccessConfig {
  std::string tls_certificate_path;  ///< with its chain behind it; none: no TLS
  std::string tls_key_path;
  bool tls_required = false;                      ///< connections without TLS are refused
  std::string token_key_path;                     ///< public key of access tokens; none: they are not taken
  std::string token_revoked_path;                 ///< ids of tokens that do not hold any more
  std::optional<Role> anonymous = Role::builder;  ///< role of who comes without a token; none: refused
  std::string world;                              ///< this server's name in tokens
  std::string bans_path;                          ///< where bans are kept; none: until the server ends
};

/// What a session may do, and why.
struct Grant {
  Role role = Role::viewer;
  uint64_t token_id = 0;      ///< 0: it came without an access token
  uint64_t expires_s = 0;     ///< 0: never
  std::string name{};         ///< the person's, by its token; empty: as the person says
  bool vouches_name = false;  ///< the name is the token's, and not only what the person says
  std::string team{};         ///< the person's, by its token; empty: none
};

class Access {
 public:
  /// Reads the files. The error names the file, or the options that contradict each other.
  static Result<std::shared_ptr<const Access>> load(const AccessConfig& config,
                                                    const std::string& admin_token);

  /// The grant for a hello's token, which may be empty.
  tl::expected<Grant, Refused> grant(const std::string& token, uint64_t now_s) const;
  /// Refuses a grant that expired or was revoked since it was given.
  tl::expected<void, Refused> still_holds(const Grant& grant, uint64_t now_s) const;

  /// Null: this server has no certificate.
  const std::shared_ptr<const TlsServerContext>& tls() const { return tls_; }
  bool accepts_tokens() const { return key_.has_value(); }

 private:
  Access() = default;
  tl::expected<Grant, Refused> grant_to(const ReadToken& read, uint64_t now_s) const;
  bool is_revoked(uint64_t id) const;

  std::optional<Role> anonymous_;
  std::string world_;
  std::string admin_token_;  ///< empty: none
  std::shared_ptr<const TlsServerContext> tls_;
  std::optional<VerifyingKey> key_;
  std::vector<uint64_t> revoked_;  ///< sorted
};

/// The role that a request needs.
Role role_for(const Request& request);

/// What is open to everybody who reaches the address, a sentence each; nothing on this machine's own.
std::vector<std::string> open_doors(const AccessConfig& config, const std::string& bind);

}  // namespace scree
