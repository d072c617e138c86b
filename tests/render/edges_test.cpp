// Edges of bodies as drawn: their outlines against the sky, held against those of the exact body.
#include <cmath>
#include <string>

#include "client/render/methods.h"
#include "shared/field/voxel_vector.h"
#include "tests/support/edged_shapes.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

constexpr int outline_width = 320, outline_height = 240;
/// How many ways each body is turned.
constexpr int turns = 3;
constexpr float away_m = 9.0F;

class Edges : public OffscreenTest {
 protected:
  Edges() : OffscreenTest("mesh", flat_terrain) {}

  /// 10 m above the ground, 50 m from the last one: farther than what counts as drawn.
  static VoxelCoord centre_of(size_t number) { return {static_cast<int>(number) * 200, 40, 0}; }

  void SetUp() override {
    OffscreenTest::SetUp();
    for (size_t i = 0; i < shapes_.size() * turns; ++i)
      scatter(field_,
              codes_of(shapes_[i / turns], shape_place(static_cast<int>(i % turns) + 1), centre_of(i)));
    camera_.field_of_view = 0.65F;
  }
  /// Looks up at the body's middle: behind it is the sky.
  void look_at(VoxelCoord centre) {
    const glm::vec3 from = glm::normalize(glm::vec3(0.5F, -0.35F, 0.8F));
    camera_.eye_m = as_vector(centre) * voxel_m + from * away_m;
    camera_.yaw = std::atan2(from.x, from.z);
    camera_.pitch = std::asin(-from.y);
  }
  /// Whether each pixel's ray meets the exact body.
  std::vector<bool> exact(const EdgedShape& shape, const ShapePlace& place, VoxelCoord centre) const {
    const float half = std::tan(camera_.field_of_view * 0.5F), pixel = 2.0F * half / outline_height;
    const glm::vec3 right = camera_.right(), up = glm::cross(right, camera_.forward());
    std::vector<bool> met;
    for (int i = 0; i < outline_width * outline_height; ++i) {
      const float x = (static_cast<float>(i % outline_width) + 0.5F) * pixel - half * 4.0F / 3.0F;
      const float y = half - (static_cast<float>(i / outline_width) + 0.5F) * pixel;
      const glm::vec3 way = glm::normalize(camera_.forward() + right * x + up * y);
      bool hit = false;
      float along = 0.0F;
      for (int step = 0; step < 200 && along < 2.0F * away_m && !hit; ++step) {
        const glm::vec3 p = (camera_.eye_m + way * along) / voxel_m - as_vector(centre);
        const float distance = shape.distance(place.in(p));
        hit = distance < 0.003F;
        along += std::max(distance, 0.003F) * voxel_m;
      }
      met.push_back(hit);
    }
    return met;
  }
  std::vector<bool> drawn() {
    finish();
    const Result<DepthImage> depths =
        renderer_->draw_depths(*method_, camera_, outline_width, outline_height);
    EXPECT_TRUE(depths) << depths.error().message;
    std::vector<bool> met;
    if (depths)
      for (const float metres : depths->metres) met.push_back(metres < 2.0F * away_m);
    return met;
  }

  const std::vector<EdgedShape> shapes_ = edged_shapes();
};

/// The mean distance of two outlines, in pixels: the area between them by the outline's length.
double apart(const std::vector<bool>& a, const std::vector<bool>& b) {
  size_t area = 0, outline = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    area += a[i] != b[i] ? 1 : 0;
    if ((i + 1) % outline_width != 0) outline += a[i] != a[i + 1] ? 1 : 0;
    if (i + outline_width < a.size()) outline += a[i] != a[i + outline_width] ? 1 : 0;
  }
  // Steps along an aslant line count up to √2 times its length.
  return static_cast<double>(area) / (static_cast<double>(outline) / 1.3);
}

TEST_F(Edges, outlines_are_within_a_tenth_of_a_voxel_by_mesh_dual_and_raymarch) {
  const double pixels_a_voxel =
      static_cast<double>(voxel_m / (2.0F * away_m * std::tan(camera_.field_of_view * 0.5F))) *
      outline_height;
  for (const std::string_view name : {"mesh", "dual", "raymarch", "cubes"}) {
    method_name_ = name;
    method_ = make_method();
    for (size_t s = 0; s < shapes_.size(); ++s) {
      const EdgedShape& shape = shapes_[s];
      double sum = 0.0;
      for (size_t i = 0; i < turns; ++i) {
        const VoxelCoord centre = centre_of(s * turns + i);
        look_at(centre);
        sum += apart(exact(shape, shape_place(static_cast<int>(i) + 1), centre), drawn()) / pixels_a_voxel;
      }
      const double error = sum / turns;
      std::printf("%s, %s: %.3f voxels\n", std::string(name).c_str(), shape.name.c_str(), error);
      if (name == "cubes") {
        EXPECT_GT(error, 0.1) << "marching cubes rounds edges, so the measure tells";
      } else {
        EXPECT_LT(error, 0.1) << name << ", " << shape.name;
      }
    }
  }
}

}  // namespace
}  // namespace scree
