// The cutter `field`: works on codes, without any mesh.
#include <algorithm>
#include <numeric>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/vector_clones.h"
#include "shared/field/eight_bytes.h"
#include "shared/field/occupancy_byte.h"
#include "shared/fracture/cell_cut.h"
#include "shared/fracture/cell_groups.h"
#include "shared/fracture/cutter.h"
#include "shared/fracture/mass_shares.h"
#include "shared/fracture/nearest_seed.h"
#include "shared/fracture/touching_cells.h"

namespace scree {

namespace {

using Label = CellLabel;

/// Mass lost nearest to each seed: exact enough to tell which cells are too light.
std::vector<MassUnits> rough_masses(const std::vector<uint8_t>& lost, const std::vector<Label>& labels,
                                    size_t cells) {
  std::vector<MassUnits> masses(cells);
  for_each_nonzero(lost, [&](size_t i) { masses[labels[i]] += lost[i]; });
  return masses;
}

/// The greatest of −x, −y, −z, x, y and z of some voxels: bounds that one comparison extends.
using Extremes = int16_t __attribute__((vector_size(16)));

/// The extremes of each cell's voxels in or near the volume, from the window's low corner.
std::vector<Extremes> cell_extremes(const Window& volume, const std::vector<Label>& labels, size_t cells) {
  constexpr Code near_surface = 43;  // one voxel
  constexpr size_t stretch = 8;      // voxels, looked at one by one only if one of them is near
  const VoxelCoord size = volume.box.size();
  CHECK(std::max({size.x, size.y, size.z}) <= INT16_MAX);
  std::vector<Extremes> found(cells, Extremes{} + int16_t{INT16_MIN});
  const auto count = static_cast<size_t>(size.z);
  size_t row = 0;
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y, row += count)
      for (size_t from = 0; from < count; from += stretch) {
        const size_t to = std::min(from + stretch, count);
        if (to - from == stretch && !any_below(&volume.codes[row + from], near_surface)) continue;
        for (size_t k = from; k < to; ++k) {
          if (volume.codes[row + k] >= near_surface) continue;
          const auto sx = static_cast<int16_t>(x), sy = static_cast<int16_t>(y), sz = static_cast<int16_t>(k);
          const Extremes at = {static_cast<int16_t>(-sx),
                               static_cast<int16_t>(-sy),
                               static_cast<int16_t>(-sz),
                               sx,
                               sy,
                               sz,
                               0,
                               0};
          Extremes& most = found[labels[row + k]];
          most = at > most ? at : most;
        }
      }
  return found;
}

/// Per piece, at its root: the bounds of its voxels in or near the volume, grown so that its surface lies
/// within.
std::vector<VoxelBox> piece_boxes(const Window& volume, const std::vector<Label>& labels,
                                  const CellGroups& groups, size_t cells) {
  const VoxelBox& all = volume.box;
  std::vector<VoxelBox> boxes(cells, VoxelBox{all.hi, all.lo});
  const std::vector<Extremes> extremes = cell_extremes(volume, labels, cells);
  for (size_t i = 0; i < cells; ++i) {
    const Extremes& most = extremes[i];
    if (most[0] == INT16_MIN) continue;
    VoxelBox& box = boxes[groups.root(static_cast<Label>(i))];
    box = hull_of(box, {all.lo - VoxelCoord{most[0], most[1], most[2]},
                        all.lo + VoxelCoord{most[3] + 1, most[4] + 1, most[5] + 1}});
  }
  constexpr int margin = 2;
  for (VoxelBox& b : boxes) {
    if (b.empty()) b = {all.lo, all.lo};
    b = common(b.grown(margin), all);
  }
  return boxes;
}

/// Few pieces touch more cells.
constexpr size_t neighbours_usual = 24;

glm::vec3 centre_of_mass(const PartMass& sum, VoxelCoord origin) {
  CHECK(sum.mass >= limits::piece_mass_min);
  const auto mass = static_cast<double>(sum.mass);
  return {static_cast<float>(static_cast<double>(sum.x) / mass + origin.x),
          static_cast<float>(static_cast<double>(sum.y) / mass + origin.y),
          static_cast<float>(static_cast<double>(sum.z) / mass + origin.z)};
}

/// The masses of the parts. If one is lighter than a piece may be, every voxel counts wholly for its nearest
/// part instead.
std::vector<PartMass> masses_of(const VoxelBox& box, const std::vector<uint8_t>& lost,
                                const NearestParts& nearest, std::vector<CellPart>& parts) {
  std::vector<PartMass> masses = share_out(box, lost, nearest, parts);
  const auto light = [](const PartMass& part) { return part.mass < limits::piece_mass_min; };
  if (std::ranges::none_of(masses, light)) return masses;
  for (CellPart& part : parts) part.shares.clear();
  return share_out(box, lost, nearest, parts);
}

}  // namespace

Cut cut_by_field(const Window& volume, std::vector<uint8_t> lost,
                 const std::vector<glm::vec3>& seeds_voxels) {
  Cut cut;
  const MassUnits total = std::accumulate(lost.begin(), lost.end(), MassUnits{0});
  if (seeds_voxels.empty() || total < limits::piece_mass_min) {
    cut.dust = total;
    return cut;
  }
  const size_t cells = seeds_voxels.size();
  std::vector<Label> labels = label_voxels(volume, seeds_voxels);
  const auto touching = touching_cells(volume, labels, cells);
  const CellGroups groups(rough_masses(lost, labels, cells), touching);
  const std::vector<VoxelBox> boxes = piece_boxes(volume, labels, groups, cells);

  std::vector<CellBounds> bounds;
  bounds.reserve(cells);
  std::vector<Label> piece_of(cells);  // a root's piece, then every cell's
  for (size_t i = 0; i < cells; ++i) {
    const Label root = groups.root(static_cast<Label>(i));
    if (root == i) {
      piece_of[i] = static_cast<Label>(cut.pieces.size());
      cut.pieces.emplace_back();
      bounds.push_back({.box = boxes[root], .own = {}, .neighbours = {}});
      bounds.back().neighbours.reserve(neighbours_usual);
    }
    piece_of[i] = piece_of[root];
    cut.pieces[piece_of[i]].seeds.push_back(static_cast<uint32_t>(i));
    bounds[piece_of[i]].own.push_back(seeds_voxels[i]);
  }
  for (const auto& [a, b] : touching) {
    const Label pa = piece_of[a], pb = piece_of[b];
    if (pa == pb) continue;
    bounds[pa].neighbours.push_back(seeds_voxels[b]);
    bounds[pb].neighbours.push_back(seeds_voxels[a]);
  }
  std::vector<CellPart> parts = cut_parts(volume, bounds);
  const std::vector<PartMass> masses = masses_of(volume.box, lost, {labels, piece_of}, parts);
  for (size_t i = 0; i < parts.size(); ++i) {
    Volume& piece = cut.pieces[i].volume;
    piece.window = std::move(parts[i].window);
    piece.mass = masses[i].mass;
    piece.centre_voxels = centre_of_mass(masses[i], volume.box.lo);
  }
  CHECK_EQ(std::accumulate(masses.begin(), masses.end(), MassUnits{0},
                           [](MassUnits sum, const PartMass& part) { return sum + part.mass; }),
           total);
  cut.lost = std::move(lost);
  cut.cell_of_voxel = std::move(labels);
  cut.piece_of_cell = std::move(piece_of);
  return cut;
}

}  // namespace scree
