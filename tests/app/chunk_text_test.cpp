// The dump of a chunk: bricks in order, codes by layers from the highest down.
#include "server/app/chunk_text.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/support/materials.h"

namespace scree {
namespace {

BrickPatch patch_at(BrickCoord coord, Code fill) {
  BrickPatch patch{coord, {}, {}};
  patch.brick.codes.fill(fill);
  return patch;
}

TEST(ChunkText, bricks_without_a_surface_take_a_line_each) {
  BrickPatch rock = patch_at({-3, 1, 8}, code_solid);
  rock.materials = all_of(material::ice);
  const std::vector<BrickPatch> bricks = {patch_at({-3, 2, 8}, code_air), rock};
  const std::string text = chunk_text({-1, 0, 2}, bricks);
  EXPECT_TRUE(
      text.starts_with("chunk (-1, 0, 2): 2 edited bricks; all others are the ground's\n"
                       "brick (-3, 1, 8): material 2, hash "))
      << text;
  EXPECT_NE(text.find(", all rock\nbrick (-3, 2, 8): the ground's materials, hash "), std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with(", all air\n"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 3);
}

TEST(ChunkText, codes_stand_in_layers_from_the_highest_down) {
  BrickPatch surface = patch_at({0, 1, 0}, code_air);
  surface.brick.codes[static_cast<size_t>(Brick::index(2, 7, 3))] = -12;
  surface.brick.codes[static_cast<size_t>(Brick::index(0, 0, 0))] = code_solid;
  const std::string text = chunk_text({0, 0, 0}, std::vector<BrickPatch>{surface});
  const size_t highest = text.find("  y = 15\n"), lowest = text.find("  y = 8\n");
  ASSERT_NE(highest, std::string::npos);
  ASSERT_NE(lowest, std::string::npos);
  const std::string air = "    .    .    .    .    .    .    .    .\n";
  EXPECT_EQ(text.substr(highest + 9, air.size() * 3),
            air + air + "    .    .    .  -12    .    .    .    .\n");
  EXPECT_EQ(text.substr(lowest + 8, air.size()), "    #    .    .    .    .    .    .    .\n");
  EXPECT_EQ(std::ranges::count(text, '\n'), 2 + 8 * 9);
}

TEST(ChunkText, a_file_that_is_no_world_is_refused) {
  const auto text = saved_chunk_text("/no/such.world", {0, 0, 0});
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().message.find("/no/such.world"), std::string::npos) << text.error().message;
}

}  // namespace
}  // namespace scree
