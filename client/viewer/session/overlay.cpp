#include "client/viewer/session/overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/render/scene/joint_lines.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

constexpr LineColour followed{90, 220, 120, 130};
constexpr LineColour around{200, 200, 200, 90};
constexpr LineColour interest_colour{255, 255, 255, 200};
constexpr LineColour piece_colour{250, 220, 70, 150};
constexpr LineColour awake_colour{255, 150, 50, 230};
constexpr LineColour asleep_colour{90, 160, 255, 230};
constexpr LineColour island_colour{200, 110, 255, 255};
constexpr LineColour contact_colour{255, 60, 60, 255};
constexpr LineColour searched_colour{255, 60, 255, 200};
constexpr float contact_min_m = 0.15F;
constexpr float contact_max_m = 1.5F;

void add_chunk(LineList& lines, ChunkCoord chunk, float voxel_m, LineColour colour) {
  const float side_m = static_cast<float>(chunk_size) * voxel_m;
  const glm::vec3 lo_m = glm::vec3(chunk.x, chunk.y, chunk.z) * side_m;
  lines.box(lo_m, lo_m + side_m, colour);
}

/// The message has no faces of hulls, but near corners of a convex body mostly share an edge: so each corner
/// is joined with its three nearest.
void add_hull(LineList& lines, const BodyView& body, const Pose& pose, LineColour colour) {
  const auto place = [&](const glm::vec3& corner_m) { return pose.position_m + pose.rotation * corner_m; };
  std::vector<size_t> others(body.hull_m.size());
  for (size_t i = 0; i < body.hull_m.size(); ++i) {
    for (size_t k = 0; k < others.size(); ++k) others[k] = k;
    const auto distance = [&](size_t k) {
      const glm::vec3 way = body.hull_m[k] - body.hull_m[i];
      return glm::dot(way, way);
    };
    const size_t near = std::min<size_t>(4, others.size());  // itself among them
    std::ranges::partial_sort(others, others.begin() + static_cast<std::ptrdiff_t>(near), {}, distance);
    for (size_t k = 0; k < near; ++k)
      if (others[k] != i) lines.line(place(body.hull_m[i]), place(body.hull_m[others[k]]), colour);
  }
}

/// Null: it is neither a piece nor a prop here.
const Pose* pose_of(PieceId id, const Scene& scene) {
  if (const auto piece = scene.pieces.find(id); piece != scene.pieces.end()) return &piece->second.pose;
  const auto prop = scene.props.find(id);
  return prop == scene.props.end() ? nullptr : &prop->second.pose;
}

}  // namespace

void add_borders(LineList& lines, ViewerSession& session, const OverlayChoice& choice, glm::vec3 eye_m,
                 double now_s) {
  Mirror* mirror = session.mirror();
  if (mirror == nullptr) return;
  const float voxel_m = mirror->terrain().voxel_size_m;
  if (choice.chunks) {
    for (const ChunkCoord chunk : mirror->held_chunks()) add_chunk(lines, chunk, voxel_m, followed);
    const glm::vec3 at = glm::floor(eye_m / (static_cast<float>(chunk_size) * voxel_m));
    add_chunk(lines, {static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)}, voxel_m,
              around);
  }
  if (choice.interest)
    lines.circle(session.interest_m(), {0.0F, 1.0F, 0.0F}, session.interest_radius_m(), interest_colour);
  if (!choice.pieces) return;
  for (const auto& [id, piece] : session.pieces(now_s)) {
    const VoxelBox& box = piece.volume->window.box;
    const glm::vec3 centre = piece.volume->centre_voxels;
    lines.box((as_vector(box.lo) - centre) * voxel_m, (as_vector(box.hi) - 1.0F - centre) * voxel_m,
              piece_colour, piece.pose.rotation, piece.pose.position_m);
  }
}

void add_joints_of(ViewerSession& session, LineList& lines, glm::vec3 eye_m, double now_s) {
  const Mirror* mirror = session.mirror();
  if (mirror == nullptr || mirror->joints().empty()) return;
  add_joints(lines, mirror->joints(), session.scene(now_s), eye_m);
}

void add_physics(LineList& lines, const PhysicsMessage& physics, const Scene& scene) {
  for (const BodyView& body : physics.bodies) {
    const Pose* pose = pose_of(body.id, scene);
    if (pose == nullptr) continue;
    const LineColour moving = body.island ? island_colour : awake_colour;
    add_hull(lines, body, *pose, body.awake ? moving : asleep_colour);
  }
  for (const ContactView& contact : physics.contacts) {
    const float length_m =
        std::clamp(contact_min_m * std::sqrt(contact.impulse_n_s) * 0.1F, contact_min_m, contact_max_m);
    lines.line(contact.point_m, contact.point_m + contact.normal * length_m, contact_colour);
  }
  const float side_m = static_cast<float>(brick_size) * scene.field.source().voxel_size_m;
  for (const BrickCoord brick : physics.searched) {
    const glm::vec3 lo_m = glm::vec3(brick.x, brick.y, brick.z) * side_m;
    lines.box(lo_m, lo_m + side_m, searched_colour);
  }
}

}  // namespace scree
