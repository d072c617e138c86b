#include "server/world/impact_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/work/work.h"
#include "server/world/blast.h"
#include "server/world/blow_stage.h"
#include "server/world/limits.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/base/roots.h"
#include "shared/field/material_window.h"

namespace scree {

namespace {

/// An impact, compared with the strength of a piece. A prop has none, and never breaks.
struct Blow {
  BodyImpact impact;
  float centre_m_s = 0.0F;  ///< change of the speed of the piece's centre of mass
  float speed_m_s = 0.0F;   ///< which it would lose in a flat blow of as much energy
  float excess = 0.0F;      ///< that speed over strength_m_s(); up to 1 the piece holds
  bool broke_terrain = false;
  bool dents = true;
};

/// The material of a piece at the place of a blow.
Material struck_material(const World::State& state, PieceId piece, glm::vec3 point_m) {
  const Volume& volume = *state.pieces.at(piece);
  if (volume.materials.is_uniform()) return volume.materials.all;
  const Pose pose = state.bodies.state(piece).pose;
  const glm::vec3 off_m = glm::conjugate(pose.rotation) * (point_m - pose.position_m);
  const glm::vec3 at = volume.centre_voxels + off_m / state.config.terrain.voxel_size_m + 0.5F;
  const VoxelBox& box = volume.window.box;
  return volume.materials.at(VoxelCoord{std::clamp(floor_to_int(at.x), box.lo.x, box.hi.x - 1),
                                        std::clamp(floor_to_int(at.y), box.lo.y, box.hi.y - 1),
                                        std::clamp(floor_to_int(at.z), box.lo.z, box.hi.z - 1)});
}

const MaterialRow& struck_row(const World::State& state, const BodyImpact& impact) {
  return struck_row(state, impact.id, impact.point_m);
}

/// The change of speed above which the piece breaks, by what it is of where the blow fell.
float strength_m_s(const World::State& state, const BodyImpact& impact) {
  const float dx = state.config.terrain.voxel_size_m;
  const Volume& volume = *state.pieces.at(impact.id);
  const MaterialRow& row = struck_row(state, impact);
  const float size_m3 = static_cast<float>(volume.mass) / units_per_voxel * dx * dx * dx;
  return row.strength_m_s / power(std::max(size_m3, 0.001F), row.strength_by_size);
}

void sort(std::vector<Blow>& blows) {
  std::ranges::stable_sort(blows, std::ranges::greater{}, &Blow::excess);
}

/// A body bears no more of a blow than the terrain did before it broke.
void lessen(std::vector<Blow>& blows, const std::map<PieceId, float>& borne) {
  for (Blow& blow : blows) {
    const auto part = borne.find(blow.impact.id);
    if (part == borne.end() || blow.impact.other) continue;
    blow.broke_terrain = true;
    blow.impact.impulse_n_s *= part->second;
    blow.centre_m_s *= part->second;
    blow.speed_m_s *= part->second;
    blow.excess *= part->second;
  }
  sort(blows);
}

/// Props, and pieces that bear props, strike the ground as hard as they neared it. By its impulse alone, a
/// wheel under a heavy car would strike in every tick.
class Nearing {
 public:
  explicit Nearing(const World::State& state) : state_(state) {
    if (state.props.empty()) return;
    for (const Carried& carried : state.bodies.contacts().carried)
      if (state.props.contains(carried.upper)) bearing_.insert(carried.lower);
  }

  /// Changes a piece's blow on the ground if the piece bears a prop.
  void correct(Blow& blow) const {
    if (blow.impact.other || !bearing_.contains(blow.impact.id)) return;
    const std::vector<TerrainBlow>& all = state_.bodies.terrain_blows();
    const auto found = std::ranges::lower_bound(all, blow.impact.id, {}, &TerrainBlow::id);
    if (found != all.end() && found->id == blow.impact.id && is_blow(*found))
      blow = blow_on_ground(*found, blow.excess);
    else
      blow.dents = false;
  }

  void add_props(std::vector<Blow>& blows) const {
    for (const TerrainBlow& blow : state_.bodies.terrain_blows())
      if (state_.props.contains(blow.id) && is_blow(blow)) blows.push_back(blow_on_ground(blow, 0.0F));
  }

 private:
  static bool is_blow(const TerrainBlow& blow) { return blow.speed_m_s >= limits::impact_speed_min_m_s; }
  static Blow blow_on_ground(const TerrainBlow& blow, float excess) {
    BodyImpact impact{blow.id, std::nullopt, blow.point_m, blow.normal, blow.impulse_n_s, blow.speed_m_s};
    return {impact, blow.speed_m_s, blow.speed_m_s, excess};
  }

  const World::State& state_;
  std::set<PieceId> bearing_;
};

std::vector<Blow> blows_of(const World::State& state) {
  std::vector<Blow> blows;
  const Nearing nearing(state);
  for (const BodyImpact& impact : state.bodies.impacts(limits::impact_speed_min_m_s)) {
    if (state.props.contains(impact.id)) continue;
    const float centre_m_s = impact.impulse_n_s / state.bodies.mass_kg(impact.id);
    const float speed_m_s = std::sqrt(centre_m_s * impact.give_m_s);
    blows.push_back({impact, centre_m_s, speed_m_s, speed_m_s / strength_m_s(state, impact)});
    nearing.correct(blows.back());
  }
  nearing.add_props(blows);
  sort(blows);
  return blows;
}

/// Seeds of a break of the piece, as far as the limits allow; below 2 the piece stays whole.
uint32_t seeds_for(const World::State& state, const Blow& blow) {
  const Volume& volume = *state.pieces.at(blow.impact.id);
  const MassUnits mass = volume.mass;
  if (state.traits_of(blow.impact.id).generation >= limits::break_generations_max ||
      mass < limits::break_mass_min)
    return 0;
  const float wanted = (1.0F + 2.0F * blow.excess) * struck_row(state, blow.impact).seed_density;
  const auto seeds = static_cast<uint32_t>(std::clamp(wanted, 2.0F, limits::break_seeds_max));
  const auto heavy_enough = static_cast<uint32_t>(mass / limits::break_child_mass_min);
  const size_t others = state.pieces.size() - 1;
  const auto room =
      static_cast<uint32_t>(state.config.pieces_max - std::min<size_t>(others, state.config.pieces_max));
  return std::min({seeds, heavy_enough, room});
}

uint32_t random_seed(const World::State& state, const BodyImpact& impact) {
  const uint32_t which = state.config.rules >= rules::by_place ? number_of_place(impact.point_m) : impact.id;
  return static_cast<uint32_t>(state.tick) * 0x9E3779B1U + which;
}

/// The initial states of the children of a break: the piece's motion at their places, and a push away from
/// the blow. The sum of their momenta is the piece's, up to rounding: the surplus from the pushes, and from
/// the distance between the piece's centre of mass and the children's, is subtracted from all of them alike.
class Breakup {
 public:
  Breakup(const World::State& state, const Blow& blow)
      : parent_(state.bodies.state(blow.impact.id)),
        blow_(blow),
        centre_voxels_(state.pieces.at(blow.impact.id)->centre_voxels),
        dx_(state.config.terrain.voxel_size_m) {}

  void balance(const Applied& applied, const PieceTable& pieces) {
    glm::dvec3 momentum(0.0);
    double mass = 0.0;
    for (const CreatedPiece& child : applied.created) {
      const Volume& volume = *pieces.at(child.id);
      momentum += glm::dvec3(relative_velocity(volume)) * static_cast<double>(volume.mass);
      mass += static_cast<double>(volume.mass);
    }
    if (mass > 0.0) surplus_ = glm::vec3(momentum / mass);
  }

  BodyState child(const Volume& volume) const {
    BodyState state = part_of(parent_, (volume.centre_voxels - centre_voxels_) * dx_);
    state.velocity_m_s += push(volume) - surplus_;
    return state;
  }

  /// The place of the blow in the voxel frame of the piece.
  glm::vec3 impact_voxels() const {
    const glm::vec3 off_m =
        glm::conjugate(parent_.pose.rotation) * (blow_.impact.point_m - parent_.pose.position_m);
    return centre_voxels_ + off_m / dx_;
  }

 private:
  glm::vec3 offset_m(const Volume& volume) const {
    return parent_.pose.rotation * ((volume.centre_voxels - centre_voxels_) * dx_);
  }
  glm::vec3 relative_velocity(const Volume& volume) const {
    return glm::cross(parent_.spin_rad_s, offset_m(volume)) + push(volume);
  }

  /// Away from the blow.
  glm::vec3 push(const Volume& volume) const {
    const glm::vec3 away = parent_.pose.position_m + offset_m(volume) - blow_.impact.point_m;
    const float distance = std::sqrt(glm::dot(away, away));
    return away * (limits::break_push * blow_.speed_m_s / std::max(distance, 0.01F));
  }

  BodyState parent_;
  const Blow& blow_;
  glm::vec3 centre_voxels_;
  float dx_;
  glm::vec3 surplus_{0.0F};
};

SeedPattern break_pattern(const World::State& state, const MaterialRow& row) {
  const SeedPattern pattern = pattern_of(row.breaks, row.axis);
  return is_cut_on(pattern) && state.config.rules < rules::by_place ? SeedPattern::radial : pattern;
}

/// Breaks or dents in one tick: up to a limit, and as far as the tick's budget goes.
struct Quota {
  uint32_t max = 0;
  uint32_t done = 0;

  /// Whether there is room for one more; else counts it as left out.
  bool try_afford(float cost_us, WorkBudget& work, uint32_t& left_out) {
    if (done >= max || !work.affords(cost_us)) {
      ++left_out;
      return false;
    }
    ++done;
    work.spend(cost_us);
    return true;
  }
};

void break_piece(World::State& state, const Blow& blow, Quota& quota, TickDelta& delta) {
  const PieceId id = blow.impact.id;
  CHECK(blow.excess > 1.0F);
  const uint32_t seeds = seeds_for(state, blow);
  if (seeds < 2) return;
  const auto voxels = static_cast<float>(state.pieces.at(id)->window.codes.size());
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels);
  if (!quota.try_afford(cut_price_us(cutter, voxels, seeds), state.work, delta.work.breaks_left_out)) return;
  const MaterialRow& row = struck_row(state, blow.impact);
  const SeedPattern pattern = break_pattern(state, row);
  Breakup breakup(state, blow);
  const PieceTraits parent = state.traits_of(id);
  state.bodies.remove(id);
  const Applied applied =
      state.apply_and_record(ShatterOperation{.piece = id,
                                              .pattern = pattern,
                                              .seeds = seeds,
                                              .random_seed = random_seed(state, blow.impact),
                                              .impact_voxels = breakup.impact_voxels(),
                                              .first_piece = state.next_piece,
                                              .cutter = cutter},
                             parent.owner, delta);
  CHECK_EQ(applied.terrain_gain, 0);
  state.ledger.pieces -= applied.dust;
  state.ledger.dust += applied.dust;
  breakup.balance(applied, state.pieces);
  PieceTraits traits = parent;
  ++traits.generation;
  traits.kept = false;
  const auto born = [&](PieceId, const Volume& volume) { return Newborn{breakup.child(volume), traits}; };
  spawn(state, applied, born, delta);
}

/// Radius r of the ball that takes this volume out of flat ground when its centre is r/4 above it: a cap of
/// height h = ¾ r has the volume π h² (3 r − h) / 3.
float dent_radius_m(float volume_m3) {
  return std::min(cube_root(volume_m3 / 1.325F), limits::dent_radius_max_m);
}

/// The speeds of a dent's pieces: up and sideways, away from the blow. Their energy and their momentum come
/// out of the blow's: of its energy at most limits::dent_energy_share, of its momentum, which is along the
/// normal, at most all; sideways the momenta cancel out.
class Ejecta {
 public:
  Ejecta(const World::State& state, const Blow& blow, const Applied& applied) : state_(state), blow_(blow) {
    glm::vec3 sum(0.0F);
    float mass = 0.0F;
    for (const CreatedPiece& piece : applied.created) {
      const Volume& volume = *state.pieces.at(piece.id);
      sum += sideways(volume) * mass_kg(state, volume);
      mass += mass_kg(state, volume);
    }
    if (mass == 0.0F) return;
    mean_sideways_ = sum / mass;
    float squares = 0.0F;
    for (const CreatedPiece& piece : applied.created) {
      const Volume& volume = *state.pieces.at(piece.id);
      squares += mass_kg(state, volume) * glm::dot(direction(volume), direction(volume));
    }
    const float impulse = blow.impact.impulse_n_s;
    const float by_energy = std::sqrt(limits::dent_energy_share * impulse * blow.centre_m_s / squares);
    speed_m_s_ = std::min({limits::dent_throw * blow.speed_m_s, by_energy, impulse / mass});
  }

  glm::vec3 velocity_m_s(const Volume& volume) const { return direction(volume) * speed_m_s_; }

 private:
  /// Unit, or shorter above the blow.
  glm::vec3 sideways(const Volume& volume) const {
    const glm::vec3 away = volume.centre_voxels * state_.config.terrain.voxel_size_m - blow_.impact.point_m;
    const glm::vec3 part = away - blow_.impact.normal * glm::dot(away, blow_.impact.normal);
    return part / std::max(std::sqrt(glm::dot(part, part)), 0.01F);
  }
  glm::vec3 direction(const Volume& volume) const {
    return sideways(volume) - mean_sideways_ + blow_.impact.normal;
  }

  const World::State& state_;
  const Blow& blow_;
  glm::vec3 mean_sideways_{0.0F};
  float speed_m_s_ = 0.0F;
};

/// The blow's, and what earlier ones left at its place.
float energy_at(World::State& state, const Blow& blow) {
  const float energy_j = 0.5F * blow.impact.impulse_n_s * blow.centre_m_s;
  if (state.config.rules < rules::blows) return energy_j;
  const glm::vec3 at = blow.impact.point_m / state.config.terrain.voxel_size_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
  return state.struck.add(voxel, energy_j, state.tick);
}

void dent_ground(World::State& state, const Blow& blow, Quota& quota, TickDelta& delta) {
  const BodyImpact& impact = blow.impact;
  const float dx = state.config.terrain.voxel_size_m;
  const Material material = material_at(state.field, impact.point_m - impact.normal * dx);
  const float energy_j = energy_at(state, blow);
  const float volume_m3 = energy_j / state.palette->row_or_first(material).dent_resistance_j_m3;
  const uint32_t seeds = limits::dent_seeds;
  if (volume_m3 < limits::dent_voxels_min * dx * dx * dx) return;
  if (state.pieces.size() + seeds > state.config.pieces_max) return;
  const float radius_m = dent_radius_m(volume_m3);
  const CarveOperation operation{
      .shape = sphere(impact.point_m + impact.normal * (0.25F * radius_m), radius_m),
      .pattern = SeedPattern::uniform,
      .seeds = seeds,
      .random_seed = random_seed(state, impact),
      .impact_m = impact.point_m,
      .first_piece = state.next_piece,
      .cutter = cutter_for(state.config.methods.cutter,
                           voxels_of(band_box(in_voxels(sphere(impact.point_m, radius_m), dx))))};
  if (!validate(Operation(operation), state.pieces, state.config.terrain.voxel_size_m))
    return;  // at the world's edge
  if (state.regions.forbidding(forbids::dents, operation.shape) != nullptr) return;
  if (!quota.try_afford(limits::dent_cost_us, state.work, delta.work.dents_left_out)) return;
  const uint64_t owner = state.traits_of(impact.id).owner;
  const Applied applied = state.apply_and_record(operation, owner, delta);
  state.enter_removed(applied);
  const Ejecta ejecta(state, blow, applied);
  const auto thrown = [&](PieceId, const Volume& volume) {
    Newborn piece;
    piece.body.pose.position_m = volume.centre_voxels * dx;
    piece.body.velocity_m_s = ejecta.velocity_m_s(volume);
    piece.traits = {.generation = limits::break_generations_max, .owner = owner};
    return piece;
  };
  spawn(state, applied, thrown, delta);
}

}  // namespace

const MaterialRow& struck_row(const World::State& state, PieceId piece, glm::vec3 point_m) {
  return state.palette->row_or_first(struck_material(state, piece, point_m));
}

void apply_impacts(World::State& state, TickDelta& delta) {
  if (!state.config.methods.impacts && !state.config.methods.dents) return;
  Quota breaks{limits::breaks_per_tick_max};
  Quota dents{limits::dents_per_tick_max};
  std::vector<Blow> blows = blows_of(state);
  lessen(blows, break_terrain(state, delta));
  TurnQueue<WaitingWork>& turns = state.turns.blows;
  for (size_t i = 0; i < blows.size(); ++i) turns.push(state.party_of(blows[i].impact.id), {i});
  turns.begin_tick();
  while (!turns.empty()) {
    const Blow& blow = blows[turns.next().index];
    const bool on_terrain = !blow.impact.other.has_value();
    const float left_us = state.work.left_us();
    if (state.config.methods.dents && on_terrain && blow.dents && !blow.broke_terrain)
      dent_ground(state, blow, dents, delta);
    if (state.config.methods.impacts && blow.excess > 1.0F) break_piece(state, blow, breaks, delta);
    turns.pop(left_us - state.work.left_us());
  }
}

}  // namespace scree
