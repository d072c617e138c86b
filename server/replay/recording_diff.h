// Where two recordings first differ: in which tick, in which stage of it, and at which place. Frames and
// commands are compared as recorded; only where the terrain differs are both played, to find the brick.
// Nothing is simulated. One thread at a time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/world/world_config.h"
#include "shared/base/ids.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"

namespace scree {

/// In the order in which a tick goes through them.
enum class DiffStage : uint8_t { world, commands, settings, field, bodies, ledger, extent };

struct DiffStageRow {
  DiffStage stage{};
  std::string_view name;
};

constexpr DiffStageRow row_of(DiffStage stage) {
  switch (stage) {
    case DiffStage::world:
      return {stage, "world"};  // ground, voxel size, tick rate: what no tick changes
    case DiffStage::commands:
      return {stage, "commands"};
    case DiffStage::settings:
      return {stage, "settings"};
    case DiffStage::field:
      return {stage, "field"};
    case DiffStage::bodies:
      return {stage, "bodies"};
    case DiffStage::ledger:
      return {stage, "ledger"};
    case DiffStage::extent:
      return {stage, "extent"};  // one has ticks that the other has not; those that both have are the same
  }
  return {};
}

struct StageDifference {
  DiffStage stage{};
  std::string text;  ///< what both have, in words, with the place in metres
};

struct RecordingDiff {
  Tick first = 0, last = 0;             ///< the ticks that both have
  Tick tick = 0;                        ///< the first that differs; 0: there is none
  std::vector<StageDifference> stages;  ///< in which it differs, in their order; empty: in none

  bool same() const { return stages.empty(); }
};

/// A recording and the ground that it names.
struct DiffSide {
  std::string path;
  GroundGiver ground;
};

/// Compares the ticks that both have; where these are the same, their extent. Calls `progress(done, all)`
/// now and then. Recordings without a tick in common, and those that cannot be read, are errors.
Result<RecordingDiff> diff(const DiffSide& a, const DiffSide& b,
                           const std::function<void(Tick, Tick)>& progress = {});

}  // namespace scree
