// World files of the study, made when they are lacking, and what it takes to start with one and to join it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/support/carved_world.h"
#include "server/app/saved_world.h"

namespace scree {

/// A world of a file, as a server has it: its terrain comes and goes as memory-max says. Not saved.
struct OpenedWorld {
  std::unique_ptr<SavedWorld> file;  ///< holds the file
  std::unique_ptr<World> world;
  double start_ms = 0.0;  ///< processor time of this thread
  double heap_mib = 0.0;  ///< that this thread holds more than before
};

/// The paths of the grounds' files in the folder, in their order. Those that are not there are written, the
/// last one first, on as many threads as this process may use cores.
Result<std::vector<std::string>> worlds_on_disk(const std::string& folder,
                                                const std::vector<CarvedGround>& grounds);

Result<OpenedWorld> open_world(const std::string& path, const WorldConfig& config);

struct JoinCost {
  double kib = 0.0;  ///< received until all edits within the interest are there
  double seconds = 0.0;
  size_t chunks = 0;
};

/// A client joins a server with a copy of that world, by loopback, with an eye above the ground in the
/// world's middle. An error when the edits do not come within a minute.
Result<JoinCost> join_cost(const std::string& path, const WorldConfig& config, float interest_m);

}  // namespace scree
