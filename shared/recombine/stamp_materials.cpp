#include "shared/recombine/stamp_materials.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

/// From the terrain's voxels into a piece's own.
class PieceFrame {
 public:
  PieceFrame(const MergedPiece& piece, float voxel_size_m) : volume_(piece.volume) {
    const Pose pose = dequantise(piece.pose);
    position_voxels_ = pose.position_m / voxel_size_m;
    inverse_ = glm::conjugate(pose.rotation);
  }

  /// The voxel of the piece's window nearest to a voxel of the terrain.
  VoxelCoord nearest(VoxelCoord voxel) const {
    const glm::vec3 p =
        inverse_ * (glm::vec3(voxel.x, voxel.y, voxel.z) - position_voxels_) + volume_.centre_voxels + 0.5F;
    const VoxelBox& box = volume_.window.box;
    return {std::clamp(floor_to_int(p.x), box.lo.x, box.hi.x - 1),
            std::clamp(floor_to_int(p.y), box.lo.y, box.hi.y - 1),
            std::clamp(floor_to_int(p.z), box.lo.z, box.hi.z - 1)};
  }
  Code code(VoxelCoord own) const { return volume_.window.at(own.x, own.y, own.z); }
  Material material(VoxelCoord own) const { return volume_.materials.at(own); }

 private:
  const Volume& volume_;
  glm::vec3 position_voxels_{};
  glm::quat inverse_{};
};

/// `material_of(voxel)`: of what fills it.
template <typename F>
std::vector<uint8_t> take_over(MaterialWindow& materials, const Window& before, const Window& after,
                               F&& material_of_voxel) {
  CHECK(before.box == after.box && before.box == materials.box);
  std::vector<uint8_t> marks;
  size_t at = 0;
  for (int x = before.box.lo.x; x < before.box.hi.x; ++x)
    for (int y = before.box.lo.y; y < before.box.hi.y; ++y)
      for (int z = before.box.lo.z; z < before.box.hi.z; ++z, ++at) {
        if (before.codes[at] == after.codes[at]) continue;
        if (occupancy(after.codes[at]) <= 2 * occupancy(before.codes[at])) continue;
        const Material material = material_of_voxel(VoxelCoord{x, y, z});
        if (material == materials.at(at)) continue;
        if (materials.is_uniform()) materials.each.assign(before.codes.size(), materials.all);
        if (marks.empty()) marks.resize(before.codes.size());
        materials.each[at] = material;
        marks[at] = 1;
      }
  return marks;
}

}  // namespace

bool are_all_of(std::span<const MergedPiece> pieces, Material material) {
  return std::ranges::all_of(pieces, [material](const MergedPiece& piece) {
    return piece.volume.materials.is_uniform() && piece.volume.materials.all == material;
  });
}

std::vector<uint8_t> merge_materials(MaterialWindow& materials, const Window& before, const Window& after,
                                     std::span<const MergedPiece> pieces, float voxel_size_m) {
  CHECK(!pieces.empty());
  const Material first = pieces.front().volume.materials.all;
  if (are_all_of(pieces, first)) return fill_materials(materials, before, after, first);
  std::vector<PieceFrame> frames;
  for (const MergedPiece& piece : pieces) frames.emplace_back(piece, voxel_size_m);
  return take_over(materials, before, after, [&](VoxelCoord voxel) {
    const PieceFrame* nearest = nullptr;
    VoxelCoord place{};
    Code least = code_air;
    for (const PieceFrame& frame : frames) {
      const VoxelCoord own = frame.nearest(voxel);
      const Code code = frame.code(own);
      if (nearest != nullptr && code >= least) continue;
      nearest = &frame;
      place = own;
      least = code;
    }
    return nearest->material(place);
  });
}

std::vector<uint8_t> fill_materials(MaterialWindow& materials, const Window& before, const Window& after,
                                    Material material) {
  if (materials.is_uniform() && materials.all == material) return {};
  return take_over(materials, before, after, [material](VoxelCoord) { return material; });
}

}  // namespace scree
