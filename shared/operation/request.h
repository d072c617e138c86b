// What clients ask for: the world answers a request by operations, or by a refusal. Plain values; a request
// is untrusted until World::step has validated it. Lengths in metres.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "shared/base/overloaded.h"
#include "shared/base/setting_value.h"
#include "shared/field/shape.h"
#include "shared/fracture/seed_pattern.h"
#include "shared/material/material.h"

namespace scree {

struct CarveRequest {
  Shape shape;
  SeedPattern pattern = usual_pattern;
  uint32_t seeds = 32;
  uint32_t random_seed = 0;
  glm::vec3 impact_m{0.0F};  ///< place of the blow; pieces fly out towards it
  float blast_speed_m_s = 6.0F;
  std::vector<glm::vec3> authored_m{};  ///< as many as seeds when the pattern needs points; else none

  bool operator==(const CarveRequest&) const = default;
};

struct FillRequest {
  Shape shape;
  std::optional<Material> material{};  ///< nothing: as FillOperation says

  bool operator==(const FillRequest&) const = default;
};

/// The rock in the shape becomes this material, voxel by voxel.
struct PaintRequest {
  Shape shape;
  Material material = material::rock;

  bool operator==(const PaintRequest&) const = default;
};

/// Changes how the simulation goes on (server/world/settings.h): all of them, or none.
struct SettingsRequest {
  SettingValues settings;

  bool operator==(const SettingsRequest&) const = default;
};

/// The session cannot go on: its requests that still wait are dropped. Asked for by the network side, never
/// by a client, and not answered.
struct LeaveRequest {
  bool operator==(const LeaveRequest&) const = default;
};

using Request = std::variant<CarveRequest, FillRequest, PaintRequest, SettingsRequest, LeaveRequest>;

/// The shape of a request that edits terrain; null: it edits none.
inline const Shape* shape_of(const Request& request) {
  return std::visit(Overloaded{[](const CarveRequest& carve) { return &carve.shape; },
                               [](const FillRequest& fill) { return &fill.shape; },
                               [](const PaintRequest& paint) { return &paint.shape; },
                               [](const SettingsRequest&) { return static_cast<const Shape*>(nullptr); },
                               [](const LeaveRequest&) { return static_cast<const Shape*>(nullptr); }},
                    request);
}

}  // namespace scree
