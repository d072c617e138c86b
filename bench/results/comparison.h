// Two results of the same bench or study beside each other: what became better, what worse, and what is the
// same within the noise.
//
// Noise: each file says between which values its runs lay. Two medians differ when they lie farther apart
// than both spreads together, and than a floor: the metric's own (metric_sense.h), or, where a file has fewer
// than runs_for_noise runs and so knows little of its noise, unknown_noise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_result.h"
#include "shared/base/result.h"

namespace scree {

inline constexpr uint32_t runs_for_noise = 3;
inline constexpr double unknown_noise = 0.2;  ///< as a share of the larger value

enum class Change : uint8_t { same, better, worse, changed, gone, added };

struct ChangeRow {
  std::string_view name;
};

constexpr ChangeRow row_of(Change change) {
  switch (change) {
    case Change::same:
      return {.name = "same"};  // within noise
    case Change::better:
      return {.name = "better"};
    case Change::worse:
      return {.name = "worse"};
    case Change::changed:
      return {.name = "changed"};  // which way is better nobody knows
    case Change::gone:
      return {.name = "gone"};
    case Change::added:
      return {.name = "new"};
  }
  return {};
}

/// A number that became NaN is worse, whatever it measures.
struct MetricChange {
  std::string metric;
  std::optional<MetricRange> before{}, after{};
  Change change = Change::same;

  /// After over before; nothing where that is no number.
  std::optional<double> ratio() const;
};

/// A check that is missed or gone where it passed is worse, and so is a new one that is missed. One that
/// passes where it was missed is better.
struct CheckChange {
  std::string check;
  Change change = Change::same;
  std::string detail;  ///< after; before where it is gone
};

struct ResultComparison {
  std::string name;
  std::vector<std::string>
      notes;  ///< what makes the figures hard to compare: other machines, other conditions
  std::vector<MetricChange> metrics{};
  std::vector<CheckChange> checks{};

  size_t count(Change change) const;  ///< of metrics and checks
  bool is_worse() const { return count(Change::worse) > 0; }
  /// Something that was measured or checked before is not any more.
  bool lacks_something() const { return count(Change::gone) > 0; }
};

/// An error when they are of different benches or of different work.
Result<ResultComparison> compare_results(const StoredResult& before, const StoredResult& after);

/// A table for people.
std::string text_of(const ResultComparison& comparison);

}  // namespace scree
