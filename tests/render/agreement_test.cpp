// Every method draws the same field: one carved scene, from the same cameras, held against the raymarcher's.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "client/render/levels/block_windows.h"
#include "client/render/methods.h"
#include "shared/base/random.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

constexpr float sky = std::numeric_limits<float>::infinity();
/// Pixels. Where one thing hides another far behind it, pictures may differ by a pixel: the more of them, the
/// less that is of the mean.
constexpr int picture_width = 320, picture_height = 240;

struct View {
  std::string_view name;
  Camera camera;
};

std::vector<View> views() {
  const auto view = [](std::string_view name, glm::vec3 eye_m, float yaw_degrees, float pitch_degrees) {
    const float degree = 0.01745329252F;
    return View{name, {eye_m, yaw_degrees * degree, pitch_degrees * degree}};
  };
  return {view("over the scene", {16.0F, 9.0F, 12.0F}, 60.0F, -20.0F),
          view("along the horizon", {12.0F, 5.0F, 6.0F}, 170.0F, 2.0F),
          view("straight down", {9.5F, 8.0F, 5.0F}, 90.0F, -85.0F),
          view("into a hole", {5.0F, 6.4F, 6.0F}, 66.0F, -4.0F)};
}

/// Metres from the eye, pixel by pixel.
std::vector<float> distances(const DepthImage& image, const Camera& camera) {
  const float half = std::tan(camera.field_of_view * 0.5F);
  const float pixel = 2.0F * half / static_cast<float>(image.height);
  std::vector<float> found;
  for (int i = 0; i < image.width * image.height; ++i) {
    const float x = (static_cast<float>(i % image.width) + 0.5F) * pixel - half * 4.0F / 3.0F;
    const float y = (static_cast<float>(i / image.width) + 0.5F) * pixel - half;
    found.push_back(image.metres[static_cast<size_t>(i)] * std::sqrt(1.0F + x * x + y * y));
  }
  return found;
}

/// Where one thing hides another behind it, or the sky: two pictures may put that a pixel apart, which says
/// nothing of how deep anything lies.
std::vector<bool> outlines(const std::vector<float>& distances_m) {
  constexpr float jump_m = 1.0F;
  std::vector<bool> found(distances_m.size());
  for (size_t i = 0; i < distances_m.size(); ++i) {
    const auto jumps = [&](size_t other) {
      const bool apart = !(std::abs(distances_m[i] - distances_m[other]) < jump_m);
      if (apart) found[i] = found[other] = true;
    };
    if ((i + 1) % picture_width != 0) jumps(i + 1);
    if (i + picture_width < distances_m.size()) jumps(i + picture_width);
  }
  return found;
}

/// What one picture has and the other has not, of what lies within both methods' reach.
struct Difference {
  size_t either = 0;  ///< pixels
  size_t both = 0;
  size_t near = 0;                 ///< of these, within the finest level of both methods
  std::vector<double> near_m;      ///< of these, those that are on no outline
  std::vector<double> far_voxels;  ///< beyond, in voxels of the level that belongs there
};

Difference compare(const std::vector<float>& a, const std::vector<float>& b, float reach_m, float fine_m) {
  Difference difference;
  const std::vector<bool> outline_a = outlines(a), outline_b = outlines(b);
  for (size_t i = 0; i < a.size(); ++i) {
    const bool in_a = a[i] < reach_m, in_b = b[i] < reach_m;
    difference.either += in_a || in_b;
    if (!in_a || !in_b) continue;
    ++difference.both;
    const double apart_m = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    float level_m = fine_m, level_voxel_m = voxel_m;
    for (; a[i] > level_m; level_m *= 2.0F) level_voxel_m *= 2.0F;
    if (a[i] < fine_m) {
      ++difference.near;
      if (!outline_a[i] && !outline_b[i]) difference.near_m.push_back(apart_m);
    } else {
      difference.far_voxels.push_back(apart_m / static_cast<double>(level_voxel_m));
    }
  }
  return difference;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// One carved scene.
class Agreement : public OffscreenTest {
 protected:
  Agreement() : OffscreenTest("raymarch", {TerrainKind::canyon, 1, voxel_m}, 32.0F) {}

  /// A cave into the cliff that two blows made, a notch beside it, and pits in the ground: craters, too.
  void SetUp() override {
    OffscreenTest::SetUp();
    for (const glm::vec3 at_m : {glm::vec3(0.5F, 6.0F, 4.0F), {-0.8F, 6.3F, 4.3F}, {1.0F, 4.8F, 6.0F}})
      carve(at_m);
    for (const glm::vec2 at : {glm::vec2(9.0F, 4.0F), {11.0F, 7.0F}, {6.5F, 8.0F}})
      carve({at.x, ground_height_m(field_.source(), at.x, at.y), at.y}, ShapeKind::crater);
    pieces_.clear();
  }
  std::vector<float> depths_of(const View& view) {
    camera_ = view.camera;
    finish();
    const Result<DepthImage> depths =
        renderer_->draw_depths(*method_, camera_, picture_width, picture_height);
    EXPECT_TRUE(depths) << depths.error().message;
    return depths ? distances(*depths, camera_) : std::vector<float>(picture_width * picture_height, sky);
  }
  void use(std::string_view method) {
    method_name_ = method;
    method_ = make_method();
    ASSERT_NE(method_, nullptr);
  }
  void expect_agreement(const Difference& difference, double overlap_min) {
    const auto share = [](size_t part, size_t whole) {
      return static_cast<double>(part) / static_cast<double>(whole);
    };
    const double overlap = share(difference.both, difference.either);
    const double judged = share(difference.near_m.size(), difference.near);
    const double near_voxels = mean(difference.near_m) / static_cast<double>(voxel_m);
    const double far_voxels = median(difference.far_voxels);
    EXPECT_GE(overlap, overlap_min);
    EXPECT_GE(judged, 0.9) << "hardly anything but outlines";
    EXPECT_LE(near_voxels, 0.5);
    EXPECT_LE(far_voxels, 0.5);
    std::printf("silhouette %.4f, depth %.3f voxels near (of %.3f), %.3f far\n", overlap, near_voxels, judged,
                far_voxels);
  }
};

TEST_F(Agreement, every_method_has_the_raymarchers_silhouettes_and_depths) {
  std::vector<std::vector<float>> marched;
  for (const View& view : views()) marched.push_back(depths_of(view));
  const float marched_reach_m = method_->reach_m();
  for (const MethodEntry& entry : all_methods()) {
    if (entry.name == "raymarch" || entry.missing()) continue;
    use(entry.name);
    for (size_t i = 0; i < marched.size(); ++i) {
      SCOPED_TRACE(std::string(entry.name) + ", " + std::string(views()[i].name));
      const std::vector<float> drawn = depths_of(views()[i]);
      std::printf("%s, %s: ", std::string(entry.name).c_str(), std::string(views()[i].name).c_str());
      expect_agreement(
          compare(marched[i], drawn, std::min(marched_reach_m, method_->reach_m()), view_radius_m / 2.0F),
          entry.name == "grid" ? 0.95 : 0.98);
    }
  }
}

/// The pieces of three blows, turned anyhow and merged into a heap at the cliff's foot: knife edges, clefts,
/// and two surfaces within a cell.
class AgreementOverRubble : public Agreement {
 protected:
  void SetUp() override {
    OffscreenTest::SetUp();
    for (const glm::vec3 at_m : {glm::vec3(0.5F, 6.0F, 4.0F), {-0.8F, 6.3F, 4.3F}, {1.0F, 4.8F, 6.0F}})
      carve(at_m);
    PieceTable table;
    for (const auto& [id, piece] : pieces_) table[id] = piece.volume;
    Random random(3);
    const auto either_way = [&] { return 2.0F * random.unit() - 1.0F; };
    for (const auto& [id, piece] : pieces_) {
      const float x = heap_m.x + 1.6F * either_way(), z = heap_m.y + 1.6F * either_way();
      const float up_m = 0.2F + 0.8F * random.unit();
      const glm::quat turn(either_way(), either_way(), either_way(), either_way());
      const Pose pose{{x, ground_height_m(field_.source(), x, z) + up_m, z}, glm::normalize(turn)};
      apply(StampOperation{id, quantise(pose), 0, StampMethod::facets}, field_, table);
    }
    pieces_.clear();
  }
  static Camera towards_heap(glm::vec3 from_m) {
    const glm::vec3 way = glm::normalize(glm::vec3(heap_m.x, from_m.y - 2.0F, heap_m.y) - from_m);
    return {from_m, std::atan2(-way.x, -way.z), std::asin(way.y)};
  }
  std::vector<View> rubble_views() const {
    const float ground_m = ground_height_m(field_.source(), heap_m.x, heap_m.y);
    return {{"from the side", towards_heap({heap_m.x + 5.0F, ground_m + 2.5F, heap_m.y + 3.0F})},
            {"from the foot", towards_heap({heap_m.x + 2.0F, ground_m + 2.2F, heap_m.y + 5.0F})}};
  }
  static constexpr glm::vec2 heap_m{5.0F, 5.0F};
};

/// Code and slope of the field at a point, as the raymarcher has them.
struct FieldSample {
  float code;
  glm::vec3 slope;
};

FieldSample sample_at(const Window& window, glm::vec3 p) {
  const auto code = [&window](glm::vec3 at) {
    const VoxelCoord c{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
    const glm::vec3 f = at - glm::vec3(c.x, c.y, c.z);
    float sum = 0.0F;
    for (int i = 0; i < 8; ++i) {
      const int x = i >> 2, y = (i >> 1) & 1, z = i & 1;
      const float part =
          (x == 1 ? f.x : 1.0F - f.x) * (y == 1 ? f.y : 1.0F - f.y) * (z == 1 ? f.z : 1.0F - f.z);
      sum += part * static_cast<float>(window.at(c.x + x, c.y + y, c.z + z));
    }
    return sum;
  };
  FieldSample sample{code(p), {}};
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 step(0.0F);
    step[axis] = 1.0F;
    sample.slope[axis] = code(p + step) - code(p - step);
  }
  return sample;
}

TEST_F(AgreementOverRubble, meshes_have_the_raymarchers_silhouettes) {
  std::vector<std::vector<float>> marched;
  for (const View& view : rubble_views()) marched.push_back(depths_of(view));
  const float marched_reach_m = method_->reach_m();
  use("mesh");
  for (size_t i = 0; i < marched.size(); ++i) {
    SCOPED_TRACE(rubble_views()[i].name);
    const std::vector<float> drawn = depths_of(rubble_views()[i]);
    expect_agreement(
        compare(marched[i], drawn, std::min(marched_reach_m, method_->reach_m()), view_radius_m / 2.0F),
        0.995);
  }
}

TEST_F(AgreementOverRubble, triangles_face_as_the_field_does) {
  const float ground_m = ground_height_m(field_.source(), heap_m.x, heap_m.y);
  const auto voxel = [](float m) { return floor_to_int(m / voxel_m); };
  const VoxelCoord middle{voxel(heap_m.x), voxel(ground_m + 1.0F), voxel(heap_m.y)};
  const std::optional<BlockWindows> windows =
      gather_windows(field_, {middle - VoxelCoord{12, 12, 12}, middle + VoxelCoord{12, 12, 12}});
  ASSERT_TRUE(windows);
  const SurfaceMesh mesh = windows->mesh(FaceEdges::sharp);
  double area = 0.0, drawn_degrees = 0.0;
  size_t judged = 0, astray = 0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::array<glm::vec3, 3> at{};
    glm::vec3 drawn(0.0F);
    for (size_t i = 0; i < 3; ++i) {
      const SurfaceVertex& vertex = mesh.vertices[mesh.indices[t + i]];
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        at[i][axis] = static_cast<float>(vertex.position[a]) / surface_steps_per_voxel;
        drawn[axis] += static_cast<float>(vertex.normal[a]);
      }
      at[i] += glm::vec3(mesh.origin.x, mesh.origin.y, mesh.origin.z);
    }
    const glm::vec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
    const float size = glm::length(across);
    const FieldSample field = sample_at(windows->now, (at[0] + at[1] + at[2]) / 3.0F);
    // Two faces that meet at more than a right angle leave the mean of their slopes less than this: there the
    // field shows no one surface.
    const float slope = glm::length(field.slope) / (2.0F * codes_per_voxel);
    const bool one_surface = std::abs(field.code) < 0.25F * codes_per_voxel && slope > 0.7F;
    if (size < 0.05F || !one_surface) continue;
    ++judged;
    const glm::vec3 faces = glm::normalize(field.slope);
    if (glm::dot(across / size, faces) < 0.5F) ++astray;
    const float between = std::clamp(glm::dot(glm::normalize(drawn), faces), -1.0F, 1.0F);
    drawn_degrees += static_cast<double>(size * std::acos(between)) * 57.29577951;
    area += static_cast<double>(size);
  }
  const size_t all = mesh.indices.size() / 3;
  std::printf("%zu of %zu triangles judged, %zu astray, normals %.2f degrees apart\n", judged, all, astray,
              drawn_degrees / area);
  EXPECT_GT(judged, all * 6 / 10);
  EXPECT_LE(astray, judged / 1000);  // where edges meet in a point, one may fold
  EXPECT_LE(drawn_degrees / area, 8.0);
}

}  // namespace
}  // namespace scree
