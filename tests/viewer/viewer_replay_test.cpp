// The timeline of a replay in the viewer's window: apart from all other panels, dragged by the mouse, moved
// by keys.
#include <filesystem>
#include <gtest/gtest.h>

#include "tests/support/recorded_session.h"
#include "tests/support/viewer_window_fixture.h"

namespace scree {
namespace {

/// Looks at a replay, whose timeline the hand drags.
class ReplayHand : public ViewerHand {
 protected:
  static constexpr Tick ticks = 400;

  void prepare(LiveConfig& config) override {
    folder_ = std::filesystem::temp_directory_path() / ("scree_replay_hand_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    config.replay.path = (folder_ / "session.scree").string();
    record_session(config.replay.path, ticks);
    options_.quality = Quality::low;
  }
  void TearDown() override {
    ViewerHand::TearDown();
    server_.reset();
    std::filesystem::remove_all(folder_);
  }
  const PlaybackMessage& playback() { return viewing_->session.timeline().playback(); }
  /// Moves the mouse to a part of the bar.
  void point_at(float part) {
    const Rectangle& strip = app_->panels()[index_of(PanelPlace::lowest)];
    const glm::vec2 at = strip.at + glm::vec2(8.0F + part * (strip.size.x - 16.0F), 18.0F);
    hand("mousemove " + std::to_string(static_cast<int>(at.x)) + " " +
         std::to_string(static_cast<int>(at.y)));
    frames(3);
  }

 private:
  std::filesystem::path folder_;
};

class ViewerTimeline : public ReplayHand, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(ViewerTimeline, stands_apart_from_all_else_is_dragged_and_hides_with_all) {
  const auto [width, height] = GetParam();
  join(width, height);
  hand("key l key Return type 'a line that is written while everything is shown'");
  run_until(
      [&] {
        for (const PanelPlace place :
             {PanelPlace::upper_left, PanelPlace::lower_left, PanelPlace::upper_right,
              PanelPlace::lower_right, PanelPlace::bottom, PanelPlace::lowest})
          if (!shown(place)) return false;
        return window_->writes().has_value();
      },
      "everything");
  expect_apart(width, height);
  hand("key Escape key j");
  run_until([&] { return !playback().playing; }, "the hold");
  point_at(0.25F);
  hand("mousedown 1");
  frames(3);
  point_at(0.75F);
  hand("mouseup 1");
  const auto is_near = [&](Tick tick) {
    return playback().moment + 8 > tick && playback().moment < tick + 8;
  };
  run_until([&] { return is_near(ticks * 3 / 4); }, "the moment to which the bar was dragged");
  EXPECT_FALSE(window_->holds_mouse()) << "a click on the bar takes no mouse";
  const Tick before = playback().moment;
  hand("key 9");
  run_until([&] { return playback().moment < before; }, "the event before");
  hand("key End");
  run_until([&] { return playback().moment == ticks; }, "the end");
  hand("key F1");
  run_until([&] { return app_->panels() == PanelRectangles{}; }, "the picture alone");
}

INSTANTIATE_TEST_SUITE_P(Sizes, ViewerTimeline, window_sizes);

TEST_F(ReplayHand, looks_through_the_eye_of_who_was_there_until_it_moves) {
  join(320, 200);
  hand("key j");
  run_until([&] { return viewing_->session.figures(steady_now_s()).all().contains(recorded_person(3)); },
            "who was there");
  hand("key n");
  run_until([&] { return app_->eye().person() == recorded_person(3); }, "her eye");
  run_until([&] { return std::abs(viewing_->camera.eye_m.y - 1.7F) < 0.05F; }, "the camera at it");
  EXPECT_NEAR(viewing_->camera.eye_m.z, 0.0F, 0.05F);
  hand("keydown s");
  run_until([&] { return !app_->eye().follows(); }, "one's own eye");
  hand("keyup s");
}

}  // namespace
}  // namespace scree
