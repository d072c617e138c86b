#include "shared/base/token.h"

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "shared/base/limits.h"

namespace scree {

Result<std::string> read_token(const std::string& path) {
  std::ifstream file(path);
  if (!file) return fail("the token's file " + path + " cannot be read");
  // A file that is something else altogether is not read to its end.
  std::string token(limits::token_bytes_max + 1, '\0');
  file.read(token.data(), static_cast<std::streamsize>(token.size()));
  token.resize(static_cast<size_t>(file.gcount()));
  token.resize(std::min(token.find_first_of("\r\n"), token.size()));
  if (Result<void> good = check_token(token); !good) return fail(path + ": " + good.error().message);
  return token;
}

Result<void> check_token(std::string_view token) {
  if (token.size() < limits::token_bytes_min || token.size() > limits::token_bytes_max)
    return fail("a token has " + std::to_string(limits::token_bytes_min) + " to " +
                std::to_string(limits::token_bytes_max) +
                " characters (limits.token_bytes_min, token_bytes_max)");
  if (std::ranges::any_of(token, [](char c) { return c <= ' ' || c > '~'; }))
    return fail("a token consists of printable ASCII characters, without spaces");
  return {};
}

bool same_token(std::string_view given, std::string_view wanted) {
  volatile uint8_t difference = given.size() == wanted.size() ? 0 : 1;
  for (size_t i = 0; i < given.size() && !wanted.empty(); ++i)
    difference = difference | static_cast<uint8_t>(given[i] ^ wanted[i % wanted.size()]);
  return difference == 0;
}

}  // namespace scree
