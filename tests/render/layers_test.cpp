// What the ground is made of is seen by every method alike: layers in cuts, and paint.
#include <cmath>
#include <cstdlib>
#include <string>

#include "client/render/methods.h"
#include "client/viewer/pictures/png.h"
#include "content/builtin_palette.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

/// A wall that faces the camera, from the ground down.
constexpr float wall_z_m = -4.0F, pit_depth_m = 4.0F;

struct Colour {
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  float bright() const { return red + green + blue; }
};

/// A pit in flat ground, whose uppermost metre is soil.
class Layers : public OffscreenTest, public testing::WithParamInterface<std::string> {
 protected:
  Layers() : OffscreenTest(GetParam(), {TerrainKind::flat, 3, voxel_m}, 16.0F) {}

  void SetUp() override {
    OffscreenTest::SetUp();
    if (method_ == nullptr) return;
    renderer_->set_terrain(field_.source());
    renderer_->set_palette(shared_builtin_palette());
    finish();
    const CarveOperation pit{box({0.0F, 0.0F, 0.0F}, {4.0F, pit_depth_m, -wall_z_m}), {}, 1, 5, {}, 1};
    change(pit);
    camera_.eye_m = {0.0F, -0.5F, 2.5F};
    camera_.pitch = -0.2F;
  }

  void change(const Operation& operation) {
    PieceTable table;
    const Applied applied = apply(operation, field_, table);
    changes_.bricks.insert(changes_.bricks.end(), applied.changed.begin(), applied.changed.end());
  }

  Image show() {
    method_->changed(changes_);
    finish();
    return draw();
  }

  /// The colour of the wall between two depths, m below the ground.
  Colour wall(const Image& image, float from_m, float to_m) const {
    const float half = std::tan(camera_.field_of_view * 0.5F);
    const auto row = [&](float depth_m) {
      const float up = std::atan((-depth_m - camera_.eye_m.y) / (camera_.eye_m.z - wall_z_m)) - camera_.pitch;
      return static_cast<int>((0.5F - 0.5F * std::tan(up) / half) * static_cast<float>(image.height));
    };
    Colour sum;
    int count = 0;
    for (int y = row(from_m); y < row(to_m); ++y)
      for (int x = image.width / 2 - 8; x < image.width / 2 + 8; ++x, ++count) {
        const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (y * image.width + x))];
        sum.red += pixel[0], sum.green += pixel[1], sum.blue += pixel[2];
      }
    const auto n = static_cast<float>(count);
    return {sum.red / n, sum.green / n, sum.blue / n};
  }

  /// To look at the pictures: SCREE_PICTURES names a folder.
  void save_picture(const Image& image, const std::string& name) {
    const char* folder = std::getenv("SCREE_PICTURES");
    if (folder == nullptr) return;
    EXPECT_TRUE(write_png(std::string(folder) + "/" + GetParam() + "_" + name + ".png", image));
  }

  MirrorChanges changes_;
};

TEST_P(Layers, a_cut_lays_the_soil_bare) {
  const Image image = show();
  save_picture(image, "soil");
  const float depth_m = field_.source().rows.soil_depth_m;
  // A cell of the grid is half a metre.
  const Colour soil = wall(image, 0.5F, depth_m - 0.2F);
  const Colour rock = wall(image, depth_m + 0.5F, 2.5F);
  EXPECT_LT(soil.bright(), 0.88F * rock.bright());
}

TEST_P(Layers, paint_is_seen) {
  change(PaintOperation{box({0.0F, -3.0F, wall_z_m}, {4.0F, 1.0F, 3.0F}), material::ice});
  const Image image = show();
  save_picture(image, "paint");
  const Colour ice = wall(image, 2.5F, 3.2F), soil = wall(image, 0.4F, 0.8F);
  EXPECT_GT(ice.blue, 0.9F * ice.red);
  EXPECT_LT(soil.blue, 0.75F * soil.red) << "above the paint";
}

std::vector<std::string> methods_here() {
  std::vector<std::string> names;
  for (const MethodEntry& entry : all_methods()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(methods, Layers, testing::ValuesIn(methods_here()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace scree
