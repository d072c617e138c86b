#include "shared/base/token.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "shared/base/limits.h"
#include "shared/base/regular_file.h"

namespace scree {

Result<void> check_secret(std::string_view secret, size_t bytes_max) {
  if (secret.size() > bytes_max)
    return fail("a token has at most " + std::to_string(bytes_max) + " characters");
  if (std::ranges::any_of(secret, [](char c) { return c <= ' ' || c > '~'; }))
    return fail("a token consists of printable ASCII characters, without spaces");
  return {};
}

Result<std::string> read_secret(const std::string& path, size_t bytes_max) {
  TRY(check_no_device(path));
  errno = 0;
  std::ifstream file(path);
  if (!file)
    return fail("the token's file " + path + " cannot be read: " + std::strerror(errno != 0 ? errno : EIO));
  // A file that is something else altogether is not read to its end.
  std::string secret(bytes_max + 1, '\0');
  file.read(secret.data(), static_cast<std::streamsize>(secret.size()));
  secret.resize(static_cast<size_t>(file.gcount()));
  secret.resize(std::min(secret.find_first_of("\r\n"), secret.size()));
  if (Result<void> good = check_secret(secret, bytes_max); !good)
    return fail(path + ": " + good.error().message);
  return secret;
}

Result<std::string> read_token(const std::string& path) {
  // More, so that check_token says what the bounds are.
  Result<std::string> token = read_secret(path, 16 * limits::token_bytes_max);
  if (!token) return token;
  if (Result<void> good = check_token(*token); !good) return fail(path + ": " + good.error().message);
  return token;
}

Result<void> check_token(std::string_view token) {
  if (token.size() < limits::token_bytes_min || token.size() > limits::token_bytes_max)
    return fail("a token has " + std::to_string(limits::token_bytes_min) + " to " +
                std::to_string(limits::token_bytes_max) +
                " characters (limits.token_bytes_min, token_bytes_max)");
  return check_secret(token, limits::token_bytes_max);
}

bool same_token(std::string_view given, std::string_view wanted) {
  volatile uint8_t difference = given.size() == wanted.size() ? 0 : 1;
  for (size_t i = 0; i < given.size() && !wanted.empty(); ++i)
    difference = difference | static_cast<uint8_t>(given[i] ^ wanted[i % wanted.size()]);
  return difference == 0;
}

}  // namespace scree
