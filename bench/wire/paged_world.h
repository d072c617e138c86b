// A world larger than memory: made, and served to clients that roam in it.
#pragma once

#include <string>

#include "bench/support/bench.h"

namespace scree {

/// Makes a world of 4 GiB of edited bricks in a new file (`quick`: 64 MiB), row by row, and lets 8 viewers
/// walk and carve in it for a minute. The server is a process of its own, the program scree-server beside
/// this one, with 512 megabytes (quick: 256). Says so, and does nothing, when the disk or the program is not
/// there.
void roam_a_paged_world(BenchReport& report, const std::string& path, bool quick);

}  // namespace scree
