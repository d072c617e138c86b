// A place that every ground suggests to begin at: outside rock, with ground and sky in sight; and places as
// text.
#include "server/world/overlook.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/world/spawn_place.h"
#include "tests/support/memory_heights.h"

namespace scree {
namespace {

constexpr float sight_m = 70.0F;

/// The shares of a coarse picture from the spawn, of a vertical field of view of 60 degrees.
struct Shares {
  int sky = 0, all = 0;
  float nearest_m = sight_m;
};

Shares shares_of(const Field& field, const Spawn& spawn) {
  constexpr float radians = 0.01745329F, tangent = 0.577F, aspect = 16.0F / 9.0F;
  const float yaw = spawn.yaw_degrees * radians, pitch = spawn.pitch_degrees * radians;
  const glm::vec3 ahead(-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
  const glm::vec3 right = glm::normalize(glm::cross(ahead, {0.0F, 1.0F, 0.0F})),
                  up = glm::cross(right, ahead);
  const float voxel_m = field.source().voxel_size_m;
  Shares shares;
  for (int y = -4; y <= 4; ++y)
    for (int x = -8; x <= 8; ++x, ++shares.all) {
      const glm::vec3 ray = glm::normalize(ahead + right * (tangent * aspect * static_cast<float>(x) / 8.0F) +
                                           up * (tangent * static_cast<float>(y) / 4.0F));
      const auto hit = trace(field, spawn.eye_m / voxel_m, ray, sight_m / voxel_m);
      if (!hit) ++shares.sky;
      if (hit) shares.nearest_m = std::min(shares.nearest_m, *hit * voxel_m);
    }
  return shares;
}

void expect_a_good_place(const TerrainSource& source) {
  const MapField field(source);
  const Spawn spawn = lifted(field, overlook_of(source));
  SCOPED_TRACE(text_of(spawn));
  EXPECT_EQ(spawn, lifted(field, spawn)) << "no rock is there";
  const float ground_m = ground_height_m(source, spawn.eye_m.x, spawn.eye_m.z);
  EXPECT_GT(spawn.eye_m.y, ground_m + 2.0F);
  EXPECT_LT(spawn.eye_m.y, ground_m + 12.0F);
  EXPECT_LT(std::max(std::abs(spawn.eye_m.x), std::abs(spawn.eye_m.z)), 100.0F);
  const Shares shares = shares_of(field, spawn);
  EXPECT_GT(shares.sky, shares.all / 10) << "the horizon is in the picture";
  EXPECT_LT(shares.sky, shares.all * 6 / 10) << "and so is the ground";
  EXPECT_GT(shares.nearest_m, 1.5F);
}

TEST(Overlook, every_generated_ground_suggests_a_place_with_ground_and_sky_in_sight) {
  for (const TerrainKind kind : all_kinds<TerrainKind>)
    for (const uint32_t seed : {1U, 2U, 4000000000U})
      for (const float voxel_m : {0.25F, 1.0F}) {
        SCOPED_TRACE(std::string(name_of(kind)) + " " + std::to_string(seed) + " " + std::to_string(voxel_m));
        expect_a_good_place({kind, seed, voxel_m});
      }
}

TEST(Overlook, a_ground_by_heights_suggests_one_too) {
  for (const float steep : {0.0F, 0.3F, 1.5F}) {
    SCOPED_TRACE(steep);
    const auto hills = [steep](int x, int z) {
      const float wave = std::sin(0.21F * static_cast<float>(x)) * std::cos(0.17F * static_cast<float>(z));
      return static_cast<int32_t>(40.0F * steep * wave * static_cast<float>(height_steps_per_m) / 2.0F);
    };
    expect_a_good_place({.heights = std::make_shared<MemoryHeights>(64, 48, 2.0F, hills)});
  }
}

TEST(SpawnText, a_text_says_a_place_or_is_refused) {
  EXPECT_EQ(parse_spawn("3,2,-4,30,-10"), (Spawn{{3.0F, 2.0F, -4.0F}, 30.0F, -10.0F}));
  EXPECT_EQ(parse_spawn(text_of({{3.0F, 2.0F, -4.0F}, 30.0F, -10.0F})),
            (Spawn{{3.0F, 2.0F, -4.0F}, 30.0F, -10.0F}));
  EXPECT_EQ(parse_spawn("1,2.5,-3"), (Spawn{{1.0F, 2.5F, -3.0F}, 0.0F, 0.0F}));
  EXPECT_EQ(parse_spawn("0,0,0,350,0")->yaw_degrees, -10.0F);
  for (const char* text :
       {"", "1", "1,2", "1,2,3,4", "1,2,3,4,5,6", "1,2,3,", "1,2,3,4,5,", "a,2,3", "1 ,2,3", "nan,0,0",
        "inf,0,0", "0,0,0,nan,0", "4097,0,0", "0,513,0", "0,0,0,0,89.5"})
    EXPECT_FALSE(parse_spawn(text)) << text;
}

}  // namespace
}  // namespace scree
