// A value for each kind of operation: counts, bytes, costs. A new kind has its value without further doing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>

#include "shared/operation/operation.h"

namespace scree {

template <typename Value>
class PerOperation {
 public:
  Value& operator[](const Operation& operation) { return values_[operation.index()]; }

  template <typename Kind>
  const Value& of() const {
    return values_[Operation(Kind{}).index()];
  }

  /// visit(name, value) for each kind, in the order of the variant; the name is a plural: "carves".
  template <typename Visit>
  void for_each(Visit&& visit) const {
    const auto each = [&]<size_t... kind>(std::index_sequence<kind...>) {
      (visit(std::variant_alternative_t<kind, Operation>::plural, values_[kind]), ...);
    };
    each(std::make_index_sequence<kinds>{});
  }

  PerOperation& operator+=(const PerOperation& other) {
    for (size_t kind = 0; kind < kinds; ++kind) values_[kind] += other.values_[kind];
    return *this;
  }

 private:
  static constexpr size_t kinds = std::variant_size_v<Operation>;
  std::array<Value, kinds> values_{};
};

using OperationCounts = PerOperation<uint64_t>;

}  // namespace scree
