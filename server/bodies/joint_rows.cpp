#include "server/bodies/joint_rows.h"

#include <algorithm>

#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr float no_bound = 1e30F;
constexpr float half_turn = 3.14159265F;

float magnitude(float value) {
  return value < 0.0F ? -value : value;
}

/// The turn, as a vector, that takes one axis to another one: its sine's length, at most 1.
btVector3 turn_between(const btVector3& from, const btVector3& to, const btVector3& aside) {
  const btVector3 turn = from.cross(to);
  if (from.dot(to) >= 0.0F) return turn;
  const float length2 = turn.length2();
  return length2 > 1e-12F ? turn / btSqrt(length2) : aside;
}

/// The turn, as a vector, that takes axes to other ones: twice the sine of half of its angle.
btVector3 turn_between(const btMatrix3x3& from, const btMatrix3x3& to) {
  const btMatrix3x3 between = to * from.transpose();
  btQuaternion turn;
  between.getRotation(turn);
  const float twice = turn.w() < 0.0F ? -2.0F : 2.0F;
  return btVector3(turn.x(), turn.y(), turn.z()) * twice;
}

const btVector3 nothing(0.0F, 0.0F, 0.0F);

}  // namespace

/// A minimax polynomial of the arcus tangens (Hastings, Approximations for Digital Computers, 1955).
float angle_of(float cosine, float sine) {
  const float c = magnitude(cosine), s = magnitude(sine);
  const float ratio = std::min(c, s) / std::max({c, s, 1e-30F}), r2 = ratio * ratio;
  float angle =
      ratio *
      (0.99997726F + r2 * (-0.33262347F +
                           r2 * (0.19354346F + r2 * (-0.11643287F + r2 * (0.05265332F - r2 * 0.01172120F)))));
  if (s > c) angle = 0.5F * half_turn - angle;
  if (cosine < 0.0F) angle = half_turn - angle;
  return sine < 0.0F ? -angle : angle;
}

/// Where the sides are in the world.
struct JointRows::Places {
  btVector3 arm_a, arm_b;  ///< from the bodies' centres of mass to their places
  btVector3 off;           ///< from a's place to b's
  btMatrix3x3 axes_a, axes_b;

  btVector3 axis_a(int i) const { return axes_a.getColumn(i); }
  btVector3 axis_b(int i) const { return axes_b.getColumn(i); }
};

void JointRows::replace(PieceId body, btRigidBody* now) {
  CHECK(body != 0 && (body == joint_.a.body || body == joint_.b.body));
  frames_[body == joint_.a.body ? 0 : 1].body = now;
}

/// The speed that undoes a part of what is off, but no faster than a bound.
float JointRows::undoing(float off, float most) const {
  return undo_share_ * std::clamp(-limits::joint_undone_a_step * off / step_s_, -most, most);
}

void JointRows::weigh(HoldingRow& row) const {
  row.gain_a = a_.inverse_inertia * row.turn_a;
  row.gain_b = b_.inverse_inertia * row.turn_b;
  const float ease = (a_.inverse_mass + b_.inverse_mass) * row.along.length2() + row.turn_a.dot(row.gain_a) +
                     row.turn_b.dot(row.gain_b);
  row.mass = ease > 0.0F ? 1.0F / ease : 0.0F;
}

HoldingRow& JointRows::add(const btVector3& along, const btVector3& turn_a, const btVector3& turn_b) {
  CHECK_DEBUG(count_ < rows_max);
  HoldingRow& row = rows_[count_++];
  row = {along, turn_a, turn_b};
  row.low = -no_bound;
  row.high = no_bound;
  weigh(row);
  return row;
}

/// Three rows along the world's axes.
void JointRows::add_point(const Places& at) {
  for (int i = 0; i < 3; ++i) {
    btVector3 along(0.0F, 0.0F, 0.0F);
    along[i] = 1.0F;
    add(along, at.arm_a.cross(along), at.arm_b.cross(along))
        .want_undone(undoing(at.off[i], limits::joint_undo_m_s));
  }
}

/// No turn about y and z of a's axes, nor, for a fixed joint and a slider, about x.
void JointRows::add_turns(const Places& at, bool with_axis) {
  const btVector3 off =
      with_axis ? turn_between(at.axes_a, at.axes_b) : turn_between(at.axis_a(0), at.axis_b(0), at.axis_a(1));
  for (int i = with_axis ? 0 : 1; i < 3; ++i) {
    const btVector3 about = at.axis_a(i);
    add(nothing, about, about).want_undone(undoing(about.dot(off), limits::joint_undo_rad_s));
  }
}

/// No way along y and z of a's axes.
void JointRows::add_slide(const Places& at) {
  const btVector3 arm_a = at.arm_a + at.off;
  for (int i = 1; i < 3; ++i) {
    const btVector3 along = at.axis_a(i);
    add(along, arm_a.cross(along), at.arm_b.cross(along))
        .want_undone(undoing(along.dot(at.off), limits::joint_undo_m_s));
  }
}

/// What turns about the other one goes straight on within a step, so that the line grows. At this speed.
float JointRows::drift_m_s(const Places& at, const btVector3& along, float length_m) const {
  const btVector3 speed =
      b_.speed_now() + b_.spin_now().cross(at.arm_b) - a_.speed_now() - a_.spin_now().cross(at.arm_a);
  const btVector3 aside_m = (speed - along * speed.dot(along)) * step_s_;
  const float drift_m = btSqrt(length_m * length_m + aside_m.length2()) - length_m;
  return std::min(drift_m / step_s_, limits::joint_undo_m_s);
}

void JointRows::add_line(const Places& at) {
  const float length = at.off.length();
  const btVector3 along = length > 1e-6F ? at.off / length : at.axis_a(0);
  HoldingRow& row = add(along, at.arm_a.cross(along), at.arm_b.cross(along));
  const float longer_m = length - joint_.length_m;
  const float drifts_m_s = drift_m_s(at, along, length);
  row.want_undone(undoing(longer_m, limits::joint_undo_m_s));
  row.wanted -= drifts_m_s;
  if (joint_.kind == JointKind::rope) {
    row.high = 0.0F;                                                  // a rope pulls, and does not push
    if (longer_m < 0.0F) row.want(-longer_m / step_s_ - drifts_m_s);  // it gets taut in the step, or not
  }
  calm_line(at, along);
}

/// What moves aside of a taut line is drawn back by the line's force over its length. Where a step is too
/// long to follow that, a line that is short beside its load, this draws by where the body will be.
void JointRows::calm_line(const Places& at, const btVector3& along) {
  const float stiffness_n_m = force_n_ / std::max(joint_.length_m, limits::joint_line_min_m);
  const float kept = step_s_ * step_s_ * stiffness_n_m;  // impulse by a speed of 1
  if (!(kept * (a_.inverse_mass + b_.inverse_mass) > limits::joint_calmed_from)) return;
  btVector3 aside, across;
  btPlaneSpace1(along, aside, across);
  for (const btVector3& way : {aside, across}) {
    impulses_[count_] = 0.0F;
    HoldingRow& row = add(way, at.arm_a.cross(way), at.arm_b.cross(way));
    row.soft = 1.0F / kept;
    row.mass = row.mass > 0.0F ? 1.0F / (1.0F / row.mass + row.soft) : 0.0F;
  }
}

/// The motor and the limits, which it does not drive beyond. `value`: the angle, or the way.
void JointRows::add_axis(const Places& at, float value) {
  const bool slides = joint_.kind == JointKind::slider;
  const btVector3 x = at.axis_a(0);
  const btVector3 along = slides ? x : nothing;
  const btVector3 turn_a = slides ? (at.arm_a + at.off).cross(x) : x, turn_b = slides ? at.arm_b.cross(x) : x;
  motor_ = count_;
  HoldingRow& motor = add(along, turn_a, turn_b);
  const float most = slides ? no_bound : std::min(frames_[0].spin_max_rad_s, frames_[1].spin_max_rad_s);
  motor.wanted = std::clamp(joint_.motor.speed, -most, most);
  motor.high = joint_.motor.greatest * step_s_;
  motor.low = -motor.high;
  HoldingRow& lower = add(along, turn_a, turn_b);
  HoldingRow& upper = add(along, turn_a, turn_b);
  lower.low = lower.high = upper.low = upper.high = 0.0F;
  if (!joint_.limits) return;
  const float undo = slides ? limits::joint_undo_m_s : limits::joint_undo_rad_s;
  const float above = value - joint_.limits->low, below = joint_.limits->high - value;
  lower.high = no_bound;
  above > 0.0F ? lower.want(-above / step_s_) : lower.want_undone(undoing(above, undo));
  upper.low = -no_bound;
  below > 0.0F ? upper.want(below / step_s_) : upper.want_undone(-undoing(below, undo));
  motor.wanted = std::max(lower.wanted, std::min(motor.wanted, upper.wanted));
}

void JointRows::prepare(const SolvedBody& a, const SolvedBody& b, float step_s) {
  a_ = a;
  b_ = b;
  step_s_ = step_s;
  count_ = 0;
  motor_ = rows_max;
  Places at;
  std::array<btVector3, 2> places;
  for (size_t i = 0; i < 2; ++i) {
    const HeldFrame& frame = frames_[i];
    btVector3& arm = i == 0 ? at.arm_a : at.arm_b;
    btMatrix3x3& axes = i == 0 ? at.axes_a : at.axes_b;
    arm = nothing;
    places[i] = frame.place;
    axes = frame.axes;
    if (frame.body == nullptr) continue;
    const btTransform& pose = frame.body->getWorldTransform();
    arm = pose.getBasis() * frame.place;
    places[i] = pose.getOrigin() + arm;
    axes = pose.getBasis() * frame.axes;
  }
  at.off = places[1] - places[0];
  add_rows(at);
  for (size_t i = 0; i < count_; ++i) {
    const HoldingRow& row = rows_[i];
    holds_[i] = row.mass > 0.0F && impulses_[i] > row.low && impulses_[i] < row.high;
  }
}

void JointRows::add_rows(const Places& at) {
  switch (joint_.kind) {
    case JointKind::fixed:
      add_turns(at, true);
      return add_point(at);
    case JointKind::hinge:
      add_axis(at, angle_of(at.axis_b(1).dot(at.axis_a(1)), at.axis_b(1).dot(at.axis_a(2))));
      add_turns(at, false);
      return add_point(at);
    case JointKind::slider:
      add_axis(at, at.off.dot(at.axis_a(0)));
      add_turns(at, true);
      return add_slide(at);
    case JointKind::ball:
      return add_point(at);
    case JointKind::distance:
    case JointKind::rope:
      return add_line(at);
  }
}

float JointRows::speed_of(const HoldingRow& row) const {
  return row.along.dot(b_.speed_now() - a_.speed_now()) + row.turn_b.dot(b_.spin_now()) -
         row.turn_a.dot(a_.spin_now());
}

void JointRows::give(const HoldingRow& row, float impulse) {
  if (a_.solver != nullptr) {
    a_.solver->m_deltaLinearVelocity -= row.along * (impulse * a_.inverse_mass);
    a_.solver->m_deltaAngularVelocity -= row.gain_a * impulse;
  }
  if (b_.solver != nullptr) {
    b_.solver->m_deltaLinearVelocity += row.along * (impulse * b_.inverse_mass);
    b_.solver->m_deltaAngularVelocity += row.gain_b * impulse;
  }
}

std::array<HeldSide, 2> JointRows::sides() const {
  const auto side = [&](bool is_b) {
    const SolvedBody& solved = is_b ? b_ : a_;
    if (solved.solver == nullptr) return HeldSide{-1, is_b};
    return HeldSide{frames_[is_b ? 1 : 0].body->getCompanionId(), is_b, solved.inverse_mass};
  };
  return {side(false), side(true)};
}

double JointRows::is_off_m_s(size_t i) const {
  const HoldingRow& row = rows_[i];
  const double softness = double{row.soft} + limits::joint_softness / double{row.mass};
  return double{row.wanted} - double{speed_of(row)} - softness * double{impulses_[i]};
}

void JointRows::change(size_t i, float impulse) {
  impulses_[i] += impulse;
  give(rows_[i], impulse);
}

std::array<btVector3, 4> JointRows::gained() const {
  const auto of = [](const SolvedBody& body, btVector3 btSolverBody::*which) {
    return body.solver == nullptr ? nothing : body.solver->*which;
  };
  return {of(a_, &btSolverBody::m_deltaLinearVelocity), of(b_, &btSolverBody::m_deltaLinearVelocity),
          of(a_, &btSolverBody::m_deltaAngularVelocity), of(b_, &btSolverBody::m_deltaAngularVelocity)};
}

void JointRows::undo_less(size_t i, float share) {
  rows_[i].wanted -= share * rows_[i].undo;
  rows_[i].undo -= share * rows_[i].undo;
}

bool JointRows::let_go(size_t i) {
  const HoldingRow& row = rows_[i];
  const float bounded = std::clamp(impulses_[i], row.low, row.high);
  if (bounded == impulses_[i]) return false;
  change(i, bounded - impulses_[i]);
  impulses_[i] = bounded;
  holds_[i] = false;
  return true;
}

void JointRows::start() {
  for (size_t i = 0; i < count_; ++i) {
    const float before = (holds_[i] ? 1.0F : limits::joint_warm_share) * impulses_[i];
    impulses_[i] = rows_[i].mass > 0.0F ? std::clamp(before, rows_[i].low, rows_[i].high) : 0.0F;
    give(rows_[i], impulses_[i]);
  }
}

void JointRows::solve() {
  for (size_t i = 0; i < count_; ++i) {
    const HoldingRow& row = rows_[i];
    if (!is_open(i)) continue;
    const float before = impulses_[i];
    const float change =
        limits::joint_relaxation * (row.wanted - speed_of(row) - row.soft * before) * row.mass;
    impulses_[i] = std::clamp(before + change, row.low, row.high);
    give(row, impulses_[i] - before);
  }
}

/// Whether something keeps it from undoing what is off.
bool JointRows::is_opposed() const {
  for (size_t i = 0; i < count_; ++i) {
    const HoldingRow& row = rows_[i];
    if (i == motor_ || !holds_[i] || magnitude(row.wanted) < limits::joint_opposed_min) continue;
    if (magnitude(row.wanted - speed_of(row)) > 0.5F * magnitude(row.wanted)) return true;
  }
  return false;
}

void JointRows::finish(float step_s) {
  btVector3 force = nothing, torque = nothing;
  for (size_t i = 0; i < count_; ++i) {
    const HoldingRow& row = rows_[i];
    if (i == motor_ || row.soft > 0.0F) continue;
    if (row.along.isZero())
      torque += row.turn_b * impulses_[i];
    else
      force += row.along * impulses_[i];
  }
  pulled_n_ = force / step_s;
  force_n_ = pulled_n_.length();
  torque_nm_ = torque.length() / step_s;
  // What works against it, such as a body between, does so in the next step too.
  if (is_opposed()) {
    undo_share_ *= 0.5F;
    for (float& impulse : impulses_) impulse *= 0.5F;
  } else {
    undo_share_ = std::min(1.0F, 1.1F * undo_share_ + 0.001F);
  }
  is_driven_ = false;
  if (motor_ < count_ && joint_.motor.greatest > 0.0F && joint_.motor.speed != 0.0F) {
    const float share = speed_of(rows_[motor_]) / joint_.motor.speed;
    is_driven_ = share > limits::joint_driven_share;
  }
  for (float& impulse : impulses_)
    if (!(magnitude(impulse) < no_bound)) impulse = 0.0F;
  a_.solver = b_.solver = nullptr;
}

// A force f at a place r from the centre turns the body by r × f. By a turn about an axis e of length 1, that
// becomes (e × r) × f more.
btVector3 JointRows::turning_stiffness(bool of_b) const {
  const HeldFrame& frame = frames_[of_b ? 1 : 0];
  const btVector3 force = frame.body->getWorldTransform().getBasis().transpose() * pulled_n_;
  btVector3 out;
  for (int i = 0; i < 3; ++i) {
    btVector3 axis(0.0F, 0.0F, 0.0F);
    axis[i] = 1.0F;
    out[i] = axis.cross(frame.place).cross(force).length() + torque_nm_;
  }
  return out;
}

bool JointRows::breaks() const {
  return (joint_.break_force_n > 0.0F && force_n_ > joint_.break_force_n) ||
         (joint_.break_torque_nm > 0.0F && torque_nm_ > joint_.break_torque_nm);
}

}  // namespace scree
