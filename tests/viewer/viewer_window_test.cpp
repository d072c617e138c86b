// The viewer's window, on an X server of the test's own that shows nothing to anyone (Xvfb).
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

#include "client/viewer/pictures/png.h"
#include "content/builtin_palette.h"
#include "tests/support/run_viewer.h"
#include "tests/support/viewer_window_fixture.h"

namespace scree {
namespace {

TEST_F(ViewerWindow, draws_with_all_of_the_hud_and_goes_on_without_a_server) {
  open(320, 200);
  run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
  EXPECT_EQ(app_->settings().width, 320);
  EXPECT_EQ(app_->settings().method, options_.method->name);
  server_.reset();
  run_until([&] { return !viewing_->session.connected(); }, "the loss");
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(app_->frame());
  EXPECT_NE(viewing_->view->methods().shown(), nullptr) << "the last field stays";
}

TEST_F(ViewerWindow, shows_what_the_servers_bodies_do_when_the_overlay_asks) {
  open(320, 200);
  run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
  viewing_->session.strike(carving_tool(), viewing_->camera.eye_m, viewing_->camera.forward(),
                           steady_now_s());
  run_until(
      [&] {
        const PhysicsMessage* physics = viewing_->session.physics();
        return physics != nullptr && !physics->bodies.empty();
      },
      "what the bodies do");
  LineList lines;
  OverlayChoice choice;
  viewing_->add_overlay(lines, choice, steady_now_s());
  EXPECT_TRUE(lines.vertices().empty()) << "nothing is shown that was not asked for";
}

TEST_F(ViewerHand, turns_sound_off_and_on_by_a_key) {
  options_.sound = true;
  join(320, 200);
  EXPECT_TRUE(app_->settings().sound);
  hand("key 6");
  run_until([&] { return !app_->settings().sound; }, "silence");
  hand("key 6");
  run_until([&] { return app_->settings().sound; }, "sound");
}

TEST_F(ViewerHand, shows_hides_and_ends_by_keys) {
  join(640, 360);
  run_until(
      [&] {
        return shown(PanelPlace::upper_left) && shown(PanelPlace::lower_left) &&
               shown(PanelPlace::upper_right) && shown(PanelPlace::lower_right) && shown(PanelPlace::lowest);
      },
      "everything");
  for (size_t i = 0; i < panel_places; ++i)
    for (size_t j = 0; j < i; ++j) EXPECT_FALSE(intersect(app_->panels()[i], app_->panels()[j]));
  hand("key F1");
  run_until([&] { return app_->panels() == PanelRectangles{}; }, "the picture alone");
  hand("key Escape key m");
  run_until([&] { return window_->has_menu(); }, "the menu, seen all the same");
  hand("key Escape");
  run_until([&] { return !window_->has_menu(); }, "the world again");
  EXPECT_FALSE(window_->should_close());
  EXPECT_EQ(app_->settings().method, options_.method->name) << "a key that the menu got did nothing else";
  hand("key F1 key g key p key h");
  run_until(
      [&] {
        return shown(PanelPlace::upper_left) && !shown(PanelPlace::lower_right) &&
               !shown(PanelPlace::upper_right) && !shown(PanelPlace::lower_left);
      },
      "figures alone: after all the help comes none");
  hand("key Escape");
  run_until([&] { return window_->has_menu(); }, "the menu");
  hand("key Down key Down key Return");
  run_until([&] { return window_->should_close(); }, "the end, by the menu's last button");
}

TEST_F(ViewerHand, escape_frees_the_mouse_first) {
  join(320, 200);
  capture_mouse();
  hand("key Escape");
  run_until([&] { return !window_->holds_mouse(); }, "the mouse's freedom");
  EXPECT_FALSE(window_->has_menu());
  EXPECT_FALSE(window_->should_close());
}

TEST_F(ViewerHand, a_newcomer_sees_the_cross_a_tool_line_and_one_hint) {
  settings_ = Settings{};
  join(1280, 720);
  run_until([&] { return shown(PanelPlace::lowest) && shown(PanelPlace::bottom); }, "line and hint");
  float shown_pixels = 0.0F;
  for (const Rectangle& one : app_->panels()) shown_pixels += one.size.x * one.size.y;
  EXPECT_LT(shown_pixels, 0.08F * 1280.0F * 720.0F);
  for (const PanelPlace place : {PanelPlace::top, PanelPlace::upper_left, PanelPlace::lower_left,
                                 PanelPlace::upper_right, PanelPlace::lower_right})
    EXPECT_FALSE(shown(place)) << static_cast<int>(place);
  EXPECT_EQ(app_->settings().tool.use, ToolUse::dig);
}

/// The whole way by keys, from a window that nobody has touched.
TEST_F(ViewerHand, digs_ten_times_at_one_spot_by_the_keyboard_alone) {
  settings_ = Settings{};
  join(640, 360);
  hand("keydown Down");
  run_until([&] { return viewing_->camera.pitch < -1.5F; }, "the ground below");
  hand("keyup Down");
  const glm::vec3 eye_m = viewing_->camera.eye_m;
  const auto answers = [&] { return viewing_->session.answer().number; };
  for (uint32_t strike = 1; strike <= 10; ++strike) {
    hand("key e");
    run_until([&] { return answers() == strike; }, "the answer");
    EXPECT_EQ(viewing_->session.answer().refused, "");
  }
  EXPECT_FALSE(window_->holds_mouse());
  EXPECT_EQ(viewing_->camera.eye_m, eye_m);
  run_until([&] { return viewing_->session.predictions() == 0; }, "the server's digs");
  const auto bottom_m = viewing_->session.aim(eye_m, viewing_->camera.forward());
  ASSERT_TRUE(bottom_m);
  EXPECT_LT(bottom_m->y, -3.0F) << "dug from flat ground at 0 m";
  RecordProperty("depth_m", std::to_string(-bottom_m->y));
  const auto& carried = viewing_->session.holder().carried;
  const auto& status = viewing_->session.mirror()->status();
  const auto sum = [&] {
    MassUnits all = 0;
    for (const MaterialMass& one : carried) all += one.mass;
    return all;
  };
  run_until([&] { return sum() > 0 && status && status->ledger_stored == sum(); },
            "the ledger with what is carried");
  EXPECT_EQ(status->ledger_terrain + status->ledger_pieces + status->ledger_dust + status->ledger_stored,
            status->ledger_poured);
  const MassUnits dug = sum();
  hand("key 2 key e");
  run_until([&] { return answers() == 11; }, "what was placed");
  EXPECT_EQ(viewing_->session.answer().refused, "");
  EXPECT_LT(sum(), dug);
  hand("key u");
  run_until([&] { return viewing_->session.holder().carried.empty(); }, "the world's store to have it");
  hand("key e");
  run_until([&] { return answers() == 13; }, "that there is nothing to place");
  EXPECT_EQ(viewing_->session.answer().refused, "you carry nothing");
}

TEST_F(ViewerHand, a_key_that_is_held_digs_again_and_again) {
  settings_ = Settings{};
  join(320, 200);
  hand("keydown e");
  run_until([&] { return viewing_->session.answer().number >= 4; }, "four digs");
  hand("keyup e");
  frames(3);
  run_until([&] { return viewing_->session.predictions() == 0; }, "all answers");
  frames(10);
  const uint32_t number = viewing_->session.answer().number;
  frames(10);
  EXPECT_EQ(viewing_->session.answer().number, number);
}

TEST_F(ViewerHand, the_first_click_takes_the_mouse_and_the_second_strikes) {
  join(320, 200);
  capture_mouse();
  EXPECT_FALSE(viewing_->session.carved());
  hand("click 1");
  run_until([&] { return viewing_->session.carved(); }, "what the strike broke");
  const HandChoice before = app_->settings().hand;
  hand("key Prior key comma key Tab");
  run_until([&] { return !window_->holds_mouse(); }, "the mouse's freedom");
  EXPECT_GT(app_->settings().hand.text_scale, before.text_scale);
  EXPECT_LT(app_->settings().hand.field_of_view_degrees, before.field_of_view_degrees);
}

TEST_F(ViewerHand, a_window_that_comes_back_strikes_nothing_by_the_click_that_takes_the_mouse_again) {
  join(320, 200);
  capture_mouse();
  hand("search --maxdepth 0 --name '.*' windowfocus");
  run_until([&] { return !window_->holds_mouse(); }, "the mouse's freedom");
  hand("search --name Scree windowfocus --sync click 1 key f");
  run_until([&] { return window_->holds_mouse() && app_->settings().tool.use == ToolUse::fill; },
            "the mouse");
  EXPECT_EQ(viewing_->session.predictions(), 0U);
  EXPECT_FALSE(viewing_->session.carved());
}

TEST_F(ViewerHand, full_screen_and_back_turn_no_view) {
  options_.quality = Quality::low;
  join(320, 200);
  capture_mouse();
  const Camera before = viewing_->camera;
  for (const int width : {1920, 320}) {
    hand("key F11");
    run_until([&] { return window_->width() == width; }, "the other size");
    frames(8);
    EXPECT_EQ(viewing_->camera.yaw, before.yaw) << width;
    EXPECT_EQ(viewing_->camera.pitch, before.pitch) << width;
  }
}

TEST_F(ViewerHand, fills_and_paints) {
  join(320, 200);
  capture_mouse();
  const auto poured = [&] {
    const auto& status = viewing_->session.mirror()->status();
    return status && status->ledger_poured > 0;
  };
  hand("key f click 1");
  run_until(poured, "what was poured");
  viewing_->session.mirror()->set_palette(shared_builtin_palette());
  const auto painted = [&] {
    Field& field = viewing_->session.mirror()->field();
    for (const ChunkCoord chunk : field.edited_chunks())
      for (const BrickCoord brick : field.edited_bricks(chunk))
        if (std::ranges::count(field.materials(brick).list(), said(material::ice)) > 0) return true;
    return false;
  };
  hand("key f key b key b click 1");
  run_until(painted, "what was painted");
  EXPECT_EQ(app_->settings().tool.use, ToolUse::paint);
  EXPECT_EQ(app_->settings().tool.material, "ice");
  EXPECT_FALSE(viewing_->session.carved());
}

TEST_F(ViewerHand, walks_and_is_stopped_by_a_wall) {
  join(320, 200);
  capture_mouse();
  // A box stands on what it is aimed at.
  const Tool box{.kind = ToolKind::box, .use = ToolUse::fill, .material = {}, .radius_m = 2.0F};
  viewing_->session.strike(box, {0.0F, 6.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, steady_now_s());
  hand("key q");
  const float ground_m = ground_height_m(viewing_->session.mirror()->terrain(), 0.0F, 6.0F);
  const glm::vec3& eye_m = viewing_->camera.eye_m;
  run_until([&] { return std::abs(eye_m.y - ground_m - Walker::eye_above_m) < 0.2F; }, "the ground");
  hand("keydown w");
  run_until([&] { return eye_m.z < 2.6F; }, "the box");
  const double until_s = steady_now_s() + 0.5;
  run_until([&] { return steady_now_s() > until_s; }, "some more steps against it");
  hand("keyup w");
  EXPECT_GT(eye_m.z, 2.0F) << "the box stands in the way";
  hand("key q");
  run_until([&] { return app_->flies(); }, "wings");
}

TEST_F(ViewerHand, says_a_line_and_lists_who_is_there) {
  join(640, 360);
  const auto& conversation = viewing_->session.conversation();
  run_until([&] { return !conversation.persons().persons.empty(); }, "the list of persons");
  hand("key p key h key g key l");
  run_until([&] { return shown(PanelPlace::lower_right) && !shown(PanelPlace::upper_right); }, "the list");
  const glm::vec3 before_m = viewing_->camera.eye_m;
  hand("key Return type 'wasd m'");
  run_until([&] { return window_->writes() && window_->writes()->text() == "wasd m"; }, "what is written");
  EXPECT_EQ(viewing_->camera.eye_m, before_m) << "letters move nothing";
  EXPECT_EQ(app_->settings().method, options_.method->name) << "nor do they change anything";
  hand("key Return");
  run_until([&] { return !conversation.lines(steady_now_s(), true).empty(); }, "the line");
  EXPECT_FALSE(window_->writes());
  EXPECT_NE(conversation.lines(steady_now_s(), true)[0].find("wasd m"), std::string::npos);
}

class ViewerPanels : public ViewerHand, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(ViewerPanels, do_not_overlap_while_all_of_them_are_shown_and_a_line_is_written) {
  const auto [width, height] = GetParam();
  options_.quality = Quality::low;
  join(width, height);
  hand("key l key Return type 'a line that is written while everything is shown'");
  run_until(
      [&] {
        return shown(PanelPlace::upper_left) && shown(PanelPlace::lower_left) &&
               shown(PanelPlace::upper_right) && shown(PanelPlace::lower_right) &&
               shown(PanelPlace::bottom) && window_->writes();
      },
      "everything");
  expect_apart(width, height);
  hand("key Escape key F1");
  run_until([&] { return app_->panels() == PanelRectangles{}; }, "the picture alone");
}

INSTANTIATE_TEST_SUITE_P(Sizes, ViewerPanels, window_sizes);

TEST_F(ViewerHand, takes_pictures_and_records_paths_into_this_folder) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "scree_hand", before = fs::current_path();
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::current_path(folder);
  const auto file = [&](const char* ending) {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ending) return entry.path().string();
    return std::string();
  };
  join(320, 200);
  hand("key F12 key k key k");
  run_until([&] { return !file(".json").empty(); }, "the path's file");
  fs::current_path(before);
  EXPECT_TRUE(read_png(file(".png")));
  EXPECT_TRUE(CameraPath::read(file(".json")));
  fs::remove_all(folder);
}

TEST_F(ViewerWindow, opengl_that_is_too_old_is_said_with_the_way_out) {
  const auto [status, said] =
      run_viewer("MESA_GL_VERSION_OVERRIDE=2.1 MESA_GLES_VERSION_OVERRIDE=2.0", "--port 1");
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("OpenGL 3.3"), std::string::npos) << said;
  EXPECT_NE(said.find("libgl1-mesa-dri"), std::string::npos) << said;
}

TEST_F(ViewerWindow, may_be_one_pixel) {
  open(1, 1);
  run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
}

}  // namespace
}  // namespace scree
