#include "client/render/scene/joint_lines.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

constexpr LineColour hemp{176, 136, 84, 255}, steel{158, 164, 172, 255}, iron{112, 118, 128, 255};
constexpr float rope_m = 0.025F, rod_m = 0.03F, arm_m = 0.02F, pin_m = 0.05F;  // radii
constexpr float pin_half_m = 0.3F, knob_half_m = 0.06F;
constexpr size_t rope_links = 16;
constexpr int near_sides = 6, far_sides = 3;
constexpr float round_m = 15.0F;

/// Half a pixel, about, of a picture of 720 rows, at a distance of a metre.
constexpr float half_pixel = 0.0008F;

/// A joint where it is now.
struct Placed {
  const Joint& joint;
  std::array<Pose, 2> frames;
  glm::vec3 a_m, b_m;

  glm::vec3 axis() const { return frames[0].rotation * (joint.a.turn * glm::vec3(1.0F, 0.0F, 0.0F)); }
};

/// Nothing: the body is not in the scene.
std::optional<Pose> frame_of(const JointSide& side, const Scene& scene) {
  if (side.holds_terrain()) return Pose{glm::vec3(0.0F), {1.0F, 0.0F, 0.0F, 0.0F}};
  if (const auto prop = scene.props.find(side.body); prop != scene.props.end()) return prop->second.pose;
  if (const auto piece = scene.pieces.find(side.body); piece != scene.pieces.end()) return piece->second.pose;
  return std::nullopt;
}

glm::vec3 at(const Pose& frame, glm::vec3 place_m) {
  return frame.position_m + frame.rotation * place_m;
}

class JointDrawing {
 public:
  JointDrawing(LineList& lines, glm::vec3 eye_m) : lines_(lines), eye_m_(eye_m) {}

  void add(const Placed& placed) const {
    switch (placed.joint.kind) {
      case JointKind::rope:
        return hang(placed);
      case JointKind::distance:
        return bar(placed.a_m, placed.b_m, rod_m, steel);
      case JointKind::slider:
        return rail(placed);
      case JointKind::hinge:
        arms(placed);
        return bar(placed.a_m - placed.axis() * pin_half_m, placed.a_m + placed.axis() * pin_half_m, pin_m,
                   iron);
      case JointKind::fixed:
      case JointKind::ball:
        arms(placed);
        return knob(placed);
    }
  }

 private:
  void bar(glm::vec3 from_m, glm::vec3 to_m, float radius_m, LineColour colour) const {
    const float away_m = glm::distance(eye_m_, 0.5F * (from_m + to_m));
    lines_.cylinder(from_m, to_m, std::max(radius_m, away_m * half_pixel),
                    away_m < round_m ? near_sides : far_sides, colour);
  }

  /// From the middle of each body to the joint.
  void arms(const Placed& placed) const {
    if (!placed.joint.a.holds_terrain()) bar(placed.frames[0].position_m, placed.a_m, arm_m, steel);
    if (!placed.joint.b.holds_terrain()) bar(placed.frames[1].position_m, placed.b_m, arm_m, steel);
  }

  /// A ball's is round, as far as three bars are, and what is fixed has a cross.
  void knob(const Placed& placed) const {
    const float radius_m = placed.joint.kind == JointKind::ball ? knob_half_m : rod_m;
    for (const glm::vec3 axis :
         {glm::vec3(knob_half_m, 0, 0), glm::vec3(0, knob_half_m, 0), glm::vec3(0, 0, knob_half_m)}) {
      const glm::vec3 half_m = placed.frames[0].rotation * (placed.joint.a.turn * axis);
      bar(placed.a_m - half_m, placed.a_m + half_m, radius_m, iron);
    }
  }

  /// As far as its limits let side b go, or to where b is.
  void rail(const Placed& placed) const {
    const float way_m = glm::dot(placed.b_m - placed.a_m, placed.axis());
    const JointLimits limits =
        placed.joint.limits.value_or(JointLimits{way_m - pin_half_m, way_m + pin_half_m});
    bar(placed.a_m + placed.axis() * std::min(limits.low, 0.0F),
        placed.a_m + placed.axis() * std::max(limits.high, 0.0F), rod_m, steel);
    bar(placed.b_m - placed.axis() * knob_half_m, placed.b_m + placed.axis() * knob_half_m, pin_m, iron);
  }

  using Links = std::array<glm::vec3, rope_links + 1>;

  static Links parabola(glm::vec3 a_m, glm::vec3 b_m, float sag_m) {
    Links links{};
    for (size_t i = 0; i < links.size(); ++i) {
      const float t = static_cast<float>(i) / rope_links;
      links[i] = a_m + (b_m - a_m) * t - glm::vec3(0.0F, 4.0F * sag_m * t * (1.0F - t), 0.0F);
    }
    return links;
  }
  static float length_of(const Links& links) {
    float length_m = 0.0F;
    for (size_t i = 0; i < rope_links; ++i) length_m += glm::distance(links[i], links[i + 1]);
    return length_m;
  }

  /// A parabola as long as the rope, found by halving.
  void hang(const Placed& placed) const {
    constexpr int halvings = 12;
    float low_m = 0.0F, high_m = placed.joint.length_m;
    for (int i = 0; i < halvings; ++i) {
      const float middle_m = 0.5F * (low_m + high_m);
      const bool is_long = length_of(parabola(placed.a_m, placed.b_m, middle_m)) > placed.joint.length_m;
      (is_long ? high_m : low_m) = middle_m;
    }
    const Links links = parabola(placed.a_m, placed.b_m, low_m);
    for (size_t i = 0; i < rope_links; ++i) bar(links[i], links[i + 1], rope_m, hemp);
  }

  LineList& lines_;
  glm::vec3 eye_m_;
};

}  // namespace

void add_joints(LineList& lines, const SceneJoints& joints, const Scene& scene, glm::vec3 eye_m) {
  const JointDrawing drawing(lines, eye_m);
  for (const auto& [id, joint] : joints) {
    const auto a = frame_of(joint.a, scene), b = frame_of(joint.b, scene);
    if (!a || !b) continue;
    const Placed placed{joint, {*a, *b}, at(*a, joint.a.place_m), at(*b, joint.b.place_m)};
    if (glm::distance(placed.a_m, eye_m) <= limits::joints_seen_m) drawing.add(placed);
  }
}

}  // namespace scree
