// Exports: surfaces that touch themselves are closed, colours of points, elevation models, and what comes
// back when they are imported.
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "shared/field/field.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_ground.h"
#include "tools/export/elevation.h"
#include "tools/export/gdal/geotiff_export.h"
#include "tools/export/mesh_export.h"
#include "tools/export/pinches.h"
#include "tools/export/vdb/vdb_export.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/heights_import.h"

namespace scree {
namespace {

void quiet(double) {}

/// Edges that do not have one triangle on each side, and no more.
size_t bad_edges(const WeldedSurface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (const auto& t : surface.triangles)
    for (size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  size_t bad = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    bad += count != 1 || back == uses.end() || back->second != 1 ? 1 : 0;
  }
  return bad;
}

/// A cube; points that are there already are taken.
void add_cube(WeldedSurface& surface, int x, int y, int z) {
  std::array<uint32_t, 8> at{};
  for (int i = 0; i < 8; ++i) {
    const WeldedSurface::Point p{4 * (x + (i >> 2)), 4 * (y + ((i >> 1) & 1)), 4 * (z + (i & 1))};
    const auto found = std::ranges::find(surface.points, p);
    at[static_cast<size_t>(i)] = static_cast<uint32_t>(found - surface.points.begin());
    if (found != surface.points.end()) continue;
    surface.points.push_back(p);
    surface.materials.push_back(material::rock);
  }
  for (const auto& [a, b, c, d] : std::initializer_list<std::array<size_t, 4>>{
           {0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
    surface.triangles.push_back({at[a], at[b], at[c]});
    surface.triangles.push_back({at[a], at[c], at[d]});
  }
}

TEST(Pinches, surfaces_that_touch_in_a_point_along_an_edge_or_themselves_become_closed) {
  WeldedSurface point, edge, ring;
  add_cube(point, 0, 0, 0);
  const size_t alone = point.points.size();
  EXPECT_EQ(split_pinches(point), 0U);
  add_cube(point, 1, 1, 1);
  EXPECT_EQ(split_pinches(point), 1U) << "each cube has its corner";
  EXPECT_EQ(point.points.size(), 2 * alone);
  add_cube(edge, 0, 0, 0);
  add_cube(edge, 1, 1, 0);
  ASSERT_GT(bad_edges(edge), 0U);
  EXPECT_GT(split_pinches(edge), 0U);
  EXPECT_EQ(bad_edges(edge), 0U);
  for (const auto& [x, y] : std::initializer_list<std::pair<int, int>>{{0, 0}, {1, 1}, {2, 0}, {1, -1}})
    add_cube(ring, x, y, 0);  // around a hole, edge to edge
  EXPECT_GT(split_pinches(ring), 0U);
  EXPECT_EQ(bad_edges(ring), 0U);
  EXPECT_EQ(ring.materials.size(), ring.points.size());
}

class ExportTest : public ::testing::Test {
 protected:
  /// A pit, a tower beside it, and a slab over both.
  ExportTest() {
    carve(-12, -20, -12, 4, 0, 4, code_air);
    carve(8, 0, 8, 16, 24, 16, code_solid);
    carve(0, 32, 0, 16, 40, 16, code_solid);
  }
  void carve(int x0, int y0, int z0, int x1, int y1, int z1, Code code) {
    Window window = gather(field_, {{x0 - 8, y0 - 8, z0 - 8}, {x1 + 8, y1 + 8, z1 + 8}});
    for (int x = x0; x < x1; ++x)
      for (int y = y0; y < y1; ++y)
        for (int z = z0; z < z1; ++z) window.at(x, y, z) = code;
    scatter(field_, window);
  }
  std::string read(const std::string& path) const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TestFolder folder_;
  MapField field_{flat_terrain};
  const ChunkBox box_ = chunks_of({-15.9F, -15.9F, -15.9F}, {15.9F, 15.9F, 15.9F}, voxel_m);
};

TEST_F(ExportTest, a_glb_is_one_closed_mesh_with_the_colours_of_its_materials) {
  field_.set_materials(brick_of(VoxelCoord{12, 20, 12}), BrickMaterials(said(material::ice)));
  const auto exported = export_mesh(field_, builtin_palette(), box_, folder_ / "rock.glb", quiet);
  ASSERT_TRUE(exported) << exported.error().message;
  const std::string bytes = read(folder_ / "rock.glb");
  EXPECT_EQ(bytes.size(), exported->bytes);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  for (const char* name : {"ice", "rock"}) {
    const auto colour = builtin_palette().row(*builtin_palette().named(name)).look.colour;
    const nlohmann::json factor{colour[0], colour[1], colour[2], 1.0};
    EXPECT_NE(bytes.find("\"name\":\"" + std::string(name) +
                         "\",\"pbrMetallicRoughness\":{\"baseColorFactor\":" + factor.dump()),
              std::string::npos)
        << name;
  }
  const auto back = read_solids({folder_ / "rock.glb"}, {});
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_NE(back->said.front().find(", closed"), std::string::npos) << back->said.front();
  EXPECT_NEAR(back->meshes_volume_m3, exported->volume_m3, 1e-3 * exported->volume_m3);
}

TEST_F(ExportTest, an_elevation_model_has_the_highest_surface_and_nothing_where_there_is_none) {
  const auto exported = export_geotiff(field_, box_, folder_ / "all.tif", {}, quiet);
  ASSERT_TRUE(exported) << exported.error().message;
  auto raster = open_raster(folder_ / "all.tif");
  ASSERT_TRUE(raster) << raster.error().message;
  const Raster::Shape shape = (*raster)->shape();
  ASSERT_EQ(shape.columns, exported->grid.columns);
  EXPECT_EQ(shape.cell_x_m, 0.25);
  EXPECT_EQ(shape.cell_z_m, 0.25);
  const auto height_at = [&](int x, int z) {
    std::vector<double> row(static_cast<size_t>(shape.columns));
    EXPECT_TRUE((*raster)->read_row(z - box_.voxels().lo.z, row));
    return row[static_cast<size_t>(x - box_.voxels().lo.x)];
  };
  EXPECT_NEAR(height_at(40, 40), 0.0, 0.13) << "the ground";
  EXPECT_NEAR(height_at(-6, -6), -5.0, 0.26) << "the pit";
  EXPECT_NEAR(height_at(4, 4), 10.0, 0.26) << "the slab, not what is below it";
  const ChunkBox above = chunks_of({-7.9F, 0.5F, -7.9F}, {7.9F, 15.9F, 7.9F}, voxel_m);
  const auto towers =
      export_geotiff(field_, above, folder_ / "towers.tif", {.cell_m = 1.0, .zero_m = 90.0}, quiet);
  ASSERT_TRUE(towers) << towers.error().message;
  EXPECT_EQ(towers->grid.columns, 16);
  EXPECT_EQ(towers->sums.empty_cells, 16U * 16U - 16U) << "of 4 m by 4 m";
  EXPECT_NEAR(towers->sums.volume_m3, 160.0, 8.0) << "4 m by 4 m by 10 m, all under the slab";
  auto cells = open_raster(folder_ / "towers.tif");
  std::vector<double> row(16);
  ASSERT_TRUE((*cells)->read_row(9, row));
  EXPECT_TRUE(std::isnan(row[0]));
  EXPECT_NEAR(row[9], 100.0, 0.26);
}

TEST_F(ExportTest, a_box_that_ends_at_a_chunks_border_does_not_touch_the_next_one) {
  const float side_m = chunk_size * voxel_m;
  const ChunkBox box = chunks_of({-side_m, 0.0F, -0.1F}, {side_m, 2.0F * side_m, 0.1F}, voxel_m);
  EXPECT_EQ(box.lo, (ChunkCoord{-1, 0, -1}));
  EXPECT_EQ(box.hi, (ChunkCoord{1, 2, 1}));
  EXPECT_EQ(chunks_of({0.0F, 0.0F, 0.0F}, glm::vec3(side_m + 0.1F), voxel_m).hi, (ChunkCoord{2, 2, 2}));
  EXPECT_EQ(chunks_of(glm::vec3(1.0F), glm::vec3(1.1F), voxel_m).count(), 1U);
}

TEST_F(ExportTest, an_elevation_model_that_cannot_be_is_refused) {
  const ChunkBox sky = chunks_of({0.0F, 100.0F, 0.0F}, {7.0F, 107.0F, 7.0F}, voxel_m);
  EXPECT_FALSE(export_geotiff(field_, sky, folder_ / "sky.tif", {}, quiet)) << "no rock";
  EXPECT_FALSE(export_geotiff(field_, box_, folder_ / "fine.tif", {.cell_m = 0.1}, quiet))
      << "finer than voxels";
  EXPECT_FALSE(export_geotiff(field_, box_, folder_ / "none/a.tif", {}, quiet)) << "no such folder";
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "")) << "nothing is left behind";
}

TEST_F(ExportTest, carved_ground_by_heights_comes_back_by_tif_with_its_volume) {
  const auto ground = written_ground(folder_ / "hills.ground", 60, 40, 2.0F);
  MapField hills({.heights = ground});
  const auto whole = whole_of(hills);
  ASSERT_TRUE(whole);
  const auto exported = export_geotiff(hills, *whole, folder_ / "hills.tif", {}, quiet);
  ASSERT_TRUE(exported) << exported.error().message;
  auto raster = open_raster(folder_ / "hills.tif");
  ASSERT_TRUE(raster);
  const auto back = import_heights(**raster, folder_ / "back.ground", {.zero_m = 0.0}, quiet);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_NEAR(back->volume_m3, exported->sums.volume_m3, 1e-4 * exported->sums.volume_m3);
  const auto again = GroundFile::open(folder_ / "back.ground");
  ASSERT_TRUE(again);
  for (const float at_m : {-20.0F, 0.5F, 17.0F})
    EXPECT_NEAR(ground_height_m({.heights = *again}, at_m + 0.125F, at_m + 0.125F),
                ground_height_m(hills.source(), at_m, at_m), 0.13F);
}

TEST_F(ExportTest, unedited_ground_is_exported_from_its_heights_and_nothing_is_generated) {
  const auto ground = written_ground(folder_ / "hills.ground", 60, 40, 2.0F);
  MapField unedited({.heights = ground}), edited({.heights = ground});
  const auto whole = whole_of(unedited);
  ASSERT_TRUE(whole);
  for_each_chunk(whole->voxels(), [&](ChunkCoord chunk) {
    const BrickCoord first = brick_of(first_voxel(chunk));
    edited.set_brick(first, Brick(edited.brick(first)));  // as it was
  });
  const auto grid = elevation_grid(*whole, 0.25F, std::nullopt);
  ASSERT_TRUE(grid);
  std::array<std::vector<float>, 2> heights;
  for (const size_t which : {0U, 1U}) {
    const auto add = [&](std::span<const float> row) -> Result<void> {
      heights[which].insert(heights[which].end(), row.begin(), row.end());
      return {};
    };
    ASSERT_TRUE(each_elevation_row(which == 0 ? unedited : edited, *whole, *grid, add, quiet));
  }
  ASSERT_EQ(heights[0].size(), heights[1].size());
  for (size_t i = 0; i < heights[0].size(); ++i) ASSERT_NEAR(heights[0][i], heights[1][i], 0.05F) << i;
  for_each_chunk(whole->voxels(), [&](ChunkCoord chunk) { EXPECT_FALSE(unedited.has_generated(chunk)); });
}

/// A disk without room is stood for by a bound of this process's files.
TEST_F(ExportTest, a_vdb_that_finds_no_room_is_an_error_and_leaves_the_file_before_it) {
  const std::string path = folder_ / "full.vdb";
  std::ofstream(path) << "before";
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &little), 0);
  const auto exported = export_vdb(field_, builtin_palette(), box_, path, quiet);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(exported.has_value());
  EXPECT_NE(exported.error().message.find("whole"), std::string::npos) << exported.error().message;
  EXPECT_EQ(std::filesystem::file_size(path), 6U);
}

TEST_F(ExportTest, a_carved_field_comes_back_by_vdb_the_same_and_resampled_with_its_volume) {
  ASSERT_TRUE(export_vdb(field_, builtin_palette(), box_, folder_ / "world.vdb", quiet));
  const auto volume_of = [&](const SolidsImport& how, bool exact) {
    const auto read = read_solids({folder_ / "world.vdb"}, how);
    EXPECT_TRUE(read) << read.error().message;
    BricksImport bricks{.level_m = -100.0, .voxel_size_m = how.voxel_size_m};
    if (exact) bricks.exact = read->exact;
    const auto imported = import_bricks(read->solids, folder_ / "back.ground", bricks, quiet);
    EXPECT_TRUE(imported) << imported.error().message;
    return imported ? imported->volume_m3 : 0.0;
  };
  const double same = volume_of({}, true);
  const auto file = GroundFile::open(folder_ / "back.ground");
  ASSERT_TRUE(file);
  MapField again({.heights = *file});
  for_each_chunk(box_.voxels(), [&](ChunkCoord chunk) {
    for (int i = 0; i < 64; ++i)
      ASSERT_EQ(again.brick(brick_in_chunk(chunk, i)), field_.brick(brick_in_chunk(chunk, i)));
  });
  EXPECT_NEAR(volume_of({}, false), same, 1e-2 * same);
}

}  // namespace
}  // namespace scree
