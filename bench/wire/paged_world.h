// A world larger than memory: made, and served to clients that roam in it.
#pragma once

#include <string>

#include "bench/support/bench.h"

namespace scree {

struct RoamPlan {
  std::string made;    ///< the world's file, which is made unless it is there
  std::string roamed;  ///< its copy, in which clients roam
  uint32_t world_mb;   ///< of edited bricks
  uint32_t memory_max_mb;
  double seconds;
};

/// Makes a world row by row, and lets 8 viewers walk and carve in it. The server is a process of its own, the
/// program scree-server beside this one. Says so, and does nothing, when the disk or the program is not
/// there.
void roam_a_paged_world(BenchReport& report, const RoamPlan& plan);

}  // namespace scree
