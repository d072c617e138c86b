#include "shared/falling/support_network.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Links of one neck lie within squares of so many bricks; wider ones break in several places.
constexpr int neck_side_bricks = 4;

constexpr float grams_per_kg = 1000.0F;

/// Links from a mass to parts that hold it, in one plane and near each other.
using NeckKey = std::tuple<uint32_t, int, int, int, int>;

NeckKey key_of(uint32_t mass, const SupportLink& link, BrickCoord b) {
  const int plane = link.axis == 0 ? b.x : link.axis == 1 ? b.y : b.z;
  const int u = link.axis == 0 ? b.y : b.x, v = link.axis == 2 ? b.y : b.z;
  const auto square = [](int at) { return at >= 0 ? at / neck_side_bricks : ~(~at / neck_side_bricks); };
  return {mass, link.axis, plane, square(u), square(v)};
}

}  // namespace

SupportNetwork::SupportNetwork(const SupportParts& parts, const Palette& palette, float voxel_m,
                               LoadKind kind)
    : parts_(parts), palette_(palette), voxel_m_(voxel_m) {
  for (const MaterialRow& row : palette.rows) strengths_.push_back(strength_of(row, voxel_m, kind));
}

SupportNetwork::Strength SupportNetwork::strength_of(const MaterialRow& traits, float voxel_m,
                                                     LoadKind kind) {
  const float area_m2 = voxel_m * voxel_m;
  const Bearing& bearing = traits.bearing;
  const auto carried = [&](float pa) {
    return static_cast<int64_t>(pa * area_m2 / standard_gravity * grams_per_kg);
  };
  const float pressed_pa =
      kind == LoadKind::blow ? std::max(bearing.pressed_pa, traits.dent_resistance_j_m3) : bearing.pressed_pa;
  return {carried(pressed_pa), carried(bearing.hanging_pa), carried(bearing.sideways_pa)};
}

SupportNetwork::Strength SupportNetwork::weaker(const Strength& a, const Strength& b) {
  return {std::min(a.pressed, b.pressed), std::min(a.hanging, b.hanging), std::min(a.sideways, b.sideways)};
}

SupportNetwork::Strength SupportNetwork::carried(const SupportLink& link) const {
  if (!parts_.is_mixed(link)) {
    const int64_t section = link.section;
    const Strength each =
        weaker(strength(parts_.parts()[link.lower].material), strength(parts_.parts()[link.upper].material));
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

void SupportNetwork::add_to(LoadFlow& flow, LoadDirection direction, bool weighs) const {
  for (const SupportPart& part : parts_.parts()) {
    const auto voxel =
        static_cast<int64_t>(part.density_kg_m3 * (voxel_m_ * voxel_m_) * voxel_m_ * grams_per_kg);
    const uint32_t node = flow.add_node(weighs ? voxel * part.voxels : 0);
    if (part.held) flow.ground(node);
  }
  for (const SupportLink& link : parts_.links()) {
    const Strength most = carried(link);
    if (link.axis != direction.axis)
      flow.link(link.lower, link.upper, most.sideways, most.sideways);
    else if (direction.up)
      flow.link(link.lower, link.upper, most.pressed, most.hanging);
    else
      flow.link(link.lower, link.upper, most.hanging, most.pressed);
  }
}

std::vector<uint32_t> SupportNetwork::mass_of_parts(const std::vector<bool>& overloaded) const {
  std::vector<uint32_t> mass(parts_.parts().size());
  std::iota(mass.begin(), mass.end(), 0U);
  const auto root = [&](uint32_t part) {
    while (mass[part] != part) part = mass[part] = mass[mass[part]];
    return part;
  };
  for (const SupportLink& link : parts_.links()) {
    if (!overloaded[link.lower] || !overloaded[link.upper]) continue;
    const uint32_t a = root(link.lower), b = root(link.upper);
    mass[std::max(a, b)] = std::min(a, b);
  }
  for (uint32_t i = 0; i < mass.size(); ++i) mass[i] = root(i);
  return mass;
}

std::map<uint32_t, Overload> SupportNetwork::masses(const std::vector<bool>& overloaded) const {
  const std::vector<uint32_t> mass = mass_of_parts(overloaded);
  std::map<uint32_t, Overload> masses;
  for (uint32_t i = 0; i < mass.size(); ++i) {
    if (!overloaded[i]) continue;
    const SupportPart& part = parts_.parts()[i];
    Overload& overload = masses[mass[i]];
    if (overload.voxels == 0) overload.start = first_voxel(part.brick) + bounds_of(first_of(part.bits)).lo;
    overload.voxels += part.voxels;
  }
  std::map<NeckKey, std::vector<SupportLink>> necks;
  for (const SupportLink& link : parts_.links()) {
    if (overloaded[link.lower] == overloaded[link.upper]) continue;
    const uint32_t beyond = overloaded[link.lower] ? link.lower : link.upper;
    necks[key_of(mass[beyond], link, parts_.parts()[link.lower].brick)].push_back(link);
  }
  for (const auto& [at, links] : necks) masses.at(std::get<0>(at)).necks.push_back(neck(links));
  return masses;
}

/// One section through all of the links, where it is least in sum.
Neck SupportNetwork::neck(const std::vector<SupportLink>& links) const {
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

}  // namespace scree
