// Bounds that server and client share, each with its unit, its reason, and the behaviour at the bound.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Ticks a second. Below, a click is answered so late that it seems lost; above, a tick's work does not fit
/// into its time. Refused where a world is created, and in a server's welcome.
inline constexpr uint32_t tick_rate_min_hz = 10;
inline constexpr uint32_t tick_rate_max_hz = 1000;

/// Seeds in one carve: a request makes at most 4,096 pieces, of which each costs the tick its hull and body.
/// Above: refused.
inline constexpr uint32_t seeds_max = 4096;

/// Authored seeds in one carve: 12 bytes each on the wire, to every client near. Above: refused.
inline constexpr uint32_t authored_seeds_max = 256;

/// Reach (half the longest extent) of one carve or fill, metres. Cost grows with its cube; above: refused.
inline constexpr float edit_reach_max_m = 8.0F;

/// The same in voxels, which counts where voxels are finer than 0.148 m (edit_reach.h): a box of it fits
/// window_side_max, and becomes terrain again within stamp_voxels_max. Above: refused.
inline constexpr float edit_reach_max_voxels = 54.0F;

/// Smallest reach of an edit, metres: half a default voxel; below, nothing would change. Refused.
inline constexpr float edit_reach_min_m = 0.125F;

/// By so much a reach may miss its bounds, metres: near the world's edge the ends of a capsule are rounded to
/// multiples of 2^-11 m.
inline constexpr float edit_reach_rounding_m = 1.0F / 2048.0F;

/// Speed that a carve gives its pieces, metres a second. A piece must not cross the narrow band in one tick.
inline constexpr float blast_speed_max_m_s = 30.0F;

/// Half extents of the world, metres, around the origin. Positions must fit quantised poses and float voxels;
/// edits beyond are refused, pieces beyond become dust.
inline constexpr float world_half_width_m = 4096.0F;
inline constexpr float world_half_height_m = 512.0F;

/// Samples along a side of an elevation model, the distance of two, metres, and how high they may lie,
/// metres: the largest spans a world, and its heights leave room for what flies up. Above: refused.
inline constexpr int height_samples_max = 32768;
inline constexpr float height_cell_min_m = 0.25F;
inline constexpr float height_cell_max_m = 1000.0F;
inline constexpr float height_max_m = 480.0F;

/// Voxels along a side of an edit's window; bounds the memory that bytes off a wire can make us allocate.
inline constexpr int window_side_max = 128;

/// Voxels of the window around a piece that becomes terrain: their mass fits an int, and memory is bounded.
/// The largest carve (edit_reach_max_voxels) stays below, however it turned, by stamp and slices; the ball of
/// the method sphere may not, and the world stamps such a piece instead. Above: refused.
inline constexpr size_t stamp_voxels_max = size_t{1} << 23;

/// Voxel sizes that a world may have, metres. Below, an edit would reach less than 5 m, and the mass of the
/// largest world come near ledger_mass_max; above, a piece would be coarser than anything it lies on. Refused
/// where a world is created.
inline constexpr float voxel_size_min_m = 0.1F;
inline constexpr float voxel_size_max_m = 2.0F;

/// Bytes of one message on the wire, either way. Above: the connection is refused.
inline constexpr size_t message_bytes_max = size_t{1} << 20;

/// Settings in one request to change them, and in a status: those of the table and material_settings_max. The
/// length of a name, of which "material.", a row and a member take 59 at most, and of a value, bytes. Above:
/// refused.
inline constexpr size_t settings_max = 128;
inline constexpr size_t setting_name_bytes_max = 64;
inline constexpr size_t setting_value_bytes_max = 64;

/// Numbers of a palette that administrators have changed while the world ran: every status lists them. Above:
/// refused; the palette's file has room for all.
inline constexpr size_t material_settings_max = 96;

/// Length of the token that lets a client change settings, bytes. Shorter ones could be guessed; both are
/// refused.
inline constexpr size_t token_bytes_min = 8;
inline constexpr size_t token_bytes_max = 128;
/// A file of keys or certificates (PEM), bytes.
inline constexpr size_t pem_bytes_max = size_t{1} << 20;

/// Lines of one kind in a log, a second and at once, where the other side of a connection causes them; above:
/// counted (log_limit.h).
inline constexpr double log_lines_per_second = 2.0;
inline constexpr double log_lines_burst = 8.0;

/// Radius of interest that a client may ask for, metres; more is cut to this.
inline constexpr float interest_radius_max_m = 256.0F;

/// Bytes of generated chunks kept in memory by a field, unless it is given a lower bound: 0.6 KiB for a chunk
/// of air or rock, some 10 KiB for one with a surface. Above: those that were not used lately are dropped,
/// and made anew on demand.
inline constexpr size_t generated_bytes_max = size_t{64} << 20U;
/// The materials of unedited bricks that a field keeps once it was asked for them, bytes; beyond, it forgets
/// them and computes them again.
inline constexpr size_t ground_materials_bytes_max = size_t{16} << 20U;

/// Smallest mass of a piece, units of 1/254 voxel: two voxels. Smaller cells join their largest neighbour.
inline constexpr int64_t piece_mass_min = 2 * 254;

/// Pieces that merge in one pass; the longest side of each one's volume, voxels; and how far from the first
/// they may lie along each axis, metres: with the smallest voxels all of it fits window_side_max. Above: they
/// merge one by one; off a wire: refused.
inline constexpr size_t stamp_group_max = 16;
inline constexpr int stamp_group_side_max_voxels = 32;
inline constexpr float stamp_group_reach_max_m = 3.0F;

/// Bricks along a side of an island's piece: with its shell, and room to redistance in, it fits
/// window_side_max. What is longer falls in several.
inline constexpr int island_side_max_bricks = 14;

}  // namespace scree::limits
