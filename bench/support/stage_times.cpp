#include "bench/support/stage_times.h"

#include <algorithm>
#include <fmt/format.h>

namespace scree {

namespace {

void report_times(BenchReport& report, const std::string& what, const std::vector<double>& samples) {
  report.metric(what + "_median_ms", quantile(samples, 0.5));
  report.metric(what + "_p99_ms", quantile(samples, 0.99));
}

}  // namespace

void report_stages(BenchReport& report, const std::string& when, std::span<const StageTimes> ticks) {
  std::vector<double> samples(ticks.size());
  for (const TickStageRow& row : tick_stages) {
    std::ranges::transform(ticks, samples.begin(), [&](const StageTimes& times) { return times[row.stage]; });
    report_times(report, fmt::format("{}_{}", when, row.name), samples);
  }
  std::ranges::transform(ticks, samples.begin(), &StageTimes::total_ms);
  report_times(report, when + "_total", samples);
}

}  // namespace scree
