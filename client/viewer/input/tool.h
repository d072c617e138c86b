// The tool in a person's hand: a shape, what is done with it, and the pattern of the pieces that it carves.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "client/viewer/input/actions.h"
#include "proto/messages.h"
#include "shared/base/kind_table.h"
#include "shared/field/material_window.h"
#include "shared/material/palette.h"

namespace scree {

/// A crater has a broken wall (shared/field/crater.h), the others are smooth.
enum class ToolKind : uint8_t { sphere = 0, box = 1, tunnel = 2, crater = 3 };

/// What a click does with the tool's shape, in the order of the keys 1 to 5.
enum class ToolUse : uint8_t { dig = 0, place = 1, carve = 2, fill = 3, paint = 4 };

struct UseRow {
  std::string_view name;
  float depth_in_radii;    ///< of the shape's centre in the rock, from the point that was hit
  float usual_radius_m;    ///< a bite by hand, or a blast
  float repeat_s = 0.25F;  ///< from click to click while the button is held: a person's own pace
  bool has_material = true;
  bool as_ground = false;  ///< no material of one's own is one, too
};

constexpr UseRow row_of(ToolUse use) {
  switch (use) {
    case ToolUse::dig:
      return {.name = "dig",
              .depth_in_radii = carve_depth_in_radii,
              .usual_radius_m = 1.5F,
              .has_material = false};
    case ToolUse::place:
      return {.name = "place", .depth_in_radii = -0.5F, .usual_radius_m = 1.0F};
    case ToolUse::carve:
      // Slower: the pieces fly apart before the next blow.
      return {.name = "carve",
              .depth_in_radii = carve_depth_in_radii,
              .usual_radius_m = 2.0F,
              .repeat_s = 0.5F,
              .has_material = false};
    case ToolUse::fill:  // it stands on what it touches
      return {.name = "fill", .depth_in_radii = -0.5F, .usual_radius_m = 2.0F, .as_ground = true};
    case ToolUse::paint:
      return {.name = "paint", .depth_in_radii = 0.0F, .usual_radius_m = 2.0F};
  }
  return {};
}

/// A tunnel's length, the rounded ends included.
inline constexpr float tunnel_length_in_radii = 6.0F;

struct ToolRow {
  std::string_view name;
  float spheres;  ///< volume, in spheres of the tool's radius
};

constexpr ToolRow row_of(ToolKind kind) {
  switch (kind) {
    case ToolKind::sphere:
      return {.name = "sphere", .spheres = 1.0F};
    case ToolKind::box:
      return {.name = "box", .spheres = 8.0F / 4.19F};
    case ToolKind::tunnel:
      return {.name = "tunnel", .spheres = 1.0F + 0.75F * (tunnel_length_in_radii - 2.0F)};
    case ToolKind::crater:
      return {.name = "crater", .spheres = 0.65F};
  }
  return {};
}

struct Tool {
  ToolKind kind = ToolKind::crater;
  ToolUse use = ToolUse::dig;
  std::string material;  ///< to fill, paint or place with, by name; empty: as the ground, or the first
  /// A box has half its side; a tunnel is six times as long.
  float radius_m = traits_of(ToolUse::dig).usual_radius_m;
  float blast_speed_m_s = 6.0F;
  SeedPattern pattern = usual_pattern;
  uint32_t seeds = 0;  ///< 0: by the volume, so that pieces are about as large at any size

  bool operator==(const Tool&) const = default;
};

/// Ranges that fit the server's limits (shared/base/limits.h).
inline constexpr float tool_radius_min_m = 0.5F;
inline constexpr float tool_radius_max_m = 4.0F;
inline constexpr uint32_t tool_seeds_max = 256;

/// A hand gives no points.
inline constexpr auto tool_patterns = pointless_patterns;

/// The shape of a use along `direction` (unit) that meets rock at `hit_m`, no larger than edits may be in
/// voxels of that size. A tunnel goes along the direction; boxes stand upright.
Shape shape_of(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction, float voxel_size_m);

/// Number of seeds of a strike.
uint32_t seeds_of(const Tool& tool);

/// What a tool fills or paints with; nothing: as the ground. A name that the world's palette lacks stands for
/// its first row, and so does none in a tool that paints.
std::optional<Material> material_of(const Tool& tool, const Palette& palette);
/// What a tool places: its material where one carries it, else what one carries most of; nothing: one carries
/// nothing.
std::optional<Material> placed_by(const Tool& tool, const MaterialMasses& carried, const Palette& palette);

/// For whom a click asks.
struct ToolHolder {
  const Palette& palette;
  const MaterialMasses& carried;
  float voxel_size_m;      ///< of the world
  bool may_build = false;  ///< place solid rock; else rubble is placed
};

/// What a click along `direction` (unit) that meets rock at `hit_m` asks for; `number` tells it from others.
/// A tool that places has something to place.
Request request_of(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction, uint32_t number,
                   const ToolHolder& holder);

/// Takes the use up. A size that nobody has chosen becomes the usual one of the use.
void take_up(Tool& tool, ToolUse use);

/// Larger by that many notches of the wheel.
void grow(Tool& tool, float notches);
/// "carve: crater, radius 2.00 m, blast 6 m/s, radial, about 20 pieces".
std::string describe(const Tool& tool);
/// Changes the tool, if the action concerns it. Materials are those of the palette; to place, those that one
/// carries.
void change(Tool& tool, Action action, const Palette& palette = *plain_palette(),
            const MaterialMasses& carried = {});

}  // namespace scree
