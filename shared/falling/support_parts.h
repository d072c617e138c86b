// The parts that support_search.h looks at: what connects inside each brick, its sections and weight, and
// which of them touch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/falling/ground.h"
#include "shared/field/brick_bits.h"
#include "shared/field/field.h"

namespace scree {

struct SupportPart {
  static constexpr uint32_t none = UINT32_MAX;

  BrickCoord brick;
  BrickBits bits;
  /// Voxels that touch their next neighbours, between layers k and k + 1 along each axis.
  std::array<std::array<uint8_t, brick_size - 1>, 3> sections{};
  std::array<int, 3> middle{};  ///< layer along each axis up to which half of the voxels lie
  int voxels = 0;
  Material material = Material::rock;
  bool held = false;     ///< touches ground, or leaves the surroundings
  uint32_t next = none;  ///< of the same brick
};

/// Two parts that touch, `upper` beyond the + face of `lower` along the axis (0: x, 1: y, 2: z).
struct SupportLink {
  uint32_t lower = 0;
  uint32_t upper = 0;
  int axis = 0;
  int at = 0;       ///< of the thinnest section: layers beyond the face, negative in the lower brick
  int section = 0;  ///< voxels
};

class SupportParts {
 public:
  /// Every part that connects to the bricks, or to their neighbours, within `reach_bricks` of them.
  SupportParts(Field& field, std::span<const BrickCoord> changed, int reach_bricks, size_t parts_max);

  const std::vector<SupportPart>& parts() const { return parts_; }
  const std::vector<SupportLink>& links() const { return links_; }
  /// There were more than `parts_max`.
  bool overflow() const { return overflow_; }

  /// Section of a link, `at` layers beyond the face: between layer at − 1 and at; within −7 … 7.
  int section(const SupportLink& link, int at) const;
  /// First and last place between the middles of the two.
  int first_place(const SupportLink& link) const;
  int last_place(const SupportLink& link) const;
  /// Voxels on both sides of that section, in the field's coordinates.
  VoxelBox section_box(const SupportLink& link, int at) const;

 private:
  bool inside(BrickCoord brick) const;
  uint32_t& first_of_brick(BrickCoord brick);
  /// Its parts are made at the first look. Index of the first.
  uint32_t load(BrickCoord brick);
  bool is_held(const SupportPart& part) const;
  void add(BrickCoord brick, const BrickBits& bits, uint32_t& first);
  void connect(uint32_t part, size_t face);
  SupportLink link_of(uint32_t lower, uint32_t upper, int axis) const;

  Field& field_;
  Ground ground_;
  size_t parts_max_;
  BrickCoord lo_, size_;  ///< surroundings
  std::vector<uint32_t> firsts_;
  std::vector<SupportPart> parts_;
  std::vector<SupportLink> links_;
  bool overflow_ = false;
};

}  // namespace scree
