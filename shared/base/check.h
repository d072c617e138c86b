// Programmer's errors abort the process. Bytes from a wire or a file are never CHECKed: they are refused,
// with a Result.
//
// CHECK: on in every build, for the borders of modules.
// CHECK_EQ: the same for two integers of any types; the message shows both.
// CHECK_DEBUG: for hot loops. On where SCREE_CHECK_DEBUG is defined (debug and sanitizer builds, so the fuzz
// tests' too). Elsewhere the condition is compiled but never evaluated, so it costs nothing and cannot rot.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace scree {

[[noreturn, gnu::cold, gnu::noinline]] inline void check_failed(const char* file, int line,
                                                                const char* condition) {
  std::fprintf(stderr, "%s:%d: CHECK failed: %s\n", file, line, condition);
  std::abort();
}

[[noreturn, gnu::cold, gnu::noinline]] inline void check_failed(const char* file, int line,
                                                                const char* condition, long long left,
                                                                long long right) {
  std::fprintf(stderr, "%s:%d: CHECK failed: %s (%lld, %lld)\n", file, line, condition, left, right);
  std::abort();
}

template <typename Left, typename Right>
void check_equal(const Left& left, const Right& right, const char* file, int line, const char* condition) {
  if (!std::cmp_equal(left, right)) [[unlikely]]
    check_failed(file, line, condition, static_cast<long long>(left), static_cast<long long>(right));
}

}  // namespace scree

#define CHECK(condition)                                     \
  do {                                                       \
    if (!(condition)) [[unlikely]]                           \
      ::scree::check_failed(__FILE__, __LINE__, #condition); \
  } while (false)

#define CHECK_EQ(left, right) ::scree::check_equal((left), (right), __FILE__, __LINE__, #left " == " #right)

#ifdef SCREE_CHECK_DEBUG
#define CHECK_DEBUG(condition) CHECK(condition)
#else
#define CHECK_DEBUG(condition)               \
  do {                                       \
    if (false) static_cast<void>(condition); \
  } while (false)
#endif
