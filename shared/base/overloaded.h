// One visitor out of several lambdas. std::visit compiles only when there is one for every alternative of the
// variant, so that a new alternative is an error wherever somebody has not said what it means.
#pragma once

namespace scree {

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace scree
