// Worlds out of a recording: simulated from where it, or a process that went on with it, began. The
// RecordedTerrain must outlive them.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/replay/recorded_terrain.h"
#include "server/store/recording_reader.h"
#include "server/world/world.h"

namespace scree {

/// The world that a process began with after that tick; `ground` gives the ground that it names.
Result<std::unique_ptr<World>> restored_from(WorldSnapshot state, Tick tick, RecordedTerrain& terrain,
                                             const GroundGiver& ground);

/// The world of a tick that has a state in the recording, or, at tick 0, the untouched one.
Result<std::unique_ptr<World>> world_at(RecordingReader& recording, Tick tick, RecordedTerrain& terrain,
                                        const GroundGiver& ground);

/// The world after a tick of the recording, or before its first one: simulated from the latest state up to
/// there, by the commands. The hash of every tick is compared; the error names the first that differs. Calls
/// `observe` after each tick.
using TickObserver = std::function<void(World&, const TickDelta&)>;
Result<std::unique_ptr<World>> simulated_to(RecordingReader& recording, Tick tick, RecordedTerrain& terrain,
                                            const GroundGiver& ground,
                                            const std::function<void(Tick, Tick)>& progress = {},
                                            const TickObserver& observe = {});

/// Two hashes, in words.
std::string hashes_differ(const char* what, uint64_t simulated, uint64_t recorded);
/// In which hash a simulated tick differs from the recorded one; empty: in none.
std::string difference_of(const TickDelta& simulated, const RecordedFrame& recorded);

/// Ticks between two reports of progress.
inline constexpr Tick progress_ticks = 32;

}  // namespace scree
