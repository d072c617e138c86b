// How blows shake the eye.
#include "client/viewer/viewing/shake.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree {
namespace {

PieceEvent blow_at(glm::vec3 place_m, float mass_kg, float speed_m_s) {
  PieceEvent event;
  event.place_m = place_m;
  event.mass_kg = mass_kg;
  event.impulse_n_s = mass_kg * speed_m_s;
  return event;
}

float strength_after(const PieceEvent& event) {
  Shake shake;
  shake.add(std::array{event}, glm::vec3(0.0F), 5.0);
  return shake.strength(5.0);
}

TEST(Shake, grows_with_energy_and_falls_with_distance_and_time) {
  const float near = strength_after(blow_at({3.0F, 0.0F, 0.0F}, 1000.0F, 8.0F));
  EXPECT_GT(near, strength_after(blow_at({12.0F, 0.0F, 0.0F}, 1000.0F, 8.0F)));
  EXPECT_GT(near, strength_after(blow_at({3.0F, 0.0F, 0.0F}, 1000.0F, 3.0F)));
  EXPECT_GT(near, 0.2F);
  EXPECT_EQ(strength_after(blow_at({3.0F, 0.0F, 0.0F}, 1.0F, 4.0F)), 0.0F) << "a pebble";
  PieceEvent settled = blow_at({1.0F, 0.0F, 0.0F}, 1000.0F, 8.0F);
  settled.kind = PieceEventKind::settle;
  EXPECT_EQ(strength_after(settled), 0.0F);
}

TEST(Shake, is_bounded_goes_on_smoothly_and_ends) {
  Shake shake;
  const std::array blasts{blow_at({1.0F, 0.0F, 0.0F}, 1e6F, 30.0F), blow_at({2.0F, 0.0F, 0.0F}, 1e6F, 30.0F)};
  shake.add(blasts, glm::vec3(0.0F), 1.0);
  EXPECT_LE(shake.strength(1.0), 1.0F);
  const Camera still{};
  float most = 0.0F;
  for (int i = 0; i < 400; ++i) {
    const double now_s = 1.0 + 0.005 * i;
    const Camera a = shake.of(still, now_s), b = shake.of(still, now_s + 0.001);
    most = std::max(most, std::abs(a.yaw) + std::abs(a.pitch));
    EXPECT_LT(std::abs(a.yaw - b.yaw) + std::abs(a.pitch - b.pitch), 0.006F);
    EXPECT_LT(glm::distance(a.eye_m, still.eye_m), 0.06F);
  }
  EXPECT_GT(most, 0.002F);
  EXPECT_LT(most, 0.03F);
  EXPECT_EQ(shake.of(still, 4.0).yaw, 0.0F);
  shake.add(blasts, glm::vec3(0.0F), 5.0);
  shake.end();
  EXPECT_EQ(shake.of(still, 5.0).yaw, 0.0F);
}

}  // namespace
}  // namespace scree
