#include "shared/fracture/natural_cut.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/base/roots.h"
#include "shared/fracture/material_shares.h"
#include "shared/fracture/seeds.h"
#include "shared/fracture/shatter.h"

namespace scree {

namespace {

/// n of the law that blocks are cut by. The pieces of a block are unlike, too, but none is larger than its
/// block: in all, n is 1.4 to 2.1 (bench sizes).
constexpr float law_n = 1.2F;
/// The most of a volume that becomes dust.
constexpr float fines_share_max = 0.06F;
/// A break into fewer leaves no dust: so few are all large.
constexpr uint32_t fines_seeds_min = 16;
/// Mass of the smallest piece that is planned, voxels; smaller than limits::piece_mass_min none can be.
constexpr float piece_voxels_min = 2.5F;
/// The law's share of mass below that is at most so much: pieces are only so small on average.
constexpr float share_below_max = 0.18F;
constexpr uint32_t pieces_per_block = 6;
constexpr uint32_t blocks_min = 2, blocks_max = 7;
/// By so much of its distance a block may count as nearer to the blow or farther from it.
constexpr float disorder = 0.2F;
constexpr float ln_2 = 0.69314718F;

/// −ln(x), 0 < x ≤ 1: the series of 2 artanh, of a fourth square root.
float minus_log(float x) {
  CHECK_DEBUG(x > 0.0F && x <= 1.0F);
  constexpr int roots = 4, terms = 8;
  float root = x;
  for (int i = 0; i < roots; ++i) root = std::sqrt(root);
  const float z = (1.0F - root) / (1.0F + root);
  float power_of_z = z, sum = 0.0F;
  for (int i = 0; i < terms; ++i, power_of_z *= z * z) sum += power_of_z / static_cast<float>(2 * i + 1);
  return sum * 2.0F * (1 << roots);
}

/// x to the power of 3/n = 2.5: from a ratio of diameters' powers to one of volumes.
float volume_power(float x) {
  static_assert(law_n == 1.2F);
  return x * x * std::sqrt(x);
}

struct Block {
  size_t piece = 0;
  float order = 0.0F;  ///< distance from the blow, with some disorder
  float voxels = 0.0F;
  float size = 0.0F;  ///< of its pieces by the law, in units of the law's own volume
  uint32_t pieces = 1;

  float piece_voxels() const { return voxels / static_cast<float>(pieces); }
};

float voxels_of(MassUnits mass) {
  return static_cast<float>(mass) / units_per_voxel;
}

/// How many pieces each block becomes.
class Plan {
 public:
  Plan(const Cut& cut, const NaturalBreak& natural) : natural_(natural) {
    Random random(natural.random_seed);
    for (size_t i = 0; i < cut.pieces.size(); ++i) {
      const Volume& volume = cut.pieces[i].volume;
      const glm::vec3 off = volume.centre_voxels - natural.impact_voxels;
      const float about = 1.0F + disorder * (2.0F * random.unit() - 1.0F);
      blocks.push_back({i, std::sqrt(glm::dot(off, off)) * about, voxels_of(volume.mass)});
      voxels_ += blocks.back().voxels;
    }
    std::ranges::stable_sort(blocks, {}, &Block::order);
    float nearer = 0.0F;
    for (Block& block : blocks) {
      const float share = (nearer + 0.5F * block.voxels) / voxels_;
      block.size = volume_power(minus_log(std::max(1.0F - share, 1e-6F)));
      nearer += block.voxels;
    }
    choose();
  }

  std::vector<Block> blocks;

 private:
  /// The least volume of the law that leaves no more pieces than are wanted.
  void choose() {
    constexpr int halvings = 32;
    float low = piece_voxels_min * volume_power(1.0F / share_below_max);
    if (pieces_by(low) <= natural_.seeds) return;
    float high = low + voxels_ * static_cast<float>(1U << 20U);
    for (int i = 0; i < halvings; ++i) {
      const float middle = std::sqrt(low * high);
      (pieces_by(middle) > natural_.seeds ? low : high) = middle;
    }
    pieces_by(high);
  }

  /// Cuts into pieces by that volume of the law; returns how many are left when the finest are dust.
  uint32_t pieces_by(float law_voxels) {
    uint32_t all = 0;
    for (Block& block : blocks) {
      const float each = std::max(law_voxels * block.size, piece_voxels_min);
      const float pieces = std::min(block.voxels / each + 0.5F, static_cast<float>(limits::seeds_max));
      block.pieces = std::max(static_cast<uint32_t>(pieces), 1U);
      all += block.pieces;
    }
    return all - fines();
  }

  uint32_t fines() const {
    if (natural_.seeds < fines_seeds_min) return 0;
    std::vector<const Block*> by_size;
    for (const Block& block : blocks) by_size.push_back(&block);
    std::ranges::stable_sort(by_size, {}, &Block::piece_voxels);
    float left = fines_share_max * voxels_;
    uint32_t count = 0;
    for (const Block* block : by_size) {
      const auto some =
          std::min(block->pieces, static_cast<uint32_t>(std::min(left / block->piece_voxels(), 1e6F)));
      count += some;
      if (some < block->pieces) break;
      left -= block->voxels;
    }
    return count;
  }

  const NaturalBreak& natural_;
  float voxels_ = 0.0F;
};

/// The pieces that a block is cut into: itself where it has no room for two.
void cut_block(CutPiece block, uint32_t pieces, const NaturalBreak& natural, uint32_t random_seed, Cut& to) {
  const Volume& volume = block.volume;
  std::vector<glm::vec3> seeds;
  if (pieces > 1)
    seeds = scatter_seeds(volume.window, plain_pattern, pieces, random_seed, natural.impact_voxels);
  if (seeds.size() < 2) {
    to.pieces.push_back(std::move(block));
    return;
  }
  Cut parts = shatter(natural.cutter, volume, seeds);
  share_materials(parts, volume.materials, masses_of(volume));
  to.dust += parts.dust;
  for (CutPiece& part : parts.pieces) {
    part.seeds = block.seeds;
    to.pieces.push_back(std::move(part));
  }
}

/// The law's share of mass in pieces smaller than this one, by the one in the middle of the mass.
float share_below(float voxels, float middle_voxels) {
  return ln_2 * power(voxels / middle_voxels, law_n / 3.0F);
}

/// Turns the smallest pieces into dust: as much of the mass as the law has below the smallest that is left,
/// within bounds, and those above the number that is wanted.
void turn_fines_to_dust(Cut& cut, uint32_t wanted) {
  std::vector<size_t> by_mass(cut.pieces.size());
  std::iota(by_mass.begin(), by_mass.end(), size_t{0});
  const auto mass_of = [&](size_t i) { return cut.pieces[i].volume.mass; };
  std::ranges::stable_sort(by_mass, {}, mass_of);
  MassUnits all = cut.dust;
  for (const CutPiece& piece : cut.pieces) all += piece.volume.mass;
  size_t middle = 0;
  for (MassUnits sum = 0; middle + 1 < by_mass.size(); ++middle)
    if ((sum += mass_of(by_mass[middle])) * 2 >= all) break;
  const float middle_voxels = voxels_of(mass_of(by_mass[middle]));
  std::vector<bool> is_dust(cut.pieces.size());
  size_t left = by_mass.size();
  for (const size_t i : by_mass) {
    const float share = std::min(share_below(voxels_of(mass_of(i)), middle_voxels), fines_share_max);
    const bool is_fine = voxels_of(cut.dust + mass_of(i)) <= share * voxels_of(all);
    if (left == 1 || (left <= wanted && !is_fine)) break;
    is_dust[i] = true;
    cut.dust += mass_of(i);
    --left;
  }
  std::vector<CutPiece> kept;
  kept.reserve(left);
  for (size_t i = 0; i < cut.pieces.size(); ++i)
    if (!is_dust[i]) kept.push_back(std::move(cut.pieces[i]));
  cut.pieces = std::move(kept);
}

}  // namespace

uint32_t seeds_of_blocks(uint32_t seeds) {
  return std::min(seeds, std::clamp(seeds / pieces_per_block, blocks_min, blocks_max));
}

void cut_on(Cut& cut, const NaturalBreak& natural) {
  CHECK(natural.seeds > 0 && natural.seeds <= limits::seeds_max);
  if (cut.pieces.empty()) return;
  Plan plan(cut, natural);
  std::ranges::sort(plan.blocks, {}, &Block::piece);
  Cut made;
  made.dust = cut.dust;
  for (const Block& block : plan.blocks)
    cut_block(std::move(cut.pieces[block.piece]), block.pieces, natural,
              natural.random_seed + 1 + static_cast<uint32_t>(block.piece), made);
  if (natural.seeds >= fines_seeds_min) turn_fines_to_dust(made, natural.seeds);
  cut = std::move(made);
}

}  // namespace scree
