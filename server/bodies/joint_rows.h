// Joints in the solver: each as a few rows, which joint_system.h solves together, or one by one by sequential
// impulses (Catto, Iterative Dynamics with Temporal Coherence, 2005). Each step begins with the impulses of
// the last one. Private to this folder.
//
// Bullet's own joints are not used. They begin each step with no impulse, and they find their angles by atan2
// and acos of the math library, whose last bits differ between systems. These rows use + − × ÷ and sqrt; the
// angle is by a polynomial.
//
// prepare(), start(), solve() and finish() change the joint and its two bodies in the solver alone: threads
// may solve joints of different groups at once.
#pragma once

#include <BulletDynamics/ConstraintSolver/btSolverBody.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <array>

#include "shared/prop/joint.h"

namespace scree {

/// A joint's place and axes in the axes of a body of Bullet, or in the world's.
struct HeldFrame {
  btRigidBody* body = nullptr;  ///< null: the terrain
  btVector3 place{0.0F, 0.0F, 0.0F};
  btMatrix3x3 axes;              ///< x, y and z as columns
  float spin_max_rad_s = 1e30F;  ///< the body's: no motor turns it faster
};

/// A body while it is solved.
struct SolvedBody {
  btSolverBody* solver = nullptr;                             ///< null: impulses do not move it
  btVector3 speed{0.0F, 0.0F, 0.0F}, spin{0.0F, 0.0F, 0.0F};  ///< without what the solver adds
  float inverse_mass = 0.0F;
  btMatrix3x3 inverse_inertia = btMatrix3x3(0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F);

  btVector3 speed_now() const { return solver == nullptr ? speed : speed + solver->m_deltaLinearVelocity; }
  btVector3 spin_now() const { return solver == nullptr ? spin : spin + solver->m_deltaAngularVelocity; }
};

/// A row brings a speed of side b against side a to a wanted one, by an impulse within bounds.
struct HoldingRow {
  btVector3 along{0.0F, 0.0F, 0.0F};  ///< unit, or 0: the row is of spins alone
  btVector3 turn_a{0.0F, 0.0F, 0.0F}, turn_b{0.0F, 0.0F, 0.0F};
  btVector3 gain_a{0.0F, 0.0F, 0.0F}, gain_b{0.0F, 0.0F, 0.0F};  ///< spin by an impulse of 1
  float mass = 0.0F;  ///< impulse that changes the speed by 1; 0: nothing does
  float wanted = 0.0F, low = 0.0F, high = 0.0F;
  float undo = 0.0F;  ///< the part of `wanted` that undoes what is off
  float soft = 0.0F;  ///< speed by which an impulse of 1 gives way

  void want(float speed) {
    wanted = speed;
    undo = 0.0F;
  }
  void want_undone(float speed) { wanted = undo = speed; }
};

/// One of a joint's bodies, in a step.
struct HeldSide {
  int moved = -1;  ///< the body's number in the solver; -1: impulses do not move it
  bool is_b = false;
  float inverse_mass = 0.0F;
};

class JointRows {
 public:
  JointRows(JointId id, const Joint& joint, const HeldFrame& a, const HeldFrame& b)
      : id_(id), joint_(joint), frames_{a, b} {}

  JointId id() const { return id_; }
  const Joint& joint() const { return joint_; }
  void set_motor(const JointMotor& motor) { joint_.motor = motor; }
  /// Null: the terrain.
  btRigidBody* body_a() const { return frames_[0].body; }
  btRigidBody* body_b() const { return frames_[1].body; }
  /// One of its bodies has another object in Bullet, of the same shape.
  void replace(PieceId body, btRigidBody* now);

  /// Finds the rows of a step of the simulation, for bodies as they stand.
  void prepare(const SolvedBody& a, const SolvedBody& b, float step_s);
  // After prepare(), in a step:
  size_t rows() const { return count_; }
  const HoldingRow& row(size_t i) const { return rows_[i]; }
  std::array<HeldSide, 2> sides() const;
  /// Whether the row's last impulse is within its bounds, so that it holds with what it needs, until it lets
  /// go. The others are open, or nothing.
  bool holds(size_t i) const { return holds_[i]; }
  bool is_open(size_t i) const { return !holds_[i] && rows_[i].low < rows_[i].high && rows_[i].mass > 0.0F; }
  void hold_none() { holds_ = {}; }
  /// Gives the bodies the impulses of the last step.
  void start();
  /// By which the speed of a row that holds differs from what it wants, and from what its impulse softens.
  double is_off_m_s(size_t i) const;
  void change(size_t i, float impulse);
  /// By which the solver has changed the speeds of a and b, and their spins.
  std::array<btVector3, 4> gained() const;
  /// Wants so much less of what undoes what is off: a share.
  void undo_less(size_t i, float share);
  /// Brings a row whose impulse is beyond its bounds back to them, and holds it no more.
  bool let_go(size_t i);
  /// Moves the impulse of each open row by what brings its speed to the wanted one, as far as its bounds
  /// allow.
  void solve();
  /// Measures force and torque. The bodies in the solver are not used from here on.
  void finish(float step_s);

  /// In the last step that solved it, without the motor's.
  float force_n() const { return force_n_; }
  float torque_nm() const { return torque_nm_; }
  /// Whether these break it.
  bool breaks() const;
  /// The torque that they gain on a body by its turn about each of its axes, by its size, N m.
  btVector3 turning_stiffness(bool of_b) const;
  /// Whether its motor moved it in the last step.
  bool is_driven() const { return is_driven_; }

 private:
  struct Places;
  void add_rows(const Places& at);
  void add_point(const Places& at);
  void add_turns(const Places& at, bool with_axis);
  void add_slide(const Places& at);
  float drift_m_s(const Places& at, const btVector3& along, float length_m) const;
  void add_line(const Places& at);
  void calm_line(const Places& at, const btVector3& along);
  void add_axis(const Places& at, float value);
  HoldingRow& add(const btVector3& along, const btVector3& turn_a, const btVector3& turn_b);
  void weigh(HoldingRow& row) const;
  float undoing(float off, float most) const;
  bool is_opposed() const;
  float speed_of(const HoldingRow& row) const;
  void give(const HoldingRow& row, float impulse);

  JointId id_;
  Joint joint_;
  std::array<HeldFrame, 2> frames_;
  float force_n_ = 0.0F, torque_nm_ = 0.0F;
  btVector3 pulled_n_{0.0F, 0.0F, 0.0F};  ///< the force on b
  bool is_driven_ = false;
  float undo_share_ = 1.0F;  ///< of the speed by which it undoes what is off

  static constexpr size_t rows_max = 8;     ///< a hinge with limits and a motor: 3 + 2 + 2 + 1
  std::array<float, rows_max> impulses_{};  ///< of each row, kept from step to step: the rows of a kind are
                                            ///< always the same ones
  // For the step that is solved:
  SolvedBody a_, b_;
  std::array<HoldingRow, rows_max> rows_;
  size_t count_ = 0;
  std::array<bool, rows_max> holds_{};
  size_t motor_ = rows_max;  ///< the motor's row; rows_max: there is none
  float step_s_ = 0.0F;
};

/// Angle of a direction (cosine, sine), radians, from −π to π; of any length but 0. Within 1e-5.
float angle_of(float cosine, float sine);

}  // namespace scree
