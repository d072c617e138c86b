// Each voxel is seen as of its material, by every method, with sharp edges and the looks of the palette.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "client/render/methods.h"
#include "client/viewer/pictures/png.h"
#include "content/builtin_palette.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

constexpr Material red_row{7}, blue_row{6};
constexpr float face_z_m = 0.5F;
/// The two materials of the wall meet here: inside a brick of voxels, which is 2 m large.
constexpr float seam_x_m = 0.75F;

enum class Hue { red, blue, other };

Hue hue_at(const Image& image, int x, int y) {
  const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (y * image.width + x))];
  const int red = pixel[0], green = pixel[1], blue = pixel[2];
  if (red > 2 * green && red > 2 * blue) return Hue::red;
  if (blue > 2 * red && blue > 3 * green / 2) return Hue::blue;
  return Hue::other;
}

MaterialLook plain_look(std::array<float, 3> colour) {
  MaterialLook look;
  look.colour = colour;
  look.variation = 0.0F;
  look.roughness = 1.0F;
  return look;
}

/// The built-in palette, with two rows of these colours.
std::shared_ptr<const Palette> hues(std::array<float, 3> red, std::array<float, 3> blue) {
  auto palette = std::make_shared<Palette>(builtin_palette());
  palette->rows[row_number(red_row)].look = plain_look(red);
  palette->rows[row_number(blue_row)].look = plain_look(blue);
  return palette;
}

constexpr std::array<float, 3> pure_red{0.7F, 0.02F, 0.02F}, pure_blue{0.02F, 0.05F, 0.8F};

/// A wall on flat ground that faces the camera: red up to a seam, blue beyond.
class Materials : public OffscreenTest, public testing::WithParamInterface<std::string> {
 protected:
  Materials() : OffscreenTest(GetParam(), {TerrainKind::flat, 3, voxel_m}, 16.0F) {}

  void SetUp() override {
    OffscreenTest::SetUp();
    if (method_ == nullptr) return;
    renderer_->set_terrain(field_.source());
    renderer_->set_palette(hues(pure_red, pure_blue));
    build(-2.0F, seam_x_m, red_row);
    build(seam_x_m, 3.0F, blue_row);
    camera_.eye_m = {0.5F, 1.2F, 4.0F};
    camera_.pitch = 0.0F;
  }
  void build(float from_x_m, float to_x_m, Material material) {
    const float half_m = 0.5F * (to_x_m - from_x_m);
    change(FillOperation{box({from_x_m + half_m, 1.0F, 0.0F}, {half_m, 1.5F, face_z_m}), material});
  }
  Applied change(const Operation& operation) {
    const Applied applied = apply(operation, field_, table_);
    MirrorChanges changes;
    changes.bricks = applied.changed;
    method_->changed(changes);
    return applied;
  }
  Image show(const std::string& name) {
    finish();
    const Image image = draw();
    const char* folder = std::getenv("SCREE_PICTURES");
    if (folder == nullptr) return image;
    EXPECT_TRUE(write_png(std::string(folder) + "/" + GetParam() + "_" + name + ".png", image));
    return image;
  }
  /// At a point of the wall's face.
  int column_of(float x_m) const {
    const float half = std::tan(camera_.field_of_view * 0.5F) * (camera_.eye_m.z - face_z_m);
    return static_cast<int>(0.5F * width + (x_m - camera_.eye_m.x) / half * 0.5F * height);
  }
  static size_t count(const Image& image, Hue hue) {
    size_t pixels = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) pixels += hue_at(image, x, y) == hue ? 1 : 0;
    return pixels;
  }
  /// The cells of the grid are two voxels large.
  float edge_m() const { return GetParam() == "grid" ? 2.0F * voxel_m : voxel_m; }

  PieceTable table_;
};

TEST_P(Materials, two_in_one_brick_meet_within_a_voxel) {
  const Image image = show("wall");
  for (int y = height / 2 - 20; y < height / 2 + 15; y += 5) {
    for (int x = column_of(-1.5F); x < column_of(seam_x_m - edge_m()); ++x)
      ASSERT_EQ(hue_at(image, x, y), Hue::red) << x << " " << y;
    for (int x = column_of(seam_x_m + edge_m()) + 1; x < column_of(2.5F); ++x)
      ASSERT_EQ(hue_at(image, x, y), Hue::blue) << x << " " << y;
    int between = 0;
    for (int x = column_of(-1.5F); x < column_of(2.5F); ++x)
      between += hue_at(image, x, y) == Hue::other ? 1 : 0;
    EXPECT_LE(between, 3) << "the edge is sharp";
  }
}

TEST_P(Materials, a_piece_of_two_keeps_both_where_it_lies) {
  const Applied cut = change(CarveOperation{box({0.5F, 1.8F, 0.0F}, {1.5F, 1.0F, 1.0F}), {}, 1, 5, {}, 1});
  ASSERT_EQ(cut.created.size(), 1U);
  const PieceId id = cut.created.front().id;
  const glm::vec3 home = table_.at(id)->centre_voxels * voxel_m;
  // Turned about: what was on the right is on the left.
  pieces_[id] = {table_.at(id), Pose{home + glm::vec3(0.0F, 0.3F, 1.0F), {0.0F, 0.0F, 1.0F, 0.0F}}};
  MirrorChanges changes;
  changes.pieces_added = {id};
  method_->changed(changes);
  const Image image = show("piece");
  size_t left_blue = 0, right_red = 0;
  for (int y = height / 6; y < height / 3; ++y) {
    for (int x = 0; x < width / 2 - 12; ++x) left_blue += hue_at(image, x, y) == Hue::blue ? 1 : 0;
    for (int x = width / 2 + 12; x < width; ++x) right_red += hue_at(image, x, y) == Hue::red ? 1 : 0;
  }
  EXPECT_GT(left_blue, 100U);
  EXPECT_GT(right_red, 100U);
}

TEST_P(Materials, another_palette_changes_the_picture_alone) {
  const Image before = show("before");
  renderer_->set_palette(hues(pure_blue, pure_red));
  const Image after = draw();
  const size_t red = count(before, Hue::red), blue = count(before, Hue::blue);
  EXPECT_GT(red, 1000U);
  EXPECT_GT(blue, 1000U);
  EXPECT_NEAR(static_cast<double>(count(after, Hue::blue)), static_cast<double>(red), 120.0);
  EXPECT_NEAR(static_cast<double>(count(after, Hue::red)), static_cast<double>(blue), 120.0);
}

TEST_P(Materials, rows_that_the_palette_lacks_look_as_its_first) {
  auto palette = std::make_shared<Palette>(*plain_palette());
  palette->rows.front().look = plain_look(pure_red);
  renderer_->set_palette(palette);
  const Image image = show("lacking");
  EXPECT_EQ(count(image, Hue::blue), 0U);
  for (int x = column_of(-1.5F); x < column_of(2.5F); ++x)
    ASSERT_EQ(hue_at(image, x, height / 2), Hue::red) << x;
}

using PixelBytes = std::array<uint8_t, 3>;

/// Two by two pixels, rows from the top.
std::shared_ptr<const MaterialTexels> image_of(const std::array<PixelBytes, 4>& pixels) {
  std::vector<uint8_t> rgb;
  for (const PixelBytes& pixel : pixels) rgb.insert(rgb.end(), pixel.begin(), pixel.end());
  return std::make_shared<const MaterialTexels>(resampled(rgb, 2, 2));
}

class Images : public Materials {
 protected:
  static constexpr PixelBytes green{10, 220, 10}, blue{10, 20, 220}, red{220, 10, 10}, white{230, 230, 230};
  static constexpr Digest albedo_file{1};

  void use(std::optional<Digest> albedo, std::optional<Digest> normal) {
    auto palette = std::make_shared<Palette>(*hues(pure_red, pure_blue));
    MaterialLook& look = palette->rows[row_number(red_row)].look;
    look.albedo = albedo;
    look.normal = normal;
    look.image_m = 2.0F;
    renderer_->set_palette(palette);
  }
  /// At a point of the wall's face.
  std::array<int, 3> colour_at(const Image& image, float x_m, float y_m) const {
    const float half = std::tan(camera_.field_of_view * 0.5F) * (camera_.eye_m.z - face_z_m);
    const int row = static_cast<int>((0.5F - (y_m - camera_.eye_m.y) / half * 0.5F) * height);
    const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (row * image.width + column_of(x_m)))];
    return {pixel[0], pixel[1], pixel[2]};
  }
  int brightness_with_normals(PixelBytes normal) {
    const Digest file{normal[0]};
    use(std::nullopt, file);
    renderer_->set_images({{file, image_of({normal, normal, normal, normal})}});
    return colour_at(show("normals"), -0.5F, 1.5F)[0];
  }
};

TEST_P(Images, lie_over_the_colour_upright_and_at_their_scale) {
  use(albedo_file, std::nullopt);
  EXPECT_GT(colour_at(show("not_come"), 0.4F, 1.5F)[0], 100) << "red, before it has come";
  renderer_->set_images({{albedo_file, image_of({green, blue, red, white})}});
  const Image image = show("albedo");
  const auto top_left = colour_at(image, 0.4F, 1.5F), top_right = colour_at(image, -0.5F, 1.5F);
  const auto low_left = colour_at(image, 0.4F, 0.6F), low_right = colour_at(image, -0.5F, 0.6F);
  EXPECT_GT(top_left[1], 2 * std::max(top_left[0], top_left[2]));
  EXPECT_GT(top_right[2], 2 * std::max(top_right[0], top_right[1]));
  EXPECT_GT(low_left[0], 2 * std::max(low_left[1], low_left[2]));
  EXPECT_GT(std::min({low_right[0], low_right[1], low_right[2]}), 90);
  EXPECT_EQ(hue_at(image, column_of(1.5F), height / 2), Hue::blue) << "the other row has none";
}

TEST_P(Images, of_normals_turn_the_light) {
  const int even = brightness_with_normals({128, 128, 255});
  EXPECT_GT(brightness_with_normals({200, 128, 220}), even + 5) << "towards the sun, which is on the right";
  EXPECT_LT(brightness_with_normals({56, 128, 220}), even - 5);
}

std::vector<std::string> all_method_names() {
  std::vector<std::string> names;
  for (const MethodEntry& entry : all_methods()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(methods, Materials, testing::ValuesIn(all_method_names()),
                         [](const auto& tested) { return tested.param; });
INSTANTIATE_TEST_SUITE_P(methods, Images, testing::ValuesIn(all_method_names()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace scree
