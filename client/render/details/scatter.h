// What stands on the ground as generated, by its place alone: grass and bushes where client/shaders/rock.glsl
// draws scrub, stones on sand and on ledges. Pure, but that fields keep what they read.
#pragma once

#include <optional>
#include <vector>

#include "client/render/details/detail.h"
#include "shared/field/field.h"

namespace scree {

struct PlacedDetail {
  Detail detail;
  DetailKind kind = DetailKind::grass;
  VoxelCoord cell;     ///< whose eight voxels have the surface between them
  bool stands = true;  ///< nobody has changed the ground there
};

/// Whether the field can tell what stands in a chunk without generating ground.
bool can_scatter(const Field& field, ChunkCoord chunk);

/// What stands on the ground that begins in the chunk, the farthest seen first. Only where can_scatter().
std::vector<PlacedDetail> scatter_details(const Field& field, ChunkCoord chunk);

/// Sets which of them stand: the ground about them has the codes that were generated, and looks so. True:
/// any changed.
bool check_standing(const Field& field, ChunkCoord chunk, std::vector<PlacedDetail>& placed);

/// Sets the light that reaches it past the field, as far as that is there without generating. True: changed.
bool light_detail(const Field& field, glm::vec3 sun, PlacedDetail& placed);

}  // namespace scree
