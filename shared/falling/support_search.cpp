#include "shared/falling/support_search.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/falling/leverage.h"
#include "shared/falling/load_flow.h"
#include "shared/falling/support_parts.h"

namespace scree {

namespace {

/// Links of one neck lie within squares of so many bricks; wider ones break in several places.
constexpr int neck_side_bricks = 4;
/// Steps of the flow for each part.
constexpr size_t steps_per_part = 400;

/// What one face of a voxel carries, in grams, so that they add up exactly.
struct Strength {
  int64_t pressed = 0, hanging = 0, sideways = 0;
};

Strength strength_of(const MaterialRow& traits, float voxel_size_m) {
  constexpr float grams = 1000.0F;
  const float area_m2 = voxel_size_m * voxel_size_m;
  const Bearing& bearing = traits.bearing;
  const auto carried = [&](float pa) {
    return static_cast<int64_t>(pa * area_m2 / standard_gravity * grams);
  };
  return {carried(bearing.pressed_pa), carried(bearing.hanging_pa), carried(bearing.sideways_pa)};
}

class Search {
 public:
  Search(Field& field, const Palette& palette, std::span<const BrickCoord> changed, int reach_bricks)
      : field_(field),
        palette_(palette),
        parts_(field, palette, changed, reach_bricks, support_parts_max),
        changed_(changed.begin(), changed.end()) {
    for (const MaterialRow& row : palette.rows)
      strengths_.push_back(strength_of(row, field.source().voxel_size_m));
  }

  SupportFound run() {
    SupportFound found;
    found.parts = parts_.parts().size();
    found.given_up = parts_.overflow() || !flow();
    if (found.given_up) return found;
    label();
    for (auto& [mass, overload] : gather())
      if (overload.voxels >= overload_voxels_min && !overload.necks.empty())
        found.overloads.push_back(std::move(overload));
    if (found.overloads.empty()) found.overloads = find_levers(parts_, field_, palette_, changed_);
    return found;
  }

 private:
  const Strength& strength(Material material) const {
    return strengths_[palette_.has(material) ? row_number(material) : 0];
  }
  static Strength weaker(const Strength& a, const Strength& b) {
    return {std::min(a.pressed, b.pressed), std::min(a.hanging, b.hanging), std::min(a.sideways, b.sideways)};
  }

  /// What a link carries: its thinnest section; where materials mix, the weakest of its sections, pair by
  /// pair of voxels.
  Strength carried(const SupportLink& link) const {
    if (!parts_.is_mixed(link)) {
      const int64_t section = link.section;
      const Strength each = weaker(strength(parts_.parts()[link.lower].material),
                                   strength(parts_.parts()[link.upper].material));
      return {section * each.pressed, section * each.hanging, section * each.sideways};
    }
    Strength least{INT64_MAX, INT64_MAX, INT64_MAX};
    for (int at = parts_.first_place(link); at <= parts_.last_place(link); ++at) {
      Strength sum;
      parts_.for_each_pair(link, at, [&](Material low, Material high) {
        const Strength pair = weaker(strength(low), strength(high));
        sum = {sum.pressed + pair.pressed, sum.hanging + pair.hanging, sum.sideways + pair.sideways};
      });
      least = weaker(least, sum);
    }
    return least;
  }

  bool flow() {
    constexpr float grams = 1000.0F;
    const float dx = field_.source().voxel_size_m;
    for (const SupportPart& part : parts_.parts()) {
      const auto voxel = static_cast<int64_t>(part.density_kg_m3 * (dx * dx) * dx * grams);
      const uint32_t node = flow_.add_node(voxel * part.voxels);
      if (part.held) flow_.ground(node);
    }
    for (const SupportLink& link : parts_.links()) {
      const Strength most = carried(link);
      if (link.axis == 1)
        flow_.link(link.lower, link.upper, most.hanging, most.pressed);
      else
        flow_.link(link.lower, link.upper, most.sideways, most.sideways);
    }
    return flow_.run(steps_per_part * std::max<size_t>(parts_.parts().size(), 1));
  }

  /// Gives every overloaded part its mass: the first part that it connects to through overloaded parts.
  void label() {
    mass_.resize(parts_.parts().size());
    for (uint32_t i = 0; i < mass_.size(); ++i) mass_[i] = i;
    for (const SupportLink& link : parts_.links()) {
      if (!flow_.overloaded(link.lower) || !flow_.overloaded(link.upper)) continue;
      const uint32_t a = root(link.lower), b = root(link.upper);
      mass_[std::max(a, b)] = std::min(a, b);
    }
  }
  uint32_t root(uint32_t part) {
    while (mass_[part] != part) part = mass_[part] = mass_[mass_[part]];
    return part;
  }

  /// Links from a mass to parts that hold it, in one plane and near each other.
  using NeckKey = std::tuple<uint32_t, int, int, int, int>;

  std::map<uint32_t, Overload> gather() {
    std::map<uint32_t, Overload> masses;
    std::set<uint32_t> touched;
    for (uint32_t i = 0; i < mass_.size(); ++i) {
      if (!flow_.overloaded(i)) continue;
      const SupportPart& part = parts_.parts()[i];
      Overload& overload = masses[root(i)];
      if (overload.voxels == 0) overload.start = first_voxel(part.brick) + bounds_of(first_of(part.bits)).lo;
      overload.voxels += part.voxels;
      if (changed_.contains(part.brick)) touched.insert(root(i));
    }
    std::map<NeckKey, std::vector<SupportLink>> necks;
    for (const SupportLink& link : parts_.links()) {
      if (flow_.overloaded(link.lower) == flow_.overloaded(link.upper)) continue;
      const uint32_t beyond = flow_.overloaded(link.lower) ? link.lower : link.upper;
      const uint32_t before = beyond == link.lower ? link.upper : link.lower;
      necks[key(root(beyond), link)].push_back(link);
      if (changed_.contains(parts_.parts()[before].brick)) touched.insert(root(beyond));
    }
    for (const auto& [at, links] : necks) masses.at(std::get<0>(at)).necks.push_back(neck(links));
    std::erase_if(masses, [&](const auto& entry) { return !touched.contains(entry.first); });
    return masses;
  }

  NeckKey key(uint32_t mass, const SupportLink& link) const {
    const BrickCoord b = parts_.parts()[link.lower].brick;
    const int plane = link.axis == 0 ? b.x : link.axis == 1 ? b.y : b.z;
    const int u = link.axis == 0 ? b.y : b.x, v = link.axis == 2 ? b.y : b.z;
    const auto square = [](int at) { return at >= 0 ? at / neck_side_bricks : ~(~at / neck_side_bricks); };
    return {mass, link.axis, plane, square(u), square(v)};
  }

  /// One section through all of the links, where it is least in sum.
  Neck neck(const std::vector<SupportLink>& links) const {
    const auto [first, last] = parts_.common_places(links);
    Neck neck{{}, INT64_MAX};
    int place = 0;
    for (int at = first; at <= last; ++at) {
      int64_t sum = 0;
      for (const SupportLink& link : links) sum += parts_.section(link, at);
      if (sum > neck.section_voxels || (sum == neck.section_voxels && std::abs(at) >= std::abs(place)))
        continue;
      neck.section_voxels = sum;
      place = at;
    }
    CHECK(neck.section_voxels > 0);
    neck.box = parts_.section_box(links, place);
    neck.box = neck.box.grown(1);  // two layers on each side, and slanting ones
    return neck;
  }

  Field& field_;
  const Palette& palette_;
  SupportParts parts_;
  std::set<BrickCoord> changed_;
  std::vector<Strength> strengths_;  ///< by row of the palette
  LoadFlow flow_;
  std::vector<uint32_t> mass_;  ///< by part
};

}  // namespace

SupportFound find_overloads(Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                            int reach_bricks) {
  return Search(field, palette, changed, reach_bricks).run();
}

}  // namespace scree
