// The plane section of links between parts (support_parts.h), measured by the codes on both of its sides.
// Lengths in voxels.
#pragma once

#include <array>
#include <span>

#include "shared/falling/section.h"
#include "shared/falling/support_parts.h"

namespace scree {

/// The axes in a section across each axis: the first is the one along which a load bends it.
inline constexpr std::array<std::array<int, 2>, 3> plane_axes{{{1, 2}, {0, 2}, {1, 0}}};

/// Its own voxels, and those of the surface around them; `links` are of one plane, and so many layers beyond
/// it lies the section. Its area is 0 where none of them has voxels there.
Section section_of(const SupportParts& parts, const Field& field, std::span<const SupportLink> links, int at);

}  // namespace scree
