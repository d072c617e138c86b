// How long the stages of ticks took, as metrics of a bench.
#pragma once

#include <span>
#include <string>

#include "bench/support/bench.h"
#include "server/world/stages.h"

namespace scree {

/// Reports, for every stage and for the whole tick ("total"), `when`_stage_median_ms and `when`_stage_p99_ms.
void report_stages(BenchReport& report, const std::string& when, std::span<const StageTimes> ticks);

}  // namespace scree
