// /metrics, the figures of a running server for Prometheus (docs/monitoring.md, which a test compares).
#pragma once

#include <span>
#include <string>

#include "server/app/server_report.h"
#include "server/app/server_status.h"
#include "server/metrics/figure.h"

namespace scree {

/// What the figures need beside the report.
struct MetricsFacts {
  float voxel_size_m = 0.0F;
  uint64_t started_unix_s = 0;
  std::span<const Figure> of_host;  ///< the host's own, which come last
};

std::string metrics_text(const ServerReport& report, const NetFigures& figures, const ServerFacts& facts,
                         const MetricsFacts& more);

}  // namespace scree
