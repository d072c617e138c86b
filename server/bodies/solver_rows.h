// The rows of Bullet's solver of contacts, in vector instructions: Debian's library solves them in scalar
// ones. The method is the same, sequential impulses (Catto, Iterative Dynamics with Temporal Coherence,
// 2005). Private to this folder.
#pragma once

struct btSolverBody;
struct btSolverConstraint;

namespace scree {

/// Moves a row's impulse by what brings the speed of its two bodies along it to the wanted one, but not out
/// of the row's limits. Returns the residual as Bullet counts it.
float solve_between_limits(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row);
/// Likewise, for a row without an upper limit.
float solve_from_limit(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row);
/// Likewise, of the velocities that undo overlaps, which are apart from the bodies' own.
float undo_overlap(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row);

}  // namespace scree
