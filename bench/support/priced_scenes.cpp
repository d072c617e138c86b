#include "bench/support/priced_scenes.h"

#include <algorithm>
#include <glm/common.hpp>

#include "bench/support/scenes.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

constexpr float block_m = 15.0F;    ///< side of the boxes that a scene is built from, at most
constexpr float overlap_m = 0.25F;  ///< of neighbouring boxes, or they would only touch
constexpr int looked_at_voxels = 64;
constexpr int settle_ticks_min = 120;

}  // namespace

void PricedScene::step(const std::vector<Command>& commands) {
  const auto delta = world_.step(commands);
  alive_ = delta->pieces.size();
  costs_.push_back({delta->times, delta->work, delta->state_hash});
}

void PricedScene::settle(int ticks_max) {
  for (int tick = 0; tick < ticks_max && (tick < settle_ticks_min || alive_ > 0); ++tick) step();
}

void PricedScene::build(glm::vec3 lo_m, glm::vec3 size_m) {
  const glm::ivec3 parts(glm::ceil(size_m / block_m));
  const glm::vec3 part_m = size_m / glm::vec3(parts);
  for (int x = 0; x < parts.x; ++x)
    for (int y = 0; y < parts.y; ++y)
      for (int z = 0; z < parts.z; ++z)
        ask(FillRequest{box(lo_m + part_m * (glm::vec3(x, y, z) + 0.5F), part_m * 0.5F + overlap_m)});
}

void PricedScene::generate(const Shape& shape) {
  gather(world_.field(), band_box(in_voxels(shape, terrain().voxel_size_m)).grown(looked_at_voxels));
}

WorldConfig flat_config() {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  return config;
}

CarveRequest still_carve(const Shape& shape, uint32_t seeds) {
  CarveRequest request;
  request.shape = shape;
  request.seeds = seeds;
  request.impact_m = centre_of(shape);
  request.blast_speed_m_s = 0.0F;
  return request;
}

std::vector<TickCost> cut_slab(float height_m) {
  PricedScene scene(flat_config());
  scene.build({-30.0F, 0.0F, -3.0F}, {60.0F, 20.0F, 6.0F});
  scene.settle(120);
  scene.begin();
  std::vector<Command> cuts;
  for (float x_m = -26.25F; x_m < 30.0F; x_m += 7.5F)
    cuts.push_back({0, 0, still_carve(box({x_m, height_m, 0.0F}, {3.9F, 0.25F, 3.5F}), 4)});
  scene.step(cuts);
  scene.settle(1200);
  return scene.costs();
}

std::vector<TickCost> large_carve(Cutter cutter, float radius_m, uint32_t seeds) {
  WorldConfig config = flat_config();
  config.methods.cutter = cutter;
  PricedScene scene(config);
  const CarveRequest blow = blow_at(config.terrain, 0.0F, 0.0F, radius_m, seeds, 1);
  scene.generate(blow.shape);
  scene.ask(blow);
  scene.settle(3600);
  return scene.costs();
}

std::vector<TickCost> large_pieces(int carves) {
  PricedScene scene({});
  for (int i = 0; i < carves; ++i) {
    const float x_m = -900.0F + 90.0F * static_cast<float>(i % 20), z_m = 100.0F * static_cast<float>(i / 20);
    const CarveRequest blow =
        blow_at(scene.terrain(), x_m, z_m, limits::edit_reach_max_m, 8, static_cast<uint32_t>(i));
    scene.generate(blow.shape);
    scene.ask(blow);
    for (int tick = 0; tick < 30; ++tick) scene.step();
  }
  scene.settle(3600);
  return scene.costs();
}

std::vector<TickCost> least_of(int runs, const std::function<std::vector<TickCost>()>& play) {
  std::vector<TickCost> least = play();
  for (int run = 1; run < runs; ++run) {
    const std::vector<TickCost> again = play();
    CHECK_EQ(again.size(), least.size());
    for (size_t i = 0; i < least.size(); ++i) {
      CHECK_EQ(again[i].state_hash, least[i].state_hash);
      for (size_t stage = 0; stage < tick_stages.size(); ++stage)
        least[i].times.ms[stage] = std::min(least[i].times.ms[stage], again[i].times.ms[stage]);
    }
  }
  return least;
}

}  // namespace scree
