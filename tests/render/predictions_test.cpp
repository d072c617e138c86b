// One's own carves shown before the server answers, by every method: seen at once, and afterwards every
// picture is, bit for bit, that of a viewer that never predicted.
#include "client/mirror/predictions.h"

#include <string>
#include <vector>

#include "client/mirror/limits.h"
#include "client/render/grid/grid_shape.h"
#include "client/render/methods.h"
#include "tests/support/flat_welcome.h"
#include "tests/support/offscreen_fixture.h"
#include "tests/support/patience.h"

namespace scree {
namespace {

std::vector<std::string_view> names_of_methods() {
  std::vector<std::string_view> names;
  for (const MethodEntry& entry : all_methods()) names.push_back(entry.name);
  return names;
}

/// Two viewers that get the same messages; one of them predicts.
class PredictedPictures : public OffscreenTest, public testing::WithParamInterface<std::string_view> {
 protected:
  PredictedPictures() : OffscreenTest(GetParam(), flat_terrain, 6.0F) {}

  void SetUp() override {
    OffscreenTest::SetUp();
    if (const auto missing = method_named(GetParam())->missing()) GTEST_SKIP() << *missing;
    plain_method_ = make_method();
    const DrawOptionValues small = values_of(GridShape{64, 1, GridSpacing::uniform});
    method_->set_options(small);
    plain_method_->set_options(small);
    camera_.eye_m = {0.0F, 3.0F, 5.0F};
    camera_.pitch = -0.6F;
  }

  static CarveRequest blow(float x_m, uint32_t random_seed) {
    CarveRequest request;
    request.shape = sphere({x_m, -0.3F, 0.0F}, 1.0F);
    request.pattern = SeedPattern::uniform;
    request.seeds = 5;
    request.random_seed = random_seed;
    request.impact_m = {x_m, 0.0F, 0.0F};
    return request;
  }
  Operation made_of(const CarveRequest& request, uint32_t seeds) {
    const CarveOperation made{.shape = request.shape,
                              .pattern = request.pattern,
                              .seeds = seeds,
                              .random_seed = request.random_seed,
                              .impact_m = request.impact_m,
                              .first_piece = next_piece_};
    next_piece_ += seeds;
    return made;
  }
  bool foresee(uint32_t request, const CarveRequest& asked) {
    return predictions_.foresee(request, asked, now_s_, [](ChunkCoord) { return true; });
  }
  void apply(const ServerMessage& message) {
    const auto changes = mirror_.apply(message);
    ASSERT_TRUE(changes) << changes.error().message;
    ASSERT_TRUE(plain_.apply(message));
    predictions_.notice(message);
    MirrorChanges all = *changes;
    predictions_.settle(now_s_, all);
    method_->changed(all);
    plain_method_->changed(*changes);
  }
  void frame(const std::vector<Operation>& operations) {
    FrameMessage message;
    message.tick = ++tick_;
    message.operations = operations;
    apply(message);
  }
  void settle() {
    MirrorChanges changes;
    predictions_.settle(now_s_, changes);
    method_->changed(changes);
  }
  ScenePieces pieces_of(const Mirror& mirror) const {
    ScenePieces pieces;
    for (const auto& [id, motion] : mirror.pieces()) pieces[id] = {motion.volume, motion.to};
    return pieces;
  }
  Image picture_of(DrawMethod& method, Field& field, const ScenePieces& pieces) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    for (method.update(Scene{field, pieces}, camera_);
         !method.complete() && std::chrono::steady_clock::now() < deadline;
         method.update(Scene{field, pieces}, camera_))
      wait_a_moment();
    return draw(method);
  }
  Image seen() {
    ScenePieces pieces = pieces_of(mirror_);
    for (const auto& [id, volume] : predictions_.pieces())
      pieces[id] = {volume, Pose{volume->centre_voxels * voxel_m, {1.0F, 0.0F, 0.0F, 0.0F}}};
    return picture_of(*method_, predictions_.field(), pieces);
  }
  Image plain() { return picture_of(*plain_method_, plain_.field(), pieces_of(plain_)); }
  void expect_plain(const std::string& when) {
    EXPECT_EQ(predictions_.outstanding(), 0U) << when;
    EXPECT_EQ(differing_pixels(seen(), plain(), 0), 0U) << when;
  }
  void expect_shown(const std::string& when) {
    EXPECT_GT(predictions_.outstanding(), 0U) << when;
    EXPECT_GT(differing_pixels(seen(), plain(), 8), 20U) << when;
  }

  Mirror mirror_{flat_welcome()};
  Mirror plain_{flat_welcome()};
  Predictions predictions_{mirror_};
  std::unique_ptr<DrawMethod> plain_method_;
  double now_s_ = 0.0;
  Tick tick_ = 0;
};

TEST_P(PredictedPictures, are_those_of_a_viewer_without_predictions_once_all_is_answered) {
  frame({made_of(blow(-1.5F, 1), 4)});
  expect_plain("before");

  ASSERT_TRUE(foresee(1, blow(0.5F, 2)));
  settle();
  expect_shown("asked");
  frame({made_of(blow(0.5F, 2), 5)});
  expect_plain("accepted");

  ASSERT_TRUE(foresee(2, blow(1.5F, 3)));
  settle();
  expect_shown("asked again");
  apply(ReplyMessage{2, "refused", 0});
  expect_plain("refused");

  ASSERT_TRUE(foresee(3, blow(1.5F, 4)));
  ASSERT_TRUE(foresee(4, blow(-0.5F, 5)));
  settle();
  frame({made_of(blow(1.0F, 6), 3)});
  expect_shown("overtaken");
  frame({made_of(blow(-0.5F, 5), 2)});
  apply(ReplyMessage{4, "", 2});
  expect_shown("one of two answered");
  frame({made_of(blow(1.5F, 4), 5)});
  expect_plain("overtaken, and accepted");

  ASSERT_TRUE(foresee(5, blow(-2.5F, 7)));
  settle();
  seen();
  now_s_ += limits::prediction_seconds_max;
  settle();
  expect_plain("not answered in time");

  ASSERT_TRUE(foresee(6, blow(-2.5F, 8)));
  settle();
  seen();
  apply(ResetMessage{});
  expect_plain("reset");
}

INSTANTIATE_TEST_SUITE_P(Methods, PredictedPictures, testing::ValuesIn(names_of_methods()),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace scree
