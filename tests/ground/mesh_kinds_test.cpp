// Meshes as other programs write them: in several materials, open, torn, turned, doubled, thin; each has its
// own volume, or is refused in words.
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

#include "shared/field/material_window.h"
#include "tests/support/test_folder.h"
#include "tools/import/file_forms.h"
#include "tools/import/files/solid_files.h"

namespace scree {
namespace {

constexpr const char* data = SCREE_SOURCE_DIR "/tests/data/import/";
constexpr double house_m3 = 480.0;

struct Face {
  std::vector<int> corners;  ///< from 1
  std::string material{};
};

/// The house of the data: 10 × 6 × 8 m.
const std::vector<std::array<double, 3>> house_points = {{-5, 0, -4}, {-5, 0, 4}, {-5, 6, -4}, {-5, 6, 4},
                                                         {5, 0, -4},  {5, 0, 4},  {5, 6, -4},  {5, 6, 4}};
const std::vector<Face> house_faces = {{{1, 2, 4, 3}}, {{5, 7, 8, 6}}, {{1, 3, 7, 5}},
                                       {{2, 6, 8, 4}}, {{1, 5, 6, 2}}, {{3, 4, 8, 7}}};

class MeshKinds : public ::testing::Test {
 protected:
  struct Imported {
    double volume_m3 = 0.0;
    std::string said{};
    Digest name{};
  };

  std::string obj(const std::vector<std::array<double, 3>>& points, const std::vector<Face>& faces) const {
    const std::string path = folder_ / "made.obj";
    std::ofstream out(path);
    for (const auto& p : points) out << fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    for (const Face& face : faces) {
      if (!face.material.empty()) out << "usemtl " << face.material << "\n";
      out << "f";
      for (const int corner : face.corners) out << " " << corner;
      out << "\n";
    }
    return path;
  }

  Imported imported(const std::string& path, const SolidsImport& how = {}) const {
    const auto read = read_solids({path}, how);
    EXPECT_TRUE(read) << read.error().message;
    if (!read) return {};
    Imported done;
    for (const std::string& line : read->said) done.said += line + "\n";
    const BricksImport bricks{.level_m = how.level_m.value_or(0.0),
                              .voxel_size_m = how.voxel_size_m,
                              .palette = read->palette,
                              .least_m3 = least_volume_m3(*read)};
    const auto made = import_bricks(read->solids, folder_ / "made.ground", bricks, [](double) {});
    EXPECT_TRUE(made) << made.error().message;
    if (!made) return done;
    done.volume_m3 = made->volume_m3;
    done.name = name_of(made->header);
    return done;
  }
  std::string refusal(const std::string& path, const SolidsImport& how = {}) const {
    const auto read = read_solids({path}, how);
    return read ? std::string("none") : read.error().message;
  }

  TestFolder folder_;
};

void expect_words(const std::string& words, const char* part) {
  EXPECT_NE(words.find(part), std::string::npos) << words;
}

const SolidsImport no_colours{.colour_rows_max = 0};

TEST_F(MeshKinds, one_house_in_one_two_or_six_materials_is_the_same_rock) {
  const Imported one = imported(data + std::string("house_one.obj"), no_colours);
  EXPECT_NEAR(one.volume_m3, house_m3, 0.01 * house_m3);
  for (const char* name : {"house_walls_roof.obj", "house_six.obj"}) {
    const Imported other = imported(data + std::string(name), no_colours);
    EXPECT_EQ(other.name, one.name) << name;
    expect_words(other.said, "1 part, closed, 480 m³");
    expect_words(other.said, "a unit as a metre");
  }
}

TEST_F(MeshKinds, materials_go_by_the_nearest_triangle) {
  std::vector<Face> faces = house_faces;
  for (Face& face : faces) face.material = "rock";
  faces.back().material = "ice";  // the roof
  imported(obj(house_points, faces));
  const auto file = GroundFile::open(folder_ / "made.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  EXPECT_EQ(material_at(field, {0.5F, 5.5F, 0.5F}), material::ice);
  EXPECT_EQ(material_at(field, {4.5F, 3.0F, 0.5F}), material::rock);
}

TEST_F(MeshKinds, open_sheets_are_filled_down_or_refused) {
  const std::string sheet = data + std::string("sheet.obj");
  expect_words(refusal(sheet), "--sheet down fills the rock below them");
  const Imported filled = imported(sheet, {.sheet = SheetRule::down, .level_m = -3.0});
  EXPECT_NEAR(filled.volume_m3, 29'646.0, 296.0);
  expect_words(filled.said, "filled down to y = -3 m");
  expect_words(refusal(sheet, {.sheet = SheetRule::drop}), "nothing of it is left");
}

TEST_F(MeshKinds, a_sheet_that_faces_down_is_filled_down_as_well) {
  const std::vector<std::array<double, 3>> points = {{-8, 4, -8}, {8, 4, -8}, {-8, 8, 8}, {8, 8, 8}};
  for (const Face& face : {Face{{1, 2, 4, 3}}, Face{{1, 3, 4, 2}}}) {
    const Imported filled = imported(obj(points, {face}), {.sheet = SheetRule::down, .level_m = 0.0});
    EXPECT_NEAR(filled.volume_m3, 16.0 * 16.0 * 6.0, 15.0);
  }
}

TEST_F(MeshKinds, stray_sheets_are_left_out_unless_a_rule_says_more) {
  std::vector<std::array<double, 3>> points = house_points;
  for (const auto& p : {std::array{20.0, 3.0, 0.0}, {20.0, 3.0, 0.5}, {20.5, 3.0, 0.5}, {20.5, 3.0, 0.0}})
    points.push_back(p);
  std::vector<Face> faces = house_faces;
  faces.push_back({{9, 10, 11, 12}});
  const std::string path = obj(points, faces);
  expect_words(imported(path).said, "1 part with a surface of 0.25 m², open sheets, left out");
  expect_words(imported(path, {.sheet = SheetRule::down, .level_m = -1.0}).said, "filled down to y = -1 m");
}

TEST_F(MeshKinds, a_box_without_a_floor_is_closed_and_said) {
  std::vector<Face> faces = house_faces;
  faces.erase(faces.begin() + 4);
  const Imported house = imported(obj(house_points, faces));
  EXPECT_NEAR(house.volume_m3, house_m3, 0.01 * house_m3);
  expect_words(house.said, "not closed: 4 open edges, 21 % of the surface is missing");
}

TEST_F(MeshKinds, a_cavity_in_a_sheet_that_is_closed_stays_a_cavity) {
  // Three faces of a cube at one corner, and a cube of 3 m inside out near it.
  std::vector<std::array<double, 3>> points = {{0, 0, 0},  {0, 0, 16},  {0, 16, 0}, {0, 16, 16},
                                               {16, 0, 0}, {16, 0, 16}, {16, 16, 0}};
  std::vector<Face> faces = {{{1, 2, 4, 3}}, {{1, 5, 6, 2}}, {{1, 3, 7, 5}}};
  for (const auto& p : house_points)
    points.push_back({2.5 + 0.3 * p[0], 1.0 + 0.5 * p[1], 2.5 + 0.375 * p[2]});
  for (Face face : house_faces) {
    for (int& corner : face.corners) corner += 7;
    std::ranges::reverse(face.corners);
    faces.push_back(face);
  }
  const Imported corner = imported(obj(points, faces), {.sheet = SheetRule::close, .level_m = -1.0});
  EXPECT_NEAR(corner.volume_m3, 2048.0 - 27.0, 10.0);
  expect_words(corner.said, "1 part within others are cavities");
}

TEST_F(MeshKinds, triangles_that_stand_against_their_neighbours_are_turned) {
  std::vector<Face> faces = house_faces;
  for (const size_t i : {1U, 4U}) std::ranges::reverse(faces[i].corners);
  const Imported house = imported(obj(house_points, faces));
  EXPECT_NEAR(house.volume_m3, house_m3, 0.01 * house_m3);
  expect_words(house.said, "4 triangles stood against their neighbours");
}

TEST_F(MeshKinds, walls_that_share_no_points_make_one_house) {
  std::vector<std::array<double, 3>> points;
  std::vector<Face> faces;
  for (const Face& face : house_faces) {
    faces.emplace_back();
    for (const int corner : face.corners) {
      points.push_back(house_points[static_cast<size_t>(corner - 1)]);
      points.back()[1] += 1e-6 * static_cast<double>(points.size() % 3);  // as rounding does
      faces.back().corners.push_back(static_cast<int>(points.size()));
    }
  }
  const Imported torn = imported(obj(points, faces));
  EXPECT_NEAR(torn.volume_m3, house_m3, 0.01 * house_m3);
  expect_words(torn.said, "1 part, closed");
  // The roof in two halves: the walls' long edges lack the points in their middles.
  points = house_points;
  points.push_back({0, 6, -4});
  points.push_back({0, 6, 4});
  faces.assign(house_faces.begin(), house_faces.end() - 1);
  faces.push_back({{3, 4, 10, 9}});
  faces.push_back({{9, 10, 8, 7}});
  const Imported joined = imported(obj(points, faces));
  EXPECT_NEAR(joined.volume_m3, house_m3, 0.01 * house_m3);
  expect_words(joined.said, "1 part, closed");
}

TEST_F(MeshKinds, surfaces_with_two_sides_and_cavities_are_told_apart) {
  std::vector<Face> faces = house_faces;
  for (const Face& face : house_faces) {
    faces.push_back(face);
    std::ranges::reverse(faces.back().corners);
  }
  const Imported doubled = imported(obj(house_points, faces));
  EXPECT_NEAR(doubled.volume_m3, house_m3, 0.01 * house_m3);
  expect_words(doubled.said, "12 triangles are the second sides");
  // A hollow house, the right way round and inside out.
  std::vector<std::array<double, 3>> points = house_points;
  for (const auto& p : house_points) points.push_back({0.8 * p[0], 0.8 * p[1] + 0.6, 0.8 * p[2]});
  for (const bool inverted : {false, true}) {
    faces = house_faces;
    for (Face face : house_faces) {
      for (int& corner : face.corners) corner += 8;
      std::ranges::reverse(face.corners);
      faces.push_back(face);
    }
    for (Face& face : faces)
      if (inverted) std::ranges::reverse(face.corners);
    const Imported hollow = imported(obj(points, faces));
    EXPECT_NEAR(hollow.volume_m3, house_m3 * (1.0 - 0.512), 0.02 * house_m3);
    expect_words(hollow.said, "1 part within others are cavities");
  }
}

TEST_F(MeshKinds, walls_of_a_hollow_body_thinner_than_a_voxel_are_named) {
  std::vector<std::array<double, 3>> points = house_points;
  for (const auto& p : house_points) points.push_back({0.96 * p[0], 0.96 * p[1] + 0.12, 0.96 * p[2]});
  std::vector<Face> faces = house_faces;
  for (Face face : house_faces) {
    for (int& corner : face.corners) corner += 8;
    std::ranges::reverse(face.corners);
    faces.push_back(face);
  }
  const auto read = read_solids({obj(points, faces)}, {});
  ASSERT_TRUE(read);
  expect_words(read->said.back(), "1 part with 55.3 m³ is thinner than a voxel of 0.25 m");
}

TEST_F(MeshKinds, a_plate_thinner_than_two_voxels_is_named) {
  std::vector<std::array<double, 3>> points = house_points;
  for (auto& p : points) p[1] = 3.05 + 0.07 * p[1];
  const Imported plate = imported(obj(points, house_faces));
  expect_words(plate.said, "is thinner than two voxels of 0.25 m, the thinnest about 0.38");
}

TEST_F(MeshKinds, a_plate_thinner_than_a_voxel_is_refused_in_its_own_words) {
  std::vector<std::array<double, 3>> points = house_points;
  for (auto& p : points) p[1] = 3.05 + 0.005 * p[1];
  const auto read = read_solids({obj(points, house_faces)}, {});
  ASSERT_TRUE(read);
  expect_words(read->said.back(), "1 part with 2.4 m³ is thinner than a voxel of 0.25 m");
  const auto made = import_bricks(read->solids, folder_ / "plate.ground",
                                  {.level_m = 0.0, .least_m3 = least_volume_m3(*read)}, [](double) {});
  ASSERT_FALSE(made);
  expect_words(made.error().message, "--voxel-size");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plate.ground"));
  EXPECT_TRUE(words_on_difference(*read, 2.3));
  EXPECT_FALSE(words_on_difference(*read, 2.39));
}

/// The two ends of a drum are fans of slivers that lie askew and all meet in the middle.
TEST_F(MeshKinds, fans_of_slivers_have_their_volume) {
  constexpr int sides = 3000;
  constexpr double radius = 9.0, height = 6.0;
  std::vector<std::array<double, 3>> points = {{0, 0, 0}, {0, height, 0}};
  std::vector<Face> faces;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * i / sides, x = radius * std::cos(angle), z = radius * std::sin(angle);
    points.push_back({x, 0, z});
    points.push_back({x, height, z});
    const int low = 3 + 2 * i, next = 3 + 2 * ((i + 1) % sides);
    faces.push_back({{1, low, next}});
    faces.push_back({{2, next + 1, low + 1}});
    faces.push_back({{low, low + 1, next + 1, next}});
  }
  const double own_m3 = M_PI * radius * radius * height;
  EXPECT_NEAR(imported(obj(points, faces)).volume_m3, own_m3, 0.01 * own_m3);
}

TEST_F(MeshKinds, binary_ply_files_may_begin_with_any_byte) {
  expect_words(refusal(data + std::string("segfault.ply")), "its header has no end");
  const Imported cube = imported(data + std::string("cube_first_byte_0a.ply"));
  EXPECT_NEAR(cube.volume_m3, 1000.0, 10.0);
  for (const char* line_end : {"\n", "\r\n"})
    for (const int first : {0x0A, 0x0D, 0x00, 0x20}) {
      const std::string path = folder_ / "house.ply";
      std::ofstream out(path, std::ios::binary);
      for (const char* line : {"ply", "format binary_little_endian 1.0", "comment end_header of a house",
                               "element vertex 8", "property float x", "property float y", "property float z",
                               "element face 6", "property list uchar int vertex_indices", "end_header"})
        out << line << line_end;
      const auto put = [&](const auto& value) {
        std::array<char, sizeof value> bytes{};
        std::memcpy(bytes.data(), &value, sizeof value);
        out.write(bytes.data(), sizeof value);
      };
      for (const auto& p : house_points)
        for (const double axis : p) {
          auto number = static_cast<float>(axis);
          uint32_t bits = 0;
          std::memcpy(&bits, &number, sizeof bits);
          bits = (bits & ~0xFFU) | static_cast<uint32_t>(first);  // the lowest byte is the file's first
          put(bits);
        }
      for (const Face& face : house_faces) {
        put(uint8_t{4});
        for (const int corner : face.corners) put(int32_t{corner - 1});
      }
      out.close();
      EXPECT_NEAR(imported(path).volume_m3, house_m3, 0.01 * house_m3) << first;
    }
}

TEST_F(MeshKinds, coordinates_that_are_read_too_coarsely_are_refused_or_named) {
  for (const double east_m : {4'000'000.0, 500'000.0}) {
    std::vector<std::array<double, 3>> points = house_points;
    for (auto& p : points) p[0] += east_m;
    SolidsImport how;
    how.place.at_m = {-east_m, 0.0, 0.0};
    const std::string path = obj(points, house_faces);
    if (east_m > 1e6)
      expect_words(refusal(path, how), "read in steps of 0.477 m");
    else
      expect_words(imported(path, how).said, "read in steps of 0.0596 m");
  }
}

TEST_F(MeshKinds, forms_that_are_not_read_are_refused_in_their_own_words) {
  expect_words(refusal_of_form("city.7z").value_or(""), "an archive: unpack it");
  EXPECT_FALSE(refusal_of_form("city.zip")) << "GDAL finds rasters in it, or lists its files";
  expect_words(refusal_of_form("Scan.LAZ").value_or(""), "a cloud of points");
  EXPECT_FALSE(refusal_of_form("hills.tif"));
  EXPECT_TRUE(is_solid_file("model.FBX"));
}

}  // namespace
}  // namespace scree
