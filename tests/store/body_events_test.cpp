// Contacts, props and joints in the log of events: bounded, recorded, verified, and as lines.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/formats/event_codec.h"
#include "server/replay/verify.h"
#include "server/store/event_deriver.h"
#include "server/store/event_lines.h"
#include "shared/prop/joint.h"
#include "tests/support/prop_world.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

TickDelta striking(Tick tick, std::vector<float> energies_j) {
  TickDelta delta;
  delta.tick = tick;
  for (const float energy_j : energies_j)
    delta.contacts.push_back({7, 0, {1.0F, 2.0F, 3.0F}, {0.0F, 1.0F, 0.0F}, 10.0F, energy_j});
  return delta;
}

TEST(BodyEvents, of_contacts_the_hardest_are_told_and_the_others_counted) {
  EventDeriver deriver(0.25F, {});
  std::vector<Event> events;
  for (Tick tick = 1; tick <= 70; ++tick) {
    TickDelta delta = striking(tick, {});
    if (tick == 2) delta = striking(tick, {900.0F, 800.0F, 99.0F});
    if (tick == 3) delta = striking(tick, std::vector<float>(20, 500.0F));
    if (tick == 30) delta = striking(tick, {5000.0F, 200.0F});
    for (const Event& event : deriver.events_of(delta)) events.push_back(event);
  }
  ASSERT_EQ(events.size(), contacts_told_max + 1);
  EXPECT_EQ(events[0].energy_j, 900.0F);
  EXPECT_EQ(events[0].kind, EventKind::contact);
  EXPECT_EQ(events[0].body, 7U);
  EXPECT_EQ(events[0].place_m, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(events[1].energy_j, 800.0F);
  EXPECT_EQ(events.back().tick, 2 + merge_burst_ticks);
  EXPECT_EQ(events.back().energy_j, 5000.0F) << "the hardest of a second is always told";
  EXPECT_EQ(events.back().left_out, 2 + 20 + 2 - events.size());
}

TEST(BodyEvents, what_became_of_props_is_bounded_too_and_old_recordings_tell_none_of_it) {
  TickDelta delta = striking(1, {500.0F});
  delta.told.resize(told_events_max + 5, {.kind = EventKind::prop_added, .tick = 1});
  EventDeriver deriver(0.25F, {}), old(0.25F, {}, merge_burst_ticks, 0.0F);
  const std::vector<Event> events = deriver.events_of(delta);
  ASSERT_EQ(events.size(), told_events_max + 1);
  EXPECT_EQ(events[told_events_max - 1].left_out, 5U);
  EXPECT_TRUE(old.events_of(delta).empty());
}

TEST(BodyEvents, every_number_survives_a_row_and_a_line_says_it) {
  const Event event{.kind = EventKind::contact,
                    .tick = 60,
                    .place_m = glm::vec3(1.0F, 2.0F, 3.0F),
                    .body = 3,
                    .other = 9,
                    .tag = 1ULL << 60U,
                    .normal = {0.0F, 1.0F, 0.0F},
                    .impulse_n_s = 12.5F,
                    .energy_j = 250.0F,
                    .left_out = 4};
  const auto read = decode_recorded_events(encode(std::span(&event, 1)), 60);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->size(), 1U);
  EXPECT_EQ(read->front(), event);
  const auto line = nlohmann::json::parse(json_line(event, {60}));
  EXPECT_EQ(line["event"], "contact");
  EXPECT_EQ(line["body"], 3);
  EXPECT_EQ(line["other"], 9);
  EXPECT_EQ(line["tag"], 1ULL << 60U);
  EXPECT_EQ(line["normal"], (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(line["impulse_n_s"], 12.5);
  EXPECT_EQ(line["energy_j"], 250.0);
  EXPECT_EQ(line["left_out"], 4);
  const std::string csv = csv_line(event, {60});
  EXPECT_TRUE(csv.ends_with(",3,9,1152921504606846976,0.000,1.000,0.000,12.500,250.000,4")) << csv;
  EXPECT_EQ(std::ranges::count(csv, ','), std::ranges::count(event_csv_heads, ','));
}

class BodyEventsTest : public RecordingTest {
 protected:
  void step(World& world, std::vector<Command> commands = {}) {
    deltas.push_back(world.step(commands));
    commands_by_tick.push_back(std::move(commands));
  }
  /// Two crates that a ball joint holds fall; the joint is removed, then a crate.
  void play() {
    World world(small_world());
    Prop box = crate();
    box.tag = 77;
    step(world,
         {{5, 1, AddPropRequest{box, {0.0F, 5.0F, 0.0F}}}, {5, 2, AddPropRequest{box, {2.0F, 5.0F, 0.0F}}}});
    const PieceId a = deltas[0]->replies.at(0).prop.value_or(0),
                  b = deltas[0]->replies.at(1).prop.value_or(0);
    step(world, {{5, 3,
                  AddJointRequest{joint_at(JointKind::ball, {a, {0.0F, 5.0F, 0.0F}}, {b, {2.0F, 5.0F, 0.0F}},
                                           {1.0F, 5.0F, 0.0F})}}});
    const JointId joint = deltas[1]->replies.at(0).joint.value_or(0);
    for (int i = 0; i < 120; ++i) step(world);
    step(world, {{6, 1, RemoveJointRequest{joint}}});
    step(world, {{6, 2, RemovePropRequest{a}}});
    step(world);
  }
  std::vector<Event> recorded() const {
    const auto reader = RecordingReader::open(path);
    if (!reader) return {};
    const auto events = (*reader)->events(1, (*reader)->last_tick());
    return events ? *events : std::vector<Event>();
  }
};

TEST_F(BodyEventsTest, a_recording_has_props_contacts_and_joints_and_verifies) {
  play();
  record();
  const std::vector<Event> events = recorded();
  const auto of = [&](EventKind kind) {
    std::vector<Event> some;
    std::ranges::copy_if(events, std::back_inserter(some), [&](const Event& e) { return e.kind == kind; });
    return some;
  };
  const auto added = of(EventKind::prop_added), removed = of(EventKind::prop_removed),
             ended = of(EventKind::joint_ended), contacts = of(EventKind::contact);
  ASSERT_EQ(added.size(), 2U);
  EXPECT_EQ(added[0].session, 5U);
  EXPECT_EQ(added[0].tag, 77U);
  ASSERT_EQ(removed.size(), 1U);
  EXPECT_EQ(removed[0].session, 6U);
  EXPECT_EQ(removed[0].body, added[0].body);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].text, "removed");
  EXPECT_EQ(ended[0].session, 6U);
  EXPECT_EQ(ended[0].body, added[0].body);
  EXPECT_EQ(ended[0].other, added[1].body);
  ASSERT_GE(contacts.size(), 2U);
  EXPECT_GE(contacts[0].energy_j, contact_event_least_j);
  EXPECT_NEAR(contacts[0].normal.y, 1.0F, 0.1F);
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  EXPECT_EQ((*reader)->header().contacts_j, contact_event_least_j);
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
  EXPECT_EQ(report->events, events.size());
}

TEST_F(BodyEventsTest, a_recording_of_an_earlier_build_has_none_and_verifies) {
  play();
  RecordingHeader header{"test", small_world()};
  header.contacts_j = 0.0F;
  auto recorder = Recorder::create(path, header);
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  for (size_t i = 0; i < deltas.size(); ++i) (*recorder)->push(deltas[i], commands_by_tick[i]);
  ASSERT_TRUE((*recorder)->finish().has_value());
  EXPECT_TRUE(recorded().empty());
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
}

TEST_F(BodyEventsTest, the_next_event_is_none_of_contacts_alone) {
  play();
  record();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  const Tick last = (*reader)->last_tick();
  const auto next = (*reader)->next_event(1);
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(*next, last - 2) << "where the joint was removed, long after the crates have struck the ground";
  const auto before = (*reader)->previous_event(last - 2);
  ASSERT_TRUE(before.has_value());
  EXPECT_EQ(*before, 1U);
}

}  // namespace
}  // namespace scree
