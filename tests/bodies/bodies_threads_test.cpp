// Bodies stepped by several threads: the same bits as by one, by each way to find the terrain.
#include <gtest/gtest.h>
#include <string>

#include "server/bodies/bodies.h"
#include "shared/base/random.h"
#include "tests/support/bodies_support.h"

namespace scree {
namespace {

BodyShape wedge(float size_m) {
  BodyShape shape;
  shape.hull_m = {{-size_m, -size_m, -size_m},
                  {size_m, -size_m, -size_m},
                  {0.0F, -size_m, size_m},
                  {0.0F, size_m, 0.0F},
                  {0.5F * size_m, 0.5F * size_m, 0.5F * size_m}};
  shape.mass_kg = 2000.0F * size_m * size_m * size_m;
  shape.inertia_kg_m2 = glm::mat3(shape.mass_kg * size_m * size_m * 0.4F);
  return shape;
}

/// Heaps that fall, are dug up, lose bodies, freeze and thaw: the hash of every tick, and what touched.
struct Heaps {
  std::vector<uint64_t> hashes;
  std::vector<size_t> contact_points;
  std::vector<size_t> overlaps;
  std::vector<PieceId> struck;

  bool operator==(const Heaps&) const = default;
};

Heaps heaps(TerrainColliderKind kind, size_t threads) {
  constexpr PieceId count = 240;
  MapField field(ground(TerrainKind::noise));
  BodiesConfig config;
  config.terrain_collider = kind;
  config.threads = threads;
  Bodies bodies(field, config);
  Random random(11);
  for (PieceId id = 1; id <= count; ++id) {
    const float x = 8.0F * static_cast<float>(id % 4) + 3.0F * random.unit(), z = 3.0F * random.unit();
    const float y = ground_height_m(field.source(), x, z) + 0.5F + 4.0F * random.unit();
    const glm::vec3 velocity = 6.0F * (glm::vec3(random.unit(), random.unit(), random.unit()) - 0.5F);
    bodies.add(wedge(0.15F + 0.25F * random.unit()), body_at(id, {x, y, z}, velocity));
  }
  Heaps seen;
  for (PieceId tick = 1; tick <= 70; ++tick) {
    bodies.step();
    seen.hashes.push_back(bodies.state_hash());
    seen.contact_points.push_back(bodies.contact_points());
    seen.overlaps.push_back(bodies.overlaps());
    for (const BodyImpact& impact : bodies.impacts(1.0F)) seen.struck.push_back(impact.id);
    if (tick == 30) dig(field, {1.5F, ground_height_m(field.source(), 1.5F, 1.5F), 1.5F}, 1.5F, bodies);
    if (tick % 10 == 0) bodies.remove(tick);
    if (tick > 40 && tick % 5 == 0) bodies.freeze(100 + tick);
  }
  return seen;
}

class BodiesThreads : public ::testing::TestWithParam<TerrainColliderKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, BodiesThreads,
                         ::testing::Values(TerrainColliderKind::field, TerrainColliderKind::mesh,
                                           TerrainColliderKind::rays),
                         [](const auto& info) { return std::string(row_of(info.param).name); });

TEST_P(BodiesThreads, make_no_difference_to_any_bit) {
  const Heaps alone = heaps(GetParam(), 1);
  EXPECT_GT(*std::ranges::max_element(alone.contact_points), 200U);
  EXPECT_GT(*std::ranges::max_element(alone.overlaps), 0U);
  EXPECT_FALSE(alone.struck.empty());
  for (const size_t threads : {2U, 4U}) EXPECT_TRUE(heaps(GetParam(), threads) == alone) << threads;
}

}  // namespace
}  // namespace scree
