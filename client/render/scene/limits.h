// Bounds of drawing. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

#include "shared/base/limits.h"

namespace scree::limits {

/// Radius within which terrain is drawn, metres: at least one chunk, at most the interest that a server
/// grants. Other values are refused by the viewer's options.
inline constexpr float view_radius_min_m = 8.0F;
inline constexpr float view_radius_max_m = interest_radius_max_m;

/// Drawn terrain may reach beyond the radius of loading by this factor: it is dropped later than it was
/// loaded.
inline constexpr float view_radius_hysteresis = 1.15F;

/// Chunks being generated at any moment: work for the threads through a slow frame. Edits overtake them. The
/// rest waits, nearest first, and is chosen again when the camera has moved.
inline constexpr size_t chunks_generating_max = 96;

/// Waiting chunks looked at in one frame: bounds the main thread's part (about 0.3 ms).
inline constexpr size_t chunks_examined_max = 192;

/// Levels of detail of the meshes: cells of 8 m at voxels of 25 cm.
inline constexpr int mesh_levels_max = 6;

/// Nodes that are split or joined in one batch. In many small batches the same borders between levels would
/// be meshed again and again; as it is, one batch takes in all that a moving eye asks for, and a new world a
/// batch a level. The rest waits for the next batch.
inline constexpr size_t forest_steps_max = 4096;

/// No terrain is generated higher than this, metres: meshes begin below it, except around the eye.
inline constexpr float terrain_top_m = 64.0F;

/// Threads that generate and mesh. Two keep a viewer fluent beside a server on a small machine; more than
/// four find nothing to do.
inline constexpr unsigned worker_threads_max = 4;

/// Texels along a side of the shadow map, 16 MiB at 32 bits; over 96 m that is 5 cm a texel.
inline constexpr int shadow_map_side = 2048;

/// Pixels along a side of an offscreen image; a larger --size is refused.
inline constexpr int image_side_max = 8192;

/// Texels along a side of the raymarcher's atlas, 128 MiB at the most; less where the driver's textures are
/// smaller. A coarser level shows the bricks that do not fit.
inline constexpr int atlas_side_max = 512;

/// Texels along the third side of an atlas of looks or planes: 28³ bricks, 32 or 64 MiB. It begins small. A
/// brick that does not fit looks as one of its voxels does, or has rounded edges.
inline constexpr int corner_atlas_depth_max = 256;

/// Bricks with a surface in a column of a level's window that the atlas has room for. The rough open terrain
/// has 6 on the finest level and fewer on the others.
inline constexpr size_t bricks_per_column = 6;

/// Chunks that the raymarcher reads in one frame, on the main thread: bounds its part to some milliseconds.
inline constexpr size_t chunks_read_max = 64;

/// Pixels along a side of a material's image on the GPU, to which others are resampled: 2 mm where an image
/// covers a metre. With mipmaps it takes 1.3 MiB there.
inline constexpr int material_image_side = 512;

/// Images that are drawn of a palette, 86 MiB. Above: those of later rows are left out, and their colours
/// show.
inline constexpr size_t material_images_max = 64;

/// Pixels marched for one that is shown, along a side. Below, pictures are mush; above, four samples a pixel
/// are averaged and more would not be.
inline constexpr float render_scale_min = 0.25F;
inline constexpr float render_scale_max = 2.0F;

/// Distance up to which far terrain is drawn, in view radii.
inline constexpr float horizon_per_view_radius = 8.0F;

/// Distance from the eye up to which joints are drawn, metres: farther, a rope is thinner than a pixel.
inline constexpr float joints_seen_m = 80.0F;

/// Lines over a picture: 1,000 pieces' hulls, and margin. More are left out.
inline constexpr size_t lines_max = 100000;

/// Particles of dust, grit and splinters at once: several blasts, 170 KiB a frame to the GPU. Above: the
/// oldest end.
inline constexpr size_t particles_max = 6000;

/// Stones are drawn in front of terrain that is so little nearer to the eye: rubble takes 1.6 times the room
/// of its stones, so what a merge made lies about them.
inline constexpr float stone_lift_voxels = 0.9F;

/// Stones that stay where pieces merged: about thirty strikes' worth. The farthest end first.
inline constexpr size_t settled_stones_max = 1500;
/// Voxels of their volumes, all together, which a hostile server could fill memory with; likewise.
inline constexpr size_t settled_voxels_max = size_t{1} << 26;

/// Pieces that darken what they lie on: as many as a blast makes, and margin. The nearest are taken.
inline constexpr size_t contacts_max = 1024;

/// Bytes of the models of props, on the GPU and beside it: thirty of the largest. Above: those that no prop
/// in sight has are forgotten, and of others the parts are drawn.
inline constexpr size_t model_meshes_bytes_max = size_t{128} << 20;

/// Models that were read, or could not be: more are forgotten likewise.
inline constexpr size_t models_known_max = 1024;

/// Distance up to which grass and stones lie about, in chunks: 1,400 patches, 5 MiB. Farther, with small
/// voxels, there are none.
inline constexpr float detail_range_chunks_max = 6.0F;

/// Patches of them that one frame scatters, and details that it lights: bound the main thread's part (about
/// 0.5 ms). The rest waits, nearest first.
inline constexpr size_t detail_patches_a_frame = 2;
inline constexpr size_t details_lit_a_frame = 64;

}  // namespace scree::limits
