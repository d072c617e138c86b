// A figure that a program shows of itself, by the conventions of Prometheus: base units (seconds, bytes), the
// name's end says the unit, and that of a total is _total. A value.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// A total grows from 0 on; a state goes up and down.
enum class FigureKind : uint8_t { total, state };

/// Names and values. Values are few and known: no person, address or token is among them.
using FigureLabels = std::vector<std::pair<std::string, std::string>>;

struct Figure {
  std::string name;
  std::string help;
  FigureKind kind = FigureKind::state;
  double value = 0.0;
  FigureLabels labels{};
};

}  // namespace scree
