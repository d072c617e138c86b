#include "bench/support/blow_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "server/formats/world_value.h"
#include "shared/base/check.h"
#include "shared/field/window.h"

namespace scree {

namespace {

constexpr float blow_voxel_m = 0.25F;

WorldConfig rock_ground() {
  WorldConfig config;
  config.terrain = {
      TerrainKind::flat, 1, blow_voxel_m, {}, {material::rock, material::rock, material::rock, 1.0F, 1.5F}};
  auto palette = std::make_shared<Palette>(builtin_palette());
  palette->ground = config.terrain.rows;
  config.palette = std::move(palette);
  config.methods.recombine = Recombination::off;
  return config;
}

/// A box by its lowest corner and its size, between planes of voxels.
Shape block(glm::vec3 lo_m, glm::vec3 size_m) {
  const glm::vec3 half = 0.5F * size_m;
  return box(lo_m + half - 0.5F * blow_voxel_m, half);
}

std::vector<glm::vec3> grid(glm::vec3 lo_m, glm::vec3 size_m) {
  std::vector<glm::vec3> places;
  for (float x = 0.0F; x < size_m.x; x += blow_voxel_m)
    for (float y = 0.0F; y < size_m.y; y += blow_voxel_m)
      for (float z = 0.0F; z < size_m.z; z += blow_voxel_m) places.push_back(lo_m + glm::vec3(x, y, z));
  return places;
}

float fall_m_s(float height_m) {
  return std::sqrt(2.0F * 9.81F * height_m);
}

BlowScene roof() {
  BlowScene scene{.name = "roof", .direction = {0.0F, -1.0F, 0.0F}, .ticks = 60};
  for (const float side : {-6.0F, 5.0F}) {
    scene.target.push_back(block({side, -0.5F, -6.0F}, {1.0F, 5.5F, 12.0F}));
    scene.target.push_back(block({-6.0F, -0.5F, side}, {12.0F, 5.5F, 1.0F}));
  }
  scene.target.push_back(block({-6.0F, 5.0F, -6.0F}, {12.0F, blow_voxel_m, 12.0F}));
  scene.striker = block({-3.75F, 6.0F, -3.75F}, {7.5F, 7.5F, 7.5F});
  for (const float height_m : {0.5F, 2.0F, 5.0F, 15.0F}) scene.speeds_m_s.push_back(fall_m_s(height_m));
  scene.places_m = grid({-5.0F, 5.0F, -5.0F}, {10.0F, blow_voxel_m, 10.0F});
  return scene;
}

BlowScene pillar() {
  BlowScene scene{.name = "pillar", .direction = {1.0F, 0.0F, 0.0F}, .ticks = 60};
  scene.target.push_back(block({0.0F, -0.5F, 0.0F}, {0.5F, 6.5F, 0.5F}));
  scene.striker = block({-3.25F, 2.0F, -1.0F}, {2.5F, 2.5F, 2.5F});
  scene.speeds_m_s = {2.0F, 5.0F, 10.0F, 20.0F};
  scene.places_m = grid({0.0F, 0.25F, 0.0F}, {0.5F, 5.5F, 0.5F});
  return scene;
}

BlowScene dominoes() {
  constexpr int towers = 10;
  BlowScene scene{.name = "dominoes", .direction = {1.0F, 0.0F, 0.0F}, .ticks = 1800};
  for (int i = 0; i < towers; ++i) {
    const float x = 5.0F * static_cast<float>(i);
    scene.target.push_back(block({x, -0.5F, -2.0F}, {1.5F, 12.5F, 4.0F}));
    scene.places_m.push_back({x + 0.75F, 6.0F, 0.0F});
  }
  scene.striker = block({-3.5F, 8.5F, -1.25F}, {2.5F, 2.5F, 2.5F});
  scene.speeds_m_s = {2.0F, 5.0F, 10.0F, 20.0F};
  return scene;
}

BlowScene ball() {
  BlowScene scene{.name = "ball", .direction = {1.0F, 0.0F, 0.0F}, .ticks = 60};
  scene.target.push_back(block({0.0F, -0.5F, -5.0F}, {0.5F, 6.5F, 10.0F}));
  scene.striker = sphere({-1.5F, 4.0F, 0.0F}, 1.0F);
  scene.speeds_m_s = {2.0F, 5.0F, 10.0F, 20.0F};
  scene.places_m = grid({0.0F, 0.25F, -5.0F}, {0.5F, 5.5F, 10.0F});
  return scene;
}

BlowScene plate() {
  BlowScene scene{.name = "plate", .direction = {0.0F, -1.0F, 0.0F}, .ticks = 60};
  for (const float x : {-4.0F, 3.0F})
    for (const float z : {-4.0F, 3.0F}) scene.target.push_back(block({x, -0.5F, z}, {1.0F, 4.5F, 1.0F}));
  scene.target.push_back(block({-4.0F, 4.0F, -4.0F}, {8.0F, 0.5F, 8.0F}));
  scene.striker = block({-0.5F, 5.0F, -0.5F}, {1.0F, 1.0F, 1.0F});
  for (const float height_m : {0.5F, 2.0F, 5.0F, 15.0F}) scene.speeds_m_s.push_back(fall_m_s(height_m));
  scene.places_m = grid({-4.0F, 4.0F, -4.0F}, {8.0F, 0.5F, 8.0F});
  return scene;
}

bool is_rock(const Field& field, glm::vec3 place_m) {
  const glm::vec3 at = place_m / blow_voxel_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
  const VoxelCoord inside = voxel - first_voxel(brick_of(voxel));
  return field.brick(brick_of(voxel)).codes[static_cast<size_t>(Brick::index(inside.x, inside.y, inside.z))] <
         0;
}

int64_t target_voxels(const Field& field, const BlowScene& scene) {
  int64_t voxels = 0;
  VoxelBox all{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  for (const Shape& shape : scene.target) all = hull_of(all, band_box(in_voxels(shape, blow_voxel_m)));
  all.lo.y = std::max(all.lo.y, 1);  // the ground's own does not count
  const Window window = gather(field, all);
  for (const Code code : window.codes) voxels += code < 0 ? 1 : 0;
  return voxels;
}

/// The energy of all bodies' motion, but for their spin.
double energy_of(const WorldMoment& moment) {
  double energy_j = 0.0;
  for (size_t i = 0; i < moment.pieces.size(); ++i) {
    const glm::vec3 v = moment.motion.bodies[i].velocity_m_s;
    energy_j +=
        0.5 * static_cast<double>(moment.pieces[i].shape->mass_kg) * static_cast<double>(glm::dot(v, v));
  }
  return energy_j;
}

/// The target, and the striker as a body at that speed.
std::unique_ptr<World> set_out(const BlowScene& scene, float speed_m_s, uint32_t rules) {
  WorldConfig config = rock_ground();
  config.rules = rules;
  World world(config);
  std::vector<Command> commands;
  uint32_t request = 0;
  for (const Shape& shape : scene.target) commands.push_back({1, ++request, FillRequest{shape}});
  world.step(commands);
  for (int i = 0; i < 600 && world.step({})->work.requests_waiting > 0; ++i) {
  }
  std::vector<Command> fill{{1, ++request, FillRequest{scene.striker}}};
  world.step(fill);  // nothing holds it: it is an island
  WorldSnapshot value = world.snapshot();
  for (int i = 0; i < 600 && value.moment.motion.bodies.empty(); ++i) {
    world.step({});
    value = world.snapshot();
  }
  CHECK_EQ(value.moment.motion.bodies.size(), 1U);
  value.moment.motion.bodies.front().velocity_m_s = scene.direction * speed_m_s;
  auto restored = World::salvage(value);
  CHECK(restored.has_value());
  return std::move(*restored);
}

}  // namespace

std::vector<BlowScene> blow_scenes() {
  return {roof(), pillar(), dominoes(), ball(), plate()};
}

BlowOutcome strike(const BlowScene& scene, float speed_m_s, uint32_t rules) {
  const auto world = set_out(scene, speed_m_s, rules);
  BlowOutcome outcome;
  const WorldMoment start = world->moment();
  const double kg = static_cast<double>(start.pieces.front().shape->mass_kg);
  outcome.energy_j = 0.5 * kg * static_cast<double>(speed_m_s) * static_cast<double>(speed_m_s);
  const int64_t before = target_voxels(world->field(), scene);
  bool broke = false;
  for (uint32_t tick = 0; tick < scene.ticks; ++tick) {
    const auto delta = world->step({});
    const bool breaks = std::ranges::any_of(delta->operations, [](const AppliedOperation& applied) {
      return applied.stage == TickStage::impacts && std::holds_alternative<CarveOperation>(applied.operation);
    });
    if (breaks && !std::exchange(broke, true)) {
      outcome.energy_left_j = energy_of(world->moment());
      outcome.first = before - target_voxels(world->field(), scene);
    }
    outcome.worst_ms = std::max(outcome.worst_ms, delta->times[TickStage::impacts]);
    CHECK_EQ(delta->ledger.error(), 0);
  }
  outcome.voxels = before - target_voxels(world->field(), scene);
  outcome.gone = static_cast<size_t>(std::ranges::count_if(
      scene.places_m, [&](glm::vec3 place_m) { return !is_rock(world->field(), place_m); }));
  return outcome;
}

}  // namespace scree
