// Misuse of the field's kernels aborts, in every build.
#include <gtest/gtest.h>

#include "shared/field/edit.h"
#include "shared/field/field.h"
#include "shared/field/redistance.h"

namespace scree {
namespace {

constexpr VoxelBox small{{0, 0, 0}, {4, 4, 4}};
constexpr VoxelBox beside{{1, 0, 0}, {5, 4, 4}};  // as many voxels, elsewhere

TEST(FieldDeathTest, windows_of_one_call_have_the_same_box) {
  Window window(small);
  EXPECT_DEATH(carve(window, Window(beside)), "CHECK failed: window.box == shape.box");
  EXPECT_DEATH(fill(window, Window(beside)), "CHECK failed: window.box == shape.box");
  EXPECT_DEATH(extract(window, Window(beside)), "CHECK failed: window.box == shape.box");
}

TEST(FieldDeathTest, a_part_lies_in_its_window) {
  Window window(small);
  EXPECT_DEATH(part_of(window, beside), "CHECK failed: window.box.covers");
  EXPECT_DEATH(put(Window(beside), window), "CHECK failed: window.box.covers");
  EXPECT_EQ(part_of(window, small).codes, window.codes);
}

TEST(FieldDeathTest, a_window_to_redistance_has_an_inside) {
  Window thin({{0, 0, 0}, {2, 8, 8}});
  EXPECT_DEATH(redistance(thin), "CHECK failed");
}

TEST(FieldDeathTest, a_window_has_a_code_for_every_voxel) {
  MapField field(TerrainSource{TerrainKind::flat});
  Window window(small);
  window.codes.pop_back();
  EXPECT_DEATH(scatter(field, window), "63, 64");
}

TEST(FieldDeathTest, a_chunk_from_another_thread_has_all_its_bricks) {
  MapField field(TerrainSource{TerrainKind::flat});
  GeneratedChunk chunk = generate_chunk(field.source(), {0, 5, 0});
  chunk.bricks[63] = nullptr;
  EXPECT_DEATH(field.adopt_generated({0, 5, 0}, std::move(chunk)), "CHECK failed");
}

#ifdef SCREE_CHECK_DEBUG
TEST(FieldDeathTest, indices_lie_in_the_window_and_codes_in_the_band) {
  const Window window(small);
  EXPECT_DEATH(static_cast<void>(window.at(4, 0, 0)), "CHECK failed: box.holds");
  MapField field(TerrainSource{TerrainKind::flat});
  Brick brick = air_brick();
  brick.codes[7] = -128;
  EXPECT_DEATH(field.set_brick({0, 0, 0}, brick), "CHECK failed");
}
#endif

}  // namespace
}  // namespace scree
