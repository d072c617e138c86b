#include "client/viewer/viewing/tool_preview.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "client/viewer/session/region_lines.h"
#include "shared/field/mass.h"
#include "shared/operation/operation.h"

namespace scree {
namespace {

/// Seconds between two measurements of a shape that moves: each takes about as long as the click itself.
constexpr double measure_interval_s = 0.2;

/// The colour of a shape that the server would refuse.
constexpr LineColour beyond_colour{140, 140, 140, 80};

/// As a screen shows a linear colour, about.
uint8_t bright(float part) {
  return static_cast<uint8_t>(255.0F * std::sqrt(part));
}

/// What a click with the tool puts.
std::optional<Material> put_by(const Tool& tool, const ToolHolder& holder) {
  if (tool.use == ToolUse::place) return placed_by(tool, holder.carried, holder.palette);
  return material_of(tool, holder.palette);
}

/// Over the surface by so much, metres, which its roughness would else hide the line in.
constexpr float rim_over_m = 0.06F;

/// Nothing: the shape is not round, or lies within the rock, or elsewhere.
std::optional<ShapeRim> rim_of(const Shape& shape, glm::vec3 hit_m, const Field& field) {
  if (shape.kind == ShapeKind::box || distance(shape, hit_m) > 0.0F) return std::nullopt;
  const glm::vec3 gradient = sample(field, hit_m / field.source().voxel_size_m).gradient;
  if (glm::length(gradient) < 0.1F) return std::nullopt;
  const glm::vec3 normal = glm::normalize(gradient);
  const float over_m = glm::dot(hit_m - shape.a, normal);
  const float square_m2 = shape.radius_m * shape.radius_m - over_m * over_m;
  if (square_m2 <= 0.0F) return std::nullopt;
  return ShapeRim{shape.a + normal * (over_m + rim_over_m), normal, std::sqrt(square_m2)};
}

/// The volume of rock that the click takes or puts.
std::optional<double> volume_m3(const Tool& tool, const ToolAim& aim, const ToolHolder& holder,
                                const Field& field) {
  const double voxel_m = field.source().voxel_size_m;
  const DigOperation dug{aim.shape};
  if (tool.use == ToolUse::paint || (tool.use == ToolUse::place && !aim.material) ||
      !validate(Operation(dug), {}, field.source().voxel_size_m))
    return std::nullopt;
  const auto placed = [&] {
    Material made = aim.material.value_or(material::rock);
    if (tool.use == ToolUse::place && !holder.may_build) made = field.rubble().rubble[row_number(made)];
    return mass_placed({aim.shape, made}, field);
  };
  const bool takes = tool.use == ToolUse::dig || tool.use == ToolUse::carve;
  const MassUnits mass = takes ? mass_dug(dug, field) : placed();
  return static_cast<double>(mass) / units_per_voxel * voxel_m * voxel_m * voxel_m;
}

}  // namespace

const std::optional<ToolAim>& ToolPreview::step(const Tool& tool, ViewerSession& session,
                                                const Camera& camera, double now_s) {
  aim_.reset();
  const glm::vec3 direction = camera.forward();
  const std::optional<glm::vec3> hit_m = session.aim(camera.eye_m, direction);
  if (!hit_m || session.is_replay()) return aim_;
  const ToolHolder holder = session.holder();
  const Shape shape = session.shape_of_strike(tool, *hit_m, direction);
  const bool is_beyond = session.is_beyond_reach(shape, camera.eye_m) || is_in_closed_region(session, shape);
  aim_ = {shape, is_beyond, put_by(tool, holder), rim_of(shape, *hit_m, session.field())};
  if (now_s >= next_measure_s_ && (measured_ != shape || measured_use_ != tool.use)) {
    next_measure_s_ = now_s + measure_interval_s;
    measured_ = shape;
    measured_use_ = tool.use;
    volume_m3_ = volume_m3(tool, *aim_, holder, session.field());
  }
  aim_->volume_m3 = volume_m3_;
  return aim_;
}

void ToolPreview::add_to(LineList& lines, const Tool& tool, const Palette& palette) const {
  if (!aim_) return;
  constexpr uint8_t opacity = 170;
  LineColour colour{255, 236, 170, opacity};
  if (traits_of(tool.use).has_material) colour = {170, 255, 190, opacity};
  if (aim_->material) {
    const auto& [red, green, blue] = palette.row_or_first(*aim_->material).look.colour;
    colour = {bright(red), bright(green), bright(blue), opacity};
  }
  if (aim_->is_beyond) colour = beyond_colour;
  lines.shape(aim_->shape, colour);
  if (const auto& rim = aim_->rim) {
    colour.alpha = 255;
    lines.circle(rim->centre_m, rim->normal, rim->radius_m, colour);
  }
}

}  // namespace scree
