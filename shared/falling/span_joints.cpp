#include "shared/falling/span_joints.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

#include "shared/base/check.h"
#include "shared/falling/overload.h"

namespace scree {

namespace {

/// Shear modulus over the modulus of elasticity without lateral strain, times the share of a rectangle that
/// shear uses.
constexpr double shear_share = 0.5 * 5.0 / 6.0;
/// A section that turns about its edge is pressed on a strip, not on a line.
constexpr double rocking_share = 0.9;
/// Squared cosine down to which a beam's slope is taken into account.
constexpr double slope_min = 0.5;

/// A slice of a joint between the centres of its bodies.
struct Slice {
  double at = 0.0, length = 0.0;
  const SpanSection* section = nullptr;
};

class Joiner {
 public:
  Joiner(SpanBodies& bodies, float voxel_m)
      : bodies_(bodies), sections_(bodies), voxel_m_(static_cast<double>(voxel_m)) {}

  SpanJoints run() {
    SpanJoints out;
    weigh(out);
    using Key = std::tuple<uint32_t, uint32_t, int, int>;
    std::map<Key, std::vector<SpanContact>> between;
    for (const SpanContact& contact : bodies_.contacts()) {
      const SpanPart &lower = bodies_.parts()[contact.lower], &upper = bodies_.parts()[contact.upper];
      const int face = along_axis(first_voxel(upper.brick), contact.axis);
      between[{lower.body, upper.body, contact.axis, face}].push_back(contact);
    }
    for (const auto& [key, contacts] : between) {
      SpanJoint joint;
      joint.lower = std::get<0>(key);
      joint.upper = std::get<1>(key);
      joint.axis = std::get<2>(key);
      joint.face = std::get<3>(key);
      joint.contacts = contacts;
      if (make(joint)) out.joints.push_back(std::move(joint));
    }
    group(out.joints);
    return out;
  }

 private:
  const SpanBody& body(uint32_t number) const { return bodies_.bodies()[number]; }
  double newtons_per_voxel(const SpanBody& of) const {
    double kg_m3 = 0.0;
    for (const uint32_t part : of.parts)
      kg_m3 += bodies_.parts()[part].density_kg_m3 * bodies_.parts()[part].voxels;
    return kg_m3 / static_cast<double>(of.voxels) * static_cast<double>(standard_gravity) * voxel_m_ *
           voxel_m_ * voxel_m_;
  }
  /// Tension that it bears, by voxel².
  double strength(const SpanBody& of) const {
    double pa = 0.0;
    for (const uint32_t part : of.parts)
      pa += bodies_.parts()[part].bending_pa * bodies_.parts()[part].voxels;
    return pa / static_cast<double>(of.voxels) * voxel_m_ * voxel_m_;
  }

  /// Bodies by their sections across x, so that what lies in the outermost voxels counts.
  void weigh(SpanJoints& out) {
    for (const SpanBody& of : bodies_.bodies()) {
      layers_.push_back({});
      if (of.holds) continue;
      const int first = first_voxel(bodies_.parts()[of.parts.front()].brick).x;
      double voxels = 0.0;
      for (int k = 0; k < brick_size; ++k) {
        layers_.back().push_back(sections_.layer(of, 0, first + k));
        voxels += layers_.back().back().area;
      }
      out.loads.push_back({0.0, -voxels * newtons_per_voxel(of), 0.0, 0.0, 0.0, 0.0});
    }
  }

  SpanSection layer(uint32_t number, int axis, int at) {
    if (axis == 0 && !layers_[number].empty()) {
      const int first = first_voxel(bodies_.parts()[body(number).parts.front()].brick).x;
      return layers_[number][static_cast<size_t>(at - first)];
    }
    return sections_.layer(body(number), axis, at);
  }

  /// Sections of one of the two bodies, from the face to its centre.
  void add_side(SpanJoint& joint, bool is_lower) {
    const uint32_t number = is_lower ? joint.lower : joint.upper;
    const SpanBody& of = body(number);
    if (of.is_massive) return;
    const int centre = static_cast<int>(std::floor(of.centre[joint.axis] + 0.5));
    const int step = is_lower ? -1 : 1;
    const int first = is_lower ? joint.face - 1 : joint.face;
    const int count = std::max(is_lower ? joint.face - centre : centre - joint.face + 1, 1);
    const double bears = strength(of), weighs = newtons_per_voxel(of);
    SpanCheck sum;
    for (int k = 0; k < count; ++k) {
      SpanCheck check;
      check.layer = first + k * step;
      check.at = check.layer;
      check.section = layer(number, joint.axis, check.layer);
      check.strength = bears;
      if (check.section.area <= 0.0) break;
      if (joint.axis != 1) {
        // Half of this layer, and all of those between it and the face.
        const double half = 0.5 * step * -1.0 * weighs * check.section.area;
        glm::dvec3 place(0.0);
        place[joint.axis] = check.at;
        place[(joint.axis + 1) % 3] = check.section.u;
        place[(joint.axis + 2) % 3] = check.section.v;
        check.newtons = sum.newtons + half;
        check.weight_moment = sum.weight_moment + half * place;
        sum.newtons += 2.0 * half;
        sum.weight_moment += 2.0 * half * place;
      }
      joint.checks.push_back(check);
    }
  }

  std::vector<Slice> slices(const SpanJoint& joint) const {
    std::vector<Slice> out;
    const double lo = body(joint.lower).centre[joint.axis], hi = body(joint.upper).centre[joint.axis];
    for (const SpanCheck& check : joint.checks) {
      double from = check.at - 0.5, to = check.at + 0.5;
      if (check.layer < joint.face) from = std::max(from, std::min(lo, to - 0.25));
      if (check.layer >= joint.face) to = std::min(to, std::max(hi, from + 0.25));
      out.push_back({0.5 * (from + to), to - from, &check.section});
    }
    return out;
  }

  bool make(SpanJoint& joint) {
    add_side(joint, true);
    add_side(joint, false);
    if (joint.checks.empty()) return false;
    stiffen(joint);
    SpanCheck face;
    face.section = sections_.face(joint.contacts, joint.axis, joint.face);
    face.layer = joint.face;
    face.at = joint.face - 0.5;
    face.strength = std::min(strength(body(joint.lower)), strength(body(joint.upper)));
    if (face.section.area > 0.0) joint.checks.push_back(face);
    const double slope = slope_of(joint);
    for (SpanCheck& check : joint.checks) check.strength *= slope;
    return true;
  }

  /// The exact element of a beam of these slices (an elastic centre with two flexibilities).
  void stiffen(SpanJoint& joint) {
    const int axis = joint.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    double by_uu = 0.0, by_vv = 0.0, by_area = 0.0, by_turn = 0.0, at_uu = 0.0, at_vv = 0.0, of_u = 0.0,
           of_v = 0.0;
    const std::vector<Slice> all = slices(joint);
    for (const Slice& slice : all) {
      const SpanSection& section = *slice.section;
      by_uu += slice.length / section.uu;
      by_vv += slice.length / section.vv;
      by_area += slice.length / section.area;
      by_turn += slice.length * (section.uu + section.vv) / (section.uu * section.vv);
      at_uu += slice.at * slice.length / section.uu;
      at_vv += slice.at * slice.length / section.vv;
      of_u += section.u * slice.length / section.uu;
      of_v += section.v * slice.length / section.vv;
    }
    const double by_load = axis == 0   ? at_uu / by_uu
                           : axis == 2 ? at_vv / by_vv
                                       : 0.5 * (at_uu / by_uu + at_vv / by_vv);
    joint.place[axis] = by_load;
    joint.place[u] = of_u / by_uu;
    joint.place[v] = of_v / by_vv;
    double across_u = by_area / shear_share, across_v = across_u;
    for (const Slice& slice : all) {
      const double off = slice.at - by_load;
      const double turned = slice.length * (off * off + slice.length * slice.length / 12.0);
      across_u += turned / slice.section->uu;
      across_v += turned / slice.section->vv;
    }
    const auto at = [](int index) { return static_cast<size_t>(index); };
    Six& stiffness = joint.spring.stiffness;
    stiffness[at(axis)] = 1.0 / by_area;
    stiffness[at(u)] = 1.0 / across_u;
    stiffness[at(v)] = 1.0 / across_v;
    stiffness[at(3 + axis)] = 1.0 / by_turn;
    stiffness[at(3 + v)] = 1.0 / by_uu;
    stiffness[at(3 + u)] = 1.0 / by_vv;
    if (!body(joint.lower).holds) joint.spring.lower = joint.lower;
    if (!body(joint.upper).holds) joint.spring.upper = joint.upper;
  }

  /// Squared cosine of the angle between a sloping beam and the axis: sections across the axis are larger
  /// than the beam's own by one over the cosine, and the tension across them is smaller by its square.
  double slope_of(const SpanJoint& joint) const {
    const auto median = [&](double SpanSection::*centre) {
      std::vector<double> steps;
      for (size_t i = 1; i < joint.checks.size(); ++i) {
        const SpanCheck &a = joint.checks[i - 1], &b = joint.checks[i];
        if (b.layer - a.layer == 1 || a.layer - b.layer == 1)
          steps.push_back((b.section.*centre - a.section.*centre) / (b.at - a.at));
      }
      if (steps.empty()) return 0.0;
      std::ranges::sort(steps);
      return steps[steps.size() / 2];
    };
    const double du = median(&SpanSection::u), dv = median(&SpanSection::v);
    return std::max(1.0 / (1.0 + du * du + dv * dv), slope_min);
  }

  /// Joints in one plane whose bodies touch on one of its sides.
  void group(std::vector<SpanJoint>& joints) const {
    std::map<std::pair<uint32_t, uint32_t>, bool> touching;
    for (const SpanJoint& joint : joints)
      touching[{std::min(joint.lower, joint.upper), std::max(joint.lower, joint.upper)}] = true;
    const auto touch = [&](uint32_t a, uint32_t b) {
      return a == b || touching.contains({std::min(a, b), std::max(a, b)});
    };
    std::map<std::pair<int, int>, std::vector<uint32_t>> planes;
    for (uint32_t i = 0; i < joints.size(); ++i) {
      joints[i].group = i;
      planes[{joints[i].axis, joints[i].face}].push_back(i);
    }
    const auto root = [&](uint32_t i) {
      while (joints[i].group != i) i = joints[i].group;
      return i;
    };
    for (const auto& [plane, members] : planes)
      for (size_t i = 0; i < members.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
          const SpanJoint &a = joints[members[i]], &b = joints[members[j]];
          if (!touch(a.lower, b.lower) && !touch(a.upper, b.upper)) continue;
          const uint32_t x = root(members[i]), y = root(members[j]);
          joints[std::max(x, y)].group = std::min(x, y);
        }
    for (uint32_t i = 0; i < joints.size(); ++i) joints[i].group = root(i);
  }

  SpanBodies& bodies_;
  SpanSections sections_;
  double voxel_m_;
  std::vector<std::vector<SpanSection>> layers_;  ///< across x, of bodies that do not hold
};

}  // namespace

SpanJoints join_spans(SpanBodies& bodies, float voxel_m) {
  return Joiner(bodies, voxel_m).run();
}

SpanStrain strain_of(const SpanJoint& joint, const SpanCheck& check, glm::dvec3 place, const Six& forces) {
  const int axis = joint.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const SpanSection& section = check.section;
  glm::dvec3 centre(0.0);
  centre[axis] = check.at;
  centre[u] = section.u;
  centre[v] = section.v;
  const glm::dvec3 force(forces[0], forces[1], forces[2]);
  glm::dvec3 moment = glm::dvec3(forces[3], forces[4], forces[5]) + glm::cross(place - centre, force);
  // The weight between the section and the face: down, at its own place.
  const glm::dvec3 arm = check.weight_moment - check.newtons * centre;
  moment += glm::dvec3(arm.z, 0.0, -arm.x);
  const double pulled = force[axis] / section.area;
  const double slope_u = -moment[v] / section.uu, slope_v = moment[u] / section.vv;
  const double edge_u =
      slope_u > 0.0 ? slope_u * (section.u_hi - section.u) : slope_u * (section.u_lo - section.u);
  const double edge_v =
      slope_v > 0.0 ? slope_v * (section.v_hi - section.v) : slope_v * (section.v_lo - section.v);
  const double half_u = 0.5 * (section.u_hi - section.u_lo), half_v = 0.5 * (section.v_hi - section.v_lo);
  const double twisted = std::abs(moment[axis]) / std::min(section.uu / half_u, section.vv / half_v);
  const double both = edge_u + edge_v;
  SpanStrain strain;
  strain.bent = 0.5 * both + std::sqrt(0.25 * both * both + twisted * twisted);
  strain.pressed = -pulled;
  const double shape = edge_u >= edge_v ? half_u * half_u / section.uu : half_v * half_v / section.vv;
  strain.rocking = pulled < 0.0 ? rocking_share * strain.pressed * section.area * shape : 0.0;
  return strain;
}

}  // namespace scree
