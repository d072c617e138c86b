// The HUD without a window: where its panels stand, and that what they say fits; the pace of a world;
// recorded paths.
#include "client/viewer/window/hud.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

#include "client/viewer/base/camera_text.h"
#include "client/viewer/pictures/camera_path.h"
#include "client/viewer/pictures/path_recorder.h"
#include "client/viewer/session/pace.h"
#include "client/viewer/window/hud_screen.h"
#include "client/viewer/window/layout.h"

namespace scree {
namespace {

constexpr std::array<glm::vec2, 7> screens{{{1.0F, 1.0F},
                                            {320.0F, 200.0F},
                                            {640.0F, 360.0F},
                                            {960.0F, 540.0F},
                                            {1280.0F, 720.0F},
                                            {1920.0F, 1080.0F},
                                            {400.0F, 2000.0F}}};

void expect_apart_and_within(const PanelRectangles& placed, glm::vec2 screen) {
  for (size_t i = 0; i < placed.size(); ++i) {
    EXPECT_GE(placed[i].at.x, 0.0F);
    EXPECT_GE(placed[i].at.y, 0.0F);
    EXPECT_LE(placed[i].at.x + placed[i].size.x, screen.x + 0.01F) << i;
    EXPECT_LE(placed[i].at.y + placed[i].size.y, screen.y + 0.01F) << i;
    for (size_t j = 0; j < i; ++j) EXPECT_FALSE(intersect(placed[i], placed[j])) << i << " and " << j;
  }
}

TEST(Layout, panels_stay_apart_whatever_they_want) {
  for (const glm::vec2 screen : screens)
    for (uint32_t round = 0; round < 500; ++round) {
      PanelSizes wanted{};
      uint32_t random = round * 2654435761U + 1;
      for (glm::vec2& size : wanted) {
        random = random * 1664525U + 1013904223U;
        if ((random >> 28U) < 3) continue;
        size = {static_cast<float>((random >> 8U) % 900U), static_cast<float>((random >> 18U) % 1400U)};
      }
      expect_apart_and_within(lay_out(screen, wanted), screen);
    }
}

TEST(Layout, what_has_room_gets_what_it_wants) {
  PanelSizes wanted;
  wanted.fill({300.0F, 200.0F});
  const PanelRectangles placed = lay_out({1000.0F, 1200.0F}, wanted);
  for (const Rectangle& one : placed) EXPECT_EQ(one.size, glm::vec2(300.0F, 200.0F));
  wanted[static_cast<size_t>(PanelPlace::upper_left)].y = 2000.0F;
  const PanelRectangles crowded = lay_out({1000.0F, 1200.0F}, wanted);
  EXPECT_EQ(crowded[static_cast<size_t>(PanelPlace::lower_left)].size.y, 200.0F)
      << "a small one does not shrink for a large one";
}

/// Facts of a session in which everything happens at once.
HudFacts crowded_facts() {
  HudFacts facts;
  facts.connection = "a-server-with-a-long-name.example.org:40000, as administrator";
  facts.camera = "at -1234.5, 1234.5, -1234.5 m, yaw -179, pitch -89 degrees";
  facts.tick = 123456789;
  facts.pace = 0.43;
  facts.lost_ticks = 123456;
  facts.pieces_near = 1234;
  facts.mismatches = 7;
  facts.notice =
      "the carve is beyond the reach of 8 m of one edit (--edit-reach), which keeps a tick within its "
      "time; ask for smaller ones";
  facts.mark = StrikeMark::refused;
  facts.refused = "too far away";
  facts.carried = {{"rock", {0.3F, 0.3F, 0.3F}, 812.5}, {"soil", {0.2F, 0.1F, 0.1F}, 187.5}};
  facts.store_room_m3 = 1000.0F;
  facts.retry_s = 12.3;
  facts.predictions = 3;
  facts.preparing = {"raymarch", 100, 1234};
  facts.driver = "OpenGL 4.5 (Core Profile) Mesa 22.3.6 (llvmpipe (LLVM 15.0.6, 256 bits))";
  facts.method = "raymarch";
  facts.memory = {{"terrain", 1U << 28U, 1U << 29U}, {"pieces", 1U << 27U, 1U << 25U}};
  facts.gpu_times = {{"shadows", 12.5}, {"terrain", 123.5}};
  facts.latency = RequestLatency{1234.5, {1, 2, 3}};
  StatusMessage status;
  status.pieces = 1234;
  status.pieces_made = 123456;
  status.pieces_merged = 100000;
  status.ledger_terrain = -12345678901;
  status.ledger_pieces = 12345678901;
  status.work.budget_us = 11700;
  status.work.requests_waiting = 99;
  status.work.islands_put_off = 99;
  status.work.breaks_left_out = 99;
  for (int i = 0; i < 12; ++i) status.stages.push_back({"a stage", 1.5F});
  facts.status = status;
  return facts;
}

/// The timeline of a replay that somebody else controls, with events of all kinds.
Timeline crowded_timeline() {
  Timeline timeline;
  timeline.begin(60.0);
  PlaybackMessage playback{100000, 0, 2160000, -16.0F, true, 0, true};
  playback.refusal = "that takes the role admin: this session is a viewer (ask for a token, --token)";
  timeline.apply(playback, 0.0);
  MarksMessage marks{0, 4096, 0, 2160000};
  for (const EventKind kind : all_kinds<EventKind>)
    for (uint32_t column = 0; column < 500; column += 7) marks.marks.push_back({kind, column, 1 + column});
  timeline.apply(marks);
  return timeline;
}

/// The panels of a HUD with everything shown, after some frames.
class WholeHud {
 public:
  explicit WholeHud(glm::vec2 size) : screen_(size) {}

  void frame(const HudFacts& facts, float text_scale, bool all) {
    screen_.begin(true, hud_.text_px(text_scale));
    hud_.begin(true);
    hud_.note(facts, {16.0F, 2.0F, 3.0F});
    hud_.crosshair(facts);
    if (all) hud_.figures(facts, all);
    const PersonsMessage persons{
        {{1, "A person with a long name, so it", Role::builder}, {2, "", Role::viewer}}, 3, true};
    hud_.lower_right(facts, all ? &persons : nullptr, {}, all);
    if (all)
      hud_.panel(*method_named("grid"),
                 {tool_, *plain_palette(), overlay_, method_options_, particles_, details_, shake_, predict_,
                  hand_, quality_},
                 {false, true});
    hud_.help(all ? Telling::all : Telling::basics, all, all ? ControlsOf::both : ControlsOf::live);
    if (all) {
      hud_.lost(facts);
      hud_.timeline(timeline_, 10.0);
    } else {
      hud_.tool_line(tool_, ToolAim{sphere({}, 1.0F), false, {}, {}, 12.3}, facts, *plain_palette());
    }
    hud_.messages(facts,
                  {"click, and the mouse looks around, or use the arrow keys; E digs where the cross is"});
    screen_.end();
  }
  const HudPanels& panels() const { return hud_.panels(); }

 private:
  HudScreen screen_;
  Hud hud_;
  Timeline timeline_ = crowded_timeline();
  Tool tool_;
  OverlayChoice overlay_;
  DrawOptionValues method_options_;
  bool particles_ = true;
  bool details_ = true;
  bool shake_ = true;
  bool predict_ = true;
  HandChoice hand_;
  std::optional<Quality> quality_;
};

TEST(Hud, no_two_panels_overlap_at_any_size_with_everything_shown) {
  const HudFacts facts = crowded_facts();
  for (const glm::vec2 size : screens)
    for (const float text_scale : {1.0F, text_scale_max}) {
      WholeHud hud(size);
      for (int i = 0; i < 12; ++i) {
        hud.frame(facts, text_scale, true);
        expect_apart_and_within(hud.panels().rectangles(), size);
      }
      if (size.x < 300.0F) continue;
      for (const Rectangle& one : hud.panels().rectangles()) EXPECT_GT(one.size.x * one.size.y, 0.0F);
    }
}

TEST(Hud, what_a_newcomer_sees_fits_a_small_window) {
  for (const glm::vec2 size : {glm::vec2(960.0F, 540.0F), glm::vec2(1280.0F, 720.0F)}) {
    WholeHud hud(size);
    for (int i = 0; i < 12; ++i) hud.frame({}, 1.0F, false);
    for (const PanelPlace place : {PanelPlace::lower_left, PanelPlace::lowest, PanelPlace::bottom}) {
      EXPECT_FALSE(hud.panels().scrolls(place)) << static_cast<int>(place) << " at " << size.x;
      EXPECT_FALSE(hud.panels().clips(place)) << static_cast<int>(place) << " at " << size.x;
    }
  }
}

TEST(Hud, text_is_as_large_as_asked_for_where_panels_leave_it_room_and_never_goes_to_and_fro) {
  for (const glm::vec2 size :
       {glm::vec2(640.0F, 360.0F), glm::vec2(960.0F, 540.0F), glm::vec2(1920.0F, 1080.0F)})
    for (float text_scale = 1.0F; text_scale <= text_scale_max; text_scale *= 1.25F) {
      SCOPED_TRACE(testing::Message() << size.x << ", text x " << text_scale);
      WholeHud hud(size);
      for (int i = 0; i < 12; ++i) hud.frame({}, text_scale, false);
      const PanelRectangles rested = hud.panels().rectangles();
      for (const PanelPlace place : {PanelPlace::lower_left, PanelPlace::bottom})
        EXPECT_TRUE(!hud.panels().clips(place) || HudScreen::shown_px() == HudPanels::text_px_min)
            << static_cast<int>(place);
      for (int i = 0; i < 6; ++i) {
        hud.frame({}, text_scale, false);
        EXPECT_EQ(hud.panels().rectangles(), rested);
        EXPECT_EQ(HudScreen::made_px(), HudScreen::shown_px()) << "or dots of letters get lost";
      }
      if (size.x > 1900.0F && text_scale < 1.5F) {
        EXPECT_EQ(HudScreen::shown_px(), std::round(13.0F * text_scale));
      }
    }
}

TEST(Hud, of_more_lines_than_there_is_room_for_the_last_ones_are_shown) {
  std::vector<std::string> lines(8, std::string(200, 'a'));
  lines.emplace_back("say: what is being written_");
  for (const float text_scale : {1.0F, 2.5F}) {
    HudScreen screen({640.0F, 360.0F});
    Hud hud;
    for (int i = 0; i < 6; ++i) {
      screen.begin(true, hud.text_px(text_scale));
      hud.begin(true);
      hud.messages({}, lines);
      screen.end();
    }
    EXPECT_FALSE(hud.panels().scrolls(PanelPlace::bottom)) << text_scale;
    EXPECT_GT(hud.panels().rectangles()[index_of(PanelPlace::bottom)].size.y, 13.0F);
  }
}

/// The strip of messages after some frames.
glm::vec2 messages_size(const HudFacts& facts, const std::vector<std::string>& lines = {}) {
  HudScreen screen({1280.0F, 720.0F});
  Hud hud;
  for (int i = 0; i < 6; ++i) {
    screen.begin(true, hud.text_px(1.0F));
    hud.begin(true);
    hud.messages(facts, lines);
    screen.end();
  }
  return hud.panels().rectangles()[index_of(PanelPlace::bottom)].size;
}

TEST(Hud, a_long_refusal_is_broken_and_leaves_the_width_to_the_picture) {
  const glm::vec2 size = messages_size(crowded_facts());
  EXPECT_LT(size.x, 0.45F * 1280.0F);
  EXPECT_LT(size.y, 0.15F * 720.0F);
}

TEST(Hud, who_is_in_the_world_sees_past_the_making_of_more_of_it) {
  HudFacts facts;
  facts.preparing = {"mesh", 100, 20, false};
  const glm::vec2 at_first = messages_size(facts);
  facts.preparing->goes_on = true;
  const glm::vec2 later = messages_size(facts);
  EXPECT_GT(at_first.x, 300.0F) << "it has words";
  EXPECT_GT(later.x, 0.0F);
  EXPECT_LT(later.x * later.y, 0.25F * at_first.x * at_first.y);
}

TEST(Hud, a_panel_that_went_leaves_no_room_behind) {
  WholeHud hud({1280.0F, 720.0F});
  for (int i = 0; i < 6; ++i) hud.frame(crowded_facts(), 1.0F, true);
  for (int i = 0; i < 6; ++i) hud.frame({}, 1.0F, false);
  EXPECT_EQ(hud.panels().rectangles()[static_cast<size_t>(PanelPlace::lower_right)], Rectangle{});
  EXPECT_EQ(hud.panels().rectangles()[static_cast<size_t>(PanelPlace::top)], Rectangle{});
}

TEST(Controls, the_basics_are_few_and_buttons_are_told_to_those_who_have_them) {
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  const std::string basics = describe_controls(Telling::basics, false, ControlsOf::live);
  const std::string all = describe_controls(Telling::all, true, ControlsOf::both);
  EXPECT_LE(lines(basics), 11);
  EXPECT_GT(lines(all), lines(basics));
  EXPECT_EQ(basics.find("pad "), std::string::npos);
  const auto tells = [](ControlsOf of, const char* what) {
    return describe_controls(Telling::all, false, of).find(what) != std::string::npos;
  };
  EXPECT_TRUE(tells(ControlsOf::live, "use the tool") && !tells(ControlsOf::live, "replay"));
  for (const char* what : {"use the tool", "dig", "place what", "blast"})
    EXPECT_FALSE(tells(ControlsOf::replay, what)) << what;
  EXPECT_TRUE(tells(ControlsOf::replay, "replay"));
  EXPECT_LE(lines(describe_controls(Telling::basics, false, ControlsOf::replay)), 14);
  EXPECT_NE(all.find("pad RB"), std::string::npos);
  EXPECT_EQ(describe_controls(Telling::nothing, true, ControlsOf::both), "");
  EXPECT_EQ(after(after(after(Telling::basics))), Telling::basics);
}

TEST(HandChoice, stays_within_its_bounds) {
  HandChoice choice;
  for (int i = 0; i < 100; ++i)
    for (const Action action : {Action::wider_view, Action::faster_mouse, Action::larger_text})
      change(choice, action);
  EXPECT_EQ(choice, (HandChoice{field_of_view_max_degrees, mouse_speed_max, text_scale_max}));
  for (int i = 0; i < 100; ++i)
    for (const Action action : {Action::narrower_view, Action::slower_mouse, Action::smaller_text})
      change(choice, action);
  EXPECT_EQ(choice, (HandChoice{field_of_view_min_degrees, mouse_speed_min, text_scale_min}));
}

TEST(Pace, is_one_for_a_world_in_real_time_whatever_the_network_does) {
  Pace pace;
  pace.start(60.0);
  for (Tick tick = 1; tick < 600; ++tick)
    pace.note(tick, static_cast<double>(tick) / 60.0 + (tick % 7 == 0 ? 0.2 : 0.01));
  EXPECT_NEAR(pace.factor(), 1.0, 0.1);
  EXPECT_EQ(pace.lost_ticks(), 0U);
}

TEST(Pace, tells_how_much_slower_a_world_is_and_what_it_lost) {
  Pace pace;
  pace.start(60.0);
  double now_s = 0.0;
  Tick tick = 0;
  for (; tick < 300; ++tick) pace.note(tick, now_s += 1.0 / 60.0);
  for (; tick < 600; ++tick) pace.note(tick, now_s += 1.0 / 30.0);
  EXPECT_NEAR(pace.factor(), 0.5, 0.02);
  for (; tick < 1000; ++tick) pace.note(tick, now_s += 1.0 / 60.0);
  EXPECT_NEAR(pace.factor(), 1.0, 0.02);
  EXPECT_NEAR(static_cast<double>(pace.lost_ticks()), 300.0, 2.0);
}

TEST(PathRecorder, what_it_recorded_is_flown_again) {
  PathRecorder recorder;
  Camera camera;
  for (int frame = 0; frame <= 120; ++frame) {
    camera.eye_m = {static_cast<float>(frame) * 0.1F, 2.0F, 0.0F};
    camera.yaw = static_cast<float>(frame) * 0.05F;
    EXPECT_TRUE(recorder.add(1000.0 + frame / 60.0, camera));
  }
  EXPECT_NEAR(recorder.duration_s(), 2.0, PathRecorder::step_s);
  const Result<CameraPath> path = CameraPath::parse(recorder.text());
  ASSERT_TRUE(path) << path.error().message;
  const Camera flown = path->at(1.0);
  EXPECT_NEAR(flown.eye_m.x, 6.0F, 0.05F);
  EXPECT_NEAR(std::remainder(flown.yaw - 3.0F, 2.0F * std::numbers::pi_v<float>), 0.0F, 0.02F);
}

TEST(CameraText, is_what_the_option_takes_however_often_one_turned) {
  Camera camera;
  camera.eye_m = {1.0F, -2.5F, 3.25F};
  camera.yaw = glm::radians(725.0F);
  camera.pitch = glm::radians(-18.0F);
  EXPECT_EQ(camera_text(camera), "1.00,-2.50,3.25,5.0,-18.0");
}

TEST(CameraText, is_five_numbers_with_commas_and_nothing_else) {
  const Result<Camera> camera = parse_camera("1, -2.5,3.25e0,90,-10");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera_text(*camera), "1.00,-2.50,3.25,90.0,-10.0");
  for (const char* text : {"", "1,2,3,4", "1,2,3,4,", "1;2;3;4;5", "1,2,,4,5", "1,2,3,4,x", "1,2,3,4,5,6",
                           "1,2,3,4,5 m", "1,2,nan,4,5", "1e9,2,3,4,5"})
    EXPECT_FALSE(parse_camera(text)) << text;
}

}  // namespace
}  // namespace scree
