// Access tokens: what one person may do, signed by the key of who hosts. proto/scree.proto (Hello) specifies
// their bytes. Times are seconds since 1970 by the clock of who asks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "crypto/signing_key.h"
#include "shared/base/result.h"
#include "shared/base/role.h"

namespace scree {

struct AccessToken {
  uint64_t id = 0;  ///< not 0; by which it is revoked
  Role role = Role::viewer;
  uint64_t issued_s = 0;
  uint64_t expires_s = 0;  ///< 0: never
  std::string name;        ///< the person's; empty: as the person says
  std::string world;       ///< name of the only world that it is for; empty: any
  std::string team{};      ///< the person's; empty: none

  bool operator==(const AccessToken&) const = default;
};

/// The token as text; the error names the field that is over its limit.
Result<std::string> sign(const AccessToken& token, const SigningKey& key);

/// A token as it was presented: nothing of it holds before the signature was checked.
struct ReadToken {
  AccessToken token;
  std::vector<uint8_t> signed_bytes;
  Signature signature{};

  bool is_by(const VerifyingKey& key) const { return key.holds(signed_bytes, signature); }
};

/// Whether the text begins as a token does.
bool is_access_token(std::string_view text);
Result<ReadToken> read_access_token(std::string_view text);

/// 16 hex digits, and back.
std::string id_text(uint64_t id);
Result<uint64_t> read_id(std::string_view text);

/// Ids from a file: one a line; what follows '#' is ignored. The error names the file and the line. Sorted.
Result<std::vector<uint64_t>> read_revoked(const std::string& path);

}  // namespace scree
