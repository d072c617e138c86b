// Files as bodies: what scree-place makes of a .vox, and what it sends to a server.
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

#include "content/builtin_palette.h"
#include "server/app/live_server.h"
#include "server/fracture/own_volumes.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"
#include "tests/support/vox_bytes.h"
#include "tools/place/placed_piece.h"

namespace scree {
namespace {

using Voxels = std::vector<std::array<int, 4>>;

/// A file of one model: all its voxels of a box, by colour; 0: there is none.
template <typename ColourOf>
std::string write_vox(const TestFolder& folder, std::array<int, 3> size, ColourOf&& colour_of) {
  Voxels voxels;
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z)
        if (const int colour = colour_of(x, y, z); colour != 0) voxels.push_back({x, y, z, colour});
  VoxBytes bytes;
  bytes.model(size, voxels);
  const std::string path = folder / "made.vox";
  std::ofstream(path, std::ios::binary) << bytes.file();
  return path;
}

Result<PlacedPiece> placed(const std::string& path, const Palette& world) {
  const auto read = read_solids({path}, {.voxel_size_m = 0.25F,
                                         .palette = std::make_shared<const Palette>(world),
                                         .colour_rows_max = materials_max - world.rows.size()});
  EXPECT_TRUE(read) << read.error().message;
  return placed_piece(*read, world, material::soil);
}

TEST(PlacedPiece, has_a_voxel_for_each_of_the_file_and_z_becomes_y) {
  const TestFolder folder;
  const std::string path = write_vox(folder, {4, 6, 10}, [](int, int, int) { return 17; });
  const auto piece = placed(path, builtin_palette());
  ASSERT_TRUE(piece) << piece.error().message;
  EXPECT_EQ(piece->voxels, size_t{4 * 6 * 10});
  const VoxelCoord expected{6, 12, 8};  // with a layer of air
  EXPECT_EQ(piece->volume.window.box.size(), expected);
  EXPECT_EQ(piece->foot_voxels, glm::vec3(-0.5F, -0.5F, -0.5F));
  EXPECT_EQ(piece->volume.window.box.lo.y, -1);
  const auto own = own_volumes(piece->volume, RubbleRows());
  ASSERT_TRUE(own) << own.error().message;
  ASSERT_EQ(own->size(), 1U);
  EXPECT_NEAR(static_cast<double>(own->front().mass) / units_per_voxel, 240.0, 13.0);
}

TEST(PlacedPiece, colours_become_the_row_that_looks_most_like_them) {
  const Palette& world = builtin_palette();
  for (size_t row = 0; row < world.rows.size(); ++row) {
    const Material nearest = nearest_by_colour(world.rows[row].look.colour, world);
    EXPECT_EQ(world.row(nearest).look.colour, world.rows[row].look.colour) << world.rows[row].name;
    EXPECT_FALSE(world.row(nearest).rubble.has_value());
  }
  const TestFolder folder;
  const std::string path = write_vox(folder, {4, 4, 4}, [](int x, int, int) { return x < 2 ? 1 : 150; });
  const auto piece = placed(path, world);
  ASSERT_TRUE(piece) << piece.error().message;
  ASSERT_FALSE(piece->said.empty());
  EXPECT_TRUE(holds(piece->said.front(), "is no material of this world: taken as ")) << piece->said.front();
  for (const MaterialMass& one : masses_of(piece->volume)) EXPECT_TRUE(world.has(one.material));
}

TEST(PlacedPiece, what_is_too_large_is_refused_with_the_limit) {
  const TestFolder folder;
  const auto of = [&](std::array<int, 3> size) {
    const auto piece = placed(write_vox(folder, size, [](int x, int y, int z) { return x * y * z == 0; }),
                              builtin_palette());
    EXPECT_FALSE(piece);
    return piece ? "" : piece.error().message;
  };
  EXPECT_TRUE(holds(of({113, 3, 3}), "added_piece_side_max"));
  EXPECT_TRUE(holds(of({60, 60, 60}), "added_piece_voxels_max"));
}

TEST(PlaceProgram, a_file_becomes_a_kept_piece_of_a_running_world) {
  const TestFolder folder;
  const std::string path = write_vox(folder, {4, 4, 8}, [](int, int, int z) { return z == 0 ? 1 : 150; });
  LiveConfig config;
  config.world = rock_world();
  config.sim_threads = 1;
  config.net.admin_token = "the-admin-token";
  auto server = LiveServer::start(config);
  ASSERT_TRUE(server.has_value()) << server.error().message;
  const auto run = [&](const std::string& program, const std::string& words) {
    return run_program(program + " " + words + " --host 127.0.0.1 --token the-admin-token --port " +
                       std::to_string((*server)->port()));
  };
  const auto place = [&](const std::string& words) { return run(SCREE_PLACE_PROGRAM, words).second; };
  const std::string said = place(path + " --at 0 0.1 0 --turn 45");
  EXPECT_TRUE(holds(said, "piece 1 is kept, the first of 1\n")) << said;
  EXPECT_TRUE(holds(said, "taken as ")) << said;
  EXPECT_EQ(run(SCREE_ADMIN_PROGRAM, "release 1").second, "done\n");
  const std::string merged = place(path + " --at 6 0.1 0 --material brick --merge --json");
  EXPECT_TRUE(holds(merged, "\"piece\": 2")) << merged;
  EXPECT_TRUE(holds(merged, "\"kept\": false")) << merged;
  EXPECT_TRUE(holds(run(SCREE_ADMIN_PROGRAM, "release 2").second, "is not kept"));
  EXPECT_TRUE(holds(place(path + " --at 9000 1 0"), "lies outside the world"));
  EXPECT_TRUE(holds(place(path + " --at 0 1 0 --material bric"), "brick"));
  EXPECT_TRUE(holds(place(folder / "no.vox --at 0 1 0"), "no.vox"));
  EXPECT_TRUE(holds(place("ground.tif --at 0 1 0"), "a body is made of solids"));
}

}  // namespace
}  // namespace scree
