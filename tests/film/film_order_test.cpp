// What a film shows when little is said: events are found, moments and cameras chosen, and what cannot be is
// refused in words.
#include "tools/film/film_order.h"

#include <glm/geometric.hpp>

#include "tests/support/flat_terrain.h"
#include "tests/support/recording_fixture.h"
#include "tools/film/limits.h"

namespace scree {
namespace {

class FilmOrders : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    simulate(260);  // carves at ticks 10, 110 and 210, and fills with them
    record();
  }
  FilmPlan plan(const FilmOrder& order) const {
    auto planned = plan_film(order, path, {});
    EXPECT_TRUE(planned.has_value()) << planned.error().message;
    return planned ? std::move(*planned) : FilmPlan();
  }
  std::string refused(const FilmOrder& order) const {
    const auto planned = plan_film(order, path, {});
    EXPECT_FALSE(planned.has_value());
    return planned ? std::string() : planned.error().message;
  }
  Tick event_tick(const std::string& which) const {
    const FilmPlan planned = plan({.camera = *parse_event(which)});
    return planned.event ? planned.event->tick : 0;
  }
};

TEST_F(FilmOrders, the_spawn_is_a_place_to_see_a_film_from) {
  const FilmPlan planned = plan({.camera = AtSpawn{}});
  ASSERT_TRUE(std::holds_alternative<Camera>(planned.shot));
  EXPECT_FALSE(planned.event.has_value());
  EXPECT_GT(std::get<Camera>(planned.shot).eye_m.y, 2.0F) << "over the flat ground";
}

class QuietFilm : public RecordingTest {};

TEST_F(QuietFilm, where_nothing_happened_is_seen_from_the_spawn) {
  simulate(5);
  record();
  const auto planned = plan_film({}, path, {});
  ASSERT_TRUE(planned) << planned.error().message;
  EXPECT_FALSE(planned->event.has_value());
  EXPECT_TRUE(std::holds_alternative<Camera>(planned->shot));
}

TEST_F(FilmOrders, an_event_is_a_number_or_a_kind) {
  EXPECT_EQ(event_tick("1"), 10U);
  EXPECT_EQ(event_tick("fill"), 10U) << "the first of several alike";
  for (const char* wrong : {"", "0", "-1", "quake", "1.5"})
    EXPECT_FALSE(parse_event(wrong).has_value()) << wrong;
  EXPECT_NE(refused({.camera = WhichEvent(size_t{999})}).find("no event 999"), std::string::npos);
  EXPECT_NE(refused({.camera = WhichEvent(EventKind::rebuild)}).find("no rebuild"), std::string::npos);
}

TEST_F(FilmOrders, an_eye_sees_what_its_person_saw) {
  std::filesystem::remove(path);
  auto recorder = Recorder::create(path, {"test", small_world()});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  for (size_t i = 0; i < deltas.size(); ++i) {
    const Tick tick = deltas[i]->tick;
    const float x_m = 0.125F * static_cast<float>(tick);
    std::optional<std::vector<PlayerCursor>> cursors;
    if (tick % 6 == 0 && tick >= 60)
      cursors = {{3, "Ann", {x_m, 2.0F, 0.0F}, {x_m, 2.0F, -8.0F}},
                 {4, "Bo", {0.0F, 9.0F, 0.0F}, {0.0F, 0.0F, 0.0F}},
                 {7, "", {0.0F, 5.0F, 0.0F}, {8.0F, 5.0F, 0.0F}}};
    (*recorder)->push(deltas[i], commands_by_tick[i], {}, nullptr, cursors);
  }
  ASSERT_TRUE((*recorder)->finish().has_value());
  const FilmPlan planned = plan({.from = TickOrTime{40.0, false},
                                 .to = TickOrTime{150.0, false},
                                 .frames_per_s = 60.0,
                                 .speed = 0.5,
                                 .camera = PersonsEye{"Ann"}});
  ASSERT_EQ(planned.span.frames, 220U);
  for (const size_t frame : {60U, 61U, 62U, 131U, 200U}) {
    const Camera camera = camera_at(planned.shot, static_cast<double>(frame) / 60.0);
    EXPECT_NEAR(camera.eye_m.x, 0.125 * planned.span.tick(frame), 0.02) << frame;
    EXPECT_EQ(camera.yaw, 0.0F);
    EXPECT_EQ(camera.pitch, 0.0F);
  }
  const Camera waiting = camera_at(planned.shot, 0.0);
  EXPECT_NEAR(waiting.eye_m.x, 0.125F * 60.0F, 0.02F) << "before she came, where she will come";
  const FilmOrder bo{.from = TickOrTime{100.0, false}, .camera = PersonsEye{"Bo"}};
  EXPECT_GT(camera_at(plan(bo).shot, 0.0).forward().y, -1.0F) << "straight down has no side";
  for (const char* nameless : {"7", "client 7"})
    EXPECT_EQ(camera_at(plan({.camera = PersonsEye{nameless}}).shot, 3.0).eye_m, glm::vec3(0.0F, 5.0F, 0.0F))
        << "as the viewer calls who has no name";
  const std::string early = refused({.to = TickOrTime{30.0, false}, .camera = PersonsEye{"Ann"}});
  EXPECT_NE(early.find("is not seen in these ticks"), std::string::npos) << early;
  const std::string reason = refused({.camera = PersonsEye{"Cy"}});
  EXPECT_NE(reason.find("'Cy'"), std::string::npos) << reason;
  EXPECT_NE(reason.find("Ann, Bo, client 7"), std::string::npos) << reason;
}

TEST_F(FilmOrders, without_a_word_the_largest_event_is_shown_from_around_it) {
  const FilmPlan planned = plan({});
  ASSERT_TRUE(planned.event.has_value());
  EXPECT_EQ(planned.event->kind, EventKind::fall) << "of a ball that was filled; carves take half of one";
  const auto* orbit = std::get_if<Orbit>(&planned.shot);
  ASSERT_NE(orbit, nullptr);
  const double event_tick = static_cast<double>(planned.event->tick);
  EXPECT_LT(planned.span.from_tick, event_tick);
  EXPECT_GT(planned.span.tick(planned.span.frames - 1), event_tick);
  EXPECT_LE(planned.span.tick(planned.span.frames - 1), 260.0);
  for (const double time_s : {0.0, 3.0, 8.0}) {
    const Camera camera = orbit->at(time_s);
    const glm::vec3 towards = glm::normalize(*planned.event->place_m - camera.eye_m);
    EXPECT_GT(glm::dot(towards, camera.forward()), 0.999F);
    EXPECT_NEAR(glm::distance(camera.eye_m, *planned.event->place_m), orbit->distance_m(), 0.01F);
  }
}

TEST_F(FilmOrders, frames_are_as_far_apart_as_fps_and_speed_say) {
  const FilmSpan all = plan({.frames_per_s = 30.0, .camera = Camera()}).span;
  EXPECT_EQ(all.from_tick, 0.0);
  EXPECT_EQ(all.frames, 130U);
  const FilmSpan slow = plan({.from = TickOrTime{1.0, true},
                              .to = TickOrTime{120.0, false},
                              .frames_per_s = 30.0,
                              .speed = 0.25,
                              .camera = Camera()})
                            .span;
  EXPECT_EQ(slow.frames, 120U);
  EXPECT_EQ(slow.tick(1), 60.5);
  const auto path =
      CameraPath::parse(R"({"keys":[{"time_s":0,"camera":[0,5,9,0,0]},{"time_s":2,"camera":[1,5,9,0,0]}]})");
  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(plan({.camera = *path}).span.frames, 60U) << "as long as the path";
  EXPECT_EQ(plan({.from = TickOrTime{200.0, false}, .camera = *path}).span.frames, 30U) << "to the end";
}

TEST_F(FilmOrders, moments_that_are_not_there_are_refused) {
  EXPECT_NE(refused({.to = TickOrTime{261.0, false}, .camera = Camera()}).find("0 to 260"),
            std::string::npos);
  EXPECT_NE(refused({.from = TickOrTime{99.0, true}, .camera = Camera()}).find("--from"), std::string::npos);
  EXPECT_NE(refused({.from = TickOrTime{20.0, false}, .to = TickOrTime{10.0, false}, .camera = Camera()})
                .find("before it begins"),
            std::string::npos);
  EXPECT_NE(refused({.frames_per_s = 240.0, .speed = limits::film_speed_min, .camera = Camera()})
                .find("film_frames_max"),
            std::string::npos);
}

TEST(FilmOrbit, the_side_that_rock_hides_is_left_out) {
  MapField field(flat_terrain);
  PieceTable pieces;
  // A wall over the ground, on the side of +x of the event.
  for (float z = -20.0F; z <= 20.0F; z += 4.0F)
    apply(FillOperation{box({6.0F, 3.0F, z}, {1.0F, 3.0F, 2.5F})}, field, pieces);
  const Event event{.kind = EventKind::carve, .place_m = glm::vec3(0.0F), .volume_m3 = 30.0F};
  const Orbit orbit = Orbit::around(event, field, 8.0);
  EXPECT_GT(orbit.distance_m(), 9.0F);
  for (double time_s = 0.0; time_s <= 8.0; time_s += 1.0) EXPECT_LT(orbit.at(time_s).eye_m.x, 0.0F) << time_s;
  EXPECT_LT(orbit.at(4.0).eye_m.x, -0.8F * orbit.distance_m()) << "the middle is opposite to the wall";
}

}  // namespace
}  // namespace scree
