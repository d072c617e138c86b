#include "client/viewer/viewing/shake.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace scree {
namespace {

/// A cubic metre of rock that falls from 8 m: beside it, the eye shakes as much as it ever does.
constexpr float full_energy_j = 2.0e5F;
/// Distance at which a blow shakes half as much as beside it.
constexpr float half_way_m = 5.0F;
/// Less is not seen.
constexpr float least = 0.02F;
/// Time in which it falls to a third.
constexpr double decay_s = 0.28;
/// At full strength: radians, and metres. More makes people sick.
constexpr float turn_max = 0.014F, move_max_m = 0.035F;

/// Two waves whose rates (Hz) have no common measure: it does not look like one.
float wave(double now_s, double rate_hz, double offset) {
  constexpr double turn = 6.283185307179586;
  return static_cast<float>(0.6 * std::sin(turn * (now_s * rate_hz + offset)) +
                            0.4 * std::sin(turn * (now_s * rate_hz * 1.618 + 2.0 * offset)));
}

float strength_of(const PieceEvent& event, glm::vec3 eye_m) {
  if (event.kind == PieceEventKind::settle || is_cue(event.kind) || event.mass_kg <= 0.0F) return 0.0F;
  const float energy_j = 0.5F * event.impulse_n_s * event.impulse_n_s / event.mass_kg;
  const float away = glm::distance(event.place_m, eye_m) / half_way_m;
  return std::sqrt(energy_j / full_energy_j) / (1.0F + away * away);
}

}  // namespace

float Shake::strength(double now_s) const {
  return strength_ * static_cast<float>(std::exp(-std::max(now_s - since_s_, 0.0) / decay_s));
}

void Shake::add(std::span<const PieceEvent> events, glm::vec3 eye_m, double now_s) {
  // Blows at once add as their energies do.
  float squares = 0.0F;
  for (const PieceEvent& event : events) {
    const float one = strength_of(event, eye_m);
    squares += one * one;
  }
  const float added = std::sqrt(squares), left = strength(now_s);
  if (added < least) return;
  strength_ = std::min(std::sqrt(left * left + added * added), 1.0F);
  since_s_ = now_s;
}

Camera Shake::of(const Camera& camera, double now_s) const {
  const float now = strength(now_s);
  if (now < least) return camera;
  Camera shaken = camera;
  shaken.yaw += turn_max * now * wave(now_s, 11.0, 0.0);
  shaken.pitch += turn_max * now * wave(now_s, 13.0, 0.3);
  shaken.eye_m += camera.right() * (move_max_m * now * wave(now_s, 9.0, 0.6)) +
                  glm::vec3(0.0F, move_max_m * now * wave(now_s, 10.0, 0.8), 0.0F);
  return shaken;
}

}  // namespace scree
