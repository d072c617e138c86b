// Drawing by a grid of points about the camera: the same rock as the others show, whatever the spacing.
#include <algorithm>

#include "client/render/grid/grid_shape.h"
#include "client/render/methods.h"
#include "shared/base/random.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

constexpr std::array shapes{
    GridShape{48, 1, GridSpacing::uniform}, GridShape{96, 1, GridSpacing::uniform},
    GridShape{96, 1, GridSpacing::growing}, GridShape{64, 2, GridSpacing::uniform},
    GridShape{32, 1, GridSpacing::growing}, GridShape{112, 4, GridSpacing::growing},
};

std::string text_of(const GridShape& shape) {
  return std::to_string(shape.resolution) + " cells, " + std::to_string(shape.scale) + " voxels, " +
         std::string(name_of(shape.spacing));
}

TEST(GridShape, points_lie_at_multiples_of_the_spacing_about_them) {
  for (const GridShape& shape : shapes)
    for (const float eye : {0.0F, -3.7F, 1000.2F}) {
      const std::vector<int> line = grid_line(shape, eye);
      ASSERT_EQ(line.size(), static_cast<size_t>(shape.resolution) + 1) << text_of(shape);
      int widest = 0;
      for (size_t i = 0; i + 1 < line.size(); ++i) {
        const int spacing = line[i + 1] - line[i];
        ASSERT_GT(spacing, 0);
        EXPECT_EQ(line[i] % spacing, 0);
        EXPECT_EQ(line[i + 1] % spacing, 0);
        widest = std::max(widest, spacing);
      }
      EXPECT_EQ(widest, shape.spacing == GridSpacing::uniform ? shape.scale : 8 * shape.scale)
          << text_of(shape);
      EXPECT_GE(static_cast<float>(line.back()) - eye, static_cast<float>(grid_reach(shape)));
      EXPECT_GE(eye - static_cast<float>(line.front()), static_cast<float>(grid_reach(shape)));
    }
}

TEST(GridShape, it_follows_the_eye_by_whole_blocks) {
  for (const GridShape& shape : shapes) {
    const std::vector<int> here = grid_line(shape, 0.4F);
    EXPECT_EQ(here, grid_line(shape, 3.0F));
    std::vector<int> there = grid_line(shape, static_cast<float>(grid_block * shape.scale) + 1.0F);
    for (int& point : there) point -= grid_block * shape.scale;
    EXPECT_EQ(here, there) << text_of(shape);
  }
}

TEST(GridShape, the_methods_options_give_the_shapes_that_can_be) {
  EXPECT_EQ(grid_shape_of({}), GridShape());
  for (const GridShape& shape : shapes) EXPECT_EQ(grid_shape_of(values_of(shape)), shape) << text_of(shape);
  for (const GridShape& shape : {GridShape{16}, GridShape{33}, GridShape{512}, GridShape{64, 0},
                                 GridShape{64, 3}, GridShape{64, 16}, GridShape{-64}})
    EXPECT_DEATH(values_of(shape), "CHECK failed") << text_of(shape);
}

TEST(DrawOption, each_is_named_for_its_method_and_says_its_values) {
  for (const MethodEntry& entry : all_methods())
    for (const DrawOption& option : options_of(entry)) {
      EXPECT_TRUE(option.name.starts_with(std::string(entry.name) + "-")) << option.name;
      EXPECT_TRUE(option.is_number() || option.names.size() == option.values.size()) << option.name;
      DrawOptionValues values;
      EXPECT_EQ(values.of(option), option.usual);
      for (const int value : option.values) {
        EXPECT_EQ(value_of(option, text_of(option, value)), value) << option.name;
        values.set(option, value);
        EXPECT_EQ(values.of(option), value) << option.name;
        EXPECT_EQ(values == DrawOptionValues(), value == option.usual) << option.name;
      }
      EXPECT_EQ(value_of(option, ""), std::nullopt);
      EXPECT_EQ(value_of(option, "-1"), std::nullopt);
    }
}

class Grid : public OffscreenTest {
 protected:
  explicit Grid(TerrainKind kind = TerrainKind::flat) : OffscreenTest("grid", {kind, 4, 0.25F}) {}

  /// Pixels where something stands before the sky.
  static std::vector<bool> silhouette(const Image& image, const Image& sky) {
    std::vector<bool> is_rock(image.rgb.size() / 3);
    for (size_t i = 0; i < is_rock.size(); ++i) {
      int largest = 0;
      for (size_t c = 3 * i; c < 3 * i + 3; ++c)
        largest = std::max(largest, std::abs(image.rgb[c] - sky.rgb[c]));
      is_rock[i] = largest > 6;
    }
    return is_rock;
  }
  /// A method that has seen nothing yet draws nothing.
  Image draw_sky() { return draw(*make_method()); }
  Image draw_by(std::string_view name) {
    Result<std::unique_ptr<DrawMethod>> other = method_named(name)->make(pool_, view_radius_m);
    EXPECT_TRUE(other);
    finish(**other);
    return draw(**other);
  }
};

TEST_F(Grid, a_ball_has_the_silhouette_that_its_mesh_has) {
  PieceTable none;
  apply(FillOperation{sphere({0.3F, 9.0F, 0.1F}, 1.9F)}, field_, none);
  camera_.eye_m = {0.0F, 5.5F, 4.0F};
  camera_.pitch = 0.75F;
  finish();
  const Image sky = draw_sky();
  const std::vector<bool> theirs = silhouette(draw_by("mesh"), sky);
  ASSERT_GT(std::ranges::count(theirs, true), 1000);
  for (const GridShape& shape : shapes) {
    method_->set_options(values_of(shape));
    const std::vector<bool> ours = silhouette(draw(), sky);
    size_t both = 0, any = 0;
    for (size_t i = 0; i < ours.size(); ++i) {
      both += ours[i] && theirs[i] ? 1 : 0;
      any += ours[i] || theirs[i] ? 1 : 0;
    }
    const double agreement = static_cast<double>(both) / static_cast<double>(any);
    // Beyond the inner cells, and between points that are far apart, a ball is an angular thing.
    const bool fine = shape.scale == 1 && shape.resolution > 32;
    EXPECT_GE(agreement, fine ? 0.97 : 0.75) << text_of(shape);
    EXPECT_GT(method_->stats().triangles, 10U);
  }
}

TEST_F(Grid, an_edit_and_its_pieces_are_in_the_next_frame) {
  finish();
  const Image before = draw();
  carve({0.0F, 0.0F, 0.0F});
  method_->update(Scene{field_, pieces_}, camera_);
  EXPECT_TRUE(method_->complete());
  EXPECT_EQ(method_->stats().pieces, pieces_.size());
  const Image with_pieces = draw();
  EXPECT_GT(differing_pixels(before, with_pieces, 12), 300U);
  pieces_.clear();
  method_->update(Scene{field_, pieces_}, camera_);
  EXPECT_EQ(method_->stats().pieces, 0U);
  const Image after = draw();
  EXPECT_GT(differing_pixels(with_pieces, after, 12), 100U);
  const std::unique_ptr<DrawMethod> fresh = make_method();
  finish(*fresh);
  EXPECT_EQ(differing_pixels(after, draw(*fresh), 0), 0U);
}

TEST_F(Grid, camera_inside_rock_and_tiny_images_are_harmless) {
  camera_.eye_m.y = -6.0F;
  finish();
  draw();
  EXPECT_TRUE(renderer_->draw_image(*method_, camera_, 1, 1));
  renderer_->draw(method_.get(), camera_, 0, 0, 0);
}

/// Looking down on rough ground one would see the sky through any crack between cells of different sizes.
TEST_F(Grid, ground_has_no_holes_whatever_the_spacing) {
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    const auto place = [&] { return random.unit() * 8.0F - 4.0F; };
    const glm::vec3 at_m(place(), random.unit() - 0.5F, place());
    PieceTable none;
    if (i % 2 == 0)
      carve(at_m);
    else
      apply(FillOperation{sphere(at_m, 0.4F + random.unit())}, field_, none);
  }
  pieces_.clear();
  camera_.eye_m = {0.0F, 3.5F, 0.0F};
  camera_.pitch = -1.45F;
  finish();
  const Image sky = draw_sky();
  for (const GridShape& shape : shapes) {
    method_->set_options(values_of(shape));
    // Fog hides what lies at the end of a small grid.
    draw();
    if (method_->reach_m() < 10.0F) continue;
    EXPECT_EQ(std::ranges::count(silhouette(draw(), sky), false), 0) << text_of(shape);
  }
}

}  // namespace
}  // namespace scree
