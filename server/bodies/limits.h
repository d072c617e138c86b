// Bounds and tuning constants of the rigid bodies. Each says its unit, its reason, and its effect at the
// limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Speed of any piece, m/s: of a fall of two kilometres. Faster than stones of any blast; a step of 1/60 s
/// looks at 3.3 m of terrain then. Above: cut.
inline constexpr float speed_max_m_s = 200.0F;

/// The same of a prop: of a bullet. A step of 1/60 s looks at 10 m of its way.
inline constexpr float prop_speed_max_m_s = 600.0F;

/// Farthest that any point of a piece may travel unseen, voxels. The narrow band is 3 voxels wide, so a piece
/// cannot cross it without a contact. Beyond ⅘ of it in a step, the way is looked at in parts of ⅘ (sweep.h).
inline constexpr float travel_max_voxels = 2.5F;

/// Speed at which a body nears what it strikes from which on it is brought to touch it first, m/s: slower,
/// the solver takes the blow in two parts. Twice what a body has that drops by a voxel of 0.2 m.
inline constexpr float blow_min_m_s = 2.0F;

/// Part of a step within which a point that strikes the ground counts as touching it: so much of the blow may
/// be left to the next step.
inline constexpr float touching_step = 0.05F;

/// Points that a step looks at along the ways of all fast bodies, each stride of travel_max_voxels once: some
/// 4 ms. Beyond: each of them goes a shorter part of its way in the step, one stride at least, and keeps its
/// speed.
inline constexpr size_t swept_points_max = 100'000;

/// Chunks of ground that nobody has looked at into which the ways of fast bodies lead in a step: each may
/// have to be generated, in 0.3 ms. Beyond: the bodies wait at the border for the next step. So many are
/// remembered; beyond, all are forgotten.
inline constexpr size_t new_chunks_a_step = 16;
inline constexpr size_t seen_chunks_max = 65'536;

/// Overlaps of hulls whose depth a step seeks, at 10 us each: those of a crowd. Where there are more, each
/// pair of bodies takes its turn in every second step, every third and so on, and meanwhile keeps the
/// contacts that it has.
inline constexpr size_t overlaps_a_step = 1000;

/// A prop that lies in rock: its points that are looked at, the steps in which the way out is searched, and
/// the props for which it is searched in a step, half a millisecond each. The others wait.
inline constexpr size_t free_way_points = 32;
inline constexpr float free_way_steps = 24.0F;
inline constexpr size_t free_ways_a_step = 4;

/// Two pieces that near each other in a step by more than this share of the thinner one's half thickness are
/// looked at all along their way.
inline constexpr float unswept_share = 0.5F;

/// Two fast pieces that touch may near each other by so much of that thickness in a step: a corner that
/// strikes leaves the middle most of its speed.
inline constexpr float touching_share = 0.03F;

/// Spin of any piece, rad/s, of which no point may travel farther in a step than ⅕ of travel_max_voxels.
/// Faster, the contacts of one tick say nothing about the next. Above: cut.
inline constexpr float spin_max_rad_s = 20.0F;
inline constexpr float spin_travel_share = 0.2F;

/// The same of a prop, whose wheels are round: so a car drives at 30 m/s.
inline constexpr float prop_spin_max_rad_s = 120.0F;
inline constexpr float prop_spin_travel_share = 0.8F;

/// Distance from the ground within which hull points make contacts, metres, even if they do not approach it:
/// the contacts of a resting piece last from tick to tick.
inline constexpr float contact_slack_m = 0.02F;

/// A point of a piece that overlaps the terrain by less is shallow, metres: such overlaps come from
/// neighbours that merged. A deeper point is buried.
inline constexpr float overlap_shallow_m = 0.125F;

/// The highest speeds at which overlaps are undone, metres a second, whatever the length of a step. A shallow
/// point in terrain is so slow that it does not disturb pieces at rest: undone at once, a heap took twice as
/// long to merge. The others are of a buried point, and of two pieces.
inline constexpr float undo_shallow_m_s = 0.18F;
inline constexpr float undo_buried_m_s = 2.4F;
inline constexpr float undo_pieces_m_s = 1.0F;

/// Share of the overlap that the solver is told of which it undoes in a step.
inline constexpr float undone_a_step = 0.2F;

/// Largest distance between neighbouring surface points that are tested against the terrain, voxels. Terrain
/// spikes thinner than this may enter a face of the piece.
inline constexpr float sample_spacing_voxels = 2.0F;

/// Points of one piece that are tested against the terrain. Above: the spacing doubles until they are fewer.
inline constexpr unsigned samples_max = 96;

/// Bullet's margin around a hull, metres: a tenth of the piece's thickness, but not more than this. Thinner
/// margins make GJK fall back to its slow penetration search; zero is slowest of all.
inline constexpr float margin_max_m = 0.03F;

/// Gap between the collision shapes of neighbours at birth, per side, metres.
inline constexpr float birth_gap_m = 0.004F;

/// Length by which a contact's normal force resists rolling, as a share of the body's reach: a ball rolls on
/// a slope of more than so much, and to a stop on level ground. Real stones on rock have ten times as much;
/// their corners, which bodies have, too, are most of it.
inline constexpr float rolling_share = 0.02F;
inline constexpr float rolling_share_round = 0.01F;

/// The same against turning about the normal: friction, by the width of the patch that touches.
inline constexpr float turning_share = 0.1F;

/// A body is round whose points differ in their distance from its centre of mass by no more than this share,
/// and which has one within 41 degrees of every direction (the cosine): a cube's corners leave 55 degrees
/// free. It rolls as a ball does.
inline constexpr float round_off = 0.06F;
inline constexpr float round_cover_min = 0.75F;

/// By how much of its radius the hull of a capsule's points lies within it, and that of a cylinder's, at
/// most.
inline constexpr float capsule_sag = 0.07F;
inline constexpr float cylinder_sag = 0.02F;

/// Longest step of the simulation of bodies, seconds: in a longer one gravity gives a piece more speed than
/// contacts take, so that pieces jump instead of coming to rest. A longer tick takes several steps.
inline constexpr float step_max_s = 1.0F / 60.0F;

/// Change of a body's speed in one contact from which on a blow in an early step of a tick is kept for the
/// tick's end, m/s. The world asks for harder ones only.
inline constexpr float struck_speed_min_m_s = 1.0F;

/// Iterations of the contact solver. Heaps of rubble need no exact stacking; each costs a tenth of a step.
inline constexpr int solver_iterations = 8;

/// Iterations where joints hold bodies: a chain of ten links hangs still by 24 that begin with the last
/// step's impulses. They cost such bodies three times as much.
inline constexpr int joint_iterations = 24;

/// Share of what is off in a joint that a step undoes, and the greatest speeds at which it does: a joint that
/// is added far from where its bodies are draws them together without a blow.
inline constexpr float joint_undone_a_step = 0.1F;
inline constexpr float joint_undo_m_s = 4.0F;
inline constexpr float joint_undo_rad_s = 4.0F;

/// Share of its last impulses with which a joint begins a step, and by how much a row goes beyond what it
/// wants (successive over-relaxation). Measured: a load of 100 kg on ten links of 5 kg hangs still, 1 cm low.
/// By 1 and 1 it bounces at 0.7 m/s, and does not stop.
inline constexpr float joint_warm_share = 0.95F;
inline constexpr float joint_relaxation = 1.3F;

/// Speeds that undoing gives to any body of a group at most, m/s and rad/s. It is looked at where a joint
/// wants more than the first of these.
inline constexpr float joint_undo_gently_from = 0.2F;
inline constexpr float joint_undo_gained_max = 8.0F;

/// A joint that does not get half of the speed by which it undoes what is off is opposed, by another joint or
/// by a body between: it wants half as much, step by step. Not below this speed, m/s or rad/s.
inline constexpr float joint_opposed_min = 0.05F;

/// By which a held row gives way, as a share of its own: joints that contradict each other agree on something
/// between. A load of 10 t on a link of 5 kg hangs 4 mm low by it.
inline constexpr double joint_softness = 1e-5;

/// Multiplications for the factors of rows that hang together, and more of them by row: 100 rows may all
/// depend on each other, and of any number each on the 40 before it. Beyond, the rows are solved one by one,
/// as those of a body with more joints are.
inline constexpr double joint_work_max = 200'000.0;
inline constexpr double joint_work_a_row_max = 1'000.0;
inline constexpr size_t joints_a_body_max = 48;

/// How often in a step rows that are beyond their bounds let go; each time costs factors of what is left.
inline constexpr int joints_let_go_max = 3;

/// Least inertia of a body by what its joints pull, times a step squared: at a quarter it swings at
/// the edge of what a step follows, and bodies in chains swing with their neighbours.
inline constexpr float joint_inertia_share = 0.5F;

/// Likewise, the stiffness of a line aside over the mass, times a step squared, from which it is calmed: at 4
/// it flies apart. And a line that is shorter counts as so long there, metres: it may be of no length.
inline constexpr float joint_calmed_from = 0.5F;
inline constexpr float joint_line_min_m = 1e-3F;

/// Share of its speed at which a motor still moves its bodies, so that they stay awake: what it pushes
/// against in vain may sleep.
inline constexpr float joint_driven_share = 0.05F;

/// Bodies, or pairs of bodies, that a thread looks at before it takes the next ones: some 30 µs of work, as
/// much as it costs to wake a thread. As few in all are left to one thread.
inline constexpr size_t bodies_per_part = 32;
inline constexpr size_t pairs_per_part = 64;

/// Cost of solving that is worth a thread, in bodies without contacts: groups of joined bodies that cost less
/// are solved together. A manifold costs as much as so many bodies, and so
/// does a joint.
inline constexpr uint32_t solver_group_cost = 256;
inline constexpr uint32_t bodies_per_manifold = 6;

/// Masses of bodies that come from a file, kg: of far less than a piece of the smallest voxels has, and far
/// more than the largest window of the largest ones; beyond, a step gives numbers that are none. Refused.
inline constexpr float restored_mass_min_kg = 1e-3F;
inline constexpr float restored_mass_max_kg = 1e12F;

/// Least of a body's moments of inertia, as a share of its greatest: thinner splinters spin up without bound.
inline constexpr float inertia_ratio_min = 0.25F;

/// Overlap that the solver does not undo, metres: contacts last from tick to tick.
inline constexpr float penetration_slop_m = 0.004F;

/// Speeds below which Bullet lets a body fall asleep, m/s and rad/s; an island sleeps after two such seconds.
inline constexpr float sleep_speed_m_s = 0.15F;
inline constexpr float sleep_spin_rad_s = 0.3F;

/// Change of speed at which a blow thaws a frozen body, m/s: the weight of a heap stays below it, a piece
/// that drops by half a metre exceeds it.
inline constexpr float thaw_speed_m_s = 2.0F;

/// Distance that a thawed body may move before the bodies that touched it thaw, too, metres.
inline constexpr float thawed_leash_m = 0.03F;

/// Vertical component of a contact's normal above which the upper piece counts as carried by the lower one.
inline constexpr float carrying_slope = 0.2F;

}  // namespace scree::limits
