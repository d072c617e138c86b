#include "server/world/explosion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "server/world/ejecta.h"
#include "server/world/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/roots.h"
#include "shared/field/edit.h"
#include "shared/field/material_window.h"

namespace scree {

namespace {

/// Energy of a kilogram of TNT, and the impulse of its wave on a square metre a metre away.
constexpr float tnt_j_kg = 4.184e6F, wave_pa_s = 200.0F;
/// What is nearer gets no more: the wave's law does not hold there.
constexpr float nearest_m = 0.5F;
/// Bodies whose speed the wave would change by less are left alone.
constexpr float thrown_min_m_s = 0.1F;
/// Area of a body's face, as a share of the square of its reach: that of a cube.
constexpr float face_share = 4.0F / 3.0F;
/// Rock so thick lets half of the impulse pass, and twice as much a fifth.
constexpr float shield_m = 0.5F;
/// The speed that the wave gives at most.
constexpr float thrown_max_m_s = 60.0F;
/// Share of the energy that becomes motion of the rock that breaks.
constexpr float thrown_share = 0.05F;

/// Places on the way between two places where rock_between_m() looks.
int steps_between(glm::vec3 way_m, float voxel_size_m, int coarser) {
  const float length_m = std::sqrt(glm::dot(way_m, way_m));
  return std::max(1, static_cast<int>(2.0F * length_m / voxel_size_m) / coarser);
}

/// Metres of rock on the way between two places, by samples that lie so many times half a voxel apart.
float rock_between_m(const Field& field, glm::vec3 from_m, glm::vec3 to_m, int coarser) {
  const float dx = field.source().voxel_size_m;
  const glm::vec3 way_m = to_m - from_m;
  const float length_m = std::sqrt(glm::dot(way_m, way_m));
  const int steps = steps_between(way_m, dx, coarser);
  int inside = 0;
  for (int i = 0; i < steps; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(steps);
    inside += sample(field, (from_m + way_m * share) / dx).distance_voxels < 0.0F ? 1 : 0;
  }
  return length_m * static_cast<float>(inside) / static_cast<float>(steps);
}

/// What rock a shell about the centre holds.
struct Shell {
  float energy_j = 0.0F;
  float volume_m3 = 0.0F;
};

/// Shells of half a voxel.
std::vector<Shell> shells_of(const World::State& state, const BlastRequest& blast) {
  const float dx = state.config.terrain.voxel_size_m, reach_m = blast_reach_m(blast.energy_j, dx);
  const Window codes = gather(state.field, band_box(in_voxels(sphere(blast.centre_m, reach_m), dx)));
  const MaterialReader materials(state.field, codes.box);
  std::vector<Shell> shells(static_cast<size_t>(2.0F * reach_m / dx) + 1);
  const glm::vec3 centre = blast.centre_m / dx;
  const float voxel_m3 = dx * dx * dx;
  for (int x = codes.box.lo.x; x < codes.box.hi.x; ++x)
    for (int y = codes.box.lo.y; y < codes.box.hi.y; ++y)
      for (int z = codes.box.lo.z; z < codes.box.hi.z; ++z) {
        if (codes.at(x, y, z) >= 0) continue;
        const glm::vec3 off = glm::vec3(x, y, z) - centre;
        const auto shell = static_cast<size_t>(2.0F * std::sqrt(glm::dot(off, off)));
        if (shell >= shells.size()) continue;
        shells[shell].energy_j +=
            voxel_m3 * breaking_j_m3(state.palette->row_or_first(materials.at({x, y, z})));
        shells[shell].volume_m3 += voxel_m3;
      }
  return shells;
}

}  // namespace

std::optional<float> blast_radius_m(const World::State& state, const BlastRequest& blast) {
  const float half_voxel_m = 0.5F * state.config.terrain.voxel_size_m;
  float spent_j = 0.0F, volume_m3 = 0.0F, radius_m = 0.0F;
  bool breaks = false;
  for (const Shell& shell : shells_of(state, blast)) {
    if (shell.energy_j > 0.0F) {
      const float mean_j_m3 = (spent_j + shell.energy_j) / (volume_m3 + shell.volume_m3);
      if (radius_m > half_ball_radius_m(blast.energy_j / mean_j_m3)) break;
      const float share = (blast.energy_j - spent_j) / shell.energy_j;
      if (share < 1.0F) {
        radius_m += half_voxel_m * std::max(share, 0.0F);
        breaks = true;
        break;
      }
      spent_j += shell.energy_j;
      volume_m3 += shell.volume_m3;
      breaks = true;
    }
    radius_m += half_voxel_m;
  }
  if (!breaks) return std::nullopt;
  const float least_m = std::max(limits::edit_reach_min_m,
                                 limits::request_reach_min_voxels * state.config.terrain.voxel_size_m);
  return std::clamp(radius_m, least_m, greatest_edit_reach_m(state.config.terrain.voxel_size_m));
}

CarveRequest carve_of(const BlastRequest& blast, float radius_m, uint32_t seeds, uint32_t by_rules) {
  CarveRequest carve;
  carve.shape = sphere(blast.centre_m, radius_m);
  carve.seeds = seeds;
  carve.random_seed = blast.random_seed;
  carve.impact_m = blast.centre_m;
  const float mass_kg = 2600.0F * blast.energy_j / (blast_loosening_j_m3 + blast_hardness_share * 5e7F);
  carve.blast_speed_m_s =
      std::min(std::sqrt(2.0F * thrown_share * blast.energy_j / mass_kg), limits::blast_speed_max_m_s);
  if (by_rules >= rules::ejecta)
    carve.blast_speed_m_s = std::min(carve.blast_speed_m_s, ejecta_speed_m_s(radius_m));
  return carve;
}

namespace {

/// A body that the wave throws, were there no rock between.
struct Reached {
  PieceId id = 0;
  glm::vec3 off_m{0.0F};
  float away_m = 0.0F;
  float impulse_n_s = 0.0F;
};

std::vector<Reached> reached_by(const World::State& state, const BlastRequest& blast, float at_a_metre) {
  const float reach_m = std::clamp(at_a_metre / 20.0F, 4.0F, 100.0F);
  std::vector<Reached> all;
  for (const PieceId id : state.bodies.near(blast.centre_m - reach_m, blast.centre_m + reach_m)) {
    const glm::vec3 off_m = state.bodies.state(id).pose.position_m - blast.centre_m;
    const float away_m = std::sqrt(glm::dot(off_m, off_m));
    const float body_m = state.bodies.reach_m(id), mass_kg = state.bodies.mass_kg(id);
    if (away_m > reach_m + body_m) continue;
    float impulse_n_s = at_a_metre / std::max(away_m, nearest_m) * face_share * body_m * body_m;
    impulse_n_s = std::min(impulse_n_s, thrown_max_m_s * mass_kg);
    if (impulse_n_s >= thrown_min_m_s * mass_kg) all.push_back({id, off_m, away_m, impulse_n_s});
  }
  return all;
}

}  // namespace

void throw_bodies(World::State& state, const BlastRequest& blast) {
  const float kg = blast.energy_j / tnt_j_kg, root = cube_root(kg);
  const float dx = state.config.terrain.voxel_size_m;
  const std::vector<Reached> all = reached_by(state, blast, wave_pa_s * root * root);
  size_t samples = 0;
  for (const Reached& one : all) samples += static_cast<size_t>(steps_between(one.off_m, dx, 1));
  const auto coarser = static_cast<int>(1 + samples / limits::blast_rock_samples_max);
  for (const Reached& one : all) {
    const float rock =
        rock_between_m(state.field, blast.centre_m, blast.centre_m + one.off_m, coarser) / shield_m;
    const float impulse_n_s = one.impulse_n_s / (1.0F + rock * rock);
    if (impulse_n_s < thrown_min_m_s * state.bodies.mass_kg(one.id)) continue;
    const glm::vec3 way = one.away_m > 1e-3F ? one.off_m / one.away_m : glm::vec3(0.0F, 1.0F, 0.0F);
    state.bodies.push(one.id, way * impulse_n_s, blast.centre_m + one.off_m);
  }
}

}  // namespace scree
