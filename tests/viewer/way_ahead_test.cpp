// Who digs ahead on foot goes on through what is dug.
#include "client/viewer/session/way_ahead.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "client/viewer/input/tool.h"
#include "shared/person/walker.h"
#include "tests/support/person_world.h"

namespace scree {
namespace {

constexpr uint64_t person = 1;
constexpr int ticks_a_second = 60;

/// Where a walk through rock begins, and where it goes.
struct Walk {
  TerrainKind kind;
  float x_m, z_m, yaw_degrees, pitch_degrees;
};

/// How far a person comes who goes ahead for so long and digs four times a second with the usual tool: where
/// the ray meets rock, or first what is in the way.
float way_m(const Walk& walk, bool first_what_is_in_the_way, int seconds) {
  WorldConfig config;
  config.service.persons = Persons::walk;
  config.terrain = {walk.kind, 1, 0.25F};
  config.dig_m3_per_s = 0;
  PersonWorld world(config);
  const glm::vec3 begin_m(walk.x_m, ground_height_m(config.terrain, walk.x_m, walk.z_m) + 0.2F, walk.z_m);
  world.stand(person, begin_m);
  const float yaw = glm::radians(walk.yaw_degrees), pitch = glm::radians(walk.pitch_degrees);
  const glm::vec3 level(std::cos(yaw), 0.0F, std::sin(yaw));
  const glm::vec3 direction = level * std::cos(pitch) + glm::vec3(0.0F, std::sin(pitch), 0.0F);
  const Tool tool;
  const float voxel_m = config.terrain.voxel_size_m;
  for (int tick = 0; tick < seconds * ticks_a_second; ++tick) {
    if (tick > ticks_a_second && tick % (ticks_a_second / 4) == 0) {
      const glm::vec3 feet_m = world.feet_m(person),
                      eye_m = feet_m + glm::vec3(0.0F, Walker::eye_above_m, 0.0F);
      const Field& field = world.world().field();
      if (const auto along = trace(field, eye_m / voxel_m, direction, 32.0F)) {
        Shape shape = shape_of(tool, eye_m + direction * (*along * voxel_m), direction, voxel_m);
        if (first_what_is_in_the_way)
          shape.a = middle_of_way(field, feet_m, direction, tool.radius_m).value_or(shape.a);
        DigRequest dig{shape};
        dig.store = worlds_store();
        world.step({{0, 1, dig}});
      }
    }
    world.walk(person, {.go = level}, 1);
  }
  return glm::dot(world.feet_m(person) - begin_m, level);
}

TEST(WayAhead, who_digs_ahead_on_foot_comes_through_cliff_and_hills) {
  for (const Walk& walk : {Walk{TerrainKind::canyon, 12.0F, 4.0F, 180.0F, 0.0F},
                           Walk{TerrainKind::canyon, 12.0F, -9.0F, 185.0F, 0.0F},
                           Walk{TerrainKind::canyon, 12.0F, -3.0F, 180.0F, -5.0F},
                           Walk{TerrainKind::noise, 5.0F, 5.0F, 200.0F, 0.0F}}) {
    SCOPED_TRACE(testing::Message() << walk.x_m << ", " << walk.z_m << ", " << walk.yaw_degrees);
    EXPECT_LT(way_m(walk, false, 8), 18.0F) << "the eye's ray passes over the lips that stop the body";
    EXPECT_GT(way_m(walk, true, 8), 25.0F);
  }
}

TEST(WayAhead, is_free_over_flat_ground_and_not_asked_for_up_or_down) {
  MapField field(rock_terrain);
  const glm::vec3 feet_m(0.0F, 0.02F, 0.0F), ahead(1.0F, 0.0F, 0.0F);
  EXPECT_FALSE(middle_of_way(field, feet_m, ahead, 1.5F));
  PieceTable pieces;
  apply(FillOperation{box({2.0F, 0.2F, 0.0F}, {1.2F, 0.5F, 2.0F})}, field, pieces);
  const auto middle_m = middle_of_way(field, feet_m, ahead, 1.5F);
  ASSERT_TRUE(middle_m);
  EXPECT_GT(middle_m->x, 0.5F);
  EXPECT_LT(middle_m->x, 1.6F);
  // A small dig takes the lip itself.
  EXPECT_LT(middle_of_way(field, feet_m, ahead, 0.5F)->y, 1.0F);
  for (const float up : {0.7F, -0.7F})
    EXPECT_FALSE(middle_of_way(field, feet_m, glm::normalize(glm::vec3(1.0F, up, 0.0F)), 1.5F));
}

}  // namespace
}  // namespace scree
