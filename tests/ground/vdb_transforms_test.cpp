// OpenVDB grids of any transform: level sets and fog volumes, scaled, rotated, sheared and moved, have the
// volume of what they show.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include "shared/field/material_window.h"
#include "tests/support/test_folder.h"
#include "tools/import/files/solid_files.h"

namespace scree {
namespace {

using openvdb::Mat4d;
using openvdb::Vec3d;

constexpr double radius_m = 5.0;
constexpr double ball_m3 = 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * radius_m;
const Vec3d middle_m(3.0, 12.0, -2.0);

/// A ball, sampled by a grid of that transform: metres to its surface within 1 m, or its density.
openvdb::FloatGrid::Ptr ball(const Mat4d& to_world, bool is_fog) {
  const auto grid = openvdb::FloatGrid::create(is_fog ? 0.0F : 1.0F);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(to_world));
  grid->setGridClass(is_fog ? openvdb::GRID_FOG_VOLUME : openvdb::GRID_LEVEL_SET);
  grid->setName(is_fog ? "density" : "surface");
  auto voxels = grid->getAccessor();
  const Vec3d centre = grid->worldToIndex(middle_m);
  constexpr int reach = 40;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const openvdb::Coord at = openvdb::Coord::round(centre) + openvdb::Coord(i, j, k);
        const auto distance_m = static_cast<float>((grid->indexToWorld(at) - middle_m).length() - radius_m);
        const float value =
            is_fog ? std::clamp(0.5F - distance_m, 0.0F, 1.0F) : std::clamp(distance_m, -1.0F, 1.0F);
        if (value != grid->background()) voxels.setValue(at, value);
      }
  return grid;
}

double imported_m3(const Mat4d& to_world, bool is_fog) {
  openvdb::initialize();
  const TestFolder folder;
  const std::string path = folder / "ball.vdb";
  openvdb::io::File file(path);
  file.write({ball(to_world, is_fog)});
  file.close();
  const auto read = read_solids({path}, {});
  EXPECT_TRUE(read) << read.error().message;
  if (!read) return 0.0;
  const auto imported = import_bricks(read->solids, folder / "ball.ground", {.level_m = 0.0}, [](double) {});
  EXPECT_TRUE(imported) << imported.error().message;
  return imported ? imported->volume_m3 : 0.0;
}

struct NamedTransform {
  const char* name;
  Mat4d matrix;
};

std::vector<NamedTransform> transforms() {
  Mat4d uniform, boxes, rotated, sheared, mirrored;
  uniform.setToScale(Vec3d(0.25));
  boxes.setToScale(Vec3d(0.2, 0.35, 0.25));
  rotated.setToScale(Vec3d(0.25));
  rotated.postRotate(openvdb::math::Y_AXIS, 0.7);
  rotated.postRotate(openvdb::math::X_AXIS, 0.4);
  rotated.postTranslate(Vec3d(1.03, -0.4, 7.7));
  sheared.setToScale(Vec3d(0.25));
  sheared.postShear(openvdb::math::X_AXIS, openvdb::math::Y_AXIS, 0.5);
  sheared.postRotate(openvdb::math::Z_AXIS, 0.3);
  mirrored.setToScale(Vec3d(-0.25, 0.25, 0.25));
  return {{"as the world's", uniform},
          {"oblong", boxes},
          {"rotated", rotated},
          {"sheared", sheared},
          {"mirrored", mirrored}};
}

TEST(VdbTransforms, level_sets_have_their_volume_within_a_hundredth) {
  for (const auto& [name, matrix] : transforms())
    EXPECT_NEAR(imported_m3(matrix, false), ball_m3, 0.01 * ball_m3) << name;
}

TEST(VdbTransforms, fog_volumes_have_their_volume_within_a_hundredth) {
  for (const auto& [name, matrix] : transforms())
    EXPECT_NEAR(imported_m3(matrix, true), ball_m3, 0.01 * ball_m3) << name;
}

class VdbChoices : public ::testing::Test {
 protected:
  std::string written(const openvdb::GridCPtrVec& grids) const {
    openvdb::io::File file(folder_ / "choice.vdb");
    file.write(grids);
    file.close();
    return folder_ / "choice.vdb";
  }
  static openvdb::FloatGrid::Ptr quarter_metre_ball(bool is_fog, const char* name) {
    openvdb::initialize();
    Mat4d matrix;
    matrix.setToScale(Vec3d(0.25));
    auto grid = ball(matrix, is_fog);
    grid->setName(name);
    return grid;
  }
  static std::string outcome(const std::string& path, const SolidsImport& how = {}) {
    const auto read = read_solids({path}, how);
    return read ? read->said.front() : read.error().message;
  }

  TestFolder folder_;
};

TEST_F(VdbChoices, one_of_two_level_sets_is_chosen_by_name_alone) {
  const std::string path = written({quarter_metre_ball(false, "rock"), quarter_metre_ball(false, "cave"),
                                    quarter_metre_ball(true, "smoke")});
  EXPECT_NE(outcome(path).find("2 level sets, 'cave', 'rock': --grid NAME"), std::string::npos)
      << outcome(path);
  EXPECT_NE(outcome(path, {.grid = "cave"}).find("grid 'cave', a level set"), std::string::npos);
  EXPECT_NE(outcome(path, {.grid = "mud"}).find("no grid 'mud'; it has 'cave' of float"), std::string::npos);
  const std::string twins = written({quarter_metre_ball(false, "rock"), quarter_metre_ball(false, "rock")});
  EXPECT_NE(outcome(twins).find("'rock[0]', 'rock[1]'"), std::string::npos) << outcome(twins);
  EXPECT_NE(outcome(twins, {.grid = "rock[1]"}).find("grid 'rock[1]'"), std::string::npos);
}

TEST_F(VdbChoices, one_level_set_among_others_is_taken_and_said) {
  const std::string path = written({quarter_metre_ball(true, "smoke"), quarter_metre_ball(false, "rock")});
  EXPECT_NE(outcome(path).find("grid 'rock', a level set, in metres, y up; the file holds"),
            std::string::npos)
      << outcome(path);
}

/// Materials may change within the cubes of 8 voxels that OpenVDB keeps, and be said for a part of them
/// alone.
TEST_F(VdbChoices, materials_of_single_voxels_are_read_and_silent_ones_are_not) {
  const auto rock = quarter_metre_ball(false, "surface");
  const auto materials = openvdb::Int32Grid::create(-1);
  materials->setName("material");
  materials->setTransform(rock->transform().copy());
  auto voxels = materials->getAccessor();
  const int middle_x = 12;  // of the ball, which lies from x = -2 to 8 m
  for (int x = -8; x < 32; ++x)
    for (int y = 28; y < 68; ++y)
      for (int z = -28; z < 12; ++z) {
        if (x < middle_x)
          voxels.setValueOn({x, y, z}, static_cast<int32_t>(material::ice));
        else
          voxels.setValueOff({x, y, z}, static_cast<int32_t>(material::soil));
      }
  const auto read = read_solids({written({rock, materials})}, {});
  ASSERT_TRUE(read) << read.error().message;
  const auto imported = import_bricks(read->solids, folder_ / "ball.ground", {.level_m = 0.0}, [](double) {});
  ASSERT_TRUE(imported) << imported.error().message;
  const auto file = GroundFile::open(folder_ / "ball.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  EXPECT_EQ(material_at(field, {0.5F, 12.0F, -2.0F}), material::ice);
  EXPECT_EQ(material_at(field, {5.5F, 12.0F, -2.0F}), material::rock);
}

TEST_F(VdbChoices, volumes_without_an_inside_are_refused_in_their_own_words) {
  const std::string fog = written({quarter_metre_ball(true, "density")});
  EXPECT_NE(outcome(fog, {.density = 1.5}).find("the densest value of the fog volume is 1, not above 1.5"),
            std::string::npos)
      << outcome(fog, {.density = 1.5});
  const auto outside = openvdb::FloatGrid::create(1.0F);
  outside->setGridClass(openvdb::GRID_LEVEL_SET);
  outside->tree().setValue({0, 0, 0}, 0.5F);
  EXPECT_NE(outcome(written({outside})).find("it has no inside"), std::string::npos);
}

}  // namespace
}  // namespace scree
