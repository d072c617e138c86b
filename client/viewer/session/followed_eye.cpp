#include "client/viewer/session/followed_eye.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "proto/person_name.h"

namespace scree {
namespace {

constexpr double camera_follow_s = 0.15;  ///< time in which the camera goes two thirds of the way to the eye
constexpr float camera_jump_m = 20.0F;    ///< farther, it does not go but is there
constexpr float aim_least_m = 0.1F;
constexpr float behind_cosine = -0.9F;
constexpr float camera_pitch_max = 1.55F;  ///< short of straight up and down, as when one flies

void look_along(Camera& camera, glm::vec3 direction) {
  camera.yaw = std::atan2(-direction.x, -direction.z);
  camera.pitch =
      glm::clamp(std::asin(glm::clamp(direction.y, -1.0F, 1.0F)), -camera_pitch_max, camera_pitch_max);
}

}  // namespace

void FollowedEye::next(const Figures& figures) {
  const auto& all = figures.all();
  const auto found = person_ ? all.upper_bound(*person_) : all.begin();
  person_.reset();
  is_near_ = false;
  if (found == all.end()) return;
  person_ = found->first;
  name_ = called(found->first, found->second.name);
}

void FollowedEye::step(Camera& camera, const Figures& figures, double now_s) {
  const double passed_s = std::max(now_s - since_s_, 0.0);
  since_s_ = now_s;
  if (!person_) return;
  const auto found = figures.all().find(*person_);
  if (found == figures.all().end()) {
    is_near_ = false;
    return;
  }
  const Figures::Figure& figure = found->second;
  is_near_ = is_near_ && glm::distance(camera.eye_m, figure.eye_m) < camera_jump_m;
  const float part = is_near_ ? static_cast<float>(1.0 - std::exp(-passed_s / camera_follow_s)) : 1.0F;
  is_near_ = true;
  camera.eye_m = glm::mix(camera.eye_m, figure.eye_m, part);
  const glm::vec3 way_m = figure.aim_m - figure.eye_m;
  if (glm::length(way_m) < aim_least_m) return;
  const glm::vec3 wanted = glm::normalize(way_m), now = camera.forward();
  // What lies behind is reached by a turn to the right.
  const glm::vec3 towards = glm::dot(now, wanted) < behind_cosine ? camera.right() : wanted;
  look_along(camera, part < 1.0F ? glm::normalize(glm::mix(now, towards, part)) : wanted);
}

std::string FollowedEye::description(const Figures& figures) const {
  if (!person_) return {};
  const std::string there = figures.all().contains(*person_) ? "" : ", who is not there at this moment";
  return "by the eye of " + name_ + there + " (N: the next, or your own)";
}

}  // namespace scree
