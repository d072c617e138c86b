#include "client/viewer/input/tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "shared/base/check.h"
#include "shared/base/edit_reach.h"
#include "shared/base/limits.h"

namespace scree {
namespace {

constexpr float growth = 1.12F;  ///< a notch
constexpr float speed_step_m_s = 2.0F;
constexpr float seeds_growth = 1.5F;
constexpr uint32_t seeds_min = 2;
constexpr uint32_t seeds_by_volume_min = 6;
constexpr uint32_t seeds_by_volume_max = 192;
/// The one after `one`, and the first after the last.
template <typename T, size_t n>
T next(const std::array<T, n>& all, T one) {
  const auto found = std::ranges::find(all, one);
  return found == all.end() || found + 1 == all.end() ? all.front() : *(found + 1);
}

/// The material after the one that is placed now, among those that one carries.
std::string next_carried(const Tool& tool, const MaterialMasses& carried, const Palette& palette) {
  const std::optional<Material> now = placed_by(tool, carried, palette);
  if (!now) return tool.material;
  const auto after = std::ranges::find_if(carried, [&](const auto& one) { return one.material > *now; });
  return palette.row_or_first((after == carried.end() ? carried.front() : *after).material).name;
}

/// Where a click fills, no name at all comes before the first.
std::string next_material(const Tool& tool, const Palette& palette) {
  const std::optional<Material> now = material_of(tool, palette);
  const size_t next = now ? row_number(*now) + 1 : 0;
  if (next < palette.rows.size()) return palette.rows[next].name;
  return traits_of(tool.use).as_ground ? std::string() : palette.rows.front().name;
}

uint32_t scaled(uint32_t seeds, float factor) {
  const float wanted = std::round(static_cast<float>(seeds) * factor);
  return static_cast<uint32_t>(
      std::clamp(wanted, static_cast<float>(seeds_min), static_cast<float>(tool_seeds_max)));
}

}  // namespace

Shape shape_of(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction, float voxel_size_m) {
  const glm::vec3 centre_m = hit_m + direction * (tool.radius_m * traits_of(tool.use).depth_in_radii);
  switch (tool.kind) {
    case ToolKind::sphere:
      return sphere(centre_m, tool.radius_m);
    case ToolKind::box:
      return box(centre_m, glm::vec3(tool.radius_m));
    case ToolKind::crater:
      return crater(centre_m, tool.radius_m);
    case ToolKind::tunnel:
      // Half the longest extent, the rounded ends included, must not be over the server's limit.
      const float length_m =
          std::min(tunnel_length_in_radii * tool.radius_m, 2.0F * greatest_edit_reach_m(voxel_size_m)) -
          2.0F * tool.radius_m;
      return capsule(centre_m, centre_m + direction * length_m, tool.radius_m);
  }
  CHECK(is_known(tool.kind));
  return {};
}

uint32_t seeds_of(const Tool& tool) {
  if (tool.seeds > 0) return tool.seeds;
  const float wanted = 8.0F * tool.radius_m * tool.radius_m * traits_of(tool.kind).spheres;
  return std::clamp(static_cast<uint32_t>(wanted), seeds_by_volume_min, seeds_by_volume_max);
}

std::optional<Material> material_of(const Tool& tool, const Palette& palette) {
  const UseRow& use = traits_of(tool.use);
  if (!use.has_material || (use.as_ground && tool.material.empty())) return std::nullopt;
  return palette.named(tool.material).value_or(Material{});
}

std::optional<Material> placed_by(const Tool& tool, const MaterialMasses& carried, const Palette& palette) {
  if (carried.empty()) return std::nullopt;
  const auto chosen = std::ranges::find_if(
      carried, [&](const auto& one) { return palette.row_or_first(one.material).name == tool.material; });
  if (chosen != carried.end()) return chosen->material;
  return std::ranges::max_element(carried, {}, &MaterialMass::mass)->material;
}

Request request_of(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction, uint32_t number,
                   const ToolHolder& holder) {
  const Shape shape = shape_of(tool, hit_m, direction, holder.voxel_size_m);
  switch (tool.use) {
    case ToolUse::carve:
      break;
    case ToolUse::fill:
      return FillRequest{shape, material_of(tool, holder.palette)};
    case ToolUse::paint:
      return PaintRequest{shape, *material_of(tool, holder.palette)};
    case ToolUse::dig:
      return DigRequest{shape};
    case ToolUse::place:
      return PlaceRequest{shape, *placed_by(tool, holder.carried, holder.palette), holder.may_build};
  }
  CarveRequest carve;
  carve.shape = shape;
  carve.pattern = tool.pattern;
  carve.seeds = seeds_of(tool);
  carve.random_seed = number * 0x9E3779B1U;
  carve.impact_m = hit_m;
  carve.blast_speed_m_s = tool.blast_speed_m_s;
  return carve;
}

void take_up(Tool& tool, ToolUse use) {
  if (tool.radius_m == traits_of(tool.use).usual_radius_m) tool.radius_m = traits_of(use).usual_radius_m;
  tool.use = use;
}

void grow(Tool& tool, float notches) {
  tool.radius_m = std::clamp(tool.radius_m * std::pow(growth, notches), tool_radius_min_m, tool_radius_max_m);
}

std::string describe(const Tool& tool) {
  char numbers[64];
  const auto radius_m = static_cast<double>(tool.radius_m);
  std::snprintf(numbers, sizeof numbers, ", radius %.2f m", radius_m);
  std::string text = std::string(name_of(tool.use)) + ": " + std::string(name_of(tool.kind)) + numbers;
  if (traits_of(tool.use).has_material && !tool.material.empty()) text += ", " + tool.material;
  if (tool.use != ToolUse::carve) return text;
  std::snprintf(numbers, sizeof numbers, ", blast %.0f m/s, ", static_cast<double>(tool.blast_speed_m_s));
  return text + numbers + std::string(name_of(tool.pattern)) + ", about " + std::to_string(seeds_of(tool)) +
         " pieces";
}

void change(Tool& tool, Action action, const Palette& palette, const MaterialMasses& carried) {
  const auto faster = [&](float by_m_s) {
    tool.blast_speed_m_s = std::clamp(tool.blast_speed_m_s + by_m_s, 0.0F, limits::blast_speed_max_m_s);
  };
  switch (action) {
    case Action::dig:
      return take_up(tool, ToolUse::dig);
    case Action::place:
      return take_up(tool, ToolUse::place);
    case Action::carve:
      return take_up(tool, ToolUse::carve);
    case Action::fill:
      return take_up(tool, ToolUse::fill);
    case Action::paint:
      return take_up(tool, ToolUse::paint);
    case Action::next_tool:
      tool.kind = next(all_kinds<ToolKind>, tool.kind);
      break;
    case Action::next_use:
      return take_up(tool, next(all_kinds<ToolUse>, tool.use));
    case Action::next_material:
      tool.material =
          tool.use == ToolUse::place ? next_carried(tool, carried, palette) : next_material(tool, palette);
      break;
    case Action::next_pattern:
      tool.pattern = next(tool_patterns, tool.pattern);
      break;
    case Action::larger:
      grow(tool, 1.0F);
      break;
    case Action::smaller:
      grow(tool, -1.0F);
      break;
    case Action::stronger:
      faster(speed_step_m_s);
      break;
    case Action::weaker:
      faster(-speed_step_m_s);
      break;
    case Action::more_seeds:
      tool.seeds = scaled(seeds_of(tool), seeds_growth);
      break;
    case Action::fewer_seeds:
      tool.seeds = scaled(seeds_of(tool), 1.0F / seeds_growth);
      break;
    default:
      break;
  }
}

}  // namespace scree
