#include "client/viewer/figures/person_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "shared/person/walker.h"

namespace scree {
namespace {

using LimbColour = std::array<uint8_t, 4>;

constexpr LimbColour skin{206, 160, 130, 255};
constexpr LimbColour trousers{92, 88, 92, 255};
constexpr LimbColour boots{66, 54, 46, 255};
constexpr LimbColour wood{150, 112, 72, 255};
constexpr LimbColour steel{158, 164, 172, 255};
constexpr LimbColour visor{38, 44, 56, 255};

// Heights and lengths in a person of Walker::height_m.
constexpr float hip_m = 0.86F, shoulder_m = 1.33F;
constexpr float thigh_m = 0.42F, shin_m = 0.40F, sole_m = 0.06F;
constexpr float upper_arm_m = 0.28F, forearm_m = 0.26F;

/// A length of two steps, by the speed: 1.3 m when walking slowly, 2.4 m when running.
float stride_m(float speed_m_s) {
  return 1.1F + 0.18F * std::min(speed_m_s, 7.5F);
}

LimbColour worn(LineColour colour, float brightness) {
  const auto part = [&](uint8_t value) {
    return static_cast<uint8_t>(std::min(brightness * static_cast<float>(value), 255.0F));
  };
  return {part(colour.red), part(colour.green), part(colour.blue), 255};
}

/// The directions of a body: `up`, to its right, and ahead.
struct Frame {
  glm::vec3 right, up, ahead;

  glm::vec3 at(float r, float u, float a) const { return right * r + up * u + ahead * a; }
};

/// Tips a direction that points down forwards by that angle.
glm::vec3 swung(const Frame& frame, float angle) {
  return frame.ahead * std::sin(angle) - frame.up * std::cos(angle);
}

class Body {
 public:
  Body(std::vector<Limb>& limbs, const Frame& frame) : limbs_(limbs), frame_(frame) {}

  /// From there to there, as thick; its x axis lies as near to the body's right as it goes.
  void between(glm::vec3 from_m, glm::vec3 to_m, glm::vec2 radius_m, LimbColour colour) {
    const glm::vec3 way = to_m - from_m;
    const float length_m = std::max(glm::length(way), 1e-4F);
    const glm::vec3 y = way / length_m;
    glm::vec3 z = glm::cross(frame_.right, y);
    if (glm::dot(z, z) < 1e-4F) z = glm::cross(frame_.ahead, y);
    z = glm::normalize(z);
    const glm::quat turn = glm::quat_cast(glm::mat3(glm::cross(y, z), y, z));
    limbs_.push_back({0.5F * (from_m + to_m),
                      0.5F * length_m,
                      {turn.x, turn.y, turn.z, turn.w},
                      {radius_m.x, 0.5F * (radius_m.x + radius_m.y), radius_m.y},
                      colour});
  }
  void round(glm::vec3 from_m, glm::vec3 to_m, float radius_m, LimbColour colour) {
    between(from_m, to_m, {radius_m, radius_m}, colour);
  }

 private:
  std::vector<Limb>& limbs_;
  const Frame& frame_;
};

/// A leg's angles from straight down, forwards.
struct Leg {
  float thigh = 0.0F;
  float knee = 0.0F;  ///< by which the shin is bent back

  glm::vec3 knee_m(const Frame& frame) const { return swung(frame, thigh) * thigh_m; }
  glm::vec3 ankle_m(const Frame& frame) const { return knee_m(frame) + swung(frame, thigh - knee) * shin_m; }
};

/// `phase`: of the leg's swing, in radians.
Leg leg_at(float phase, float swing) {
  return {swing * std::sin(phase), 0.10F + 1.5F * swing * std::max(std::cos(phase + 0.35F), 0.0F)};
}

void add_legs(Body& body, const Frame& frame, glm::vec3 hips_m, const std::array<Leg, 2>& legs) {
  for (size_t i = 0; i < legs.size(); ++i) {
    const glm::vec3 joint_m = hips_m + frame.right * (i == 0 ? -0.095F : 0.095F);
    const glm::vec3 knee_m = joint_m + legs[i].knee_m(frame), ankle_m = joint_m + legs[i].ankle_m(frame);
    body.round(joint_m, knee_m, 0.085F, trousers);
    body.round(knee_m, ankle_m, 0.066F, trousers);
    const glm::vec3 toes = glm::normalize(frame.ahead + 0.35F * (swung(frame, legs[i].thigh) + frame.up));
    body.between(ankle_m - frame.up * 0.01F - toes * 0.02F, ankle_m - frame.up * 0.02F + toes * 0.13F,
                 {0.058F, 0.05F}, boots);
  }
}

/// Two bones from a shoulder to a hand, the elbow out to that side and down.
void add_arm(Body& body, glm::vec3 shoulder, glm::vec3 hand, glm::vec3 elbow_way, LimbColour sleeve) {
  const glm::vec3 way = hand - shoulder;
  const float reach_m = upper_arm_m + forearm_m;
  const float far_m = std::clamp(glm::length(way), 0.12F, 0.999F * reach_m);
  const glm::vec3 to_hand = glm::normalize(way);
  const float along_m = (far_m * far_m + upper_arm_m * upper_arm_m - forearm_m * forearm_m) / (2.0F * far_m);
  const float off_m = std::sqrt(std::max(upper_arm_m * upper_arm_m - along_m * along_m, 0.0F));
  const glm::vec3 side = glm::normalize(elbow_way - to_hand * glm::dot(elbow_way, to_hand));
  const glm::vec3 elbow = shoulder + to_hand * along_m + side * off_m;
  const glm::vec3 wrist = shoulder + to_hand * far_m;
  body.round(shoulder, elbow, 0.058F, sleeve);
  body.round(elbow, wrist, 0.048F, sleeve);
  body.round(wrist, wrist + to_hand * 0.05F, 0.046F, skin);
}

/// A pick, whose handle begins in the hand.
void add_pick(Body& body, glm::vec3 hand_m, glm::vec3 along, glm::vec3 across) {
  const glm::vec3 head_m = hand_m + along * 0.52F;
  body.round(hand_m - along * 0.14F, head_m, 0.021F, wood);
  body.round(head_m - across * 0.06F, head_m + across * 0.24F - along * 0.05F, 0.026F, steel);
  body.round(head_m, head_m - across * 0.16F, 0.034F, steel);
}

void add_head(Body& body, glm::vec3 eye_m, const Frame& head, LimbColour hat) {
  const glm::vec3 middle_m = eye_m - head.ahead * 0.09F;
  body.between(middle_m - head.up * 0.05F, middle_m + head.up * 0.03F, {0.095F, 0.11F}, skin);
  body.between(middle_m + head.up * 0.055F, middle_m + head.up * 0.075F, {0.118F, 0.135F}, hat);
  body.between(eye_m + head.at(-0.05F, 0.0F, 0.0F), eye_m + head.at(0.05F, 0.0F, 0.0F), {0.03F, 0.03F},
               visor);
}

}  // namespace

void add_person(std::vector<Limb>& limbs, const PersonPose& pose, LineColour colour) {
  const glm::vec3 sky(0.0F, 1.0F, 0.0F);
  const glm::vec3 flat(pose.look.x, 0.0F, pose.look.z);
  const float level = glm::length(flat);
  const glm::vec3 ahead = level > 1e-3F ? flat / level : glm::vec3(0.0F, 0.0F, -1.0F);
  const glm::vec3 right = glm::cross(ahead, sky);
  const Frame frame{right, sky, ahead};
  const glm::vec3 head_right = glm::normalize(right);
  // Nobody looks straight down their own back: the head stops short of it.
  const float pitch = std::clamp(pose.look.y, -0.85F, 0.85F);
  const glm::vec3 look = ahead * std::sqrt(1.0F - pitch * pitch) + sky * pitch;
  const Frame head{head_right, glm::cross(head_right, look), look};
  Body body(limbs, frame);

  const float phase = 2.0F * std::numbers::pi_v<float> * pose.walked_m / stride_m(pose.speed_m_s);
  const float swing = pose.stands ? 0.75F * glm::smoothstep(0.0F, 5.0F, pose.speed_m_s) +
                                        0.12F * std::min(pose.speed_m_s, 1.0F)
                                  : 0.0F;
  std::array<Leg, 2> legs{leg_at(phase, swing), leg_at(phase + std::numbers::pi_v<float>, swing)};
  // Who flies lets them hang.
  if (!pose.stands) legs = {Leg{-0.10F, 0.45F}, Leg{-0.25F, 0.65F}};
  const glm::vec3 feet_m = pose.eye_m - sky * Walker::eye_above_m;
  // The lower foot is on the ground.
  const float down_m = std::max(-legs[0].ankle_m(frame).y, -legs[1].ankle_m(frame).y) + sole_m;
  const glm::vec3 hips_m = feet_m + sky * (pose.stands ? std::min(down_m, hip_m + 0.02F) : hip_m);
  add_legs(body, frame, hips_m, legs);

  const float lean = 0.12F * std::min(pose.speed_m_s / 7.5F, 1.0F);
  const glm::vec3 neck_m = feet_m + frame.at(0.0F, shoulder_m, -0.06F + 0.4F * lean);
  const LimbColour jacket = worn(colour, 0.92F), sleeve = worn(colour, 0.80F);
  body.between(hips_m + sky * 0.15F, neck_m - sky * 0.16F, {0.155F, 0.105F}, jacket);
  body.between(neck_m - frame.at(0.0F, 0.26F, 0.01F), neck_m - sky * 0.06F, {0.19F, 0.115F}, jacket);
  body.round(neck_m, neck_m + frame.at(0.0F, 0.09F, 0.02F), 0.05F, skin);
  body.between(hips_m - frame.at(0.10F, -0.04F, 0.0F), hips_m + frame.at(0.10F, 0.04F, 0.0F), {0.115F, 0.10F},
               trousers);
  add_head(body, pose.eye_m, head, worn(colour, 1.15F));

  const float arm = -0.8F * swing * std::sin(phase);
  const glm::vec3 left_m = neck_m + frame.at(-0.22F, -0.05F, 0.0F);
  const glm::vec3 left_hand = left_m + swung(frame, arm + 0.12F) * 0.50F - frame.right * 0.05F;
  add_arm(body, left_m, left_hand, frame.at(-0.3F, -0.2F, -1.0F), sleeve);
  const glm::vec3 right_m = neck_m + frame.at(0.22F, -0.05F, 0.0F);
  const glm::vec3 right_hand = right_m + frame.at(0.03F, -0.24F, 0.06F) + look * 0.26F + sky * (0.10F * arm);
  add_arm(body, right_m, right_hand, frame.at(0.6F, -0.8F, -0.5F), sleeve);
  const glm::vec3 handle = glm::normalize(look * 0.62F + head.up * 0.78F);
  add_pick(body, right_hand, handle, glm::normalize(glm::cross(head.right, handle) * -1.0F));
}

}  // namespace scree
