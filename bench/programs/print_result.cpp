#include "bench/programs/print_result.h"

#include <cstdio>
#include <fmt/format.h>

#include "bench/results/result_file.h"

namespace scree {

void print_result(const std::string& summary, const BenchReport& run, const StoredResult& result) {
  std::printf("%s: %s\n", result.name.c_str(), summary.c_str());
  for (const auto& [condition, text] : result.conditions)
    std::printf("  %-36s %s\n", condition.c_str(), text.c_str());
  for (const Metric& metric : run.metrics) {
    const MetricRange& range = result.metrics.at(metric.name);
    std::printf("  %-36s %14.6g", metric.name.c_str(), range.value);
    if (range.spread() > 0.0) std::printf("  (%.4g … %.4g)", range.min, range.max);
    std::printf("\n");
  }
  for (const Check& check : run.checks) {
    const StoredCheck& stored = result.checks.at(check.name);
    std::printf("  %s %-33s %s\n", stored.passed ? "ok  " : "MISS", check.name.c_str(),
                stored.detail.c_str());
  }
}

std::map<std::string, std::string> asked_options(const BenchOptions& options) {
  std::map<std::string, std::string> options_asked;
  if (options.quick) options_asked["quick"] = "yes";
  if (options.minutes > 0.0) options_asked["minutes"] = fmt::format("{:.4g}", options.minutes);
  if (!options.part.empty()) options_asked["part"] = options.part;
  if (options.world_mb) options_asked["world-mb"] = std::to_string(*options.world_mb);
  if (options.memory_max_mb) options_asked["memory-max"] = std::to_string(*options.memory_max_mb);
  return options_asked;
}

bool write_stored(const StoredResult& result, const std::string& path) {
  const Result<void> written = write_result(result, path);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written.has_value();
}

}  // namespace scree
