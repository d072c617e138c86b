#include "client/viewer/session/figures.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "shared/person/walker.h"

namespace scree {
namespace {

constexpr double follow_s = 0.12;  ///< time in which a figure goes two thirds of the way to its cursor
constexpr float jump_m = 20.0F;    ///< farther, it does not go but is there
constexpr float cross_m = 0.25F;
constexpr int sides = 10;

/// Half the outline of a body, from the feet up: radius, and height below or above the eye, metres.
constexpr float foot_m = -Walker::eye_above_m;
constexpr std::array outline{
    glm::vec2(0.00F, foot_m),         glm::vec2(0.17F, foot_m + 0.02F), glm::vec2(0.15F, foot_m + 0.55F),
    glm::vec2(0.19F, foot_m + 0.85F), glm::vec2(0.24F, -0.34F),         glm::vec2(0.20F, -0.24F),
    glm::vec2(0.07F, -0.19F),         glm::vec2(0.07F, -0.14F),         glm::vec2(0.12F, -0.06F),
    glm::vec2(0.13F, 0.02F),          glm::vec2(0.10F, 0.11F),          glm::vec2(0.00F, 0.15F)};

void add_body(LineList& lines, glm::vec3 eye_m, LineColour colour) {
  const auto at = [&](glm::vec2 ring, int side) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(side) / sides;
    return eye_m + glm::vec3(ring.x * std::cos(angle), ring.y, ring.x * std::sin(angle));
  };
  const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 across = glm::cross(b - a, c - a);
    const float size = glm::length(across);
    if (size > 1e-9F) lines.triangle(a, b, c, shaded(colour, across / size));
  };
  for (size_t ring = 0; ring + 1 < outline.size(); ++ring)
    for (int side = 0; side < sides; ++side) {
      add(at(outline[ring], side), at(outline[ring + 1], side), at(outline[ring + 1], side + 1));
      add(at(outline[ring], side), at(outline[ring + 1], side + 1), at(outline[ring], side + 1));
    }
}

/// A dark visor on the side of the head that looks.
void add_visor(LineList& lines, glm::vec3 eye_m, glm::vec3 forward) {
  const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.0F, 1.0F, 0.01F)));
  const glm::vec3 up = glm::cross(right, forward);
  const glm::vec3 middle_m = eye_m + forward * 0.15F;
  const glm::vec3 low = middle_m - up * 0.03F, high = middle_m + up * 0.04F, side = right * 0.09F;
  constexpr LineColour glass{25, 30, 40, 255};
  lines.triangle(low - side, low + side, high + side, glass);
  lines.triangle(low - side, high + side, high - side, glass);
}

}  // namespace

LineColour colour_of_person(uint64_t session) {
  constexpr std::array<LineColour, 8> colours{{{90, 170, 240, 255},
                                               {240, 150, 60, 255},
                                               {120, 210, 110, 255},
                                               {230, 110, 150, 255},
                                               {180, 140, 240, 255},
                                               {240, 220, 90, 255},
                                               {90, 210, 200, 255},
                                               {220, 220, 220, 255}}};
  return colours[session % colours.size()];
}

void Figures::step(const std::vector<PlayerCursor>& cursors, double now_s) {
  std::map<uint64_t, Figure> next;
  for (const PlayerCursor& cursor : cursors) {
    const auto before = figures_.find(cursor.session);
    Figure figure{cursor.name, cursor.eye_m, cursor.aim_m, now_s};
    if (before != figures_.end() && glm::distance(before->second.eye_m, cursor.eye_m) < jump_m) {
      const double passed_s = std::max(now_s - before->second.since_s, 0.0);
      const auto part = static_cast<float>(1.0 - std::exp(-passed_s / follow_s));
      figure.eye_m = glm::mix(before->second.eye_m, cursor.eye_m, part);
      figure.aim_m = glm::mix(before->second.aim_m, cursor.aim_m, part);
    }
    next.emplace(cursor.session, std::move(figure));
  }
  figures_ = std::move(next);
}

std::optional<glm::vec2> Figures::place_of_name(const Figure& figure, const glm::mat4& view_projection) {
  constexpr float over_eye_m = 0.32F;
  const glm::vec4 place = view_projection * glm::vec4(figure.eye_m + glm::vec3(0.0F, over_eye_m, 0.0F), 1.0F);
  if (place.w <= 0.0F) return std::nullopt;
  return glm::vec2(place.x / place.w * 0.5F + 0.5F, 0.5F - place.y / place.w * 0.5F);
}

void Figures::add_to(LineList& lines, glm::vec3 eye_m, std::optional<uint64_t> looked_through) const {
  for (const auto& [session, figure] : figures_) {
    const LineColour colour = colour_of_person(session);
    lines.cross(figure.aim_m, cross_m, colour);
    if (session == looked_through || glm::distance(figure.eye_m, eye_m) < 2.0F * Walker::radius_m) continue;
    add_body(lines, figure.eye_m, colour);
    const glm::vec3 way_m = figure.aim_m - figure.eye_m;
    const float far_m = glm::length(way_m);
    if (far_m > 0.1F) add_visor(lines, figure.eye_m, way_m / far_m);
  }
}

}  // namespace scree
