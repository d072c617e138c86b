// Lists of a world's bodies and joints, for directors and administrators. proto/access.proto specifies them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "shared/field/piece.h"
#include "shared/prop/joint.h"
#include "shared/prop/prop.h"

namespace scree {

/// A box along the world's axes, metres.
struct PlacesWithin {
  glm::vec3 lo_m{0.0F}, hi_m{0.0F};

  bool operator==(const PlacesWithin&) const = default;
};

/// The pieces and props whose places lie in the box.
struct ListBodiesRequest {
  std::optional<PlacesWithin> within{};  ///< nothing: everywhere
  std::vector<PieceId> ids{};            ///< these alone, limits::bodies_named_max at most; none: all
};

/// The joints of which a side's place lies in the box.
struct ListJointsRequest {
  std::optional<PlacesWithin> within{};  ///< nothing: everywhere
};

/// A piece or a prop as it is in the tick that was published last.
struct BodyRow {
  PieceId id = 0;
  bool is_prop = false;
  PropMotion motion = PropMotion::dynamic;  ///< of a prop
  bool kept = false;                        ///< a piece that never becomes terrain until it is released
  QuantisedPose pose;
  glm::vec3 velocity_m_s{0.0F};  ///< by its last two published places
  float mass_kg = 0.0F;          ///< 0: unknown, where a server has no palette
  uint64_t tag = 0;              ///< of a prop

  bool operator==(const BodyRow&) const = default;
};

}  // namespace scree
