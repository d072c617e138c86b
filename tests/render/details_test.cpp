// Grass, bushes and stones: by their place alone, on the ground, and gone where somebody changed it.
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/render/details/detail_field.h"
#include "client/render/details/detail_meshes.h"
#include "client/render/details/ground_cover.h"
#include "shared/field/shape.h"
#include "shared/operation/operation.h"

namespace scree {
namespace {

const glm::vec3 sun = glm::normalize(glm::vec3(0.72F, 0.62F, 0.42F));
constexpr ChunkCoord flat_chunk{0, -1, 0};  // whose uppermost voxels are the ground's

void generate_about(const Field& field, ChunkCoord chunk) {
  for (const ChunkCoord at : {chunk, ChunkCoord{chunk.x, chunk.y + 1, chunk.z}})
    field.adopt_generated(at, generate_chunk(field.source(), at));
}

size_t standing(const std::vector<PlacedDetail>& placed) {
  return static_cast<size_t>(std::ranges::count_if(placed, &PlacedDetail::stands));
}

/// The first chunk of the flat ground that has some.
ChunkCoord chunk_with_details(const Field& field) {
  for (int x = 0; x < 8; ++x) {
    const ChunkCoord chunk{x, flat_chunk.y, 0};
    generate_about(field, chunk);
    if (scatter_details(field, chunk).size() > 40) return chunk;
  }
  ADD_FAILURE() << "nothing grows there";
  return flat_chunk;
}

TEST(Details, are_the_same_wherever_one_comes_from_and_stand_on_the_ground) {
  const TerrainSource source{TerrainKind::canyon, 1, 0.25F};
  const MapField one(source), other(source);
  size_t seen = 0;
  for (int x = 1; x < 4; ++x)
    for (int y = -1; y < 2; ++y) {
      const ChunkCoord chunk{x, y, 0};
      generate_about(one, chunk);
      generate_about(other, chunk);
      const std::vector<PlacedDetail> a = scatter_details(one, chunk), b = scatter_details(other, chunk);
      ASSERT_EQ(a.size(), b.size());
      for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].detail, b[i].detail);
        EXPECT_NEAR(sample(one, a[i].detail.place_m / 0.25F).distance_voxels, 0.0F, 0.25F);
        EXPECT_EQ(chunk_of(a[i].cell), chunk);
      }
      seen += a.size();
    }
  EXPECT_GT(seen, 100U);
}

TEST(Details, are_gone_where_the_ground_was_struck_and_nowhere_else) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  const ChunkCoord chunk = chunk_with_details(field);
  std::vector<PlacedDetail> placed = scatter_details(field, chunk);
  EXPECT_FALSE(check_standing(field, chunk, placed));
  const size_t before = standing(placed);
  const glm::vec3 at_m = placed.front().detail.place_m;
  PieceTable pieces;
  apply(CarveOperation{sphere(at_m, 1.0F), SeedPattern::uniform, 4, 5, at_m, 1}, field, pieces);
  EXPECT_TRUE(check_standing(field, chunk, placed));
  EXPECT_LT(standing(placed), before);
  for (const PlacedDetail& one : placed) {
    const float far_m = glm::distance(one.detail.place_m, at_m);
    if (far_m < 0.9F) {
      EXPECT_FALSE(one.stands) << far_m;
    }
    if (far_m > 2.0F) {
      EXPECT_TRUE(one.stands) << far_m;
    }
  }
  field.forget_chunk(chunk);
  field.forget_chunk({chunk.x, chunk.y + 1, chunk.z});
  EXPECT_TRUE(check_standing(field, chunk, placed)) << "a prediction that was undone";
  EXPECT_EQ(standing(placed), before);
}

TEST(Details, have_no_sun_behind_a_wall) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  const ChunkCoord chunk = chunk_with_details(field);
  PlacedDetail one = scatter_details(field, chunk).front();
  light_detail(field, sun, one);
  EXPECT_EQ(one.detail.colour[3], 15 * 16 + 15);
  const glm::vec3 middle_m = one.detail.place_m + sun * 4.0F;
  PieceTable pieces;
  apply(FillOperation{sphere(middle_m, 1.0F)}, field, pieces);
  EXPECT_TRUE(light_detail(field, sun, one));
  EXPECT_LT(one.detail.colour[3], 16) << "in its shade";
}

TEST(DetailField, settles_within_its_range_and_generates_nothing) {
  const MapField field({TerrainKind::canyon, 1, 0.25F});
  DetailField details;
  const glm::vec3 eye_m(24.0F, 4.0F, 4.0F);
  details.follow(field, {}, eye_m, 20.0F, sun);
  EXPECT_EQ(field.generated_chunks(), 0U);
  EXPECT_EQ(details.count(), 0U);
  for (int x = -1; x < 7; ++x)
    for (int y = -3; y < 4; ++y)
      for (int z = -4; z < 5; ++z)
        field.adopt_generated({x, y, z}, generate_chunk(field.source(), {x, y, z}));
  int frames = 0;
  do {
    details.follow(field, {}, eye_m, 20.0F, sun);
    ASSERT_LT(++frames, 500);
  } while (!details.settled());
  const size_t all = details.count();
  EXPECT_GT(all, 200U);
  for (int i = 0; i < 40; ++i) details.follow(field, {}, eye_m + glm::vec3(300.0F, 0.0F, 0.0F), 20.0F, sun);
  details.follow(field, {}, eye_m, 0.0F, sun);
  EXPECT_EQ(details.count(), 0U) << "a range of nothing";
}

TEST(DetailMeshes, are_small_and_within_their_size) {
  for (size_t kind = 0; kind < detail_kinds; ++kind) {
    const DetailMesh mesh = detail_mesh(static_cast<DetailKind>(kind));
    EXPECT_EQ(mesh.corners.size() % 3, 0U);
    EXPECT_LE(mesh.corners.size() / 3, 160U);
    for (const uint16_t corner : mesh.corners) ASSERT_LT(corner, mesh.vertices.size());
    for (const DetailVertex& vertex : mesh.vertices) EXPECT_LT(glm::length(vertex.place), 1.6F);
  }
}

TEST(GroundCover, is_scrub_or_sand_where_it_is_flat_and_snow_on_the_heights) {
  const glm::vec3 up(0.0F, 1.0F, 0.0F), aside(1.0F, 0.0F, 0.0F);
  EXPECT_EQ(ground_cover({3.0F, 2.0F, 5.0F}, up, 19.0F).flat, 1.0F);
  EXPECT_EQ(ground_cover({3.0F, 2.0F, 5.0F}, aside, 19.0F).flat, 0.0F);
  EXPECT_EQ(ground_cover({3.0F, 2.0F, 5.0F}, up, 19.0F).snow, 0.0F);
  EXPECT_GT(ground_cover({3.0F, 30.0F, 5.0F}, up, 19.0F).snow, 0.9F);
  float least = 1.0F, most = 0.0F;
  for (int x = 0; x < 40; ++x) {
    const float green = ground_cover({static_cast<float>(x) * 3.0F, 0.0F, 0.0F}, up, 19.0F).green;
    least = std::min(least, green);
    most = std::max(most, green);
  }
  EXPECT_EQ(least, 0.0F);
  EXPECT_EQ(most, 1.0F);
}

}  // namespace
}  // namespace scree
