#include "server/bodies/joint_system.h"

#include <algorithm>
#include <numeric>

#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr uint32_t none = UINT32_MAX;

/// What one row's impulse changes of another row's speed, by the body that they share.
double coupling(const JointRows& one, size_t row, const JointRows& other, size_t other_row) {
  double sum = 0.0;
  for (const HeldSide& side : one.sides())
    for (const HeldSide& beside : other.sides()) {
      if (side.moved < 0 || side.moved != beside.moved) continue;
      const HoldingRow &a = one.row(row), &b = other.row(other_row);
      const float sign = side.is_b == beside.is_b ? 1.0F : -1.0F;
      const btVector3& turn = side.is_b ? a.turn_b : a.turn_a;
      const btVector3& gain = beside.is_b ? b.gain_b : b.gain_a;
      sum += sign * (side.inverse_mass * a.along.dot(b.along) + turn.dot(gain));
    }
  return sum;
}

}  // namespace

void JointSystem::begin(std::span<JointRows*> joints) {
  joints_ = joints;
  times_let_go_ = 0;
  held_.clear();
  if (joints.empty()) return;
  find_neighbours();
  put_in_order();
  list_held();
  if (let_go_of_costly()) list_held();
  factorise();
  for (JointRows* joint : joints) joint->start();
  undo_gently();
}

// Joints are neighbours that share a body that can move.
void JointSystem::find_neighbours() {
  std::vector<std::pair<int, uint32_t>> by_body;
  for (uint32_t i = 0; i < joints_.size(); ++i)
    for (const HeldSide& side : joints_[i]->sides())
      if (side.moved >= 0) by_body.emplace_back(side.moved, i);
  std::ranges::sort(by_body);
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (size_t begin = 0, end = 0; begin < by_body.size(); begin = end) {
    while (end < by_body.size() && by_body[end].first == by_body[begin].first) ++end;
    const bool too_many = end - begin > limits::joints_a_body_max;
    for (size_t i = begin; i < end; ++i) {
      if (too_many) joints_[by_body[i].second]->hold_none();
      for (size_t j = begin; j < end && !too_many; ++j)
        if (by_body[i].second != by_body[j].second) pairs.emplace_back(by_body[i].second, by_body[j].second);
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  neighbours_.clear();
  neighbours_begin_.assign(joints_.size() + 1, 0);
  for (const auto& [joint, beside] : pairs) {
    ++neighbours_begin_[joint + 1];
    neighbours_.push_back(beside);
  }
  std::partial_sum(neighbours_begin_.begin(), neighbours_begin_.end(), neighbours_begin_.begin());
}

std::span<const uint32_t> JointSystem::neighbours(uint32_t joint) const {
  return std::span(neighbours_)
      .subspan(neighbours_begin_[joint], neighbours_begin_[joint + 1] - neighbours_begin_[joint]);
}

/// Appends what hangs together with a joint, the nearest first, and of these what has the fewest neighbours.
void JointSystem::walk(uint32_t from, std::vector<uint32_t>& order) {
  walked_[from] = true;
  order.push_back(from);
  for (size_t next = order.size() - 1; next < order.size(); ++next) {
    const size_t begin = order.size();
    for (const uint32_t beside : neighbours(order[next]))
      if (!walked_[beside]) {
        walked_[beside] = true;
        order.push_back(beside);
      }
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(), [&](uint32_t a, uint32_t b) {
      return std::pair(neighbours(a).size(), a) < std::pair(neighbours(b).size(), b);
    });
  }
}

void JointSystem::put_in_order() {
  order_.clear();
  walked_.assign(joints_.size(), false);
  for (uint32_t i = 0; i < joints_.size(); ++i) {
    if (walked_[i]) continue;
    // The last of a walk lies at an end, and there the order begins.
    std::vector<uint32_t> there;
    walk(i, there);
    for (const uint32_t joint : there) walked_[joint] = false;
    walk(there.back(), order_);
  }
  std::ranges::reverse(order_);
}

void JointSystem::list_held() {
  held_.clear();
  place_.assign(joints_.size(), none);
  holds_all_ = true;
  for (const uint32_t i : order_) {
    const JointRows& joint = *joints_[i];
    for (uint32_t row = 0; row < joint.rows(); ++row) {
      holds_all_ &= !joint.is_open(row);
      if (!joint.holds(row)) continue;
      if (place_[i] == none) place_[i] = static_cast<uint32_t>(held_.size());
      held_.push_back({i, row});
    }
  }
  first_.clear();
  for (const Held& held : held_) {
    uint32_t first = place_[held.joint];
    for (const uint32_t beside : neighbours(held.joint)) first = std::min(first, place_[beside]);
    first_.push_back(first);
  }
}

/// Returns whether there is any.
bool JointSystem::let_go_of_costly() {
  bool any = false;
  for (size_t begin = 0, end = 0; begin < held_.size(); begin = end) {
    // No row depends on one before those that hang together with it.
    const uint32_t from = static_cast<uint32_t>(begin);
    double work = 0.0;
    for (uint32_t last = from; end < held_.size() && (end == begin || end <= last); ++end) {
      for (const uint32_t beside : neighbours(held_[end].joint))
        if (place_[beside] != none) last = std::max(last, place_[beside]);
      last = std::max(last, place_[held_[end].joint]);
      work += EnvelopeFactor::work_of(end - first_[end]);
    }
    const double most =
        limits::joint_work_max + limits::joint_work_a_row_max * static_cast<double>(end - begin);
    if (work <= most) continue;
    any = true;
    for (size_t i = begin; i < end; ++i) joints_[held_[i].joint]->hold_none();
  }
  return any;
}

void JointSystem::factorise() {
  factor_.begin(first_);
  for (uint32_t i = 0; i < held_.size(); ++i) {
    const Held& own = held_[i];
    const JointRows& joint = *joints_[own.joint];
    const auto add = [&](uint32_t beside) {
      for (uint32_t j = place_[beside]; j < i && held_[j].joint == beside; ++j)
        factor_.at(i, j) = coupling(joint, own.row, *joints_[beside], held_[j].row);
    };
    for (const uint32_t beside : neighbours(own.joint)) add(beside);
    add(own.joint);
    factor_.at(i, i) = (1.0 + limits::joint_softness) / joint.row(own.row).mass;
  }
  factor_.factorise(0.5 * limits::joint_softness);
}

/// Joints in a ring that does not fit may ask for speeds without bound, to undo what is off. So the speeds
/// that this would give the bodies are found first, and all want less where any is too great.
void JointSystem::undo_gently() {
  side_.clear();
  float most = 0.0F;
  for (const auto& [joint, row] : held_) {
    const float undo = joints_[joint]->row(row).undo;
    side_.push_back(undo);
    most = std::max(most, undo < 0.0F ? -undo : undo);
  }
  if (!(most > limits::joint_undo_gently_from)) return;
  factor_.solve(side_);
  std::vector<std::array<btVector3, 4>> before;
  for (const JointRows* joint : joints_) before.push_back(joint->gained());
  const auto give = [&](double share) {
    for (size_t i = 0; i < held_.size(); ++i)
      joints_[held_[i].joint]->change(held_[i].row, static_cast<float>(share * side_[i]));
  };
  give(1.0);
  float gained = 0.0F;
  for (size_t i = 0; i < joints_.size(); ++i) {
    const std::array<btVector3, 4> now = joints_[i]->gained();
    for (size_t k = 0; k < now.size(); ++k) gained = std::max(gained, (now[k] - before[i][k]).length());
  }
  give(-1.0);
  if (!(gained > limits::joint_undo_gained_max)) return;
  const float less = 1.0F - limits::joint_undo_gained_max / gained;
  for (const auto& [joint, row] : held_) joints_[joint]->undo_less(row, less);
}

void JointSystem::solve_held() {
  side_.clear();
  for (const auto& [joint, row] : held_) side_.push_back(joints_[joint]->is_off_m_s(row));
  factor_.solve(side_);
  for (size_t i = 0; i < held_.size(); ++i)
    joints_[held_[i].joint]->change(held_[i].row, static_cast<float>(side_[i]));
}

/// Rows that are beyond their bounds hold no more in this step. Returns whether there are any.
bool JointSystem::let_go() {
  bool any = false;
  for (const auto& [joint, row] : held_) any |= joints_[joint]->let_go(row);
  return any;
}

void JointSystem::iterate(int iteration) {
  if (!held_.empty()) solve_held();
  while (times_let_go_ < limits::joints_let_go_max && let_go()) {
    ++times_let_go_;
    list_held();
    factorise();
    if (!held_.empty()) solve_held();
  }
  // To and fro: what one end of a chain bears reaches the other end in either direction.
  const size_t count = joints_.size();
  for (size_t i = 0; i < count; ++i) joints_[iteration % 2 == 0 ? i : count - 1 - i]->solve();
}

HeldInertia::Grown& HeldInertia::grown(const btRigidBody& body) {
  const auto number = [](const Grown& one) { return one.body->getCompanionId(); };
  const auto found = std::ranges::lower_bound(bodies_, body.getCompanionId(), {}, number);
  CHECK(found != bodies_.end() && found->body == &body);
  return *found;
}

void HeldInertia::grow(std::span<JointRows* const> joints, float step_s) {
  const auto each_side = [&](const auto& visit) {
    for (const JointRows* joint : joints)
      for (const bool is_b : {false, true}) {
        btRigidBody* const body = is_b ? joint->body_b() : joint->body_a();
        if (body != nullptr && !body->isStaticOrKinematicObject()) visit(*body, *joint, is_b);
      }
  };
  bodies_.clear();
  each_side([&](btRigidBody& body, const JointRows&, bool) { bodies_.push_back({&body}); });
  std::ranges::sort(bodies_, {}, [](const Grown& one) { return one.body->getCompanionId(); });
  const auto same = [](const Grown& a, const Grown& b) { return a.body == b.body; };
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end(), same), bodies_.end());
  each_side([&](const btRigidBody& body, const JointRows& joint, bool is_b) {
    grown(body).stiffness_n_m += joint.turning_stiffness(is_b);
  });
  for (Grown& one : bodies_) {
    btVector3 inverse = one.inverse_before = one.body->getInvInertiaDiagLocal();
    for (int i = 0; i < 3; ++i) {
      const float least = limits::joint_inertia_share * step_s * step_s * one.stiffness_n_m[i];
      if (inverse[i] * least > 1.0F) inverse[i] = 1.0F / least;
    }
    if (inverse == one.inverse_before) continue;
    one.body->setInvInertiaDiagLocal(inverse);
    one.body->updateInertiaTensor();
  }
}

void HeldInertia::restore() {
  for (const Grown& one : bodies_) {
    if (one.body->getInvInertiaDiagLocal() == one.inverse_before) continue;
    one.body->setInvInertiaDiagLocal(one.inverse_before);
    one.body->updateInertiaTensor();
  }
  bodies_.clear();
}

}  // namespace scree
