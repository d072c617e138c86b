// A world that is told over a real server of NATS: those who follow have its hash at every tick, also
// when a server is killed meanwhile.
#include <gtest/gtest.h>

#include "server/formats/bus_codec.h"
#include "server/told/told_names.h"
#include "tests/bus/told_fixture.h"

namespace scree {
namespace {

TEST(ToldWorld, three_edges_have_every_ticks_hash_in_a_storm_of_carves) {
  NatsProcess nats;
  ToldByHand told(connected_bus(nats));
  told.storm(1);
  ASSERT_TRUE(told.comes_to_keyframes(1));
  std::vector<std::unique_ptr<ToldFollower>> edges;
  for (int i = 0; i < 3; ++i) {
    edges.push_back(std::make_unique<ToldFollower>(connected_bus(nats)));
    ASSERT_NE(edges.back()->source, nullptr) << edges.back()->why;
    told.storm(20);
  }
  told.storm(60);
  told.steps(60);
  for (const auto& edge : edges) {
    ASSERT_TRUE(edge->follow_to(told.world.tick()));
    expect_same(*edge, told);
    EXPECT_EQ(edge->source->status().resyncs, 0U);
    EXPECT_EQ(edge->source->keyframe()->pieces.size(), told.world.keyframe().pieces.size());
  }
  EXPECT_GT(edges[0]->hashes.size(), told.world.tick() - 10);
}

TEST(ToldWorld, a_late_edge_begins_with_a_keyframe_and_the_ticks_behind_it) {
  NatsProcess nats;
  ToldByHand told(connected_bus(nats));
  told.storm(2);
  ASSERT_TRUE(told.comes_to_keyframes(1));
  told.storm(100);
  ASSERT_TRUE(comes([&] { return told.teller->status().waiting == 0; }));
  ToldFollower late(connected_bus(nats));
  ASSERT_NE(late.source, nullptr) << late.why;
  ASSERT_TRUE(late.follow_to(told.world.tick()));
  EXPECT_GT(late.hashes.size(), 50U);
  expect_same(late, told);
}

TEST(ToldWorld, when_nats_is_killed_the_world_goes_on_and_edges_catch_up) {
  NatsProcess nats;
  const auto simulators = connected_bus(nats), edges = connected_bus(nats);
  ToldByHand told(simulators);
  told.storm(3);
  ASSERT_TRUE(told.comes_to_keyframes(1));
  ToldFollower edge(edges);
  ASSERT_NE(edge.source, nullptr) << edge.why;
  told.storm(10);
  ASSERT_TRUE(edge.follow_to(told.world.tick()));
  nats.kill();
  ASSERT_TRUE(comes([&] { return !simulators->is_connected() && !edges->is_connected(); }));
  told.storm(30);
  EXPECT_TRUE(comes([&] { return !told.teller->status().health.ok(); }));
  const Tick before = edge.number;
  ASSERT_NE(edge.source->next(), nullptr);  // it goes on with the state that it has
  ++edge.number;
  EXPECT_GT(edge.number, before);
  nats.start();
  ASSERT_TRUE(comes([&] { return simulators->is_connected() && edges->is_connected(); }));
  told.storm(10);
  ASSERT_TRUE(told.comes_to_keyframes(2));
  ASSERT_TRUE(edge.follow_to(told.world.tick()));
  expect_same(edge, told);
  EXPECT_GE(edge.source->status().resyncs, 1U);
  EXPECT_TRUE(told.teller->status().health.ok());
  EXPECT_GE(told.teller->status().health.lost, 25U);
}

TEST(ToldWorld, when_nats_hangs_the_world_goes_on_and_is_told_again) {
  NatsProcess nats;
  ToldByHand told(connected_bus(nats));
  told.storm(3);
  ASSERT_TRUE(told.comes_to_keyframes(1));
  ToldFollower edge(connected_bus(nats));
  ASSERT_NE(edge.source, nullptr) << edge.why;
  nats.hang();
  for (int i = 0; i < 600 && told.teller->status().health.ok(); ++i) {
    told.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(17));  // as long as a tick
  }
  EXPECT_FALSE(told.teller->status().health.ok());
  nats.go_on();
  const uint64_t keyframes = told.teller->status().keyframes;
  ASSERT_TRUE(comes([&] {
    told.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(17));
    return told.teller->status().keyframes > keyframes && told.teller->status().health.ok();
  }));
  told.storm(10);
  ASSERT_TRUE(edge.follow_to(told.world.tick()));
  expect_same(edge, told);
}

TEST(ToldWorld, a_simulation_that_begins_anew_ends_the_source) {
  NatsProcess nats;
  auto told = std::make_unique<ToldByHand>(connected_bus(nats), 77);
  told->storm(3);
  ASSERT_TRUE(told->comes_to_keyframes(1));
  ToldFollower edge(connected_bus(nats));
  ASSERT_NE(edge.source, nullptr) << edge.why;
  told.reset();
  ToldByHand again(connected_bus(nats), 78);
  again.storm(2);
  ASSERT_TRUE(again.comes_to_keyframes(1));
  again.steps(2);
  EXPECT_FALSE(edge.follow_to(1000));
  EXPECT_TRUE(edge.source->is_over());
  ToldFollower other(connected_bus(nats));
  ASSERT_NE(other.source, nullptr) << other.why;
  EXPECT_EQ(other.source->run(), 78U);
}

TEST(ToldWorld, a_stream_that_is_full_has_a_keyframe_and_all_behind_it) {
  NatsProcess nats;
  TellerConfig small = told_config();
  small.stream_mb = 5;
  small.in_memory = true;
  ToldByHand told(connected_bus(nats), 77, small);
  while (told.teller->status().bytes < 6'500'000) {
    told.storm(20);
    ASSERT_TRUE(comes([&] { return told.teller->status().waiting == 0; }));
  }
  EXPECT_GT(told.teller->status().keyframes, 2U);
  EXPECT_TRUE(told.teller->status().health.ok());
  ToldFollower late(connected_bus(nats));
  ASSERT_NE(late.source, nullptr) << late.why;
  ASSERT_TRUE(late.follow_to(told.world.tick()));
  expect_same(late, told);
}

TEST(ToldWorld, a_keyframe_that_the_stream_has_no_room_for_is_a_fault) {
  NatsProcess nats;
  TellerConfig small = told_config();
  small.stream_mb = 1;
  small.keyframe_s = 0.2;
  ToldByHand told(connected_bus(nats), 77, small);
  for (int i = 0; i < 100 && told.teller->status().health.ok(); ++i) {
    told.storm(20);
    ASSERT_TRUE(comes([&] { return told.teller->status().waiting == 0; }));
  }
  const auto because = told.teller->status().health.because;
  ASSERT_TRUE(because);
  EXPECT_NE(because->find("--nats-stream-mb"), std::string::npos) << *because;
}

TEST(ToldWorld, what_anybody_writes_to_the_bus_changes_nothing) {
  NatsProcess nats;
  const auto stranger = connected_bus(nats);
  TellerConfig often = told_config();
  often.keyframe_s = 0.5;
  ToldByHand told(connected_bus(nats), 77, often);
  told.storm(3);
  ASSERT_TRUE(told.comes_to_keyframes(1));
  ToldFollower edge(connected_bus(nats));
  ASSERT_NE(edge.source, nullptr) << edge.why;
  const ToldNames names(told_name);
  const std::vector<uint8_t> garbage{0xFF, 0x00, 0x13, 0x37};
  const Tick tick = told.world.tick();
  for (const std::string& subject : {names.tick(), names.keyframe(), names.whole(), names.down("x")}) {
    for (const uint64_t run : {uint64_t{77}, uint64_t{5}})
      for (const Tick at : {tick, tick + 1, tick + 1000})
        ASSERT_TRUE(stranger->send(subject, encode(ToldPart{run, at + 2, 0, 1, garbage})));
    ASSERT_TRUE(stranger->send(subject, garbage));
    ASSERT_TRUE(stranger->send(subject, {}));
  }
  ASSERT_TRUE(stranger->send(names.whole(), encode(ToldWhole{5, tick, 1})));
  ASSERT_TRUE(stranger->send(names.whole(), encode(ToldWhole{77, tick + 9, 2})));
  told.storm(30);
  ASSERT_TRUE(told.teller->status().health.ok());
  // Who forged the end of a keyframe delays those who read the stream until the next one.
  ASSERT_TRUE(edge.follow_to(tick + 1));
  EXPECT_GT(edge.source->status().reader.refused, 0U);
  expect_same(edge, told);
}

}  // namespace
}  // namespace scree
