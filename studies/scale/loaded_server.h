// The server's program on some of this machine's cores, with bots and viewers on loopback: what it takes and
// how it holds.
#pragma once

#include <cstddef>

#include "shared/base/result.h"
#include "studies/scale/served_load.h"

namespace scree {

struct ServerLoad {
  size_t bots = 0;      ///< each is to carve once a second, and looks on; on a square grid
  size_t viewers = 0;   ///< look on from the middle
  unsigned cores = 1;   ///< that the server may use; clients have the others, or all where there is no other
  double warm_s = 2.5;  ///< before it is measured
  double seconds = 5.0;
};

/// The bots' carves.
inline constexpr float bot_radius_m = 1.5F;
inline constexpr unsigned bot_seeds = 24;
inline constexpr float bots_apart_m = 20.0F;
inline constexpr float bot_interest_m = 48.0F;

/// An error when the program is not there or does not start, or a client cannot join.
Result<ServedLoad> serve_load(const ServerLoad& load);

}  // namespace scree
