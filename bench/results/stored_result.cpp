#include "bench/results/stored_result.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/base/check.h"

namespace scree {

namespace {

MetricRange range_of(const std::vector<double>& values) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) return {nan, nan, nan};
  const auto [least, most] = std::ranges::minmax(values);
  return {quantile(values, 0.5), least, most};
}

/// A check's outcomes, run by run.
StoredCheck check_of(const std::vector<Check>& outcomes) {
  const auto passed = std::ranges::count(outcomes, true, &Check::passed);
  StoredCheck stored{2 * passed > std::ssize(outcomes), outcomes.back().detail};
  for (const Check& outcome : outcomes)
    if (!outcome.passed) stored.detail = outcome.detail;
  const auto missed = std::ssize(outcomes) - passed;
  if (passed > 0 && missed > 0)
    stored.detail +=
        " (missed in " + std::to_string(missed) + " of " + std::to_string(outcomes.size()) + " runs)";
  return stored;
}

}  // namespace

size_t StoredResult::missed() const {
  return static_cast<size_t>(
      std::ranges::count_if(checks, [](const auto& check) { return !check.second.passed; }));
}

StoredResult summarised(ResultKind kind, const std::string& name, std::span<const BenchReport> runs) {
  CHECK(!runs.empty());
  StoredResult result{.kind = kind, .name = name, .runs = static_cast<uint32_t>(runs.size())};
  std::map<std::string, std::vector<double>> values;
  std::map<std::string, std::vector<Check>> outcomes;
  for (const BenchReport& run : runs) {
    std::map<std::string, double> of_run;
    for (const Metric& metric : run.metrics) of_run[metric.name] = metric.value;
    for (const auto& [metric, value] : of_run) values[metric].push_back(value);
    std::map<std::string, Check> checks;
    for (const Check& check : run.checks) checks[check.name] = check;
    for (const auto& [check, outcome] : checks) outcomes[check].push_back(outcome);
    for (const auto& [condition, text] : run.conditions) result.conditions[condition] = text;
  }
  for (const auto& [metric, of_runs] : values) result.metrics[metric] = range_of(of_runs);
  for (const auto& [check, of_runs] : outcomes) result.checks[check] = check_of(of_runs);
  return result;
}

}  // namespace scree
