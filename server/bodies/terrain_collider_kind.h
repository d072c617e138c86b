// The ways in which bodies find the terrain. See terrain_collider.h for what each does.
#pragma once

#include <cstdint>

namespace scree {

enum class TerrainColliderKind : uint8_t { field, mesh, rays };

}  // namespace scree
