// The tool of a strike: the shape that it carves, and the pattern of the pieces.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>

#include "client/viewer/input/actions.h"
#include "proto/messages.h"

namespace scree {

enum class ToolKind : uint8_t { sphere = 0, box = 1, tunnel = 2 };

struct Tool {
  ToolKind kind = ToolKind::sphere;
  float radius_m = 2.0F;  ///< of a box: half its side; a tunnel is six times as long
  float blast_speed_m_s = 6.0F;
  SeedPattern pattern = SeedPattern::radial;
  uint32_t seeds = 0;  ///< 0: by the volume, so that pieces are about as large at any size

  bool operator==(const Tool&) const = default;
};

/// Ranges that fit the server's limits (shared/base/limits.h).
inline constexpr float tool_radius_min_m = 0.5F;
inline constexpr float tool_radius_max_m = 4.0F;
inline constexpr uint32_t tool_seeds_max = 256;

inline constexpr std::array tool_kinds{ToolKind::sphere, ToolKind::box, ToolKind::tunnel};
/// A hand authors no seeds one by one.
inline constexpr std::array tool_patterns{SeedPattern::uniform, SeedPattern::radial, SeedPattern::clustered};

std::string_view name_of(ToolKind kind);
std::string_view name_of(SeedPattern pattern);

/// The shape of a strike along `direction` (unit) that meets rock at `hit_m`. A tunnel goes along the
/// direction; boxes stand upright.
Shape shape_of(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction);

/// Number of seeds of a strike.
uint32_t seeds_of(const Tool& tool);

/// The request for such a strike.
CarveMessage strike_with(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction, uint32_t request);

/// Larger by that many notches of the wheel.
void grow(Tool& tool, float notches);
/// Changes the tool, if the action concerns it.
void change(Tool& tool, Action action);

}  // namespace scree
