// The network of a search for support (support_search.h), or for what a blow breaks (blow_search.h): what
// each link between parts carries, as a flow of loads, and the necks around a set of parts. Lengths in
// voxels.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "shared/falling/load_flow.h"
#include "shared/falling/overload.h"
#include "shared/falling/support_parts.h"

namespace scree {

/// Where a load goes: along an axis (0: x, 1: y, 2: z), up it or down. Weight goes down the second one.
struct LoadDirection {
  int axis = 1;
  bool up = false;
};

/// How long a load lasts. Under a blow, which presses rock into rock, what is pressed bears as much as its
/// resistance against dents, where that is more than what it bears for long.
enum class LoadKind : uint8_t { weight, blow };

class SupportNetwork {
 public:
  /// `parts` and `palette` must outlive this.
  SupportNetwork(const SupportParts& parts, const Palette& palette, float voxel_m, LoadKind kind);

  /// Adds a node for each part, in their order, and the links, by what carries a load of that direction.
  /// `weighs`: each part is loaded by its weight.
  void add_to(LoadFlow& flow, LoadDirection direction, bool weighs) const;

  /// The connected masses of those parts, by their first part, and the necks of each.
  std::map<uint32_t, Overload> masses(const std::vector<bool>& overloaded) const;
  /// The first part of the mass of each part; of a part that is not overloaded, itself.
  std::vector<uint32_t> mass_of_parts(const std::vector<bool>& overloaded) const;

 private:
  /// What one face of a voxel carries, in grams, so that they add up exactly.
  struct Strength {
    int64_t pressed = 0, hanging = 0, sideways = 0;
  };

  static Strength strength_of(const MaterialRow& traits, float voxel_m, LoadKind kind);
  const Strength& strength(Material material) const {
    return strengths_[palette_.has(material) ? row_number(material) : 0];
  }
  static Strength weaker(const Strength& a, const Strength& b);
  /// What a link carries: its thinnest section; where materials mix, the weakest of its sections, pair by
  /// pair of voxels.
  Strength carried(const SupportLink& link) const;
  Neck neck(const std::vector<SupportLink>& links) const;

  const SupportParts& parts_;
  const Palette& palette_;
  float voxel_m_;
  std::vector<Strength> strengths_;  ///< by row of the palette
};

/// Steps of a flow for each part. Above, nothing is known.
inline constexpr size_t flow_steps_per_part = 400;

}  // namespace scree
