// Expected failures carry a reason that a person can act on.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <type_traits>
#include <utility>

namespace scree {

/// Why something was refused. `message` names the thing, the limit and the way out.
struct Error {
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

/// The value of TRY: that of a result which the expression made. A named result keeps its value.
template <typename T, typename E>
T value_of_try(tl::expected<T, E>&& result) {
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}
template <typename T, typename E>
void value_of_try(const tl::expected<T, E>&) {}

}  // namespace scree

/// Returns from the function with the error of a Result, or of any tl::expected with an error of the
/// function's own type; otherwise it is the value: `const Token token = TRY(read_token(text));`. With a named
/// result it only tests: `TRY(read);`. A GNU statement expression, which g++ and clang have.
#define TRY(...)                                                            \
  ({                                                                        \
    auto&& try_result = (__VA_ARGS__);                                      \
    if (!try_result) [[unlikely]]                                           \
      return tl::unexpected(std::move(try_result).error());                 \
    ::scree::value_of_try(static_cast<decltype(try_result)&&>(try_result)); \
  })
