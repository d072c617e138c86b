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

/// Where all is solid. `material_of(voxel, was)`: of what fills it.
template <typename F>
AddedMaterials add_solid(const MaterialReader& were, const Window& before, const Window& after,
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

/// Where something has pores: MergeFills says which voxels become of what `material_of` says.
template <typename F>
AddedMaterials add_filled(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                          const Window& after, F&& material_of) {
  CHECK(before.box == after.box && before.box == were.box());
  AddedMaterials added;
  std::array<MassUnits, 256> gains{};
  const auto enter = [&](Material material, int occupied, int sign) {
    const size_t row = row_number(material);
    gains[row_number(rows.stones[row])] += sign * mass_in_voxel(occupied, rows.fill[row]);
  };
  MaterialChanges changes(were);
  changes.change(mass_changes(before.codes, after.codes), [&](VoxelCoord voxel, size_t i, Material was) {
    const Material is = before.codes[i] < 0 ? was : material_of(voxel, was);
    enter(was, occupancy(before.codes[i]), -1);
    enter(is, occupancy(after.codes[i]), 1);
    return is;
  });
  added.says = changes.says();
  added.gains = listed(gains);
  return added;
}

bool has_pores(const MaterialReader& were, const RubbleRows& rows) {
  const auto pores = [&](Material one) { return rows.fill[row_number(one)] != fill_solid; };
  for (size_t place = 0; place < were.bricks(); ++place) {
    const MaterialReader::BrickOf& brick = were.brick_at(place);
    if (const auto one = brick.uniform()) {
      if (pores(*one)) return true;
      continue;
    }
    VoxelMaterials voxels;
    brick.resolve(voxels);
    if (std::ranges::any_of(voxels, [&](VoxelMaterial one) { return pores(material_of(one)); })) return true;
  }
  return false;
}

/// The pieces at their poses, and of what each place is by the nearest of them.
class MergedRock {
 public:
  MergedRock(const RubbleRows& rows, std::span<const MergedPiece> pieces, Brings brings, float voxel_size_m)
      : rows_(rows), brings_(brings) {
    CHECK(!pieces.empty() && brings != Brings::nothing);
    const Material first = pieces.front().volume.materials.all;
    if (are_all_of(pieces, first)) all_ = become(first);
    if (!all_)
      for (const MergedPiece& piece : pieces) frames_.emplace_back(piece, voxel_size_m);
  }

  std::optional<Material> uniform() const { return all_; }
  Material at(VoxelCoord voxel) const {
    if (all_) return *all_;
    const PieceFrame* nearest = nullptr;
    VoxelCoord place{};
    Code least = code_air;
    for (const PieceFrame& frame : frames_) {
      const VoxelCoord own = frame.nearest(voxel);
      const Code code = frame.code(own);
      if (nearest != nullptr && code >= least) continue;
      nearest = &frame;
      place = own;
      least = code;
    }
    return become(nearest->material(place));
  }

 private:
  Material become(Material material) const {
    return brings_ == Brings::rubble ? rows_.rubble[row_number(material)] : material;
  }

  const RubbleRows& rows_;
  Brings brings_;
  std::optional<Material> all_;
  std::vector<PieceFrame> frames_;
};

/// The fill that all that pieces bring has, if it is one.
std::optional<uint8_t> one_fill(const RubbleRows& rows, std::span<const MergedPiece> pieces, Brings brings) {
  const auto fill_of = [&](Material material) {
    return rows.fill[row_number(brings == Brings::rubble ? rows.rubble[row_number(material)] : material)];
  };
  const MaterialWindow& first = pieces.front().volume.materials;
  const uint8_t one = fill_of(first.is_uniform() ? first.all : first.each.front());
  for (const MergedPiece& piece : pieces) {
    const MaterialWindow& materials = piece.volume.materials;
    const auto differs = [&](Material material) { return fill_of(material) != one; };
    if (materials.is_uniform() ? differs(materials.all) : std::ranges::any_of(materials.each, differs))
      return std::nullopt;
  }
  return one;
}

}  // namespace

bool are_all_of(std::span<const MergedPiece> pieces, Material material) {
  return std::ranges::all_of(pieces, [material](const MergedPiece& piece) {
    return piece.volume.materials.is_uniform() && piece.volume.materials.all == material;
  });
}

MergeFills merge_fills(const MaterialReader& were, const RubbleRows& rows,
                       std::span<const MergedPiece> pieces, Brings brings, float voxel_size_m) {
  MergeFills fills;
  if (!rows.any) return fills;
  if (has_pores(were, rows)) fills.were = rock_of(were.window(), rows).fills;
  if (brings == Brings::nothing) {
    fills.brought = fills.were;
    return fills;
  }
  if (const auto one = one_fill(rows, pieces, brings)) {
    fills.brought.all = *one;
    return fills;
  }
  const MergedRock rock(rows, pieces, brings, voxel_size_m);
  const VoxelBox& box = were.box();
  fills.brought.each.reserve(Window::count(box));
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z)
        fills.brought.each.push_back(rows.fill[row_number(rock.at({x, y, z}))]);
  return fills;
}

AddedMaterials merge_materials(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                               const Window& after, std::span<const MergedPiece> pieces, Brings brings,
                               float voxel_size_m) {
  CHECK(!pieces.empty());
  if (brings == Brings::nothing) return fill_materials(were, rows, before, after, std::nullopt);
  const MergedRock rock(rows, pieces, brings, voxel_size_m);
  const auto material_of = [&](VoxelCoord voxel, Material) { return rock.at(voxel); };
  const auto one = one_fill(rows, pieces, brings);
  if (one == static_cast<uint8_t>(fill_solid) && !(rows.any && has_pores(were, rows)))
    return add_solid(were, before, after, material_of);
  return add_filled(were, rows, before, after, material_of);
}

AddedMaterials fill_materials(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                              const Window& after, std::optional<Material> material) {
  const auto material_of = [material](VoxelCoord, Material was) { return material.value_or(was); };
  const bool brings_pores = material && rows.fill[row_number(*material)] != fill_solid;
  if (!rows.any || !(brings_pores || has_pores(were, rows)))
    return add_solid(were, before, after, material_of);
  return add_filled(were, rows, before, after, material_of);
}

}  // namespace scree
