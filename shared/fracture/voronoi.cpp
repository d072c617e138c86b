#include "shared/fracture/voronoi.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/field/voxel_vector.h"
#include "shared/fracture/cell_cut.h"
#include "shared/fracture/cell_groups.h"

namespace scree {

namespace {

using Label = CellLabel;

/// Side of the blocks of voxels that share a list of candidate seeds.
constexpr int label_block_side = 4;

/// The seeds that can be nearest to some voxel of a block with that centre.
void find_candidates(const std::vector<glm::vec3>& seeds, glm::vec3 centre, std::vector<float>& distances,
                     std::vector<Label>& out) {
  constexpr float half_diagonal = 2.6F;  // 1.5 · √3, rounded up
  float nearest = std::numeric_limits<float>::max();
  for (size_t i = 0; i < seeds.size(); ++i) {
    const glm::vec3 off = seeds[i] - centre;
    distances[i] = std::sqrt(glm::dot(off, off));
    nearest = std::min(nearest, distances[i]);
  }
  out.clear();
  for (size_t i = 0; i < seeds.size(); ++i)
    if (distances[i] <= nearest + 2.0F * half_diagonal) out.push_back(static_cast<Label>(i));
  CHECK_DEBUG(!out.empty());
}

/// Labels a row of label_block_side voxels from (x, y, z) on; the lowest index wins a tie. In vectors, spelt
/// out: the compiler alone takes one voxel at a time.
void label_row(const std::vector<glm::vec3>& seeds, const std::vector<Label>& candidates, glm::vec3 first,
               std::array<int, label_block_side>& labels) {
  using Lanes = float __attribute__((vector_size(16)));
  using IntLanes = int __attribute__((vector_size(16)));
  static_assert(sizeof(Lanes) == label_block_side * sizeof(float));
  const Lanes steps = {0.0F, 1.0F, 2.0F, 3.0F};
  Lanes nearest = Lanes{} + std::numeric_limits<float>::max();
  IntLanes own{};
  for (const Label i : candidates) {
    const glm::vec3 off = first - seeds[i];
    const float across2 = off.x * off.x + off.y * off.y;
    const Lanes along = off.z + steps;
    const Lanes d2 = across2 + along * along;
    const IntLanes nearer = d2 < nearest;
    own = nearer ? IntLanes{} + i : own;
    nearest = nearer ? d2 : nearest;
  }
  std::memcpy(labels.data(), &own, sizeof(own));
}

bool all_air(const Window& volume, const VoxelBox& block) {
  for (int x = block.lo.x; x < block.hi.x; ++x)
    for (int y = block.lo.y; y < block.hi.y; ++y)
      for (int z = block.lo.z; z < block.hi.z; ++z)
        if (volume.at(x, y, z) != code_air) return false;
  return true;
}

/// Index of the nearest seed of every voxel; 0 in blocks of only air, in which no piece has a part.
std::vector<Label> label_voxels(const Window& volume, const std::vector<glm::vec3>& seeds) {
  std::vector<Label> labels(volume.codes.size());
  if (seeds.size() == 1) return labels;
  std::vector<float> distances(seeds.size());
  std::vector<Label> candidates;
  const VoxelBox& box = volume.box;
  const auto label_block = [&](const VoxelBox& block) {
    if (all_air(volume, block)) return;
    find_candidates(seeds, as_vector(block.lo) + 1.5F, distances, candidates);
    std::array<int, label_block_side> row{};
    for (int x = block.lo.x; x < block.hi.x; ++x)
      for (int y = block.lo.y; y < block.hi.y; ++y) {
        label_row(seeds, candidates, as_vector({x, y, block.lo.z}), row);
        Label* out = labels.data() + volume.index(x, y, block.lo.z);
        for (int k = 0; k < block.hi.z - block.lo.z; ++k)
          out[k] = static_cast<Label>(row[static_cast<size_t>(k)]);
      }
  };
  for (int x = box.lo.x; x < box.hi.x; x += label_block_side)
    for (int y = box.lo.y; y < box.hi.y; y += label_block_side)
      for (int z = box.lo.z; z < box.hi.z; z += label_block_side)
        label_block({{x, y, z},
                     {std::min(x + label_block_side, box.hi.x), std::min(y + label_block_side, box.hi.y),
                      std::min(z + label_block_side, box.hi.z)}});
  return labels;
}

/// Mass that the terrain lost, voxel by voxel.
std::vector<uint8_t> lost_units(const Window& before, const Window& after) {
  std::vector<uint8_t> lost(before.codes.size());
  for (size_t i = 0; i < lost.size(); ++i) {
    CHECK_DEBUG(after.codes[i] >= before.codes[i]);  // the terrain gains nothing anywhere
    lost[i] = static_cast<uint8_t>(occupancy(before.codes[i]) - occupancy(after.codes[i]));
  }
  return lost;
}

/// Mass lost nearest to each seed: exact enough to tell which cells are too light.
std::vector<MassUnits> rough_masses(const std::vector<uint8_t>& lost, const std::vector<Label>& labels,
                                    size_t cells) {
  std::vector<MassUnits> masses(cells);
  for (size_t i = 0; i < lost.size(); ++i) masses[labels[i]] += lost[i];
  return masses;
}

/// Which cells touch which: a symmetric matrix of bits.
class TouchMatrix {
 public:
  explicit TouchMatrix(size_t cells) : cells_(cells), words_((cells + 63) / 64), bits_(cells * words_) {}

  void set(Label a, Label b) {
    CHECK_DEBUG(a < cells_ && b < cells_);
    bits_[a * words_ + b / 64] |= uint64_t{1} << (b % 64);
  }

  /// Whether a row is one word; and all of it at once, then.
  bool narrow() const { return words_ == 1; }
  void set_all(Label a, uint64_t those) { bits_[a] |= those; }

  /// Pairs (low, high), sorted, of those set either way.
  std::vector<std::pair<Label, Label>> pairs() {
    for (size_t a = 0; a < cells_; ++a)
      for (size_t w = 0; w < words_; ++w)
        for (uint64_t left = bits_[a * words_ + w]; left != 0; left &= left - 1)
          set(static_cast<Label>(w * 64 + static_cast<size_t>(std::countr_zero(left))),
              static_cast<Label>(a));
    std::vector<std::pair<Label, Label>> out;
    for (size_t a = 0; a < cells_; ++a)
      for (size_t w = 0; w < words_; ++w)
        for (uint64_t left = bits_[a * words_ + w]; left != 0; left &= left - 1) {
          const size_t b = w * 64 + static_cast<size_t>(std::countr_zero(left));
          if (a < b) out.emplace_back(static_cast<Label>(a), static_cast<Label>(b));
        }
    return out;
  }

 private:
  size_t cells_;
  size_t words_;
  std::vector<uint64_t> bits_;
};

/// Pairs of cells (low, high) that touch within the volume, sorted.
std::vector<std::pair<Label, Label>> touching_cells(const Window& volume, const std::vector<Label>& labels,
                                                    size_t cells) {
  if (cells == 1) return {};
  TouchMatrix touch(cells);
  const VoxelCoord size = volume.box.size();
  const auto nz = static_cast<ptrdiff_t>(size.z);
  const ptrdiff_t nyz = nz * size.y;
  // Half of the 26 neighbours: cells that meet only along an edge still bound each other.
  constexpr int forward[13][3] = {{0, 0, 1},  {0, 1, -1}, {0, 1, 0},  {0, 1, 1}, {1, -1, -1},
                                  {1, -1, 0}, {1, -1, 1}, {1, 0, -1}, {1, 0, 0}, {1, 0, 1},
                                  {1, 1, -1}, {1, 1, 0},  {1, 1, 1}};
  std::array<ptrdiff_t, 13> steps;
  for (size_t k = 0; k < steps.size(); ++k)
    steps[k] = forward[k][0] * nyz + forward[k][1] * nz + forward[k][2];
  for (int x = 1; x + 1 < size.x; ++x)
    for (int y = 1; y + 1 < size.y; ++y)
      for (int z = 1; z + 1 < size.z; ++z) {
        const ptrdiff_t i = x * nyz + y * nz + z;
        if (volume.codes[static_cast<size_t>(i)] == code_air) continue;
        const Label here = labels[static_cast<size_t>(i)];
        if (touch.narrow()) {
          // Without a branch, for neighbours differ as often as not: half the time.
          uint64_t there = 0;
          for (const ptrdiff_t step : steps) {
            const auto j = static_cast<size_t>(i + step);
            there |= static_cast<uint64_t>(volume.codes[j] != code_air ? 1 : 0) << labels[j];
          }
          touch.set_all(here, there);
          continue;
        }
        for (const ptrdiff_t step : steps) {
          const auto j = static_cast<size_t>(i + step);
          const Label there = labels[j];
          if (here == there || volume.codes[j] == code_air) continue;
          touch.set(here, there);
        }
      }
  return touch.pairs();
}

/// Per piece: the bounds of its voxels in or near the volume, grown so that its surface lies within.
std::vector<VoxelBox> piece_boxes(const Window& volume, const std::vector<Label>& labels,
                                  const CellGroups& groups, size_t cells) {
  const VoxelBox nothing{volume.box.hi, volume.box.lo};
  std::vector<VoxelBox> boxes(cells, nothing);
  std::vector<Label> roots(cells);
  for (size_t i = 0; i < cells; ++i) roots[i] = groups.root(static_cast<Label>(i));
  constexpr Code near_surface = 43;  // one voxel
  const VoxelBox& all = volume.box;
  size_t i = 0;
  for (int x = all.lo.x; x < all.hi.x; ++x)
    for (int y = all.lo.y; y < all.hi.y; ++y)
      for (int z = all.lo.z; z < all.hi.z; ++z, ++i) {
        if (volume.codes[i] >= near_surface) continue;
        VoxelBox& b = boxes[roots[labels[i]]];
        b.lo = {std::min(b.lo.x, x), std::min(b.lo.y, y), std::min(b.lo.z, z)};
        b.hi = {std::max(b.hi.x, x + 1), std::max(b.hi.y, y + 1), std::max(b.hi.z, z + 1)};
      }
  constexpr int margin = 2;
  for (VoxelBox& b : boxes) {
    if (b.empty()) b = {all.lo, all.lo};
    b = b.grown(margin);
    b.lo = {std::max(b.lo.x, all.lo.x), std::max(b.lo.y, all.lo.y), std::max(b.lo.z, all.lo.z)};
    b.hi = {std::min(b.hi.x, all.hi.x), std::min(b.hi.y, all.hi.y), std::min(b.hi.z, all.hi.z)};
  }
  return boxes;
}

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
                                const std::vector<Label>& nearest, std::vector<CellPart>& parts) {
  std::vector<PartMass> masses = share_out(box, lost, nearest, parts);
  const auto light = [](const PartMass& part) { return part.mass < limits::piece_mass_min; };
  if (std::ranges::none_of(masses, light)) return masses;
  for (CellPart& part : parts) std::ranges::fill(part.within, uint8_t{0});
  return share_out(box, lost, nearest, parts);
}

}  // namespace

Cut cut_cells(const Window& volume, const Window& before, const Window& after,
              const std::vector<glm::vec3>& seeds_voxels) {
  CHECK(volume.box == before.box && volume.box == after.box && seeds_voxels.size() <= limits::seeds_max);
  Cut cut;
  const std::vector<uint8_t> lost = lost_units(before, after);
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

  std::vector<std::vector<glm::vec3>> own(cells), neighbours(cells);
  std::vector<Label> piece_of(cells);  // a root's piece, then every cell's
  for (size_t i = 0; i < cells; ++i) {
    const Label root = groups.root(static_cast<Label>(i));
    if (root == i) {
      piece_of[i] = static_cast<Label>(cut.pieces.size());
      cut.pieces.emplace_back();
    }
    piece_of[i] = piece_of[root];
    cut.pieces[piece_of[i]].seeds.push_back(static_cast<uint32_t>(i));
    own[root].push_back(seeds_voxels[i]);
  }
  for (const auto& [a, b] : touching) {
    const Label ra = groups.root(a), rb = groups.root(b);
    if (ra == rb) continue;
    neighbours[ra].push_back(seeds_voxels[b]);
    neighbours[rb].push_back(seeds_voxels[a]);
  }
  std::vector<CellPart> parts;
  parts.reserve(cut.pieces.size());
  for (const CutPiece& piece : cut.pieces) {
    const uint32_t root = piece.seeds.front();
    parts.push_back(cut_part(volume, boxes[root], own[root], neighbours[root]));
  }
  for (Label& label : labels) label = piece_of[label];
  const std::vector<PartMass> masses = masses_of(before.box, lost, labels, parts);
  for (size_t i = 0; i < parts.size(); ++i) {
    Volume& piece = cut.pieces[i].volume;
    piece.window = std::move(parts[i].window);
    piece.mass = masses[i].mass;
    piece.centre_voxels = centre_of_mass(masses[i], before.box.lo);
  }
  CHECK_EQ(std::accumulate(masses.begin(), masses.end(), MassUnits{0},
                           [](MassUnits sum, const PartMass& part) { return sum + part.mass; }),
           total);
  return cut;
}

}  // namespace scree
