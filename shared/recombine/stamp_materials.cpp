#include "shared/recombine/stamp_materials.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

#include "shared/base/check.h"
#include "shared/field/material_changes.h"

namespace scree {

namespace {

/// From the terrain's voxels into a piece's own.
class PieceFrame {
 public:
  PieceFrame(const MergedPiece& piece, float voxel_size_m) : volume_(piece.volume) {
    const Pose pose = dequantise(piece.pose);
    inverse_ = glm::mat3_cast(glm::conjugate(pose.rotation));
    origin_ = volume_.centre_voxels + 0.5F - inverse_ * (pose.position_m / voxel_size_m);
  }

  /// The voxel of the piece's window nearest to a voxel of the terrain.
  VoxelCoord nearest(VoxelCoord voxel) const {
    const glm::vec3 p = origin_ + inverse_ * glm::vec3(voxel.x, voxel.y, voxel.z);
    const VoxelBox& box = volume_.window.box;
    return {std::clamp(floor_to_int(p.x), box.lo.x, box.hi.x - 1),
            std::clamp(floor_to_int(p.y), box.lo.y, box.hi.y - 1),
            std::clamp(floor_to_int(p.z), box.lo.z, box.hi.z - 1)};
  }
  Code code(VoxelCoord own) const { return volume_.window.at(own.x, own.y, own.z); }
  Material material(VoxelCoord own) const { return material_near(volume_.window, volume_.materials, own); }

 private:
  const Volume& volume_;
  glm::mat3 inverse_{1.0F};
  glm::vec3 origin_{};
};

/// Voxels that hold rests of two materials, of which each counts for one alone: for the new one where its
/// share is a bound or more. That bound from a quarter to three quarters is taken that converts least in sum:
/// with a fixed one, what falls on rock in thin layers would become rock bit by bit.
class MixedVoxels {
 public:
  /// Bounds, as shares of what is new in sixteenths, rounded down.
  static constexpr int fewest = 4, half = 8, most = 12;
  static int share_of(int had, int has) { return 16 * (has - had) / has; }

  void add(int had, int has) {
    const int share = share_of(had, has);
    if (share < fewest) {
      to_old_ += has - had;
    } else if (share >= most) {
      to_old_ -= had;
    } else {
      had_[static_cast<size_t>(share)] += had;
      both_[static_cast<size_t>(share)] += has;
    }
  }
  int bound() const {
    MassUnits to_old = to_old_;  // what becomes old, less what becomes new, where all else becomes new
    for (const MassUnits had : had_) to_old -= had;
    int best = half;
    MassUnits least = std::numeric_limits<MassUnits>::max();
    for (int bound = fewest; bound <= most; ++bound) {
      const MassUnits sum = std::abs(to_old);
      if (sum < least || (sum == least && std::abs(bound - half) < std::abs(best - half))) {
        best = bound;
        least = sum;
      }
      if (bound < most) to_old += both_[static_cast<size_t>(bound)];
    }
    return best;
  }

 private:
  MassUnits to_old_ = 0;
  std::array<MassUnits, most> had_{}, both_{};  ///< by share: what was there, and that with what is new
};

/// A voxel whose material the bound decides.
struct OpenVoxel {
  VoxelCoord voxel;
  Material was, other;
  int had, has;
};

/// `material_of(voxel, was)`: of what fills it.
template <typename F>
AddedMaterials add_materials(const MaterialReader& were, const Window& before, const Window& after,
                             F&& material_of) {
  CHECK(before.box == after.box && before.box == were.box());
  AddedMaterials added;
  std::array<MassUnits, 256> gains{};
  const auto enter = [&](Material was, int had, Material is, int has) {
    gains[row_number(was)] -= had;
    gains[row_number(is)] += has;
  };
  MaterialChanges changes(were);
  MixedVoxels mixed;
  std::vector<OpenVoxel> open;
  changes.change(mass_changes(before.codes, after.codes), [&](VoxelCoord voxel, size_t i, Material was) {
    const int had = occupancy(before.codes[i]), has = occupancy(after.codes[i]);
    Material is = has < had ? was : material_of(voxel, was);
    if (is != was && had > 0) {
      mixed.add(had, has);
      const int share = MixedVoxels::share_of(had, has);
      if (share >= MixedVoxels::fewest && share < MixedVoxels::most) {
        open.push_back({voxel, was, is, had, has});
        return was;
      }
      if (share < MixedVoxels::fewest) is = was;
    }
    enter(was, had, is, has);
    return is;
  });
  const int bound = mixed.bound();
  for (const OpenVoxel& one : open) {
    const bool is_new = MixedVoxels::share_of(one.had, one.has) >= bound;
    if (is_new) changes.set(one.voxel, one.other);
    enter(one.was, one.had, is_new ? one.other : one.was, one.has);
  }
  added.says = changes.says();
  added.gains = listed(gains);
  return added;
}

}  // namespace

bool are_all_of(std::span<const MergedPiece> pieces, Material material) {
  return std::ranges::all_of(pieces, [material](const MergedPiece& piece) {
    return piece.volume.materials.is_uniform() && piece.volume.materials.all == material;
  });
}

AddedMaterials merge_materials(const MaterialReader& were, const Window& before, const Window& after,
                               std::span<const MergedPiece> pieces, bool bring, float voxel_size_m) {
  CHECK(!pieces.empty());
  const Material first = pieces.front().volume.materials.all;
  if (!bring) return fill_materials(were, before, after, std::nullopt);
  if (are_all_of(pieces, first)) return fill_materials(were, before, after, first);
  std::vector<PieceFrame> frames;
  for (const MergedPiece& piece : pieces) frames.emplace_back(piece, voxel_size_m);
  return add_materials(were, before, after, [&](VoxelCoord voxel, Material) {
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

AddedMaterials fill_materials(const MaterialReader& were, const Window& before, const Window& after,
                              std::optional<Material> material) {
  return add_materials(were, before, after,
                       [material](VoxelCoord, Material was) { return material.value_or(was); });
}

}  // namespace scree
