// Names in the OpenVDB files that export writes and import reads.
#pragma once

namespace scree::vdb_names {

inline constexpr const char* surface = "surface";  ///< the level set
inline constexpr const char* material =
    "material";  ///< rows of a palette, where the ground or paint says one

/// Metadata of the grid of materials: the palette's names in order, a line each; and its bytes
/// (proto/palette_codec.h) in hexadecimal digits.
inline constexpr const char* material_names = "material_names";
inline constexpr const char* palette = "scree_palette";

/// Metadata of the level set: floats in metres, and the box of chunks that it has all of.
inline constexpr const char* voxel_size_m = "scree_voxel_size_m";
inline constexpr const char* level_m = "scree_level_m";
inline constexpr const char* soil_below_m = "scree_soil_below_m";
inline constexpr const char* ice_above_m = "scree_ice_above_m";
inline constexpr const char* chunks_lo = "scree_chunks_lo";
inline constexpr const char* chunks_hi = "scree_chunks_hi";

}  // namespace scree::vdb_names
