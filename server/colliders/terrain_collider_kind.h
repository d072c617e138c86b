// The ways in which bodies find the terrain; terrain_collider.h describes each.
#pragma once

#include <cstdint>
#include <string_view>

namespace scree {

enum class TerrainColliderKind : uint8_t { field, mesh, rays };

struct TerrainColliderRow {
  std::string_view name;
};

constexpr TerrainColliderRow row_of(TerrainColliderKind kind) {
  switch (kind) {
    case TerrainColliderKind::field:
      return {.name = "field"};
    case TerrainColliderKind::mesh:
      return {.name = "mesh"};
    case TerrainColliderKind::rays:
      return {.name = "rays"};
  }
  return {};
}

}  // namespace scree
