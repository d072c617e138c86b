#include "shared/falling/leverage.h"

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <numeric>

#include "shared/base/check.h"
#include "shared/falling/section.h"
#include "shared/field/mass.h"
#include "shared/material/material.h"

namespace scree {

namespace {

/// A section that is measured only roughly passes when its tension is less than one of so many parts of what
/// it bears.
constexpr double rough_margin = 4.0;

/// The axes in a section across each axis: the first is the one along which a load bends it.
constexpr std::array<std::array<int, 2>, 3> plane_axes{{{1, 2}, {0, 2}, {1, 0}}};

glm::dvec3 middle_of_voxel(VoxelCoord v) {
  return glm::dvec3(v.x, v.y, v.z);
}

int along(BrickCoord brick, int axis) {
  return axis == 0 ? brick.x : axis == 1 ? brick.y : brick.z;
}

/// A weight and where it is.
struct Mass {
  double kg = 0.0;
  glm::dvec3 moment{0.0};  ///< kg voxels

  void add(double more_kg, glm::dvec3 at) {
    kg += more_kg;
    moment += at * more_kg;
  }
  glm::dvec3 centre() const { return moment / kg; }
};

/// Parts that connect without crossing the plane that is looked at.
struct Lump {
  Mass mass;
  int64_t voxels = 0;
  bool held = false;
  bool changed = false;
  VoxelBox bounds;  ///< of its bricks
};

glm::dvec3 centre(const SupportPart& part) {
  const glm::dvec3 first = middle_of_voxel(first_voxel(part.brick));
  if (part.is_whole()) return first + 0.5 * (brick_size - 1);
  glm::dvec3 sum(0.0);
  for (int axis = 0; axis < 3; ++axis)
    for (size_t k = 0; k < brick_size; ++k)
      sum[axis] += static_cast<double>(k) * part.layers[static_cast<size_t>(axis)][k];
  return first + sum / static_cast<double>(part.voxels);
}

/// Weight of so many of a part's voxels.
double kg(const SupportPart& part, int voxels, double voxel_m3) {
  const auto density = static_cast<double>(part.density_kg_m3);
  return density * voxel_m3 * static_cast<double>(part.fill) * voxels;
}

Lump lump_of(const SupportPart& part, double voxel_m3, bool changed) {
  Lump lump;
  lump.mass.add(kg(part, part.voxels, voxel_m3), centre(part));
  lump.voxels = part.voxels;
  lump.held = part.held;
  lump.changed = changed;
  const VoxelCoord first = first_voxel(part.brick);
  lump.bounds = {first, first + VoxelCoord{brick_size, brick_size, brick_size}};
  return lump;
}

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

  Sweep(const SupportParts& parts, Field& field, const Palette& palette, const std::set<BrickCoord>& changed,
        int axis, bool up)
      : parts_(parts),
        field_(field),
        palette_(palette),
        changed_(changed),
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
    Lump &to = lumps_[a], &from = lumps_[b];
    to.mass.kg += from.mass.kg;
    to.mass.moment += from.mass.moment;
    to.voxels += from.voxels;
    to.held = to.held || from.held;
    to.changed = to.changed || from.changed;
    to.bounds = hull_of(to.bounds, from.bounds);
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
      const bool touched = lump.changed || std::ranges::any_of(links, [&](const SupportLink& link) {
                             return changed_.contains(parts_.parts()[before(link)].brick);
                           });
      if (!touched || holds_easily(lump, links)) continue;
      const Candidate worst = worst_section(lump, links);
      if (worst.excess > 1.0) found_->push_back(broken(lump, links, worst));
    }
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
    return excess(section, plane, lump.mass, bearing_pa(links)) * rough_margin < 1.0;
  }

  Candidate worst_section(const Lump& lump, const std::vector<SupportLink>& links) {
    const auto [first, last] = parts_.common_places(links);
    const int face = (along(parts_.parts()[links.front().lower].brick, axis_) + 1) * brick_size;
    Candidate worst;
    for (int at = first; at <= last; ++at) {
      const Section section = measure(links, at);
      if (section.area() <= 0.0) continue;
      const Mass mass = beyond_place(lump, links, at);
      if (mass.kg <= 0.0) continue;
      const double there = excess(section, face + at - 0.5, mass, bearing_pa(links, at));
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

  /// The section by the codes on both sides: its own voxels, and those of the surface around them.
  Section measure(const std::vector<SupportLink>& links, int at) const {
    Section section;
    if (std::ranges::all_of(links, [&](const SupportLink& link) { return parts_.section(link, at) == 0; }))
      return section;
    const auto [u, v] = plane_axes[static_cast<size_t>(axis_)];
    const VoxelBox box = parts_.section_box(links, at).grown(1);
    const Window codes = gather(field_, box);
    Window own(box, 0);
    for (const SupportLink& link : links) mark(parts_.section_voxels(link, at), own);
    VoxelCoord step{0, 0, 0};
    (axis_ == 0 ? step.x : axis_ == 1 ? step.y : step.z) = 1;
    // The layers on both sides lie in the middle of the box, which was grown by one.
    VoxelBox low = box;
    int VoxelCoord::*const normal = axis_ == 0   ? &VoxelCoord::x
                                    : axis_ == 1 ? &VoxelCoord::y
                                                 : &VoxelCoord::z;
    low.lo.*normal += 1;
    low.hi.*normal = low.lo.*normal + 1;
    for (int x = low.lo.x; x < low.hi.x; ++x)
      for (int y = low.lo.y; y < low.hi.y; ++y)
        for (int z = low.lo.z; z < low.hi.z; ++z) {
          if (own.at(x, y, z) == 0) continue;
          const int units =
              std::min(occupancy(codes.at(x, y, z)), occupancy(codes.at(x + step.x, y + step.y, z + step.z)));
          if (units == 0) continue;
          const glm::dvec3 p = middle_of_voxel({x, y, z});
          section.add({p[u], p[v]}, static_cast<double>(units) / units_per_voxel);
        }
    section.finish();
    return section;
  }

  /// Marks the voxels and their neighbours in the plane.
  void mark(const SectionVoxels& voxels, Window& own) const {
    const std::array<int, 3> reach{axis_ == 0 ? 0 : 1, axis_ == 1 ? 0 : 1, axis_ == 2 ? 0 : 1};
    for (size_t x = 0; x < voxels.bits.words.size(); ++x)
      for (int bit = 0; bit < 64; ++bit) {
        if (((voxels.bits.words[x] >> bit) & 1U) == 0) continue;
        const VoxelCoord at =
            voxels.origin + VoxelCoord{static_cast<int>(x), bit / brick_size, bit % brick_size};
        for (int i = -reach[0]; i <= reach[0]; ++i)
          for (int j = -reach[1]; j <= reach[1]; ++j)
            for (int k = -reach[2]; k <= reach[2]; ++k) own.at(at.x + i, at.y + j, at.z + k) = 1;
      }
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
  int axis_;
  bool up_;
  double voxel_m_;
  std::vector<Break>* found_ = nullptr;
  std::vector<uint32_t> lump_of_;  ///< by part
  std::vector<Lump> lumps_;
};

}  // namespace

std::vector<Overload> find_levers(const SupportParts& parts, Field& field, const Palette& palette,
                                  const std::set<BrickCoord>& changed) {
  const auto dx = static_cast<double>(field.source().voxel_size_m);
  std::vector<Lump> lumps;
  lumps.reserve(parts.parts().size());
  for (const SupportPart& part : parts.parts())
    lumps.push_back(lump_of(part, dx * dx * dx, changed.contains(part.brick)));
  std::vector<Sweep::Break> found;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool up : {true, false}) Sweep(parts, field, palette, changed, axis, up).run(lumps, found);
  std::ranges::stable_sort(found, std::ranges::greater{}, &Sweep::Break::excess);
  std::vector<Overload> overloads;
  std::vector<VoxelBox> taken;
  for (Sweep::Break& one : found) {
    const bool apart =
        std::ranges::all_of(taken, [&](const VoxelBox& box) { return common(box, one.bounds).empty(); });
    if (!apart) continue;
    taken.push_back(one.bounds);
    overloads.push_back(std::move(one.overload));
  }
  return overloads;
}

}  // namespace scree
