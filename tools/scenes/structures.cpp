#include "tools/scenes/structures.h"

#include <algorithm>
#include <array>

namespace scree {

namespace {

const TerrainSource flat_ground{TerrainKind::flat, 1, 0.25F};
const TerrainSource canyon_ground{TerrainKind::canyon, 1, 0.25F};

SceneSetup on_ground(const TerrainSource& terrain, glm::vec3 eye_m, glm::vec3 target_m) {
  SceneSetup setup;
  setup.config.terrain = terrain;
  setup.eye_m = eye_m;
  setup.target_m = target_m;
  return setup;
}

void add(SceneSetup& setup, const Shape& shape) {
  setup.build.emplace_back(FillRequest{shape});
}

/// Between two corners.
Shape block(glm::vec3 lo_m, glm::vec3 hi_m) {
  return box(0.5F * (lo_m + hi_m), 0.5F * (hi_m - lo_m));
}

constexpr glm::vec3 up(float metres) {
  return {0.0F, metres, 0.0F};
}

}  // namespace

Shape post_at(glm::vec3 ground_m) {
  return box(ground_m + up(3.5F), {1.0F, 4.5F, 1.0F});
}

Shape foot_of_post(glm::vec3 ground_m) {
  return box(ground_m + up(2.5F), {1.6F, 0.75F, 1.6F});
}

Shape beam_between(glm::vec3 left_m, glm::vec3 right_m) {
  const float top_m = 7.0F + std::max(left_m.y, right_m.y);
  const float span_m = right_m.x - left_m.x;
  return box({0.5F * (left_m.x + right_m.x), top_m, left_m.z}, {0.5F * span_m + 1.0F, 1.0F, 1.0F});
}

CarveRequest strike(const Shape& shape, glm::vec3 impact_m, uint32_t seeds, float speed_m_s) {
  CarveRequest carve;
  carve.shape = shape;
  carve.seeds = seeds;
  carve.random_seed = 4;
  carve.impact_m = impact_m;
  carve.blast_speed_m_s = speed_m_s;
  return carve;
}

Result<SceneSetup> plain_scene(const std::string&) {
  SceneSetup setup = on_ground(flat_ground, {11.0F, 6.0F, 13.0F}, {0.0F, 0.0F, 0.0F});
  for (const glm::vec2 at : {glm::vec2(0.0F, 0.0F), {5.0F, -3.0F}, {-4.0F, -5.0F}, {1.5F, 2.5F}}) {
    const glm::vec3 impact_m(at.x, 0.0F, at.y);
    setup.strikes.push_back(strike(crater(impact_m - up(0.8F), 2.0F), impact_m, 48, 6.0F));
  }
  return setup;
}

Result<SceneSetup> cliffs_scene(const std::string&) {
  SceneSetup setup = on_ground(canyon_ground, {27.0F, 9.0F, 40.0F}, {3.0F, 4.0F, 26.0F});
  /// The caves: where they lie along the cliff, and how wide and high they are.
  struct Cave {
    float from_m, to_m, height_m;
  };
  constexpr std::array caves{Cave{18.0F, 25.0F, 6.0F}, Cave{26.0F, 33.0F, 4.5F}};
  constexpr float depth_m = 7.0F;
  for (const Cave& cave : caves) {
    for (float z = cave.from_m; z <= cave.to_m; z += 1.75F)
      add(setup, capsule({-1.0F, cave.height_m + 1.5F, z}, {depth_m, cave.height_m + 1.0F, z}, 1.6F));
    for (const float z : {cave.from_m, cave.to_m})
      add(setup, capsule({depth_m - 0.5F, -2.5F, z}, {depth_m - 0.5F, cave.height_m + 1.0F, z}, 1.1F));
    for (const float z : {cave.from_m - 0.5F, cave.to_m + 0.5F})
      add(setup, block({-2.0F, -2.5F, z - 0.75F}, {depth_m - 1.5F, cave.height_m + 1.5F, z + 0.75F}));
  }
  for (const Cave& cave : caves)
    for (const float z : {cave.from_m, cave.to_m}) {
      const glm::vec3 pillar_m(depth_m - 0.5F, 2.0F, z);
      setup.strikes.push_back(
          strike(crater(pillar_m, 2.0F), pillar_m + glm::vec3(2.0F, 0.0F, 0.0F), 32, 4.0F));
    }
  setup.strikes.push_back(strike(crater({0.5F, 9.5F, 14.0F}, 3.0F), {2.5F, 9.5F, 14.0F}, 80, 5.0F));
  return setup;
}

Result<SceneSetup> arch_scene(const std::string&) {
  SceneSetup setup = on_ground(flat_ground, {9.0F, 6.0F, 15.0F}, {0.0F, 3.5F, 0.0F});
  const glm::vec3 left_m(-4.0F, 0.0F, 0.0F), right_m(4.0F, 0.0F, 0.0F);
  add(setup, post_at(left_m));
  add(setup, post_at(right_m));
  add(setup, beam_between(left_m, right_m));
  for (const glm::vec3 foot_m : {left_m, right_m})
    setup.strikes.push_back(strike(foot_of_post(foot_m), foot_m + glm::vec3(0.0F, 2.5F, 1.5F), 16, 4.0F));
  return setup;
}

Result<SceneSetup> tower_scene(const std::string&) {
  SceneSetup setup = on_ground(flat_ground, {17.0F, 9.0F, 19.0F}, {0.0F, 6.5F, 0.0F});
  add(setup, block({-1.75F, -0.5F, -1.75F}, {1.75F, 3.0F, 1.75F}));
  add(setup, block({-1.25F, 2.5F, -1.25F}, {1.25F, 12.5F, 1.25F}));
  add(setup, block({-2.0F, 12.0F, -2.0F}, {2.0F, 13.5F, 2.0F}));
  for (const glm::vec2 corner : {glm::vec2(-1.5F, -1.5F), {-1.5F, 1.5F}, {1.5F, -1.5F}, {1.5F, 1.5F}})
    add(setup, block({corner.x - 0.5F, 13.0F, corner.y - 0.5F}, {corner.x + 0.5F, 14.75F, corner.y + 0.5F}));
  // What falls is a piece, which the next strike does not reach.
  for (const float y : {9.0F, 2.25F})
    setup.strikes.push_back(strike(box({0.0F, y, 0.0F}, {2.25F, 0.75F, 2.25F}), {2.0F, y, 1.0F}, 32, 5.0F));
  return setup;
}

Result<SceneSetup> bridge_scene(const std::string&) {
  constexpr float z = -30.0F, half_width_m = 1.75F, from_m = -5.0F, butte_m = 14.0F, end_m = 20.0F;
  const float deck_m = ground_height_m(canyon_ground, from_m, z);
  SceneSetup setup = on_ground(canyon_ground, {25.0F, deck_m + 3.0F, z + 24.0F}, {8.0F, deck_m - 6.0F, z});
  // The butte, in two: a fill reaches 8 m.
  add(setup, block({butte_m, -4.0F, z - 4.0F}, {end_m, 7.0F, z + 4.0F}));
  add(setup, block({butte_m + 0.5F, 6.0F, z - 3.0F}, {end_m - 0.5F, deck_m, z + 3.0F}));
  for (const auto& [lo_m, hi_m] : {std::pair(from_m, 6.0F), std::pair(5.5F, butte_m + 3.0F)}) {
    add(setup, block({lo_m, deck_m - 1.5F, z - half_width_m}, {hi_m, deck_m, z + half_width_m}));
    for (const float side : {-half_width_m + 0.375F, half_width_m - 0.375F})
      add(setup, block({lo_m, deck_m - 0.25F, z + side - 0.375F}, {hi_m, deck_m + 0.75F, z + side + 0.375F}));
  }
  for (const float x : {11.5F, 5.0F}) {
    const glm::vec3 cut_m(x, deck_m - 0.5F, z);
    setup.strikes.push_back(strike(box(cut_m, {0.75F, 2.0F, 2.5F}), cut_m + up(1.0F), 24, 3.0F));
  }
  setup.strikes.push_back(
      strike(crater({butte_m, 3.0F, z}, 3.0F), glm::vec3(butte_m - 2.0F, 3.0F, z), 64, 5.0F));
  return setup;
}

/// Terraces on three sides of a pit, each 2 m high and 2 m deep. A layer begins half a metre below its step,
/// in the one beneath, and is painted last, so that each ends at its step.
Result<SceneSetup> quarry_scene(const std::string&) {
  SceneSetup setup = on_ground(flat_ground, {15.0F, 10.0F, 17.0F}, {-1.0F, 3.0F, -6.0F});
  constexpr std::array layers{material::rock, material::soil, material::rock, material::ice, material::soil};
  constexpr float step_m = 2.0F, side_m = 16.0F;
  std::vector<BuildStep> painted;
  for (size_t i = 0; i < layers.size(); ++i) {
    const float low_m = step_m * static_cast<float>(i), high_m = low_m + step_m;
    const float edge_m = 4.0F + step_m * static_cast<float>(i);
    const float bottom_m = low_m - 0.5F;  // on the same plane, two fills leave a gap between them
    for (const auto& [lo_m, hi_m] :
         {std::pair(glm::vec3(-8.0F, bottom_m, -side_m), glm::vec3(8.0F, high_m, -edge_m)),
          std::pair(glm::vec3(-side_m, bottom_m, -side_m), glm::vec3(-edge_m, high_m, 0.0F)),
          std::pair(glm::vec3(edge_m, bottom_m, -side_m), glm::vec3(side_m, high_m, 0.0F))}) {
      add(setup, block(lo_m, hi_m));
      painted.emplace_back(PaintRequest{block({lo_m.x, low_m, lo_m.z}, hi_m), layers[i]});
    }
  }
  setup.build.insert(setup.build.end(), painted.begin(), painted.end());
  for (const glm::vec3 at_m :
       {glm::vec3(0.0F, 1.5F, -4.0F), {-3.0F, 5.0F, -8.5F}, {4.0F, 7.0F, -10.5F}, {-9.0F, 5.0F, -3.0F}})
    setup.strikes.push_back(strike(crater(at_m, 2.2F), at_m + glm::vec3(0.5F, 1.0F, 2.0F), 48, 5.0F));
  return setup;
}

}  // namespace scree
