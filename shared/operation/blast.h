// What a blast's energy breaks. Server and clients reckon alike. Metres, joules.
#pragma once

#include <algorithm>

#include "shared/base/edit_reach.h"
#include "shared/base/limits.h"
#include "shared/base/roots.h"
#include "shared/material/palette.h"

namespace scree {

/// Energy that it takes to throw out a cubic metre of loose ground, and the share of a material's hardness
/// (MaterialRow::dent_resistance_j_m3) that it takes besides to break it. So a kilogram of TNT, 4.2 MJ, makes
/// a crater of 2 m³ in soil and of 0.6 m³ in rock. Benches of rock, which break to the open side, need
/// 0.3 to 0.6 kg of explosive a cubic metre (P. Darling, ed., SME Mining Engineering Handbook, 2011, 9.2).
inline constexpr float blast_loosening_j_m3 = 2e6F, blast_hardness_share = 0.1F;

/// The energy of blasts, joules: of a gram, and of five tonnes of TNT. Beyond: refused.
inline constexpr float blast_energy_min_j = 4e3F, blast_energy_max_j = 2e10F;

inline float breaking_j_m3(const MaterialRow& row) {
  return blast_loosening_j_m3 + blast_hardness_share * row.dent_resistance_j_m3;
}

/// Radius of the half ball of that volume.
inline float half_ball_radius_m(float volume_m3) {
  return cube_root(volume_m3 * 0.47746483F);  // 3 / 2π
}

inline bool is_blast_energy(float energy_j) {
  return energy_j >= blast_energy_min_j && energy_j <= blast_energy_max_j;
}

/// The farthest that a blast breaks anything: the radius of its crater in loose ground. An energy that no
/// blast has, as of the least.
inline float blast_reach_m(float energy_j) {
  const float sound_j = is_blast_energy(energy_j) ? energy_j : blast_energy_min_j;
  return std::clamp(half_ball_radius_m(sound_j / blast_loosening_j_m3), 2.0F * limits::edit_reach_min_m,
                    limits::edit_reach_max_m);
}
/// Likewise in voxels of this size: no farther than an edit reaches.
inline float blast_reach_m(float energy_j, float voxel_size_m) {
  return std::min(blast_reach_m(energy_j), greatest_edit_reach_m(voxel_size_m));
}

/// Pieces that a blast makes at most.
inline uint32_t pieces_of_blast(float energy_j) {
  if (!is_blast_energy(energy_j)) return 0;
  return static_cast<uint32_t>(std::clamp(8.0F + energy_j / 2e6F, 8.0F, 160.0F));
}

}  // namespace scree
