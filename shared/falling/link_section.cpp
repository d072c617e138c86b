#include "shared/falling/link_section.h"

#include <algorithm>

#include "shared/base/check.h"
#include "shared/falling/lumps.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

/// Marks the voxels and their neighbours in the plane.
void mark(const SectionVoxels& voxels, int axis, Window& own) {
  const std::array<int, 3> reach{axis == 0 ? 0 : 1, axis == 1 ? 0 : 1, axis == 2 ? 0 : 1};
  for (size_t x = 0; x < voxels.bits.words.size(); ++x)
    for (int bit = 0; bit < 64; ++bit) {
      if (((voxels.bits.words[x] >> bit) & 1U) == 0) continue;
      const VoxelCoord at =
          voxels.origin + VoxelCoord{static_cast<int>(x), bit / brick_size, bit % brick_size};
      for (int i = -reach[0]; i <= reach[0]; ++i)
        for (int j = -reach[1]; j <= reach[1]; ++j)
          for (int k = -reach[2]; k <= reach[2]; ++k) own.at(at.x + i, at.y + j, at.z + k) = 1;
    }
}

}  // namespace

Section section_of(const SupportParts& parts, const Field& field, std::span<const SupportLink> links,
                   int at) {
  const int axis = links.front().axis;
  Section section;
  if (std::ranges::all_of(links, [&](const SupportLink& link) { return parts.section(link, at) == 0; }))
    return section;
  const auto [u, v] = plane_axes[static_cast<size_t>(axis)];
  const VoxelBox box = parts.section_box(links, at).grown(1);
  const Window codes = gather(field, box);
  Window own(box, 0);
  for (const SupportLink& link : links) mark(parts.section_voxels(link, at), axis, own);
  VoxelCoord step{0, 0, 0};
  (axis == 0 ? step.x : axis == 1 ? step.y : step.z) = 1;
  // The layers on both sides lie in the middle of the box, which was grown by one.
  VoxelBox low = box;
  int VoxelCoord::*const normal = axis == 0 ? &VoxelCoord::x : axis == 1 ? &VoxelCoord::y : &VoxelCoord::z;
  low.lo.*normal += 1;
  low.hi.*normal = low.lo.*normal + 1;
  for (int x = low.lo.x; x < low.hi.x; ++x)
    for (int y = low.lo.y; y < low.hi.y; ++y)
      for (int z = low.lo.z; z < low.hi.z; ++z) {
        if (own.at(x, y, z) == 0) continue;
        const int units =
            std::min(occupancy(codes.at(x, y, z)), occupancy(codes.at(x + step.x, y + step.y, z + step.z)));
        if (units == 0) continue;
        const glm::dvec3 p = middle_of_voxel({x, y, z});
        section.add({p[u], p[v]}, static_cast<double>(units) / units_per_voxel);
      }
  section.finish();
  return section;
}

}  // namespace scree
