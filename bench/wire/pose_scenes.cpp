#include "bench/wire/pose_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "bench/support/scenes.h"
#include "server/bodies/bodies.h"

namespace scree {

namespace {

const TerrainSource plain{TerrainKind::flat, 1, 0.25F};
constexpr int boxes_a_side = 30;
constexpr float box_half_m = 0.2F, cube_half_m = 0.75F, spacing_m = 0.6F;
constexpr float cube_speed_m_s = 6.0F;
constexpr float blast_radius_m = 5.0F;
constexpr uint32_t blast_pieces = 1000;

BodyShape cube(float half_m, float mass_kg) {
  BodyShape shape;
  for (int corner = 0; corner < 8; ++corner)
    shape.hull_m.push_back({(corner & 1) != 0 ? half_m : -half_m, (corner & 2) != 0 ? half_m : -half_m,
                            (corner & 4) != 0 ? half_m : -half_m});
  shape.mass_kg = mass_kg;
  shape.inertia_kg_m2 = glm::mat3(mass_kg * 4.0F * half_m * half_m / 6.0F);
  return shape;
}

/// Gives the driven cube its speed, towards a place that wanders.
void drive(Bodies& bodies, const BodyShape& shape, PieceId id, float now_s) {
  BodyState state = bodies.state(id);
  const glm::vec3 wanted_m{8.0F * std::sin(0.7F * now_s), 0.0F, 9.0F * std::sin(0.45F * now_s - 1.5F)};
  glm::vec3 way_m = wanted_m - state.pose.position_m;
  way_m.y = 0.0F;
  const float speed_m_s = std::min(cube_speed_m_s, 4.0F * glm::length(way_m));
  const glm::vec3 velocity_m_s = way_m * (speed_m_s / std::max(glm::length(way_m), 0.01F));
  state.velocity_m_s = {velocity_m_s.x, state.velocity_m_s.y, velocity_m_s.z};
  bodies.remove(id);
  bodies.add(shape, state);
}

}  // namespace

std::vector<PoseTick> pushed_boxes(uint32_t ticks) {
  MapField field(plain);
  Bodies bodies(field, BodiesConfig{});
  const BodyShape box = cube(box_half_m, 100.0F), driven = cube(cube_half_m, 8000.0F);
  const float ground_m = ground_height_m(plain, 0.0F, 0.0F);
  PieceId last = 0;
  for (int i = 0; i < boxes_a_side * boxes_a_side; ++i) {
    const auto place_m = [](int n) {
      return (static_cast<float>(n) - 0.5F * (boxes_a_side - 1)) * spacing_m;
    };
    const Pose pose{{place_m(i % boxes_a_side), ground_m + 0.22F, place_m(i / boxes_a_side)}};
    bodies.add(box, {.id = ++last, .pose = pose});
  }
  bodies.add(driven, {.id = ++last, .pose = {{0.0F, ground_m + 3.0F, -12.0F}}});

  std::vector<PoseTick> scene;
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    drive(bodies, driven, last, static_cast<float>(tick) / 60.0F);
    bodies.step();
    auto delta = std::make_shared<TickDelta>();
    delta->tick = tick;
    PoseTick now;
    for (const BodyState& body : bodies.states()) {
      if (tick == 1) delta->spawned.push_back({body.id, std::make_shared<const Volume>()});
      delta->pieces.push_back({body.id, quantise(body.pose)});
      now.exact.push_back(body.pose);
    }
    now.delta = std::move(delta);
    scene.push_back(std::move(now));
  }
  return scene;
}

std::vector<PoseTick> blast(uint32_t ticks) {
  WorldConfig config;
  config.terrain = plain;
  config.methods.recombine = Recombination::off;
  World world(config);
  CarveRequest blow = blow_at(plain, 0.0F, 0.0F, blast_radius_m, blast_pieces, 5);
  blow.pattern = SeedPattern::uniform;
  blow.blast_speed_m_s = 10.0F;
  std::vector<PoseTick> scene;
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    const Command command{0, 1, blow};
    scene.push_back({world.step(std::span(&command, tick == 1 ? 1 : 0)), {}});
  }
  return scene;
}

}  // namespace scree
