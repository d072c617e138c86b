#include "shared/falling/leverage.h"

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <map>
#include <numeric>

#include "shared/base/check.h"
#include "shared/falling/link_section.h"
#include "shared/falling/lumps.h"
#include "shared/material/material.h"

namespace scree {

namespace {

/// A section that is measured only roughly passes when its tension is less than one of so many parts of what
/// it bears.
constexpr double rough_margin = 4.0;

/// Halvings by which the part of a force is found at which a section breaks: to a millionth of the force.
constexpr int bisections = 20;

struct Candidate {
  double excess = 0.0;  ///< tension over what the section bears
  int at = 0;
};

/// One direction: what lies beyond planes across the axis, on their upper or lower side.
class Sweep {
 public:
  struct Break {
    double excess = 0.0;
    Overload overload;
    VoxelBox bounds;  ///< of the mass
  };

  /// `force`: null where weight alone bends.
  Sweep(const SupportParts& parts, Field& field, const Palette& palette, const std::set<BrickCoord>& changed,
        const PointForce* force, int axis, bool up)
      : parts_(parts),
        field_(field),
        palette_(palette),
        changed_(changed),
        force_(force),
        axis_(axis),
        up_(up),
        voxel_m_(static_cast<double>(field.source().voxel_size_m)) {}

  /// `lumps`: of each part.
  void run(std::vector<Lump> lumps, std::vector<Break>& found) {
    lumps_ = std::move(lumps);
    found_ = &found;
    lump_of_.resize(lumps_.size());
    std::iota(lump_of_.begin(), lump_of_.end(), 0U);
    const std::vector<SupportLink>& links = parts_.links();
    std::vector<uint32_t> plane;
    for (const uint32_t number : order()) {
      const SupportLink& link = links[number];
      if (!plane.empty() && (link.axis != axis_ || layer(link) != layer(links[plane.front()]))) pass(plane);
      if (link.axis == axis_)
        plane.push_back(number);
      else
        unite(link.lower, link.upper);
    }
    pass(plane);
  }

 private:
  int layer(const SupportLink& link) const { return along(parts_.parts()[link.lower].brick, axis_); }

  /// Links in the order of the sweep, from beyond to before: those within a layer, then those of the plane
  /// before it.
  std::vector<uint32_t> order() const {
    const std::vector<SupportLink>& links = parts_.links();
    if (links.empty()) return {};
    int lo = INT32_MAX, hi = INT32_MIN;
    for (const SupportLink& link : links) {
      lo = std::min(lo, layer(link));
      hi = std::max(hi, layer(link));
    }
    // Layers have even steps, planes odd ones; a plane's number is that of its lower layer.
    const auto step = [&](const SupportLink& link) {
      const int height = 2 * (layer(link) - lo) + (link.axis == axis_ ? 1 : 0);
      return static_cast<size_t>(up_ ? 2 * (hi - lo) + 1 - height : height);
    };
    std::vector<uint32_t> starts(static_cast<size_t>(2 * (hi - lo)) + 3, 0);
    for (const SupportLink& link : links) ++starts[step(link) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<uint32_t> order(links.size());
    for (uint32_t i = 0; i < links.size(); ++i) order[starts[step(links[i])]++] = i;
    return order;
  }

  /// Looks at a plane's sections, then joins both of its sides.
  void pass(std::vector<uint32_t>& plane) {
    weigh_plane(plane);
    for (const uint32_t number : plane) unite(parts_.links()[number].lower, parts_.links()[number].upper);
    plane.clear();
  }

  uint32_t root(uint32_t part) {
    while (lump_of_[part] != part) part = lump_of_[part] = lump_of_[lump_of_[part]];
    return part;
  }
  void unite(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (a > b) std::swap(a, b);
    lump_of_[b] = a;
    lumps_[a].add(lumps_[b]);
  }

  uint32_t beyond(const SupportLink& link) const { return up_ ? link.upper : link.lower; }
  uint32_t before(const SupportLink& link) const { return up_ ? link.lower : link.upper; }

  void weigh_plane(const std::vector<uint32_t>& plane) {
    std::map<uint32_t, std::vector<SupportLink>> sections;
    for (const uint32_t number : plane) {
      const SupportLink& link = parts_.links()[number];
      const uint32_t lump = root(beyond(link));
      if (!lumps_[lump].held && lumps_[lump].voxels >= overload_voxels_min) sections[lump].push_back(link);
    }
    for (const auto& [number, links] : sections) {
      const Lump& lump = lumps_[number];
      if (!concerns(lump, links) || holds_easily(lump, links)) continue;
      const Candidate worst = worst_section(lump, links);
      if (worst.excess > 1.0) found_->push_back(broken(lump, links, worst));
    }
  }

  /// Whether the change touched it, or the force falls on it and on nothing else.
  bool concerns(const Lump& lump, const std::vector<SupportLink>& links) const {
    if (force_ != nullptr) return lump.struck == force_->parts.size();
    return lump.changed || std::ranges::any_of(links, [&](const SupportLink& link) {
             return changed_.contains(parts_.parts()[before(link)].brick);
           });
  }

  /// What the weakest material of all these parts bears.
  double bearing_pa(const std::vector<SupportLink>& links) const {
    double least = 1e30;
    for (const SupportLink& link : links)
      for (const uint32_t part : {link.lower, link.upper})
        least = std::min(least, static_cast<double>(parts_.parts()[part].bending_pa));
    return least;
  }

  /// What the weakest material at a section bears.
  double bearing_pa(const std::vector<SupportLink>& links, int at) const {
    double least = 1e30;
    const auto weaken = [&](Material material) {
      least = std::min(least, static_cast<double>(palette_.row_or_first(material).bearing.bending_pa));
    };
    for (const SupportLink& link : links) {
      if (parts_.is_mixed(link)) {
        parts_.for_each_pair(link, at, [&](Material low, Material high) {
          weaken(low);
          weaken(high);
        });
      } else {
        weaken(parts_.parts()[link.lower].material);
        weaken(parts_.parts()[link.upper].material);
      }
    }
    return least;
  }

  /// Tension at the edge over what it bears, of a section at that place along the axis (its plane lies
  /// between two layers of voxels) under that mass.
  double excess(const Section& section, double plane, const Mass& mass, double bearing_pa) const {
    const auto [u, v] = plane_axes[static_cast<size_t>(axis_)];
    const glm::dvec3 centre = mass.centre();
    const double pa = mass.kg * static_cast<double>(standard_gravity) / (voxel_m_ * voxel_m_);
    if (axis_ != 1) {
      const double lever = up_ ? centre[axis_] - plane : plane - centre[axis_];
      return pa * section.tension({std::max(lever, 0.0), 0.0}) / bearing_pa;
    }
    const glm::dvec2 offset = glm::dvec2(centre[u], centre[v]) - section.centroid();
    const double weight = 1.0 / section.area();
    return pa * (up_ ? section.tension(-offset) - weight : section.tension(offset) + weight) / bearing_pa;
  }

  /// What bends and pulls a section: newtons, at levers of voxels.
  struct Bending {
    glm::dvec2 moment{0.0};
    double pull = 0.0;
  };
  Bending by_weight(const Section& section, double plane, const Mass& mass) const {
    const auto [u, v] = plane_axes[static_cast<size_t>(axis_)];
    const double newtons = mass.kg * static_cast<double>(standard_gravity);
    const glm::dvec3 centre = mass.centre();
    if (axis_ != 1) return {{std::max(out(centre, plane), 0.0) * newtons, 0.0}, 0.0};
    const double pull = up_ ? -newtons : newtons;
    return {pull * (glm::dvec2(centre[u], centre[v]) - section.centroid()), pull};
  }
  /// By the force, where it falls beyond the section.
  Bending by_force(const Section& section, double plane) const {
    const auto [u, v] = plane_axes[static_cast<size_t>(axis_)];
    const double lever = out(force_->at, plane);
    if (lever <= 0.0) return {};
    const double pull = up_ ? force_->newtons[axis_] : -force_->newtons[axis_];
    const glm::dvec2 offset = glm::dvec2(force_->at[u], force_->at[v]) - section.centroid();
    return {pull * offset - lever * glm::dvec2(force_->newtons[u], force_->newtons[v]), pull};
  }
  /// How far beyond a plane a place is.
  double out(glm::dvec3 place, double plane) const {
    return up_ ? place[axis_] - plane : plane - place[axis_];
  }

  /// One over the part of the force at which the section breaks, or less than 1. What weight alone would
  /// break has stood so far: then weight does not count. The tension grows with the part, ever faster, so
  /// that it passes what the section bears once.
  double excess_of_force(const Section& section, double plane, const Mass& mass, double bearing_pa) const {
    Bending weight = by_weight(section, plane, mass);
    const Bending force = by_force(section, plane);
    const auto strain = [&](double part) {
      const double newtons = section.tension(weight.moment + part * force.moment) +
                             (weight.pull + part * force.pull) / section.area();
      return newtons / (voxel_m_ * voxel_m_) / bearing_pa;
    };
    if (strain(0.0) >= 1.0) weight = {};
    const double whole = strain(1.0);
    if (whole <= 1.0) return whole;
    double holds = 0.0, breaks = 1.0;
    for (int i = 0; i < bisections; ++i) {
      const double between = 0.5 * (holds + breaks);
      (strain(between) > 1.0 ? breaks : holds) = between;
    }
    return 1.0 / breaks;
  }

  /// By the links' thinnest sections, taken for blocks as wide as a brick: whether it is far from breaking.
  bool holds_easily(const Lump& lump, const std::vector<SupportLink>& links) const {
    const auto [u, v] = plane_axes[static_cast<size_t>(axis_)];
    Section section;
    for (const SupportLink& link : links) {
      const glm::dvec3 middle = centre(parts_.parts()[before(link)]);
      const int high = std::max(1, link.section / brick_size);
      for (int k = 0; k < high; ++k)
        section.add({middle[u] + k - 0.5 * (high - 1), middle[v]}, static_cast<double>(link.section) / high);
    }
    section.finish();
    const int layer = along(parts_.parts()[links.front().lower].brick, axis_) + 1;
    const double plane = layer * brick_size - 0.5 + (up_ ? -brick_size : brick_size);
    const double bears = bearing_pa(links);
    const double strain = force_ != nullptr ? excess_of_force(section, plane, lump.mass, bears)
                                            : excess(section, plane, lump.mass, bears);
    return strain * rough_margin < 1.0;
  }

  Candidate worst_section(const Lump& lump, const std::vector<SupportLink>& links) {
    const auto [first, last] = parts_.common_places(links);
    const int face = (along(parts_.parts()[links.front().lower].brick, axis_) + 1) * brick_size;
    Candidate worst;
    for (int at = first; at <= last; ++at) {
      const Section section = section_of(parts_, field_, links, at);
      if (section.area() <= 0.0) continue;
      const Mass mass = beyond_place(lump, links, at);
      if (mass.kg <= 0.0) continue;
      const double plane = face + at - 0.5, bears = bearing_pa(links, at);
      const double there = force_ != nullptr ? excess_of_force(section, plane, mass, bears)
                                             : excess(section, plane, mass, bears);
      if (there > worst.excess) worst = {there, at};
    }
    return worst;
  }

  /// The mass beyond a section that lies `at` layers beyond the bricks' common face.
  Mass beyond_place(const Lump& lump, const std::vector<SupportLink>& links, int at) const {
    Mass mass = lump.mass;
    std::set<uint32_t> cut;  // parts that the section divides
    for (const SupportLink& link : links) {
      if (at < 0) cut.insert(link.lower);
      if (at > 0) cut.insert(link.upper);
    }
    const double sign = up_ == (at < 0) ? 1.0 : -1.0;
    for (const uint32_t number : cut) {
      const SupportPart& part = parts_.parts()[number];
      glm::dvec3 place = centre(part);
      const int from = at < 0 ? brick_size + at : 0, to = at < 0 ? brick_size : at;
      for (int k = from; k < to; ++k) {
        place[axis_] = along(part.brick, axis_) * brick_size + k;
        mass.add(sign * kg(part, part.layers[static_cast<size_t>(axis_)][static_cast<size_t>(k)],
                           voxel_m_ * voxel_m_ * voxel_m_),
                 place);
      }
    }
    return mass;
  }

  Break broken(const Lump& lump, const std::vector<SupportLink>& links, const Candidate& worst) const {
    Break result{worst.excess, {}, lump.bounds};
    const SupportPart& part = parts_.parts()[beyond(links.front())];
    result.overload.voxels = lump.voxels;
    result.overload.by_leverage = true;
    result.overload.start = first_voxel(part.brick) + bounds_of(first_of(part.bits)).lo;
    Neck neck;
    for (const SupportLink& link : links) neck.section_voxels += parts_.section(link, worst.at);
    neck.box = parts_.section_box(links, worst.at).grown(1);
    result.overload.necks.push_back(neck);
    return result;
  }

  const SupportParts& parts_;
  Field& field_;
  const Palette& palette_;
  const std::set<BrickCoord>& changed_;
  const PointForce* force_;
  int axis_;
  bool up_;
  double voxel_m_;
  std::vector<Break>* found_ = nullptr;
  std::vector<uint32_t> lump_of_;  ///< by part
  std::vector<Lump> lumps_;
};

}  // namespace

namespace {

/// The sections that break, the worst first.
std::vector<Sweep::Break> all_breaks(const SupportParts& parts, Field& field, const Palette& palette,
                                     const std::set<BrickCoord>& changed, const PointForce* force) {
  const auto dx = static_cast<double>(field.source().voxel_size_m);
  std::vector<Lump> lumps;
  lumps.reserve(parts.parts().size());
  for (const SupportPart& part : parts.parts()) {
    lumps.push_back(lump_of(part, dx * dx * dx));
    lumps.back().changed = changed.contains(part.brick);
  }
  if (force != nullptr)
    for (const uint32_t part : force->parts) lumps[part].struck = 1;
  std::vector<Sweep::Break> found;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool up : {true, false})
      Sweep(parts, field, palette, changed, force, axis, up).run(lumps, found);
  std::ranges::stable_sort(found, std::ranges::greater{}, &Sweep::Break::excess);
  return found;
}

}  // namespace

std::vector<Overload> find_levers(const SupportParts& parts, Field& field, const Palette& palette,
                                  const std::set<BrickCoord>& changed) {
  std::vector<Overload> overloads;
  std::vector<VoxelBox> taken;
  for (Sweep::Break& one : all_breaks(parts, field, palette, changed, nullptr)) {
    const bool apart =
        std::ranges::all_of(taken, [&](const VoxelBox& box) { return common(box, one.bounds).empty(); });
    if (!apart) continue;
    taken.push_back(one.bounds);
    overloads.push_back(std::move(one.overload));
  }
  return overloads;
}

std::optional<ForcedLever> find_lever(const SupportParts& parts, Field& field, const Palette& palette,
                                      const PointForce& force) {
  std::vector<Sweep::Break> found = all_breaks(parts, field, palette, {}, &force);
  if (found.empty()) return std::nullopt;
  return ForcedLever{std::move(found.front().overload), 1.0 / found.front().excess};
}

}  // namespace scree
