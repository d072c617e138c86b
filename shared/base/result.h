// Expected failures carry a reason that a person can act on.
#pragma once

#include <string>
#include <tl/expected.hpp>
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

}  // namespace scree
