// The ways in which bodies find the terrain; terrain_collider.h describes each.
#pragma once

#include <cstdint>

namespace scree {

enum class TerrainColliderKind : uint8_t { field, mesh, rays };

}  // namespace scree
