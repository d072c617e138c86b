// Props are drawn alike with every method: where they are, in the colours of
// their rows, hidden by what is nearer, and gone when they are removed.
#include <cmath>
#include <cstdlib>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "client/render/methods.h"
#include "client/viewer/pictures/png.h"
#include "content/builtin_palette.h"
#include "content/model/glb.h"
#include "tests/support/offscreen_fixture.h"
#include "tests/support/prop_world.h"
#include "tests/support/written_glb.h"

namespace scree {
namespace {

constexpr Material scarlet{7}, azure{6};
constexpr glm::quat unturned{1.0F, 0.0F, 0.0F, 0.0F};

MaterialLook even_look(std::array<float, 3> colour) {
  MaterialLook look;
  look.colour = colour;
  look.variation = 0.0F;
  look.roughness = 1.0F;
  return look;
}

/// The built-in palette, with two rows of these colours.
std::shared_ptr<const Palette> two_colours(std::array<float, 3> first, std::array<float, 3> second) {
  auto palette = std::make_shared<Palette>(builtin_palette());
  palette->rows[row_number(scarlet)].look = even_look(first);
  palette->rows[row_number(azure)].look = even_look(second);
  return palette;
}
constexpr std::array<float, 3> deep_red{0.7F, 0.02F, 0.02F}, deep_blue{0.02F, 0.05F, 0.8F};

bool is_red(const Image& image, int x, int y) {
  const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (y * image.width + x))];
  return pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2];
}
bool is_blue(const Image& image, int x, int y) {
  const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (y * image.width + x))];
  return pixel[2] > 2 * pixel[0] && pixel[2] > 3 * pixel[1] / 2;
}
template <typename Is>
size_t pixels(const Image& image, const Is& is) {
  size_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += is(image, x, y) ? 1 : 0;
  return count;
}

Prop of(Material material, std::vector<PropPart> parts) {
  Prop prop;
  prop.parts = std::move(parts);
  prop.material = material;
  prop.mass_kg = 50.0F;
  return prop;
}
PropPart box_of(glm::vec3 half_m, glm::vec3 place_m = glm::vec3(0.0F)) {
  return {.kind = PropPartKind::box, .place_m = place_m, .half_m = half_m};
}

/// Flat ground before the camera, which stands at its usual place and looks
/// level.
class Props : public OffscreenTest, public testing::WithParamInterface<std::string> {
 protected:
  Props() : OffscreenTest(GetParam(), {TerrainKind::flat, 3, 0.25F}, 16.0F) {}
  void SetUp() override {
    OffscreenTest::SetUp();
    if (method_ == nullptr) return;
    renderer_->set_terrain(field_.source());
    renderer_->set_palette(two_colours(deep_red, deep_blue));
    ground_m_ = ground_height_m(field_.source(), 0.0F, 0.0F);
    camera_.eye_m = {0.0F, ground_m_ + 1.5F, 6.0F};
    camera_.pitch = 0.0F;
    finish();
  }
  void put(PieceId id, const Prop& prop, glm::vec3 above_ground_m, glm::quat turn = unturned) {
    const auto known = props_.find(id);
    const auto shared = known == props_.end() ? std::make_shared<const Prop>(prop) : known->second.prop;
    props_[id] = {shared, {above_ground_m + glm::vec3(0.0F, ground_m_, 0.0F), turn}};
  }
  Image show(const std::string& name) {
    EXPECT_TRUE(renderer_->set_props(props_));
    const Image image = draw();
    if (const char* folder = std::getenv("SCREE_PICTURES")) {
      EXPECT_TRUE(write_png(std::string(folder) + "/props_" + GetParam() + "_" + name + ".png", image));
    }
    return image;
  }
  /// The pixel at which a place in the world is drawn.
  std::array<int, 2> pixel_of(glm::vec3 above_ground_m) const {
    const glm::vec3 off = above_ground_m + glm::vec3(0.0F, ground_m_, 0.0F) - camera_.eye_m;
    const float scale = 0.5F * height / (std::tan(camera_.field_of_view * 0.5F) * -off.z);
    return {static_cast<int>(0.5F * width + off.x * scale), static_cast<int>(0.5F * height - off.y * scale)};
  }

  SceneProps props_;
  float ground_m_ = 0.0F;
};

TEST_P(Props, have_the_colour_of_their_row_where_they_are) {
  put(3, of(scarlet, {box_of(glm::vec3(0.5F))}), {-1.0F, 1.0F, 0.0F});
  put(4, of(azure, {box_of({0.25F, 0.5F, 0.5F})}), {1.5F, 1.0F, 0.0F});
  const Image image = show("colours");
  // The faces before the camera, less a margin.
  for (const float x : {-1.4F, -1.0F, -0.6F})
    for (const float y : {0.6F, 1.0F, 1.4F}) {
      const auto [column, row] = pixel_of({x, y, 0.5F});
      EXPECT_TRUE(is_red(image, column, row)) << x << " " << y;
    }
  for (const float x : {1.3F, 1.7F}) {
    const auto [column, row] = pixel_of({x, 1.0F, 0.5F});
    EXPECT_TRUE(is_blue(image, column, row)) << x;
  }
  const float metre = static_cast<float>(pixel_of({1.0F, 1.0F, 0.5F})[0] - pixel_of({0.0F, 1.0F, 0.5F})[0]);
  EXPECT_NEAR(static_cast<float>(pixels(image, is_red)), metre * metre, 0.2F * metre * metre);
  EXPECT_NEAR(static_cast<float>(pixels(image, is_blue)), 0.5F * metre * metre, 0.25F * metre * metre);

  renderer_->set_palette(two_colours(deep_blue, deep_red));
  const Image swapped = show("swapped");
  EXPECT_NEAR(static_cast<float>(pixels(swapped, is_blue)), static_cast<float>(pixels(image, is_red)),
              120.0F);
}

TEST_P(Props, move_turn_and_go) {
  const Image bare = show("none");
  const Prop plank = of(scarlet, {box_of({1.0F, 0.1F, 0.3F})});
  put(3, plank, {0.0F, 1.5F, 0.0F});
  const Image first = show("plank");
  EXPECT_GT(differing_pixels(first, bare, 24), 100U);
  const auto right = pixel_of({0.8F, 1.5F, 0.3F}), above = pixel_of({0.0F, 2.2F, 0.3F});
  EXPECT_TRUE(is_red(first, right[0], right[1]));
  EXPECT_FALSE(is_red(first, above[0], above[1]));
  put(3, plank, {0.0F, 1.5F, 0.0F}, glm::angleAxis(1.5707963F, glm::vec3(0.0F, 0.0F, 1.0F)));
  const Image upright = show("plank_upright");
  EXPECT_FALSE(is_red(upright, right[0], right[1]));
  EXPECT_TRUE(is_red(upright, above[0], above[1]));
  put(3, plank, {0.0F, 1.5F, 0.0F});
  EXPECT_EQ(differing_pixels(show("plank_again"), first, 0), 0U);
  put(3, plank, {0.0F, 1.5F, 40.0F});
  EXPECT_EQ(differing_pixels(show("plank_behind"), bare, 0), 0U);
  props_.clear();
  EXPECT_EQ(differing_pixels(show("gone"), bare, 0), 0U);
}

TEST_P(Props, another_prop_of_the_same_number_takes_its_place) {
  put(3, of(scarlet, {box_of(glm::vec3(0.5F))}), {0.0F, 1.0F, 0.0F});
  EXPECT_GT(pixels(show("first"), is_red), 200U);
  props_.clear();
  put(3, of(azure, {box_of(glm::vec3(0.5F))}), {0.0F, 1.0F, 0.0F});
  const Image image = show("second");
  EXPECT_EQ(pixels(image, is_red), 0U);
  EXPECT_GT(pixels(image, is_blue), 200U);
}

TEST_P(Props, are_of_all_their_parts) {
  std::vector<PropPart> parts{box_of({0.8F, 0.1F, 0.1F}, {0.0F, 0.5F, 0.0F})};
  parts.push_back(
      {.kind = PropPartKind::sphere, .place_m = {-0.6F, -0.2F, 0.0F}, .half_m = glm::vec3(0.25F)});
  parts.push_back({.kind = PropPartKind::cylinder,
                   .place_m = {0.6F, -0.2F, 0.0F},
                   .turn = glm::angleAxis(1.5707963F, glm::vec3(0.0F, 0.0F, 1.0F)),
                   .half_m = {0.1F, 0.3F, 0.0F}});
  parts.push_back({.kind = PropPartKind::capsule, .half_m = {0.1F, 0.2F, 0.0F}});
  parts.push_back(
      {.kind = PropPartKind::hull,
       .place_m = {0.0F, -0.7F, 0.0F},
       .corners_m = {{-0.4F, 0.0F, 0.2F}, {0.4F, 0.0F, 0.2F}, {0.0F, 0.3F, 0.2F}, {0.0F, 0.0F, -0.3F}}});
  put(3, of(scarlet, std::move(parts)), {0.0F, 1.5F, 0.0F});
  const Image image = show("parts");
  for (const glm::vec3 at : {glm::vec3(0.7F, 2.0F, 0.1F),
                             {-0.6F, 1.3F, 0.25F},
                             {0.8F, 1.3F, 0.1F},
                             {0.0F, 1.7F, 0.1F},
                             {0.0F, 0.9F, 0.2F}}) {
    const auto [column, row] = pixel_of(at);
    EXPECT_TRUE(is_red(image, column, row)) << at.x << " " << at.y;
  }
  for (const glm::vec3 at : {glm::vec3(0.3F, 1.5F, 0.0F), {-0.3F, 1.0F, 0.0F}, {0.6F, 1.6F, 0.1F}}) {
    const auto [column, row] = pixel_of(at);
    EXPECT_FALSE(is_red(image, column, row)) << at.x << " " << at.y << " is between its parts";
  }
}

TEST_P(Props, are_hidden_by_ground_and_cast_a_shadow_on_it) {
  const Image bare = show("before_shadow");
  put(3, of(scarlet, {box_of(glm::vec3(0.5F))}), {0.0F, -1.0F, 2.0F});
  EXPECT_EQ(pixels(show("below"), is_red), 0U);
  // The light comes from the right, from above and a little from behind the
  // camera.
  put(3, of(scarlet, {box_of({0.6F, 0.1F, 0.6F})}), {1.0F, 2.0F, 2.0F});
  const Image shaded = show("shadow");
  const glm::vec3 sun = glm::normalize(glm::vec3(0.72F, 0.62F, 0.42F));
  const auto foot = pixel_of(glm::vec3(1.0F, 2.0F, 2.0F) - sun * (2.0F / sun.y));
  const auto brightness = [&](const Image& image) {
    const auto at = 3 * static_cast<size_t>(foot[1] * width + foot[0]);
    return image.rgb[at] + image.rgb[at + 1] + image.rgb[at + 2];
  };
  EXPECT_LT(brightness(shaded), brightness(bare) * 8 / 10);
}

TEST_P(Props, are_drawn_as_their_model_once_it_is_there) {
  const Digest name{1};
  Prop prop = of(azure, {box_of(glm::vec3(0.2F))});
  prop.model = name;
  put(3, prop, {0.0F, 1.5F, 0.0F});
  const Image parts = show("model_parts");
  EXPECT_EQ(pixels(parts, is_red), 0U);
  EXPECT_GT(pixels(parts, is_blue), 30U);

  const auto mesh =
      read_glb(box_glb({0.7F, 0.02F, 0.02F}, {0.8F, 0.5F, 0.1F}, R"(,"translation":[0,0.2,0])"));
  ASSERT_TRUE(mesh) << mesh.error().message;
  renderer_->set_models({{name, std::make_shared<const ModelMesh>(*mesh)}});
  const Image model = show("model");
  EXPECT_EQ(pixels(model, is_blue), 0U);
  for (const float x : {-0.7F, 0.0F, 0.7F})
    for (const float y : {-0.2F, 0.6F}) {
      const auto [column, row] = pixel_of({x, 1.5F + y, 0.1F});
      EXPECT_TRUE(is_red(model, column, row)) << x << " " << y;
    }
  const auto [column, row] = pixel_of({0.0F, 0.9F, 0.1F});
  EXPECT_FALSE(is_red(model, column, row)) << "the node lifts it";

  put(3, prop, {0.0F, 1.5F, 0.0F}, glm::angleAxis(1.5707963F, glm::vec3(0.0F, 0.0F, 1.0F)));
  const Image upright = show("model_upright");
  const auto right = pixel_of({0.5F, 1.5F, 0.1F}), above = pixel_of({-0.2F, 2.2F, 0.1F});
  EXPECT_FALSE(is_red(upright, right[0], right[1]));
  EXPECT_TRUE(is_red(upright, above[0], above[1]));

  renderer_->set_models({});
  put(3, prop, {0.0F, 1.5F, 0.0F});
  EXPECT_EQ(differing_pixels(show("model_gone"), parts, 0), 0U);
}

TEST_P(Props, models_cast_their_own_shadow) {
  const Digest name{1};
  Prop prop = of(azure, {box_of(glm::vec3(0.02F))});
  prop.model = name;
  put(3, prop, {1.0F, 2.0F, 2.0F});
  const Image bare = show("model_shadow_before");
  const auto mesh = read_glb(box_glb({0.7F, 0.02F, 0.02F}, {0.6F, 0.1F, 0.6F}));
  ASSERT_TRUE(mesh);
  renderer_->set_models({{name, std::make_shared<const ModelMesh>(*mesh)}});
  const Image shaded = show("model_shadow");
  const glm::vec3 sun = glm::normalize(glm::vec3(0.72F, 0.62F, 0.42F));
  const auto foot = pixel_of(glm::vec3(1.0F, 2.0F, 2.0F) - sun * (2.0F / sun.y));
  const auto at = 3 * static_cast<size_t>(foot[1] * width + foot[0]);
  const auto brightness = [&](const Image& image) {
    return image.rgb[at] + image.rgb[at + 1] + image.rgb[at + 2];
  };
  EXPECT_LT(brightness(shaded), brightness(bare) * 8 / 10);
}

std::vector<std::string> every_method() {
  std::vector<std::string> names;
  for (const MethodEntry& entry : all_methods()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(methods, Props, testing::ValuesIn(every_method()),
                         [](const auto& tested) { return tested.param; });

/// Where a picture shows the prop and not the ground.
class PropSilhouettes : public OffscreenTest {
 protected:
  PropSilhouettes() : OffscreenTest("mesh", {TerrainKind::canyon, 1, 0.25F}, 16.0F) {}

  /// Pixels of what is nearer with props than without, by that method.
  std::vector<bool> silhouette(std::string_view method, const SceneProps& props) {
    method_name_ = method;
    method_ = make_method();
    finish();
    EXPECT_TRUE(renderer_->set_props({}));
    const Result<DepthImage> bare = renderer_->draw_depths(*method_, camera_, width, height);
    EXPECT_TRUE(renderer_->set_props(props));
    const Result<DepthImage> shown = renderer_->draw_depths(*method_, camera_, width, height);
    EXPECT_TRUE(bare && shown);
    std::vector<bool> mask;
    if (bare && shown)
      for (size_t i = 0; i < bare->metres.size(); ++i)
        mask.push_back(shown->metres[i] < bare->metres[i] - 0.01F);
    return mask;
  }
};

TEST_F(PropSilhouettes, agree_between_methods) {
  const float ground_m = ground_height_m(field_.source(), 8.0F, 0.0F);
  camera_.eye_m = {8.0F, ground_m + 2.5F, 6.0F};
  camera_.pitch = -0.25F;
  SceneProps props;
  const auto put = [&](PieceId id, const Prop& prop, glm::vec3 off_m) {
    props[id] = {
        std::make_shared<const Prop>(prop),
        {glm::vec3(8.0F, ground_m, 0.0F) + off_m, glm::normalize(glm::quat(0.9F, 0.2F, 0.3F, 0.1F))}};
  };
  put(1, crate(0.5F), {-1.2F, 0.6F, 0.0F});
  put(2, ball(0.5F, 100.0F), {0.3F, 1.2F, 0.0F});
  put(3, of(azure, {{.kind = PropPartKind::cylinder, .half_m = {0.4F, 0.6F, 0.0F}}}), {1.6F, 0.2F, 0.5F});
  const std::vector<bool> first = silhouette("mesh", props);
  const auto covered = static_cast<size_t>(std::ranges::count(first, true));
  EXPECT_GT(covered, 400U);
  for (const MethodEntry& entry : all_methods()) {
    const std::vector<bool> other = silhouette(entry.name, props);
    ASSERT_EQ(other.size(), first.size());
    size_t apart = 0;
    for (size_t i = 0; i < first.size(); ++i) apart += first[i] != other[i] ? 1 : 0;
    // Their ground differs by a part of a voxel, where they stand in it.
    EXPECT_LT(apart, covered / (entry.name == "grid" ? 8 : 15)) << entry.name;
  }
}

}  // namespace
}  // namespace scree
