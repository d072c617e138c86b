// Joints are drawn alike with every method: between their bodies, hidden by what is nearer, gone with them.
#include <cmath>
#include <cstdlib>

#include "client/render/methods.h"
#include "client/render/scene/joint_lines.h"
#include "client/viewer/pictures/png.h"
#include "tests/support/offscreen_fixture.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

/// Two crates over flat ground before the camera, and a joint between them.
class DrawnJoints : public OffscreenTest, public testing::WithParamInterface<std::string> {
 protected:
  DrawnJoints() : OffscreenTest(GetParam(), {TerrainKind::flat, 3, 0.25F}, 16.0F) {}
  void SetUp() override {
    OffscreenTest::SetUp();
    if (method_ == nullptr) return;
    renderer_->set_terrain(field_.source());
    ground_m_ = ground_height_m(field_.source(), 0.0F, 0.0F);
    camera_.eye_m = {0.0F, ground_m_ + 1.5F, 6.0F};
    camera_.pitch = 0.0F;
    finish();
    put(1, {-1.5F, 2.0F, 0.0F});
    put(2, {1.5F, 2.0F, 0.0F});
  }
  void put(PieceId id, glm::vec3 above_ground_m) {
    props_[id] = {std::make_shared<const Prop>(crate(0.2F)),
                  {above_ground_m + glm::vec3(0.0F, ground_m_, 0.0F), {1.0F, 0.0F, 0.0F, 0.0F}}};
  }
  JointFrame frame(PieceId id) const { return {id, props_.at(id).pose.position_m}; }
  Joint line(JointKind kind, float slack = 1.0F) const {
    Joint joint = line_between(kind, frame(1), frame(1).origin_m, frame(2), frame(2).origin_m);
    joint.length_m *= slack;
    return joint;
  }
  Image show(const SceneJoints& joints, const std::string& name) {
    EXPECT_TRUE(renderer_->set_props(props_));
    LineList lines;
    add_joints(lines, joints, {field_, pieces_, props_}, camera_.eye_m);
    const Result<Image> image = renderer_->draw_image(*method_, camera_, width, height, lines);
    EXPECT_TRUE(image);
    if (!image) return {};
    if (const char* folder = std::getenv("SCREE_PICTURES")) {
      EXPECT_TRUE(write_png(std::string(folder) + "/joints_" + GetParam() + "_" + name + ".png", *image));
    }
    return *image;
  }
  /// How many of the pixels about a place differ.
  size_t changed_at(const Image& a, const Image& b, glm::vec3 above_ground_m) const {
    const glm::vec3 off = above_ground_m + glm::vec3(0.0F, ground_m_, 0.0F) - camera_.eye_m;
    const float scale = 0.5F * height / (std::tan(camera_.field_of_view * 0.5F) * -off.z);
    const int column = static_cast<int>(0.5F * width + off.x * scale);
    const int row = static_cast<int>(0.5F * height - off.y * scale);
    size_t count = 0;
    for (int y = row - 1; y <= row + 1; ++y)
      for (int x = column - 1; x <= column + 1; ++x) {
        const auto at = 3 * static_cast<size_t>(y * width + x);
        count += std::abs(a.rgb[at] - b.rgb[at]) > 12 ? 1 : 0;
      }
    return count;
  }

  SceneProps props_;
  float ground_m_ = 0.0F;
};

TEST_P(DrawnJoints, a_rod_is_straight_and_a_rope_hangs_by_its_slack) {
  const Image bare = show({}, "none");
  const Image rod = show({{5, line(JointKind::distance)}}, "rod");
  EXPECT_GT(changed_at(rod, bare, {0.0F, 2.0F, 0.0F}), 1U);
  EXPECT_EQ(changed_at(rod, bare, {0.0F, 1.3F, 0.0F}), 0U);
  const Image tight = show({{5, line(JointKind::rope)}}, "tight");
  EXPECT_GT(changed_at(tight, bare, {0.0F, 2.0F, 0.0F}), 1U);
  const Image slack = show({{5, line(JointKind::rope, 1.15F)}}, "slack");
  EXPECT_EQ(changed_at(slack, bare, {0.0F, 2.0F, 0.0F}), 0U);
  // A parabola a seventh longer than its span of 3 m hangs by about a quarter of it.
  const float sag_m = 3.0F * std::sqrt(0.15F * 3.0F / 8.0F);
  EXPECT_GT(changed_at(slack, bare, {0.0F, 2.0F - sag_m, 0.0F}), 1U);
}

TEST_P(DrawnJoints, every_kind_is_seen_where_it_holds) {
  const Image bare = show({}, "none");
  const glm::vec3 middle_m(0.0F, ground_m_ + 2.0F, 0.0F);
  for (const JointKind kind : all_kinds<JointKind>) {
    const bool has_length = traits_of(kind).has_length;
    const Joint joint = has_length ? line(kind) : joint_at(kind, frame(1), frame(2), middle_m, {0, 1, 0});
    const Image image = show({{5, joint}}, std::string(name_of(kind)));
    EXPECT_GT(changed_at(image, bare, {0.0F, 2.0F, 0.0F}), 1U) << name_of(kind);
  }
}

TEST_P(DrawnJoints, are_hidden_by_what_is_nearer_and_gone_with_their_bodies) {
  put(3, {0.0F, 2.0F, 1.0F});
  const Image bare = show({}, "crate");
  const SceneJoints rod{{5, line(JointKind::distance)}};
  EXPECT_EQ(changed_at(show(rod, "behind"), bare, {0.0F, 2.0F, 0.0F}), 0U);
  props_.erase(3);
  props_.erase(2);
  const Image alone = show({}, "alone");
  EXPECT_EQ(differing_pixels(show(rod, "without"), alone, 0), 0U);
}

std::vector<std::string> methods_with_joints() {
  std::vector<std::string> names;
  for (const MethodEntry& entry : all_methods()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(methods, DrawnJoints, testing::ValuesIn(methods_with_joints()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace scree
