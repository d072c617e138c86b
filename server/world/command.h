// The requests of clients to the world. A request is untrusted until World::step() has validated it.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "shared/base/setting_value.h"
#include "shared/field/material.h"
#include "shared/field/shape.h"
#include "shared/fracture/voronoi.h"

namespace scree {

struct CarveRequest {
  Shape shape;
  SeedPattern pattern = SeedPattern::radial;
  uint32_t seeds = 32;
  uint32_t random_seed = 0;
  glm::vec3 impact_m{0.0F};  ///< place of the blow; pieces fly out towards it
  float blast_speed_m_s = 6.0F;
  std::vector<glm::vec3> authored_m{};  ///< as many as seeds when the pattern needs points; else none

  bool operator==(const CarveRequest&) const = default;
};

struct FillRequest {
  Shape shape;

  bool operator==(const FillRequest&) const = default;
};

/// The bricks of the shape become this material.
struct PaintRequest {
  Shape shape;
  Material material = Material::rock;

  bool operator==(const PaintRequest&) const = default;
};

/// Changes settings of the simulation (server/world/settings.h): all of them, or none.
struct SettingsRequest {
  SettingValues settings;

  bool operator==(const SettingsRequest&) const = default;
};

struct Command {
  uint64_t session = 0;  ///< session of the client; 0: the server itself
  uint32_t request = 0;  ///< the client's number of the request, returned in the reply
  std::variant<CarveRequest, FillRequest, PaintRequest, SettingsRequest> body;

  bool operator==(const Command&) const = default;
};

}  // namespace scree
