// The moments of a recording: what is drawn is what was recorded, whichever moments were drawn before.
#include "tools/film/recorded_scene.h"

#include <glm/geometric.hpp>

#include "server/replay/recorded_field.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class FilmScene : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    simulate(150);  // a carve at tick 10, and at 110
    record();
  }
  std::unique_ptr<RecordedScene> scene_at(double tick) const {
    auto scene = RecordedScene::open(path, tick, {});
    EXPECT_TRUE(scene.has_value()) << scene.error().message;
    return scene ? std::move(*scene) : nullptr;
  }
  const TickDelta& recorded(Tick tick) const { return *deltas.at(tick - 1); }
};

TEST_F(FilmScene, terrain_is_that_of_the_last_whole_tick) {
  const auto scene = scene_at(0.0);
  ASSERT_TRUE(scene->go_to(0.0).has_value());
  EXPECT_EQ(scene->field().hash(), 0U);
  for (const double tick : {9.9, 10.0, 10.9, 11.0, 80.5, 150.0}) {
    ASSERT_TRUE(scene->go_to(tick).has_value());
    EXPECT_EQ(scene->field().hash(), recorded(static_cast<Tick>(tick)).field_hash) << tick;
    EXPECT_EQ(scene->pieces().size(), recorded(static_cast<Tick>(tick)).pieces.size()) << tick;
  }
}

TEST_F(FilmScene, changes_are_all_those_since_the_last_moment) {
  const auto scene = scene_at(5.0);
  EXPECT_TRUE(scene->go_to(9.0)->bricks.empty());
  const auto changes = scene->go_to(11.0);
  ASSERT_TRUE(changes.has_value());
  EXPECT_EQ(changes->pieces_added.size(), scene->pieces().size());
  EXPECT_GE(changes->bricks.size(), recorded(10).bricks.size());
  EXPECT_TRUE(scene->go_to(11.5)->bricks.empty());
}

TEST_F(FilmScene, changes_have_the_stones_of_pieces_that_merged) {
  const auto scene = scene_at(0.0);
  const auto changes = scene->go_to(150.0);
  ASSERT_TRUE(changes.has_value());
  size_t merged = 0;
  for (Tick tick = 1; tick <= 150; ++tick) merged += recorded(tick).stones.size();
  ASSERT_GT(merged, 0U);
  EXPECT_EQ(changes->stones.size(), merged);
}

TEST_F(FilmScene, pieces_are_between_their_places_of_two_ticks) {
  const auto scene = scene_at(12.0);
  ASSERT_TRUE(scene->go_to(12.25).has_value());
  ASSERT_FALSE(scene->pieces().empty());
  for (const PieceState& before : recorded(12).pieces) {
    const auto after = std::ranges::find(recorded(13).pieces, before.id, &PieceState::id);
    ASSERT_NE(after, recorded(13).pieces.end());
    const glm::vec3 from_m = dequantise(before.pose).position_m, to_m = dequantise(after->pose).position_m;
    const glm::vec3 at_m = scene->pieces().at(before.id).pose.position_m;
    EXPECT_LT(glm::distance(at_m, from_m + 0.25F * (to_m - from_m)), 1e-5F);
  }
}

/// A crate that falls from tick 3 on, and is taken away in tick 9.
class FilmProps : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    World world(small_world());
    std::optional<uint32_t> crate;
    for (Tick tick = 1; tick <= 12; ++tick) {
      std::vector<Command> commands;
      if (tick == 3) commands = {{1, 1, falling_crate()}};
      if (tick == 9) commands = {{1, 2, RemovePropRequest{*crate}}};
      deltas.push_back(world.step(commands));
      commands_by_tick.push_back(commands);
      for (const SpawnedProp& prop : deltas.back()->props_spawned) crate = prop.id;
    }
    record();
  }
  static AddPropRequest falling_crate() {
    AddPropRequest add;
    add.prop.parts.push_back({.half_m = glm::vec3(0.5F)});
    add.prop.mass_kg = 100.0F;
    add.place_m = {0.0F, 9.0F, 0.0F};
    return add;
  }
};

TEST_F(FilmProps, come_are_between_their_places_of_two_ticks_and_go) {
  auto opened = RecordedScene::open(path, 0.0, {});
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  RecordedScene& scene = **opened;
  ASSERT_TRUE(scene.go_to(2.5).has_value());
  EXPECT_TRUE(scene.scene().props.empty());
  const auto came = scene.go_to(3.0);
  ASSERT_TRUE(came.has_value());
  EXPECT_EQ(came->props_added.size(), 1U);
  ASSERT_EQ(scene.scene().props.size(), 1U);
  EXPECT_EQ(*scene.scene().props.begin()->second.prop, falling_crate().prop);
  ASSERT_TRUE(scene.go_to(6.25).has_value());
  const float from_m = dequantise(deltas[5]->props.front().pose).position_m.y;
  const float to_m = dequantise(deltas[6]->props.front().pose).position_m.y;
  ASSERT_LT(to_m, from_m);
  EXPECT_NEAR(scene.scene().props.begin()->second.pose.position_m.y, from_m + 0.25F * (to_m - from_m), 1e-4F);
  const auto went = scene.go_to(10.0);
  ASSERT_TRUE(went.has_value());
  EXPECT_EQ(went->props_removed.size(), 1U);
  EXPECT_TRUE(scene.scene().props.empty());
}

/// Somebody who stands from tick 3 on, walks, and leaves in tick 60.
class FilmPersons : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    WorldConfig config = small_world();
    config.service.persons = Persons::walk;
    World world(config);
    for (Tick tick = 1; tick <= 70; ++tick) {
      std::vector<Command> commands;
      const auto number = static_cast<uint32_t>(tick);
      if (tick == 3) commands = {{7, number, StandRequest{glm::vec3(0.0F)}}};
      if (tick > 3 && tick < 60) commands = {{7, number, WalkRequest{{.go = {1.0F, 0.0F, 0.0F}}}}};
      if (tick == 60) commands = {{7, number, StandRequest{{}, true}}};
      deltas.push_back(world.step(commands));
      commands_by_tick.push_back(commands);
    }
    record(config);
  }
};

TEST_F(FilmPersons, on_foot_are_figures_between_their_places_of_two_ticks) {
  auto opened = RecordedScene::open(path, 0.0, {});
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  RecordedScene& scene = **opened;
  ASSERT_TRUE(scene.go_to(2.0).has_value());
  EXPECT_TRUE(scene.figures().all().empty());
  ASSERT_TRUE(scene.go_to(40.25).has_value());
  EXPECT_TRUE(scene.scene().props.empty()) << "a body is no post";
  ASSERT_EQ(scene.figures().all().size(), 1U);
  const Figures::Figure& figure = scene.figures().all().at(7);
  EXPECT_TRUE(figure.on_foot);
  EXPECT_GT(figure.speed_m_s, 1.0F);
  const float from_m = deltas[39]->persons.front().walker.feet_m.x;
  const float to_m = deltas[40]->persons.front().walker.feet_m.x;
  ASSERT_GT(to_m, from_m + 0.01F);
  EXPECT_NEAR(figure.eye_m.x, from_m + 0.25F * (to_m - from_m), 0.002F);
  EXPECT_GT(scene.figures().limbs({0.0F, 9.0F, 0.0F}, {}, true).size(), 6U);
  ASSERT_TRUE(scene.go_to(65.0).has_value());
  EXPECT_TRUE(scene.figures().all().empty());
}

TEST_F(FilmPersons, walk_alike_whichever_moments_were_shown_before) {
  const auto at = [&](std::initializer_list<double> ticks) {
    auto scene = RecordedScene::open(path, 0.0, {});
    for (const double tick : ticks) EXPECT_TRUE((*scene)->go_to(tick).has_value());
    return (*scene)->figures().all().at(7);
  };
  const Figures::Figure once = at({50.5}), often = at({10.5, 30.0, 49.9, 50.5});
  EXPECT_EQ(once.eye_m, often.eye_m);
  EXPECT_EQ(once.walked_m, often.walked_m);
  EXPECT_EQ(once.speed_m_s, often.speed_m_s);
}

TEST_F(FilmScene, a_moment_is_the_same_whichever_were_shown_before) {
  const glm::vec3 eye_m(0.0F, 5.0F, 10.0F);
  const auto slowly = scene_at(0.0);
  for (double tick = 0.0; tick < 147.5; tick += 0.5) ASSERT_TRUE(slowly->go_to(tick).has_value());
  const auto at_once = scene_at(147.5);
  ASSERT_TRUE(slowly->go_to(147.5).has_value());
  ASSERT_TRUE(at_once->go_to(147.5).has_value());
  EXPECT_EQ(slowly->field().hash(), at_once->field().hash());
  ASSERT_EQ(slowly->pieces().size(), at_once->pieces().size());
  for (const auto& [id, piece] : slowly->pieces())
    EXPECT_EQ(piece.pose.position_m, at_once->pieces().at(id).pose.position_m);
  const auto a = slowly->particles(eye_m), b = at_once->particles(eye_m);
  EXPECT_FALSE(a.empty());
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].place_m, b[i].place_m);
}

TEST_F(FilmScene, the_terrain_of_a_tick_is_a_field_of_its_own) {
  for (const Tick tick : {1U, 10U, 111U, 150U}) {
    const auto field = field_at(path, tick, {});
    ASSERT_TRUE(field.has_value()) << field.error().message;
    EXPECT_EQ((*field)->hash(), recorded(tick).field_hash);
  }
  EXPECT_EQ((*field_at(path, 0, {}))->hash(), 0U);
  const auto beyond = field_at(path, 151, {});
  ASSERT_FALSE(beyond.has_value());
  EXPECT_NE(beyond.error().message.find("0 to 150"), std::string::npos) << beyond.error().message;
}

}  // namespace
}  // namespace scree
