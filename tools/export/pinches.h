// Places where a surface touches itself.
#pragma once

#include "tools/export/surface_file.h"

namespace scree {

/// Where sheets of a surface meet in a point, or along an edge, the points are doubled, so that each sheet
/// has its own. Where one sheet meets itself along an edge, the edge is doubled, with a point in its middle.
/// Then every edge has two triangles. Each edge must have as many triangles on the one side as on the other.
/// Returns how many points were added. 16 bytes a triangle lie in memory meanwhile.
size_t split_pinches(WeldedSurface& surface);

}  // namespace scree
