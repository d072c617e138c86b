// Props: rigid bodies that a game adds to a world, such as crates, balls, and the parts of a car. Plain
// values: a prop never changes while it lives, but for its motion. One that comes from outside is untrusted
// until validate() has passed it. Metres, kilograms.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/ids.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"
#include "shared/material/material.h"

namespace scree {

enum class PropPartKind : uint8_t { box = 0, sphere = 1, capsule = 2, cylinder = 3, hull = 4 };

struct PropPartRow {
  std::string_view name;
};

constexpr PropPartRow row_of(PropPartKind kind) {
  switch (kind) {
    case PropPartKind::box:
      return {"box"};
    case PropPartKind::sphere:
      return {"sphere"};
    case PropPartKind::capsule:
      return {"capsule"};
    case PropPartKind::cylinder:
      return {"cylinder"};
    case PropPartKind::hull:
      return {"hull"};
  }
  return {};
}

/// A convex part of a prop. Its own axes are turned by `turn`, and its origin lies at `place_m` in the
/// prop's.
struct PropPart {
  PropPartKind kind = PropPartKind::box;
  glm::vec3 place_m{0.0F};
  glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
  /// box: half of its sides. sphere: x is the radius. capsule and cylinder, along their y: x is the radius, y
  /// half of the length, a capsule's without its ends' balls. hull: nothing.
  glm::vec3 half_m{0.5F};
  std::vector<glm::vec3> corners_m{};  ///< of a hull, 4 to limits::prop_corners_max; else none

  bool operator==(const PropPart&) const = default;
};

/// dynamic: contacts and gravity move it. kinematic: it goes as it was told, and pushes what it meets. fixed:
/// it stands still.
enum class PropMotion : uint8_t { dynamic = 0, kinematic = 1, fixed = 2 };

struct PropMotionRow {
  std::string_view name;
};

constexpr PropMotionRow row_of(PropMotion motion) {
  switch (motion) {
    case PropMotion::dynamic:
      return {"dynamic"};
    case PropMotion::kinematic:
      return {"kinematic"};
    case PropMotion::fixed:
      return {"fixed"};
  }
  return {};
}

/// Groups of what meets: two meet if each has a group that the other one meets. Terrain and pieces have one
/// each, and meet all.
namespace group {
inline constexpr uint32_t terrain = 1U << 0U;
inline constexpr uint32_t pieces = 1U << 1U;
inline constexpr uint32_t props =
    1U << 2U;  ///< of props that name no others; from here on they are the game's
inline constexpr uint32_t all = ~0U;
}  // namespace group

struct Prop {
  std::vector<PropPart> parts;  ///< 1 to limits::prop_parts_max
  PropMotion motion = PropMotion::dynamic;
  float mass_kg = 0.0F;   ///< 0: by the material's density
  float friction = 0.6F;  ///< a contact has the geometric mean of both sides, and likewise what it gives back
  float restitution = 0.1F;  ///< share of the speed that a blow gives back, 0 to 1
  float drag = 0.0F;         ///< share of its speed that the air takes in a second, 0 to 1; as of its spin
  float spin_drag = 0.0F;
  float gravity = 1.0F;  ///< share of the world's gravity that pulls it
  uint32_t groups = group::props;
  uint32_t meets = group::all;
  Material material = material::rock;  ///< how it looks and weighs
  std::optional<Digest> model{};       ///< SHA-256 of a glTF file that shows it; nothing: its parts do
  uint64_t tag = 0;                    ///< the game's own, as is the next one
  std::vector<uint8_t> data{};         ///< at most limits::prop_data_bytes_max

  bool operator==(const Prop&) const = default;
};

/// Refuses what no world can take: numbers beyond their bounds, parts without volume, groups of terrain or
/// pieces. Whether the palette has the material is the world's to check.
Result<void> validate(const Prop& prop);

}  // namespace scree
