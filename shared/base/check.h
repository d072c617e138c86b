// Programmer's errors abort the process. Bytes from a wire or a file are never CHECKed: they are refused,
// with a Result.
//
// CHECK: on in every build, for the borders of modules.
// CHECK_EQ, CHECK_NE, CHECK_LT, CHECK_LE, CHECK_GT, CHECK_GE: the same for two values; the message shows both
// (check_text.h). Integers of different types are compared by value.
// CHECK_DEBUG: for hot loops. On where SCREE_CHECK_DEBUG is defined (debug and sanitizer builds, so the fuzz
// tests' too). Elsewhere the condition is compiled but never evaluated, so it costs nothing and cannot rot.
//
// A further argument, a string literal, is advice to the caller. Values become text only after the comparison
// failed: a check that holds costs a comparison and a branch.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "shared/base/check_text.h"

namespace scree {

/// `advice` to the caller and `values` of a comparison may be null.
[[noreturn, gnu::cold, gnu::noinline]] void check_failed(const char* file, int line, const char* condition,
                                                         const char* advice = nullptr,
                                                         const char* values = nullptr);

namespace checks {

/// Scalars are passed by value, so that a check that holds does not force them into memory.
template <typename Value>
using Argument = std::conditional_t<std::is_scalar_v<Value>, Value, const Value&>;

template <typename Left, typename Right>
[[noreturn, gnu::cold, gnu::noinline]] void fail_with(Argument<Left> left, Argument<Right> right,
                                                      const char* file, int line, const char* condition,
                                                      const char* advice) {
  CheckText values;
  add_value<Left>(values, left);
  values.add(", ");
  add_value<Right>(values, right);
  check_failed(file, line, condition, advice, values.text());
}

/// Those that std::cmp_equal and its like compare.
template <typename Value>
concept Integer = std::integral<Value> && !std::same_as<Value, bool> && !std::same_as<Value, char> &&
                  !std::same_as<Value, wchar_t> && !std::same_as<Value, char8_t> &&
                  !std::same_as<Value, char16_t> && !std::same_as<Value, char32_t>;

/// Integers are compared by value, whatever their types.
#define SCREE_COMPARISON(NAME, OPERATOR, OF_INTEGERS)                   \
  struct NAME {                                                         \
    template <typename Left, typename Right>                            \
    static constexpr bool holds(const Left& left, const Right& right) { \
      if constexpr (Integer<Left> && Integer<Right>)                    \
        return std::OF_INTEGERS(left, right);                           \
      else                                                              \
        return left OPERATOR right;                                     \
    }                                                                   \
  }
SCREE_COMPARISON(Equal, ==, cmp_equal);
SCREE_COMPARISON(NotEqual, !=, cmp_not_equal);
SCREE_COMPARISON(Less, <, cmp_less);
SCREE_COMPARISON(LessEqual, <=, cmp_less_equal);
SCREE_COMPARISON(Greater, >, cmp_greater);
SCREE_COMPARISON(GreaterEqual, >=, cmp_greater_equal);
#undef SCREE_COMPARISON

template <typename Comparison, typename Left, typename Right>
[[gnu::always_inline]] inline void compare(const Left& left, const Right& right, const char* file, int line,
                                           const char* condition, const char* advice = nullptr) {
  if (!Comparison::holds(left, right)) [[unlikely]]
    fail_with<std::decay_t<const Left&>, std::decay_t<const Right&>>(left, right, file, line, condition,
                                                                     advice);
}

}  // namespace checks
}  // namespace scree

#define CHECK(condition, ...)                                                           \
  do {                                                                                  \
    if (!(condition)) [[unlikely]]                                                      \
      ::scree::check_failed(__FILE__, __LINE__, #condition __VA_OPT__(, ) __VA_ARGS__); \
  } while (false)

#define SCREE_COMPARE(COMPARISON, left, right, text, ...)                                    \
  ::scree::checks::compare<::scree::checks::COMPARISON>((left), (right), __FILE__, __LINE__, \
                                                        text __VA_OPT__(, ) __VA_ARGS__)
#define CHECK_EQ(left, right, ...) \
  SCREE_COMPARE(Equal, left, right, #left " == " #right __VA_OPT__(, ) __VA_ARGS__)
#define CHECK_NE(left, right, ...) \
  SCREE_COMPARE(NotEqual, left, right, #left " != " #right __VA_OPT__(, ) __VA_ARGS__)
#define CHECK_LT(left, right, ...) \
  SCREE_COMPARE(Less, left, right, #left " < " #right __VA_OPT__(, ) __VA_ARGS__)
#define CHECK_LE(left, right, ...) \
  SCREE_COMPARE(LessEqual, left, right, #left " <= " #right __VA_OPT__(, ) __VA_ARGS__)
#define CHECK_GT(left, right, ...) \
  SCREE_COMPARE(Greater, left, right, #left " > " #right __VA_OPT__(, ) __VA_ARGS__)
#define CHECK_GE(left, right, ...) \
  SCREE_COMPARE(GreaterEqual, left, right, #left " >= " #right __VA_OPT__(, ) __VA_ARGS__)

#ifdef SCREE_CHECK_DEBUG
#define CHECK_DEBUG(condition) CHECK(condition)
#else
#define CHECK_DEBUG(condition)               \
  do {                                       \
    if (false) static_cast<void>(condition); \
  } while (false)
#endif
