// Bounds of imports. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Samples along a side of a raster that is imported: a row of it is kept several times. Above: refused.
inline constexpr int raster_side_max = 1 << 17;

/// A height in a raster, metres, after its scale: twice the deepest sea. What is more is no height in metres.
/// Above: refused.
inline constexpr double raster_height_max_m = 25'000.0;

/// Warnings of GDAL on one raster that are shown; more are left out.
inline constexpr size_t raster_warnings_max = 5;

/// Text of a raster's file in a message, bytes: a line on a terminal or two. More is cut off.
inline constexpr size_t raster_text_bytes_max = 240;

/// Sentences on one raster. Above: its reader counts as broken.
inline constexpr unsigned raster_said_max = 64;

/// Rasters of a file, or files of an archive, that a message names; more are counted.
inline constexpr size_t raster_names_max = 12;

/// Files of an archive that are examined. Above: refused.
inline constexpr size_t archive_files_max = 4096;

/// Bytes of a file that is unpacked from an archive, because its library reads none. Above: refused.
inline constexpr uint64_t unpacked_bytes_max = uint64_t{1} << 30U;

/// The ground of a raster ends where the raster does within this part: closer samples make it so, up to so
/// many in the place of one. Beyond: the ground is longer, and continues the heights at the edge. Its scale
/// is true, but where each sample is a cell: cells that differ from the samples by less are stretched.
inline constexpr double extent_error_max = 0.005;
inline constexpr int sample_parts_max = 8;

/// Stored numbers beyond this size, of either sign, are no heights in any unit: they fill cells without data.
inline constexpr double raster_fill_min = 1.0e15;

/// An extreme value that is this far from the next one, metres, and looks like a number that fills cells
/// without data, is refused unless the command line says whether it is a height. Cliffs are lower.
inline constexpr double undeclared_gap_m = 500.0;

/// Height between the lowest and the highest sample up to which the lowest lies at y = 0, metres; a higher
/// model's middle does.
inline constexpr double relief_at_zero_max_m = 448.0;

/// Stored chunks of one import: they lie in memory, 12 KiB each as a rule. Above: refused.
inline constexpr size_t import_chunks_max = size_t{1} << 17;

/// Chunks that a solid's surface touches; of a mesh, each counted once for each triangle that does. Above:
/// refused.
inline constexpr size_t solid_surface_max = size_t{1} << 22;

/// Triangles of one file, and points: 4 GiB of memory. Above: refused.
inline constexpr size_t import_triangles_max = size_t{1} << 26;

/// Bricks of 8 voxels a side in an OpenVDB grid, 8 GiB of floats; and its tiles. Above: refused.
inline constexpr uint64_t import_leaves_max = uint64_t{1} << 22;

/// Parts of one mesh that have holes: each is asked for winding numbers by itself. As many open sheets are
/// filled down: their walls cross each other, and take long. Above: refused.
inline constexpr size_t import_open_parts_max = 4096;

/// Levels of brackets, elements, records and nodes in a file of a scene: assimp goes down into them by
/// recursion, and its stack holds some ten thousand. Skeletons have some hundred. Above: refused.
inline constexpr size_t scene_nesting_max = 512;

/// Nodes of a scene: each takes some hundred bytes, and where one is the child of several it counts for each.
/// Above: refused.
inline constexpr uint64_t scene_nodes_max = uint64_t{1} << 20U;

/// Corners of a polygon that is made triangles: assimp's time grows with the square, 5 s for as many. Above:
/// refused.
inline constexpr size_t polygon_corners_max = 10'000;

/// The squares of the polygons' corners, in all. Above: refused.
inline constexpr uint64_t polygon_work_max = uint64_t{4} * polygon_corners_max * polygon_corners_max;

/// Rows of a palette that the colours of a mesh become without --palette: pictures have thousands.
inline constexpr size_t mesh_colour_rows = 32;

/// Cells of a raster of land cover, a byte each. Above: refused.
inline constexpr uint64_t cover_cells_max = uint64_t{1} << 28U;

/// Bytes of a --material-map: some thousand lines. Above: refused.
inline constexpr size_t material_map_bytes_max = size_t{1} << 18;

/// Materials of a scene that are none of the palette's, and may become rows of it; and the colours that their
/// pictures have, each of 15 bits. More have no colour.
inline constexpr size_t scene_materials_max = 65'000;

/// Pixels and bytes of a picture that gives a mesh its colours: 8192 a side. Above: it counts as not there.
inline constexpr uint64_t picture_pixels_max = uint64_t{1} << 26U;
inline constexpr uint64_t picture_bytes_max = uint64_t{1} << 28U;

/// Pixels along a side of a preview.
inline constexpr int preview_side_max = 1024;

}  // namespace scree::limits
