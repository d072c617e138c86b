// The axes along which the study `scale` grows a server, one function each. Each sets up its sizes, measures
// them in rounds, one after the other, so that all see the same machine, and tells how far it is by
// `progress`.
#pragma once

#include <functional>
#include <string>

#include "bench/support/stage.h"
#include "studies/scale/axis.h"

namespace scree {

struct ScaleRun {
  bool quick = false;      ///< fewer sizes and rounds
  std::string worlds;      ///< folder where worlds that take long to make are kept for the build's next run
  Stage* stage = nullptr;  ///< that draws; null: nothing can be drawn here
  std::function<void(double)> progress = [](double) {};
};

Result<Axis> measure_world_axis(const ScaleRun& run);
Result<Axis> measure_voxel_axis(const ScaleRun& run);
Result<Axis> measure_pieces_axis(const ScaleRun& run);
Result<Axis> measure_viewers_axis(const ScaleRun& run);
Result<Axis> measure_carves_axis(const ScaleRun& run);
Result<Axis> measure_recording_axis(const ScaleRun& run);

/// What a machine of some cores holds: fitted on one core, and compared with two.
struct MachineStudy {
  ReportSection section;
  BenchReport figures;
};
Result<MachineStudy> measure_machine(const ScaleRun& run);

}  // namespace scree
