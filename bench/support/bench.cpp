#include "bench/support/bench.h"

#include <algorithm>
#include <cmath>

#include "bench/support/benches.h"
#include "shared/base/check.h"

namespace scree {

const std::vector<Bench>& all_benches() {
  static const std::vector<Bench> benches = {
      {"carve", "a 2 m carve into 64 pieces: each stage of the server's tick", run_carve_bench},
      {"colliders", "terrain colliders field, mesh and rays: depth, falls, time of a tick and of a carve",
       run_colliders_bench},
      {"cutters", "a 2 m carve into 64 pieces by every cutter, with bodies by every simplifier",
       run_cutters_bench},
      {"draw", "every way to draw at every resolution: a frame, an edit until it is shown, memory",
       run_draw_bench},
      {"islands", "what a cut loosened: towers and arches, in 64 m and 1,024 m of edited terrain",
       run_islands_bench},
      {"ledger", "mass over many carves and merges: the ledger against the field measured afresh",
       run_ledger_bench},
      {"mesh", "surface nets of a changed block, beside OpenVDB's volumeToMesh; from a change to its picture",
       run_mesh_bench},
      {"raymarch", "a frame after 0 to 10,000 carves: the atlas of bricks, the paper's list of carves",
       run_raymarch_bench},
      {"recombine", "merging by stamp, slices and sphere, against OpenVDB's meshToVolume and csgUnion",
       run_recombine_bench},
      {"seams", "50 carves of a ball merged back in place: what is left of the surface", run_seams_bench},
      {"storm", "1,000 pieces alive at once, and one blast of 64, with recombination and without",
       run_storm_bench},
      {"wire", "bytes on the wire of a 2 m carve into 64 pieces, and of each merge", run_wire_bench},
  };
  return benches;
}

double quantile(std::vector<double> samples, double share) {
  CHECK(!samples.empty());
  std::ranges::sort(samples);
  const double rank = std::ceil(share * static_cast<double>(samples.size()));
  return samples[static_cast<size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace scree
