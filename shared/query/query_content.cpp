// What a box holds.
#include <array>

#include "shared/query/asked_solids.h"
#include "shared/query/query_check.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

/// Voxels whose places lie in a box: lo in it, hi not.
VoxelBox voxels_in(const glm::dvec3& lo, const glm::dvec3& hi) {
  const auto from = [](double x) { return -floor_to_int(-x); };
  return {{from(lo.x), from(lo.y), from(lo.z)}, {from(hi.x), from(hi.y), from(hi.z)}};
}

void add_masses(const Window& codes, const RockWindow& rock, std::array<MassUnits, 256>& sums) {
  if (rock.stones.is_uniform() && rock.fills.is_solid()) {
    sums[row_number(rock.stones.all)] += mass_of(codes);
    return;
  }
  for (size_t i = 0; i < codes.codes.size(); ++i)
    sums[row_number(rock.stones.at(i))] += mass_in_voxel(occupancy(codes.codes[i]), rock.fills.at(i));
}

}  // namespace

QueryResult<BoxContent> box_content(const QueryScene& scene, glm::vec3 lo_m, glm::vec3 hi_m) {
  TRY(check_volume(lo_m, hi_m));
  const double voxel_m = scene.voxel_m();
  const VoxelBox box = voxels_in(glm::dvec3(lo_m) / voxel_m, glm::dvec3(hi_m) / voxel_m);
  std::array<MassUnits, 256> sums{};
  MassUnits filled = 0;
  Answered<BoxContent> found;
  const Field& field = scene.field();
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const VoxelCoord first = first_voxel(chunk);
    const VoxelBox part = common(box, {first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}});
    ++found.cost.chunks;
    found.cost.exact = found.cost.exact && field.chunk_bricks(chunk).generated.exact;
    const Window codes = gather(field, part);
    found.cost.steps += static_cast<uint32_t>(1 + codes.codes.size() / 64);
    const MassUnits here = mass_of(codes);
    if (here == 0) return;
    filled += here;
    add_masses(codes, rock_of(gather_materials(field, part), field.rubble()), sums);
  });
  found.answer.rock_m3 =
      static_cast<double>(filled) / static_cast<double>(units_per_voxel) * voxel_m * voxel_m * voxel_m;
  found.answer.masses = listed(sums);
  return found;
}

QueryResult<std::vector<PieceId>> solids_in(const QueryScene& scene, glm::vec3 lo_m, glm::vec3 hi_m,
                                            const QueryMask& mask) {
  TRY(check_box(lo_m, hi_m));
  TRY(check_mask(mask));
  scene.terrain().begin();
  Answered<std::vector<PieceId>> found;
  const SpaceBox box{glm::dvec3(lo_m), glm::dvec3(hi_m)};
  for_each_asked(
      scene, mask, found.cost.steps, [&](const SpaceBox& other) { return other.meets(box); },
      [&](size_t, const QuerySolid& solid) {
        const glm::vec3 at = solid.pose.position_m;
        if (at.x >= lo_m.x && at.y >= lo_m.y && at.z >= lo_m.z && at.x < hi_m.x && at.y < hi_m.y &&
            at.z < hi_m.z)
          found.answer.push_back(solid.id);
      });
  std::sort(found.answer.begin(), found.answer.end());
  return found;
}

}  // namespace scree
