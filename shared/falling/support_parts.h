// The parts of a support search (support_search.h): the components inside each brick, their sections and
// sizes, and the links between parts that touch. Not thread-safe.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "shared/falling/ground.h"
#include "shared/falling/holding.h"
#include "shared/field/brick_bits.h"
#include "shared/field/material_window.h"
#include "shared/material/palette.h"

namespace scree {

struct SupportPart {
  static constexpr uint32_t none = UINT32_MAX;
  static constexpr int whole_voxels = brick_size * brick_size * brick_size;

  BrickCoord brick;
  BrickBits bits;
  /// Voxels that touch their next neighbours, between layers k and k + 1 along each axis.
  std::array<std::array<uint8_t, brick_size - 1>, 3> sections{};
  std::array<std::array<uint8_t, brick_size>, 3> layers{};  ///< voxels in each layer along each axis
  std::array<int, 3> middle{};  ///< layer along each axis up to which half of the voxels lie
  int voxels = 0;
  float fill = 1.0F;    ///< volume of its voxels by the codes, surface voxels included, over their number
  Material material{};  ///< where `each` is null
  std::shared_ptr<const BrickRock> each{};  ///< the brick's, where this part is of several materials
  float density_kg_m3 = 0.0F;               ///< mean over its voxels
  float bending_pa = 0.0F;                  ///< what the weakest of its materials bears
  bool held = false;     ///< touches ground or is held as it, or continues outside the surroundings
  uint32_t next = none;  ///< next part of the same brick

  bool is_whole() const { return voxels == whole_voxels; }
  /// `at`: relative to the brick's first voxel.
  Material material_at(VoxelCoord at) const {
    return each == nullptr ? material : (*each)[static_cast<size_t>(Brick::index(at.x, at.y, at.z))];
  }
};

/// Two parts that touch, `upper` beyond the + face of `lower` along the axis (0: x, 1: y, 2: z).
struct SupportLink {
  uint32_t lower = 0;
  uint32_t upper = 0;
  int axis = 0;
  int at = 0;       ///< place of the thinnest section: layers beyond the face, negative in the lower brick
  int section = 0;  ///< voxels
};

struct SectionVoxels {
  VoxelCoord origin;
  BrickBits bits;  ///< relative to the origin
};

class SupportParts {
 public:
  /// Every part that connects to the changed bricks, or to their neighbours, through the surroundings: the
  /// bricks' bounds grown by `reach_bricks`. `field` and `palette` must outlive this. `holding`: what it
  /// holds is held; null: nothing.
  SupportParts(Field& field, const Palette& palette, std::span<const BrickCoord> changed, int reach_bricks,
               size_t parts_max, const Holding* holding = nullptr);

  const std::vector<SupportPart>& parts() const { return parts_; }
  const std::vector<SupportLink>& links() const { return links_; }
  /// Whether there are more than `parts_max` parts; then some are missing.
  bool overflow() const { return overflow_; }

  /// Section of a link, `at` layers beyond the face: between layer at − 1 and at; within −7 … 7.
  int section(const SupportLink& link, int at) const;
  /// First and last place of a section between the middles of the two parts.
  int first_place(const SupportLink& link) const;
  int last_place(const SupportLink& link) const;
  /// First and last place that all of these links have; the face is among them.
  std::pair<int, int> common_places(std::span<const SupportLink> links) const;
  /// The voxels of a section on its lower side, each with a next neighbour on the upper side.
  SectionVoxels section_voxels(const SupportLink& link, int at) const;
  /// Calls f(material, material) for each pair of voxels that a section consists of: its lower side's, and
  /// its upper side's. Cheap only where is_mixed().
  template <typename F>
  void for_each_pair(const SupportLink& link, int at, F&& f) const;
  bool is_mixed(const SupportLink& link) const {
    return parts_[link.lower].each != nullptr || parts_[link.upper].each != nullptr;
  }
  /// Smallest box of the voxels on both sides of the links' sections there, in the field's coordinates.
  /// At least one of them has voxels there.
  VoxelBox section_box(std::span<const SupportLink> links, int at) const;

 private:
  bool inside(BrickCoord brick) const;
  uint32_t& first_of_brick(BrickCoord brick);
  /// Index of the brick's first part; the first call finds its parts.
  uint32_t load(BrickCoord brick);
  bool is_held(const SupportPart& part);
  /// Ground::holds(), which is asked once for each chunk.
  bool is_ground(BrickCoord brick);
  void add(BrickCoord brick, const BrickBits& bits, float fill, uint32_t& first);
  void read_materials(SupportPart& part) const;
  void connect(uint32_t part, size_t face);
  SupportLink link_of(uint32_t lower, uint32_t upper, int axis) const;

  Field& field_;
  const Palette& palette_;
  Ground ground_;
  size_t parts_max_;
  const Holding* holding_;
  BrickCoord lo_, size_;  ///< surroundings
  enum class Holds : uint8_t { unknown, no, yes };
  ChunkCoord lo_chunk_, size_chunks_;  ///< those of the surroundings and of the bricks beside them
  std::vector<Holds> holds_;           ///< by chunk
  std::vector<uint32_t> firsts_;
  std::vector<SupportPart> parts_;
  std::vector<SupportLink> links_;
  bool overflow_ = false;
};

template <typename F>
void SupportParts::for_each_pair(const SupportLink& link, int at, F&& f) const {
  const SupportPart& low = parts_[at > 0 ? link.upper : link.lower];
  const SupportPart& high = parts_[at < 0 ? link.lower : link.upper];
  const SectionVoxels section = section_voxels(link, at);
  VoxelCoord step{};
  (link.axis == 0 ? step.x : link.axis == 1 ? step.y : step.z) = 1;
  const VoxelCoord of_low = section.origin - first_voxel(low.brick);
  const VoxelCoord of_high = section.origin + step - first_voxel(high.brick);
  for (size_t x = 0; x < section.bits.words.size(); ++x)
    for (uint64_t left = section.bits.words[x]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const VoxelCoord voxel{static_cast<int>(x), bit / brick_size, bit % brick_size};
      f(low.material_at(of_low + voxel), high.material_at(of_high + voxel));
    }
}

}  // namespace scree
