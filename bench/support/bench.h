// The form of every benchmark: a name, a summary, and a report of metrics and checks.
//
// A bench measures its peer in the same run and checks the result that it timed; it never decides a test.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/base/quantile.h"

namespace scree {

struct Metric {
  std::string name;  ///< snake_case, unit last: "carve_p99_ms"
  double value = 0.0;
};

struct Check {
  std::string name;
  bool passed = false;
  std::string detail;  ///< the measured value beside the expected one
};

struct BenchReport {
  std::vector<Metric> metrics;
  std::vector<Check> checks;
  /// What the run met and did not choose, by name: "gl_renderer".
  std::vector<std::pair<std::string, std::string>> conditions = {};

  void metric(std::string name, double value) { metrics.push_back({std::move(name), value}); }
  void check(std::string name, bool passed, std::string detail) {
    checks.push_back({std::move(name), passed, std::move(detail)});
  }
  void condition(std::string name, std::string text) {
    conditions.emplace_back(std::move(name), std::move(text));
  }
};

struct SceneSetup;

struct BenchOptions {
  bool quick = false;    ///< fewer rounds, only to show that it runs
  double minutes = 0.0;  ///< of the session, for benches that have one; 0: as many as fit into some minutes
  std::function<void(double fraction)> progress = [](double) {};
  /// For benches that take a scene (tools/scenes/scene.h): that one; null: the bench's own ground.
  std::shared_ptr<const SceneSetup> scene{};

  // For benches that have parts.
  std::string part{};    ///< this one alone; empty: all
  std::string folder{};  ///< where worlds that take long to make are kept for later runs; empty: nowhere
  std::optional<uint32_t> world_mb{};  ///< of a world larger than memory
  std::optional<uint32_t> memory_max_mb{};
};

struct Bench {
  std::string name;
  std::string summary;
  BenchReport (*run)(const BenchOptions&);
  std::vector<std::string> parts = {};  ///< that BenchOptions::part may name
  bool takes_scene = false;             ///< BenchOptions::scene
};

}  // namespace scree
