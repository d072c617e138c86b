#include "auth/new_secret.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "auth/base64url.h"
#include "auth/replace_file.h"
#include "crypto/signing_key.h"

namespace scree {

namespace {

std::string new_secret() {
  // A dash at its start would make an option of it on a command line.
  std::array<uint8_t, 17> bytes{};
  for (size_t at = 1; at < bytes.size(); at += sizeof(uint64_t)) {
    const uint64_t number = random_number();
    std::memcpy(bytes.data() + at, &number, sizeof number);
  }
  return to_base64url(bytes);
}

}  // namespace

Result<void> write_new_secret(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) return fail("the token's file " + path + " is there already");
  constexpr unsigned owner_alone = 0600;
  const auto made = replace_file(path, new_secret() + "\n", owner_alone);
  if (!made) return fail("the token's file cannot be made: " + made.error().message);
  return {};
}

}  // namespace scree
