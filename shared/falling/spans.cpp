#include "shared/falling/spans.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "shared/base/check.h"
#include "shared/falling/span_joints.h"

namespace scree {

namespace {

/// States that are tried. Each one after the first is a better guess of where the rock yields.
constexpr int states_max = 24;
/// Products of blocks that all states of a search may take, about 20 ms. Above, the last state decides: it
/// falls if bodies move, and some section is strained to more than this.
constexpr size_t products_max = 48000;
constexpr double unclear_ratio = 1.15;
/// From this state on it falls for sure, if it moves so many times as far as when all was elastic, and a
/// section is strained so much though none cracked lately.
constexpr int sure_states = 3;
constexpr double sure_share = 3.0;
constexpr double sure_ratio = 2.0;
/// After so many states nothing falls if no body moves a little farther than when all was elastic: then
/// joints between bodies that others hold are at their limit.
constexpr int local_states = 4;
constexpr double local_share = 1.2;
/// A section through more joints is no beam's: its cracks are yield lines, which keep their bending.
constexpr size_t beam_joints_max = 4;
/// How far beyond its strength a section of a state may be strained that counts as bearable.
constexpr double tolerance = 1.055;
/// Joints at this part of their strength are at their limit.
constexpr double limit_share = 0.97;
/// What a joint keeps of its stiffness at least.
constexpr double stiffness_min = 1e-5;
/// Joints that open at least so much, relative to the one that opens most, are where it breaks.
constexpr double opening_share = 0.4;

/// Joints whose turning has so little of its stiffness left give way in all directions.
constexpr double turned_min = 1e-3;
/// Bodies that move so many times as far as when all was elastic would fall.
constexpr double moved_share = 2.0;
/// A cracked joint counts on no more than this part of the pressure that it had when it was whole.
constexpr double pressed_share = 1.25;

}  // namespace

class SpanSearch::Frame {
 public:
  Frame(const Field& field, const Palette& palette, std::span<const BrickCoord> changed, size_t parts_max,
        const Holding* holding)
      : bodies_(field, palette, changed, parts_max, holding),
        frame_(join_spans(bodies_, field.source().voxel_size_m)) {
    find_loose();
    weight_ = frame_.loads;
  }

  SpansFound run(const SpanForce* force) {
    begin(force);
    if (frame_.loads.empty()) return found_;
    double before = 1e30, most = 0.0;
    int idle = 0, settled = 0;  // states since the ratio fell, and since a section cracked
    for (int i = 0; i < states_max; ++i) {
      if (!solve()) {
        if (i == 0 || most < unclear_ratio || !any_moves(moved_share)) return found_;
        break;
      }
      if (i == 0) remember_elastic();
      most = judge();
      if (i == 0) found_.strain = most;
      if (most <= tolerance) return found_;
      if (i >= local_states && !any_moves(local_share)) return found_;
      if (i >= sure_states && settled >= 2 && most > sure_ratio && any_moves(sure_share)) break;
      const bool cracked = crack();
      idle = most < 0.99 * before || cracked ? 0 : idle + 1;
      settled = cracked ? 0 : settled + 1;
      before = most;
      if (idle > 3) break;
      soften();
    }
    report();
    return found_;
  }

 private:
  struct State {
    double stiffness = 1.0;  ///< of its turning, relative to the elastic joint's
    double tightness = 1.0;  ///< of its shifts, likewise
    double ratio = 0.0;      ///< worst strain over strength
    size_t worst = 0;        ///< check
    bool cracked = false;
    size_t crack = 0;  ///< check
    double opening = 0.0;
    double pressed = 0.0;  ///< force across the elastic joint
  };

  void begin(const SpanForce* force) {
    found_ = {};
    found_.bricks_read = bodies_.bricks_read();
    found_.bodies = frame_.loads.size();
    found_.joints = frame_.joints.size();
    states_.assign(frame_.joints.size(), {});
    frame_.loads = weight_;
    if (force != nullptr) strike(*force);
  }

  /// Bodies that nothing holds: islands, or what only its edges connect. They are left out.
  void find_loose() {
    std::vector<uint32_t> root(frame_.loads.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto root_of = [&](uint32_t body) {
      while (root[body] != body) body = root[body] = root[root[body]];
      return body;
    };
    std::vector<bool> held(root.size(), false);
    for (const SpanJoint& joint : frame_.joints)
      if (joint.spring.lower != SpringFrame::fixed && joint.spring.upper != SpringFrame::fixed)
        root[root_of(joint.lower)] = root_of(joint.upper);
    for (const SpanJoint& joint : frame_.joints) {
      if (joint.spring.lower == SpringFrame::fixed) held[root_of(joint.upper)] = true;
      if (joint.spring.upper == SpringFrame::fixed) held[root_of(joint.lower)] = true;
    }
    for (uint32_t body = 0; body < root.size(); ++body) {
      if (held[root_of(body)]) continue;
      frame_.loads[body] = {};
      loose_.push_back({SpringFrame::fixed, body, glm::dvec3(0.0), glm::dvec3(0.0), {1, 1, 1, 1, 1, 1}});
    }
  }

  /// Loads the body on which the force falls, unless that holds or nothing holds it.
  void strike(const SpanForce& force) {
    const BrickCoord brick = brick_of(force.on);
    const VoxelCoord at = force.on - first_voxel(brick);
    for (const SpanPart& part : bodies_.parts()) {
      if (!(part.brick == brick) || !part.bits.has(at)) continue;
      if (part.body >= frame_.loads.size() || frame_.loads[part.body] == Six{}) return;
      const glm::dvec3 moment = glm::cross(force.at - bodies_.bodies()[part.body].centre, force.newtons);
      for (int k = 0; k < 3; ++k) {
        frame_.loads[part.body][static_cast<size_t>(k)] += force.newtons[k];
        frame_.loads[part.body][static_cast<size_t>(k) + 3] += moment[k];
      }
    }
  }

  glm::dvec3 place(size_t i) const {
    glm::dvec3 place = frame_.joints[i].place;
    const State& state = states_[i];
    if (state.stiffness < 1.0) {
      const SpanJoint& joint = frame_.joints[i];
      place[joint.axis] = joint.checks[state.cracked ? state.crack : state.worst].at;
    }
    return place;
  }

  SpringFrame::Spring spring(size_t i) const {
    const SpanJoint& joint = frame_.joints[i];
    SpringFrame::Spring spring = joint.spring;
    for (size_t k = 0; k < 3; ++k) spring.stiffness[k] *= states_[i].tightness;
    for (size_t k = 3; k < 6; ++k) spring.stiffness[k] *= states_[i].stiffness;
    const glm::dvec3 at = place(i);
    spring.lower_arm = at - bodies_.bodies()[joint.lower].centre;
    spring.upper_arm = at - bodies_.bodies()[joint.upper].centre;
    return spring;
  }

  /// The forces in all joints. False when that is too much work.
  bool solve() {
    SpringFrame frame(frame_.loads.size());
    springs_.clear();
    for (size_t i = 0; i < frame_.joints.size(); ++i) {
      springs_.push_back(spring(i));
      frame.add(springs_.back());
    }
    for (const SpringFrame::Spring& pin : loose_) frame.add(pin);
    const bool solved = frame.factorise(products_max - found_.products);
    found_.products += frame.products();
    if (!solved) return false;
    moves_ = frame_.loads;
    frame.solve(moves_);
    forces_.clear();
    for (size_t i = 0; i < springs_.size(); ++i) {
      Six six = SpringFrame::opening(springs_[i], moves_);
      states_[i].opening = std::sqrt(six[3] * six[3] + six[4] * six[4] + six[5] * six[5]);
      for (size_t k = 0; k < six.size(); ++k) six[k] *= springs_[i].stiffness[k];
      forces_.push_back(six);
    }
    return true;
  }

  void remember_elastic() {
    elastic_moves_ = moves_;
    for (size_t i = 0; i < states_.size(); ++i)
      states_[i].pressed = -forces_[i][static_cast<size_t>(frame_.joints[i].axis)];
  }

  double ratio_of(size_t i, size_t check) const {
    const SpanJoint& joint = frame_.joints[i];
    const State& state = states_[i];
    const double strength = joint.checks[check].strength;
    const SpanStrain strain = strain_of(joint, joint.checks[check], place(i), forces_[i]);
    const bool cracked = state.cracked && state.crack == check;
    // Only as much pressure as the whole rock had helps: a cracked flat beam wedges itself in only where its
    // ends give way by nothing.
    const double pressed_most =
        pressed_share * std::max(state.pressed, 0.0) / joint.checks[check].section.area;
    const double helps = strain.pressed > pressed_most ? pressed_most / strain.pressed : 1.0;
    const double rocking = helps * strain.rocking;
    const double bears = cracked ? rocking : std::max(strength + helps * strain.pressed, rocking);
    const double crushed = strain.pressed / (pressed_most + strength);
    // A crack is never closed to the last bit.
    return std::max(crushed, strain.bent / std::max(bears, cracked ? 0.02 * strength : 1e-6 * strength));
  }

  /// The greatest ratio of all.
  double judge() {
    double most = 0.0;
    for (size_t i = 0; i < states_.size(); ++i) {
      State& state = states_[i];
      state.ratio = 0.0;
      for (size_t k = 0; k < frame_.joints[i].checks.size(); ++k) {
        const double ratio = ratio_of(i, k);
        if (ratio <= state.ratio) continue;
        state.ratio = ratio;
        state.worst = k;
      }
      most = std::max(most, state.ratio);
    }
    return most;
  }

  /// Plane sections all of whose joints are at their limit. Whether there are new ones.
  bool crack() {
    std::map<uint32_t, size_t> joints;  // of each group; 0: not all of them are at their limit
    for (const SpanJoint& joint : frame_.joints) ++joints[joint.group];
    for (size_t i = 0; i < states_.size(); ++i)
      if (states_[i].ratio < limit_share) joints[frame_.joints[i].group] = 0;
    bool any = false;
    for (size_t i = 0; i < states_.size(); ++i) {
      State& state = states_[i];
      const size_t in_group = joints.at(frame_.joints[i].group);
      if (state.cracked || in_group == 0 || in_group > beam_joints_max) continue;
      state.cracked = any = true;
      state.crack = state.worst;
    }
    return any;
  }

  /// What is strained too much gives way: turning first, then all ways, so that a thin joint between bodies
  /// that others hold ends up with nothing to bear.
  void soften() {
    for (size_t i = 0; i < states_.size(); ++i) {
      State& state = states_[i];
      if (state.ratio <= 1.0) continue;
      const SpanCheck& check = frame_.joints[i].checks[state.worst];
      const bool pulled =
          strain_of(frame_.joints[i], check, place(i), forces_[i]).pressed < -0.5 * check.strength;
      if (pulled || state.stiffness < turned_min)
        state.tightness = std::max(state.tightness / std::min(state.ratio, 100.0), stiffness_min);
      // By a power below 1, three quarters, because whole steps swing about the limit.
      const double root = std::sqrt(state.ratio);
      state.stiffness = std::max(state.stiffness / (root * std::sqrt(root)), stiffness_min);
    }
  }

  /// Which bodies move so many times as far as while all was elastic.
  std::vector<bool> moving(double share) const {
    std::vector<bool> moving(moves_.size(), false);
    const auto way = [](const Six& move) {
      return std::sqrt(move[0] * move[0] + move[1] * move[1] + move[2] * move[2]);
    };
    for (size_t i = 0; i < moves_.size(); ++i) moving[i] = way(moves_[i]) > share * way(elastic_moves_[i]);
    return moving;
  }
  bool any_moves(double share) const {
    const std::vector<bool> all = moving(share);
    return std::find(all.begin(), all.end(), true) != all.end();
  }

  /// The sections that open most become necks.
  void report() {
    const std::vector<bool> falls = moving(moved_share);
    const auto yields = [&](size_t i) {
      const SpringFrame::Spring& spring = frame_.joints[i].spring;
      return states_[i].stiffness < 1.0 && ((spring.lower != SpringFrame::fixed && falls[spring.lower]) ||
                                            (spring.upper != SpringFrame::fixed && falls[spring.upper]));
    };
    double most = 0.0;
    for (size_t i = 0; i < states_.size(); ++i)
      if (yields(i)) most = std::max(most, states_[i].opening);
    std::map<uint32_t, std::vector<size_t>> groups;
    for (size_t i = 0; i < states_.size(); ++i)
      if (yields(i) && states_[i].opening >= opening_share * most)
        groups[frame_.joints[i].group].push_back(i);
    Overload overload;
    overload.by_leverage = true;
    for (size_t i = 0; i < falls.size(); ++i) {
      if (!falls[i]) continue;
      const SpanPart& first = bodies_.parts()[bodies_.bodies()[i].parts.front()];
      if (overload.voxels == 0)
        overload.start = first_voxel(first.brick) + bounds_of(first_of(first.bits)).lo;
      overload.voxels += bodies_.bodies()[i].voxels;
    }
    for (const auto& [group, joints] : groups) overload.necks.push_back(neck(joints));
    if (!overload.necks.empty() && overload.voxels >= overload_voxels_min)
      found_.overloads.push_back(std::move(overload));
  }

  Neck neck(const std::vector<size_t>& joints) const {
    Neck neck;
    double area = 0.0;
    for (const size_t i : joints) {
      const SpanJoint& joint = frame_.joints[i];
      const State& state = states_[i];
      const SpanCheck& check = joint.checks[state.cracked ? state.crack : state.worst];
      const SpanSection& section = check.section;
      VoxelBox box;
      const auto set = [&](int axis, double lo, double hi) {
        along_axis(box.lo, axis) = static_cast<int>(std::floor(lo + 0.5));
        along_axis(box.hi, axis) = static_cast<int>(std::floor(hi + 0.5));
      };
      along_axis(box.lo, joint.axis) = check.layer - 1;
      along_axis(box.hi, joint.axis) = check.layer + 1;
      set((joint.axis + 1) % 3, section.u_lo, section.u_hi);
      set((joint.axis + 2) % 3, section.v_lo, section.v_hi);
      neck.box = i == joints.front() ? box : hull_of(neck.box, box);
      area += section.area;
    }
    neck.box = neck.box.grown(1);
    neck.section_voxels = static_cast<int64_t>(area + 0.5);
    return neck;
  }

  SpanBodies bodies_;
  SpanJoints frame_;
  std::vector<Six> weight_;  ///< loads without a force
  SpansFound found_;
  std::vector<SpringFrame::Spring> loose_;  ///< hold bodies that nothing else holds
  std::vector<State> states_;               ///< by joint, as the following
  std::vector<SpringFrame::Spring> springs_;
  std::vector<Six> forces_;
  std::vector<Six> moves_, elastic_moves_;  ///< by body that does not hold
};

SpanSearch::SpanSearch(const Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                       size_t parts_max, const Holding* holding)
    : frame_(std::make_unique<Frame>(field, palette, changed, parts_max, holding)) {}

SpanSearch::~SpanSearch() = default;

SpansFound SpanSearch::run(const SpanForce* force) {
  return frame_->run(force);
}

SpansFound find_spans(const Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                      const Holding* holding) {
  return SpanSearch(field, palette, changed, span_parts_max, holding).run(nullptr);
}

}  // namespace scree
