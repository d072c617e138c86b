// The paper's experiments, measured. Each needs the stage's GL context current, and fails when a method
// cannot be made or a frame not be drawn.
#pragma once

#include <functional>

#include "bench/support/stage.h"
#include "shared/base/result.h"
#include "studies/paper/findings/findings.h"
#include "studies/paper/plan.h"

namespace scree::paper {

/// Told the share of the experiment that is done.
using Progress = std::function<void(double fraction)>;

/// Sections 3.1 and 3.2: sets grids and raymarch.
Result<void> measure_settings(Stage& stage, const Plan& plan, const Progress& progress, Findings& found);
/// Figures 24 and 25.
Result<CarvingFound> measure_carving(Stage& stage, const Plan& plan, const Progress& progress);
/// Figures 26 and 27.
Result<RebuildFound> measure_rebuilds(Stage& stage, const Plan& plan, const Progress& progress);
/// Figure 28.
Result<MergingFound> measure_merging(Stage& stage, const Plan& plan, const Progress& progress);

}  // namespace scree::paper
