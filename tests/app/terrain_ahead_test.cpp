// Terrain generated around eyes before anything touches it: all of it comes, it is what the field itself
// would have made, and what one eye needs never pushes out what another one has.
#include "server/app/terrain_ahead.h"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "server/app/limits.h"
#include "shared/base/limits.h"

namespace scree {
namespace {

const TerrainSource terrain{TerrainKind::noise, 3, 0.25F};

/// Whether the chunks within the reach of an eye in chunk 0, 0, 0 are there.
bool all_there(const Field& field) {
  const int r = limits::ahead_chunks;
  for (int x = -r; x <= r; ++x)
    for (int y = -r; y <= r; ++y)
      for (int z = -r; z <= r; ++z)
        if (x * x + y * y + z * z <= r * r && !field.has_generated({x, y, z})) return false;
  return true;
}

/// Serves until that holds, as long as a broken worker would need to be noticed.
template <typename Holds>
bool serve_until(TerrainAhead& ahead, Field& field, std::span<const glm::vec3> eyes_m, Holds&& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    ahead.serve(field, eyes_m);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

TEST(TerrainAhead, all_around_an_eye_comes_and_is_what_the_field_makes) {
  MapField field(terrain), own(terrain);
  TerrainAhead ahead(terrain);
  const glm::vec3 eyes_m[] = {{1.0F, 2.0F, 3.0F}};
  ASSERT_TRUE(serve_until(ahead, field, eyes_m, [&] { return all_there(field); }));
  for (int x = -16; x < 16; ++x)
    for (int y = -8; y < 8; ++y)
      EXPECT_EQ(field.generated_brick({x, y, 2}).codes, own.generated_brick({x, y, 2}).codes);
}

TEST(TerrainAhead, every_eye_is_served) {
  MapField field(terrain);
  TerrainAhead ahead(terrain);
  const glm::vec3 eyes_m[] = {{1.0F, 2.0F, 3.0F}, {-400.0F, 2.0F, 300.0F}};
  EXPECT_TRUE(serve_until(ahead, field, eyes_m, [&] {
    return all_there(field) && field.has_generated({-50, 0, 37});
  }));
}

TEST(TerrainAhead, an_eye_far_out_of_the_world_counts_at_its_edge) {
  MapField field(terrain);
  TerrainAhead ahead(terrain);
  const glm::vec3 eyes_m[] = {{1e30F, 0.0F, 0.0F}};
  EXPECT_TRUE(serve_until(ahead, field, eyes_m, [&] { return field.has_generated({512, 0, 0}); }));
}

TEST(TerrainAhead, what_an_edit_asks_for_comes_before_what_lies_around_eyes) {
  MapField field(terrain);
  TerrainAhead ahead(terrain);
  const VoxelBox box{{10000, -5, 3000}, {10130, 70, 3001}};  // far from the eye
  EXPECT_FALSE(ahead.has(field, box));
  const glm::vec3 eyes_m[] = {{1.0F, 2.0F, 3.0F}};
  EXPECT_TRUE(serve_until(ahead, field, eyes_m, [&] { return ahead.has(field, box); }));
  for_each_chunk(box, [&](ChunkCoord chunk) { EXPECT_TRUE(field.has_generated(chunk)); });
  EXPECT_FALSE(all_there(field));
}

TEST(TerrainAhead, eyes_far_apart_do_not_take_more_than_the_field_keeps) {
  MapField field(terrain);
  constexpr size_t bytes_max = size_t{1} << 20U;
  field.bound_generated(bytes_max);
  TerrainAhead ahead(terrain);
  std::vector<glm::vec3> eyes_m;
  for (int i = 0; i < 40; ++i) eyes_m.emplace_back(100.0F * static_cast<float>(i) - 2000.0F, 2.0F, 3.0F);
  const ChunkCoord first = chunk_of(VoxelCoord{-8000, 8, 12});
  ASSERT_TRUE(serve_until(ahead, field, eyes_m, [&] { return field.has_generated(first); }));
  for (int i = 0; i < 400; ++i) {
    ahead.serve(field, eyes_m);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(field.has_generated(first)) << "it was not pushed out by what other eyes need";
  }
  EXPECT_LE(field.generated_bytes(), bytes_max);
}

}  // namespace
}  // namespace scree
