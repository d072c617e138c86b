#include "client/viewer/figures/figures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "client/render/scene/limits.h"
#include "client/viewer/figures/person_body.h"
#include "shared/person/walker.h"

namespace scree {
namespace {

constexpr double follow_s = 0.12;  ///< time in which a figure goes two thirds of the way to its cursor
constexpr float jump_m = 20.0F;    ///< farther, it does not go but is there
constexpr float cross_m = 0.25F;
/// Above the ground, who comes so near stands on it.
constexpr float stands_m = 0.35F;
/// Time in which a speed goes two thirds of the way to another.
constexpr float speed_s = 0.12F;

bool is_on_ground(const Field& field, glm::vec3 feet_m) {
  const float voxel_m = field.source().voxel_size_m;
  const glm::vec3 place = feet_m / voxel_m;
  const VoxelCoord voxel{floor_to_int(place.x), floor_to_int(place.y), floor_to_int(place.z)};
  // Nothing is generated for the sake of a figure.
  if (!field.has_generated(chunk_of(voxel))) return false;
  return sample(field, place).distance_voxels * voxel_m < stands_m;
}

}  // namespace

void add_body(PersonFacts& facts, std::vector<PlayerCursor>& cursors, uint64_t session, const Pose& body) {
  const glm::vec3 feet_m = body.position_m - glm::vec3(0.0F, 0.5F * Walker::height_m, 0.0F);
  facts.feet_m.emplace(session, feet_m);
  if (std::ranges::any_of(cursors, [&](const PlayerCursor& one) { return one.session == session; })) return;
  const glm::vec3 eye_m = feet_m + glm::vec3(0.0F, Walker::eye_above_m, 0.0F);
  cursors.push_back({session, "", eye_m, eye_m + body.rotation * glm::vec3(0.0F, 0.0F, -5.0F)});
}

/// Forwards by the way over the ground, backwards where the person walks so.
void Figures::walk(Figure& figure, const Figure& before, float passed_s) {
  const glm::vec3 way_m = figure.eye_m - before.eye_m, ahead_m = figure.aim_m - figure.eye_m;
  const float far_m = glm::length(glm::vec2(way_m.x, way_m.z));
  const float along = way_m.x * ahead_m.x + way_m.z * ahead_m.z < 0.0F ? -far_m : far_m;
  figure.walked_m = before.walked_m + along;
  const float part = 1.0F - std::exp(-passed_s / speed_s);
  figure.speed_m_s = glm::mix(before.speed_m_s, far_m / std::max(passed_s, 1e-3F), part);
}

void Figures::step(const std::vector<PlayerCursor>& cursors, double now_s, const PersonFacts& facts) {
  std::map<uint64_t, Figure> next;
  for (const PlayerCursor& cursor : cursors) {
    const auto before = figures_.find(cursor.session);
    Figure figure{cursor.name, cursor.eye_m, cursor.aim_m, now_s};
    if (facts.colours != nullptr) figure.colour = facts.colours->of(cursor.session);
    const glm::vec3 eye_above_m(0.0F, Walker::eye_above_m, 0.0F);
    const auto body = facts.feet_m.find(cursor.session);
    figure.on_foot = body != facts.feet_m.end();
    if (figure.on_foot) figure.eye_m = body->second + eye_above_m;
    if (before != figures_.end() && glm::distance(before->second.eye_m, figure.eye_m) < jump_m) {
      const double passed_s = std::max(now_s - before->second.since_s, 0.0);
      const auto part = static_cast<float>(1.0 - std::exp(-passed_s / follow_s));
      if (!figure.on_foot) figure.eye_m = glm::mix(before->second.eye_m, figure.eye_m, part);
      figure.aim_m = glm::mix(before->second.aim_m, cursor.aim_m, part);
      walk(figure, before->second, static_cast<float>(passed_s));
    }
    figure.stands =
        figure.on_foot || (facts.field != nullptr && is_on_ground(*facts.field, figure.eye_m - eye_above_m));
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

void Figures::add_to(LineList& lines) const {
  for (const auto& [session, figure] : figures_) lines.cross(figure.aim_m, cross_m, figure.colour);
}

std::vector<Limb> Figures::limbs(glm::vec3 eye_m, std::optional<uint64_t> looked_through,
                                 bool on_foot_alone) const {
  std::vector<Limb> limbs;
  for (const auto& [session, figure] : figures_) {
    if (session == looked_through || glm::distance(figure.eye_m, eye_m) < 2.0F * Walker::radius_m) continue;
    if (on_foot_alone && !figure.on_foot) continue;
    const glm::vec3 way_m = figure.aim_m - figure.eye_m;
    const float far_m = glm::length(way_m);
    PersonPose pose;
    pose.eye_m = figure.eye_m;
    if (far_m > 0.1F) pose.look = way_m / far_m;
    pose.walked_m = figure.walked_m;
    pose.speed_m_s = figure.speed_m_s;
    pose.stands = figure.stands;
    add_person(limbs, pose, figure.colour);
  }
  return limbs;
}

void Figures::add_to(std::vector<Contact>& contacts) const {
  constexpr float radius_m = 0.22F;
  for (const auto& [session, figure] : figures_)
    if (figure.stands && contacts.size() < limits::contacts_max)
      contacts.push_back({figure.eye_m - glm::vec3(0.0F, Walker::eye_above_m - radius_m, 0.0F), radius_m});
}

}  // namespace scree
