#include "shared/base/check.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace scree {

void CheckText::add(std::string_view text) {
  const size_t bytes = std::min(text.size(), bytes_max - bytes_);
  std::memcpy(text_ + bytes_, text.data(), bytes);
  bytes_ += bytes;
}

void CheckText::add_number(long long value) {
  char digits[32];
  add({digits, static_cast<size_t>(std::snprintf(digits, sizeof digits, "%lld", value))});
}

void CheckText::add_number(unsigned long long value) {
  char digits[32];
  add({digits, static_cast<size_t>(std::snprintf(digits, sizeof digits, "%llu", value))});
}

/// As many digits as tell two numbers apart.
void CheckText::add_number(double value) {
  char digits[40];
  add({digits, static_cast<size_t>(std::snprintf(digits, sizeof digits, "%.17g", value))});
}

void CheckText::add_address(const void* value) {
  if (value == nullptr) return add("null");
  char digits[32];
  add({digits, static_cast<size_t>(std::snprintf(digits, sizeof digits, "%p", value))});
}

void check_failed(const char* file, int line, const char* condition, const char* advice, const char* values) {
  std::fprintf(stderr, "%s:%d: CHECK failed: %s", file, line, condition);
  if (values != nullptr) std::fprintf(stderr, " (%s)", values);
  if (advice != nullptr) std::fprintf(stderr, ": %s", advice);
  std::fputc('\n', stderr);
  std::abort();
}

}  // namespace scree
