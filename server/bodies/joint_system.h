// The joints of a group of bodies, solved together. What they hold depends on each other over many bodies:
// row by row, a load of a tonne on a link of 5 kg takes a thousand iterations, and what is left over each
// step throws it about. So the rows that hold are solved at once and exactly, by factors of J M⁻¹ Jᵀ
// (Baraff, Linear-time dynamics using Lagrange multipliers, 1996, has the same equations). Rows that are
// bounded, and at their bounds, are solved one by one: slack ropes, limits that nothing touches, motors that
// give all that they have.
//
// Joints are put in the order of Cuthill and McKee (Reducing the bandwidth of sparse symmetric matrices,
// 1969), reversed. What hangs together and would cost too much is solved row by row.
//
// What joints pull also turns with their bodies. A step does not see that, so light bodies under great loads
// would swing ever wider. They get a greater inertia in the solver, as far as that needs (Andrews,
// Teichmann and Kövecses, Geometric stiffness for real-time constrained multibody dynamics, 2017).
//
// Not thread-safe. Private to this folder.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "server/bodies/envelope_factor.h"
#include "server/bodies/joint_rows.h"

namespace scree {

class JointSystem {
 public:
  /// Joints of which prepare() was called; valid until the next call.
  void begin(std::span<JointRows*> joints);
  /// Holds what is held, and moves the other rows by one iteration.
  void iterate(int iteration);
  bool is_empty() const { return joints_.empty(); }
  /// Further iterations change nothing, unless something else moves the bodies.
  bool is_exact() const { return holds_all_; }

 private:
  /// A row that holds: `row` of the joint in `joint` of order_.
  struct Held {
    uint32_t joint, row;
  };
  void find_neighbours();
  std::span<const uint32_t> neighbours(uint32_t joint) const;
  void put_in_order();
  void walk(uint32_t from, std::vector<uint32_t>& order);
  void list_held();
  void find_first();
  bool let_go_of_costly();
  void factorise();
  void solve_held();
  void undo_gently();
  bool let_go();

  std::span<JointRows*> joints_;
  std::vector<uint32_t> order_;  ///< places in joints_
  std::vector<uint32_t> neighbours_, neighbours_begin_;
  std::vector<bool> walked_;
  std::vector<Held> held_;
  std::vector<uint32_t> place_;  ///< of each joint's first row in held_; none: no row of it holds
  EnvelopeFactor factor_;
  std::vector<uint32_t> first_;  ///< of each of held_, the first one that it depends on
  std::vector<double> side_;
  bool holds_all_ = false;
  int times_let_go_ = 0;
};

/// Greater inertias for the bodies of joints, by their last impulses.
class HeldInertia {
 public:
  /// `step_s`: of the step that follows. The bodies have their numbers in the solver.
  void grow(std::span<JointRows* const> joints, float step_s);
  /// As they were.
  void restore();

 private:
  struct Grown {
    btRigidBody* body;
    btVector3 stiffness_n_m{0.0F, 0.0F, 0.0F};  ///< by a turn about each of its axes
    btVector3 inverse_before{0.0F, 0.0F, 0.0F};
  };
  Grown& grown(const btRigidBody& body);

  std::vector<Grown> bodies_;  ///< in the order of their numbers
};

}  // namespace scree
