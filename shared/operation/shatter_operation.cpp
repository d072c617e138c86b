#include "shared/operation/shatter_operation.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "shared/base/limits.h"
#include "shared/falling/connected.h"
#include "shared/falling/island.h"
#include "shared/field/edit.h"
#include "shared/fracture/material_shares.h"
#include "shared/fracture/seeds.h"
#include "shared/fracture/shatter.h"
#include "shared/operation/limits.h"

namespace scree {

namespace {

/// As many as may be pieces, the largest first.
void keep_largest(std::vector<Connected>& all) {
  const auto is_larger = [](const Connected& a, const Connected& b) { return a.voxels > b.voxels; };
  std::stable_sort(all.begin(), all.end(), is_larger);
  if (all.size() > limits::cut_rests_max) all.resize(limits::cut_rests_max);
}

/// The window's codes over a box that may reach beyond it, into air.
Window with_air(const Window& window, const VoxelBox& box) {
  Window wide(box);
  const VoxelBox both = common(box, window.box);
  if (!both.empty()) put(part_of(window, both), wide);
  return wide;
}

/// What is left of a piece, alone in its own window, which lies in the piece's.
Volume rest_of(const Window& after, const Connected& one) {
  Window around = with_air(after, lift_box(one.box));
  Volume volume = lift(around, one.box, one.start);
  volume.window = part_of(volume.window, common(volume.window.box, after.box));
  return volume;
}

/// The parts of what is left that are connected and not too light, by voxels; the mass of the others, and of
/// slivers that belong to none, is dust. Masses are those of their codes.
std::vector<CutPiece> rests_of(const Window& after, MassUnits& dust) {
  MassUnits left = mass_of(after);
  std::vector<Connected> all = connected_in(after).all;
  keep_largest(all);
  std::vector<CutPiece> rests;
  for (const Connected& one : all) {
    Volume volume = rest_of(after, one);
    if (volume.mass < limits::piece_mass_min) continue;
    left -= volume.mass;
    rests.push_back({std::move(volume), {}});
  }
  if (rests.size() == 1 && all.size() == 1) {
    rests.front().volume.mass += left;
    left = 0;
  }
  dust += std::max<MassUnits>(left, 0);
  return rests;
}

/// The shape's distances over the piece's window, as codes, where the piece lies.
Window shape_in(const PieceCut& cut, const Volume& piece, float voxel_size_m) {
  const Shape shape = in_voxels(cut.shape, voxel_size_m);
  const Pose pose = dequantise(cut.pose);
  const glm::mat3 to_world = glm::mat3_cast(pose.rotation);
  const glm::vec3 centre = pose.position_m / voxel_size_m;
  Window window(piece.window.box);
  const VoxelBox& box = window.box;
  size_t at = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++at) {
        const glm::vec3 off = glm::vec3(x, y, z) - piece.centre_voxels;
        window.codes[at] = encode(distance(shape, centre + to_world * off));
      }
  return window;
}

/// Shares the piece's mass out in proportion to the masses of codes, dust's too. Each share is the difference
/// of two cumulative ones, so no unit is left over. The products stay below 2^60.
void share_mass(Cut& cut, MassUnits mass) {
  MassUnits all = cut.dust;
  for (const CutPiece& one : cut.pieces) all += one.volume.mass;
  MassUnits before = 0, given = 0;
  for (CutPiece& one : cut.pieces) {
    before += one.volume.mass;
    const MassUnits due = mass * before / all;
    one.volume.mass = due - given;
    given = due;
  }
  cut.dust = mass - given;
}

Cut cut_by_shape(const ShatterOperation& op, const Volume& piece, float voxel_size_m, Applied& applied) {
  const Window shape = shape_in(*op.cut, piece, voxel_size_m);
  Window after = piece.window;
  carve(after, shape);
  std::vector<uint8_t> lost = mass_changes(piece.window.codes, after.codes);
  Cut cut;
  if (std::any_of(lost.begin(), lost.end(), [](uint8_t units) { return units != 0; })) {
    const Window inside = extract(piece.window, shape);
    applied.seeds_voxels =
        scatter_seeds(inside, op.pattern, first_seeds(op), op.random_seed, op.impact_voxels);
    cut = cut_volume(op.cutter, inside, std::move(lost), applied.seeds_voxels);
  }
  // What the cutter knows of voxels does not hold for the rest.
  Cut all;
  all.pieces = std::move(cut.pieces);
  all.dust = cut.dust;
  const auto broken = static_cast<ptrdiff_t>(all.pieces.size());
  for (CutPiece& rest : rests_of(after, all.dust)) all.pieces.push_back(std::move(rest));
  share_mass(all, piece.mass);
  share_materials(all, piece.materials, masses_of(piece));
  std::vector<CutPiece> rests(std::make_move_iterator(all.pieces.begin() + broken),
                              std::make_move_iterator(all.pieces.end()));
  all.pieces.resize(static_cast<size_t>(broken));
  if (!all.pieces.empty()) finish_cut(all, op, op.impact_voxels);
  applied.rests = rests.size();
  for (CutPiece& rest : rests) all.pieces.push_back(std::move(rest));
  return all;
}

}  // namespace

Cut cut_of(const ShatterOperation& op, const Volume& piece, float voxel_size_m, Applied& applied) {
  if (op.cut) return cut_by_shape(op, piece, voxel_size_m, applied);
  applied.seeds_voxels =
      scatter_seeds(piece.window, op.pattern, first_seeds(op), op.random_seed, op.impact_voxels);
  Cut cut = shatter(op.cutter, piece, applied.seeds_voxels);
  share_materials(cut, piece.materials, masses_of(piece));
  finish_cut(cut, op, op.impact_voxels);
  return cut;
}

PieceCutLook look_at_cut(const PieceCut& cut, const Volume& piece, float voxel_size_m) {
  const Window shape = shape_in(cut, piece, voxel_size_m);
  Window after = piece.window;
  carve(after, shape);
  return {after.codes != piece.window.codes, connected_in(after).all.size()};
}

}  // namespace scree
