// What a bench or a study found in one or several runs, as a value that can be kept and compared.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "bench/support/bench.h"
#include "bench/support/machine.h"
#include "shared/base/kind_table.h"

namespace scree {

enum class ResultKind : uint8_t { bench, study };

struct ResultKindRow {
  std::string_view name;
};

constexpr ResultKindRow row_of(ResultKind kind) {
  switch (kind) {
    case ResultKind::bench:
      return {.name = "bench"};
    case ResultKind::study:
      return {.name = "study"};
  }
  return {};
}

/// A metric over the runs. NaN: a run had no number for it.
struct MetricRange {
  double value = 0.0;  ///< the median
  double min = 0.0;
  double max = 0.0;

  double spread() const { return max - min; }
};

/// A check over the runs.
struct StoredCheck {
  bool passed = false;  ///< in more than half of the runs
  std::string detail;   ///< of the last run that it missed in, or of the last
};

struct StoredResult {
  ResultKind kind = ResultKind::bench;
  std::string name;
  uint32_t runs = 1;
  /// What was asked for, by the names of the options: results of different work are not compared.
  std::map<std::string, std::string> options{};
  Machine machine{};
  std::map<std::string, std::string> conditions{};  ///< what the runs met: "gl_renderer"
  std::map<std::string, MetricRange> metrics{};
  std::map<std::string, StoredCheck> checks{};

  size_t missed() const;  ///< checks
};

/// The metrics, checks and conditions of runs of the same work, at least one. A name of which a report has
/// two stands for the last.
StoredResult summarised(ResultKind kind, const std::string& name, std::span<const BenchReport> runs);

}  // namespace scree
