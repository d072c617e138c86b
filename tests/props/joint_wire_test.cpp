// Joints in messages, in a mirror, and in recordings.
#include <filesystem>
#include <glm/geometric.hpp>
#include <unistd.h>

#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "server/publish/publisher.h"
#include "server/replay/replay_source.h"
#include "server/store/recorder.h"
#include "tests/support/flat_welcome.h"
#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

Joint whole_joint() {
  Joint joint;
  joint.kind = JointKind::slider;
  joint.a = {7, {1.0F, -2.0F, 3.5F}, {0.5F, 0.5F, -0.5F, 0.5F}};
  joint.b = {0, {40.0F, -1.0F, 0.0F}};
  joint.limits = JointLimits{-1.0F, 2.0F};
  joint.motor = {0.5F, 1000.0F};
  joint.break_force_n = 1e5F;
  joint.break_torque_nm = 2e5F;
  joint.touches = true;
  return joint;
}

std::span<const uint8_t> body_of_message(const std::vector<uint8_t>& framed) {
  return std::span(framed).subspan(length_prefix_bytes);
}

TEST(JointWire, messages_come_back_as_they_were) {
  Joint rope;
  rope.kind = JointKind::rope;
  rope.a.body = 3;
  rope.b.body = 4;
  rope.length_m = 5.0F;
  const JointsMessage sent{{{8, whole_joint()}, {9, rope}}, {{2, JointEnd::let_go}, {3, JointEnd::broken}}};
  const auto got = decode_server(body_of_message(encode(ServerMessage(sent))));
  ASSERT_TRUE(got.has_value()) << got.error().message;
  const auto& joints = std::get<JointsMessage>(*got);
  EXPECT_EQ(joints.here, sent.here);
  EXPECT_EQ(joints.gone, sent.gone);
  const auto add = decode_client(body_of_message(encode(ClientMessage(AddJointMessage{{whole_joint()}, 5}))));
  ASSERT_TRUE(add.has_value());
  EXPECT_EQ(std::get<AddJointMessage>(*add).joint, whole_joint());
  EXPECT_EQ(std::get<AddJointMessage>(*add).request, 5U);
  const auto set =
      decode_client(body_of_message(encode(ClientMessage(SetMotorMessage{{8, {-1.0F, 50.0F}}, 6}))));
  ASSERT_TRUE(set.has_value());
  EXPECT_EQ(std::get<SetMotorMessage>(*set).motor, (JointMotor{-1.0F, 50.0F}));
  const auto remove = decode_client(body_of_message(encode(ClientMessage(RemoveJointMessage{{8}, 7}))));
  ASSERT_TRUE(remove.has_value());
  EXPECT_EQ(std::get<RemoveJointMessage>(*remove).joint, 8U);
}

TEST(JointWire, a_client_refuses_joints_that_cannot_be) {
  Joint self = whole_joint();
  self.b.body = self.a.body;
  const std::vector<JointsMessage> all{{{{8, self}}, {}},
                                       {{{8, whole_joint()}, {8, whole_joint()}}, {}},
                                       {{{0, whole_joint()}}, {}},
                                       {{}, {{3, JointEnd::broken}, {2, JointEnd::broken}}}};
  for (const JointsMessage& sent : all)
    EXPECT_FALSE(decode_server(body_of_message(encode(ServerMessage(sent)))).has_value());
  Mirror mirror(flat_welcome());
  EXPECT_FALSE(mirror.apply(JointsMessage{{{8, whole_joint()}}, {}}).has_value()) << "of an unknown body";
  EXPECT_TRUE(mirror.apply(JointsMessage{{}, {{5, JointEnd::broken}}}).has_value());
}

/// A publisher and a client's mirror behind a world.
class Watched {
 public:
  explicit Watched(JointWorld& world, float radius_m) : world_(world) {
    publisher_.begin(world.world().keyframe());
    publisher_.join(1, {0.0F, 2.0F, 0.0F}, radius_m, operation_kinds);
  }
  void follow() {
    const auto backlog = [](uint64_t) { return Backlog(); };
    for (const Outgoing& out : publisher_.publish(world_.last(), backlog)) {
      const auto message = decode_server(std::span(*out.bytes).subspan(length_prefix_bytes));
      ASSERT_TRUE(message.has_value()) << message.error().message;
      const auto changes = mirror_.apply(*message);
      ASSERT_TRUE(changes.has_value()) << changes.error().message;
      ended_.insert(ended_.end(), changes->joints_removed.begin(), changes->joints_removed.end());
    }
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      world_.step();
      follow();
    }
  }
  Publisher& publisher() { return publisher_; }
  const Mirror& mirror() const { return mirror_; }
  const std::vector<EndedJoint>& ended() const { return ended_; }

 private:
  JointWorld& world_;
  Workers workers_{1};
  Publisher publisher_{PublisherConfig{.terrain = rock_terrain}, workers_};
  Mirror mirror_{[] {
    WelcomeMessage welcome = flat_welcome();
    welcome.terrain = terrain_of_worlds(rock_terrain);
    return welcome;
  }()};
  std::vector<EndedJoint> ended_;
};

TEST(JointWire, a_mirror_has_the_joints_of_the_bodies_that_it_has) {
  JointWorld world(rock_world());
  const PieceId a = world.add(crate(), {0.0F, 0.5F, 0.0F}), b = world.add(crate(), {3.0F, 0.5F, 0.0F}),
                far = world.add(crate(), {90.0F, 0.5F, 0.0F}),
                farther = world.add(crate(), {93.0F, 0.5F, 0.0F});
  const JointId rope = world.join(
      line_between(JointKind::rope, world.frame(a), world.place_m(a), world.frame(b), world.place_m(b)));
  Joint there = joint_at(JointKind::hinge, world.frame(far), world.frame(farther), {91.5F, 0.5F, 0.0F});
  const JointId hinge = world.join(there);
  Watched watched(world, 40.0F);
  watched.steps(6);
  ASSERT_EQ(watched.mirror().joints().size(), 1U);
  EXPECT_NEAR(watched.mirror().joints().at(rope).length_m, 3.0F, 0.01F);
  watched.publisher().set_interest(1, {91.0F, 2.0F, 0.0F}, 40.0F);
  watched.steps(60);
  ASSERT_EQ(watched.mirror().joints().size(), 1U);
  EXPECT_TRUE(watched.mirror().joints().contains(hinge));
  world.ask(SetMotorRequest{hinge, {0.0F, 5.0F}});
  watched.follow();
  watched.steps(6);
  EXPECT_EQ(watched.mirror().joints().at(hinge).motor.greatest, 5.0F);
  world.ask(RemoveJointRequest{hinge});
  watched.follow();
  watched.steps(6);
  EXPECT_TRUE(watched.mirror().joints().empty());
  EXPECT_EQ(watched.ended().back(), (EndedJoint{hinge, JointEnd::removed}));
}

TEST(JointWire, a_joint_that_breaks_before_it_is_told_is_told_as_broken) {
  JointWorld world(rock_world());
  const PieceId above = world.add(crate(), {0.0F, 12.0F, 0.0F});
  Watched watched(world, 40.0F);
  watched.steps(6);
  Joint thread = line_between(JointKind::distance, world.frame(above), world.place_m(above), {},
                              world.place_m(above) - glm::vec3(0.0F, 12.5F, 0.0F));
  thread.length_m = 11.7F;
  thread.break_force_n = 1.0F;
  const JointId weak = world.join(thread);
  watched.follow();
  watched.steps(6);
  EXPECT_TRUE(watched.mirror().joints().empty());
  ASSERT_FALSE(watched.ended().empty());
  EXPECT_EQ(watched.ended().back(), (EndedJoint{weak, JointEnd::broken}));
}

TEST(JointWire, a_recording_keeps_joints_and_is_verified) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("scree_joints_" + std::to_string(::getpid()) + ".scree");
  const WorldConfig config = rock_world();
  JointWorld world(config);
  auto recorder = Recorder::create(path.string(), {"test", config});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  const Prop light = crate(0.3F, 100.0F);
  const std::vector<std::pair<int, Request>> requests{
      {1, AddPropRequest{light, {0.0F, 4.0F, 0.0F}}},
      {2, AddPropRequest{light, {1.0F, 4.0F, 0.0F}}},
      {3,
       AddJointRequest{joint_at(JointKind::hinge, {1, {0, 4, 0}}, {2, {1, 4, 0}}, {0.5F, 4, 0}, {0, 0, 1})}},
      {4, AddPropRequest{light, {3.0F, 4.0F, 0.0F}}},
      {5,
       AddJointRequest{line_between(JointKind::rope, {2, {1, 4, 0}}, {1, 4, 0}, {4, {3, 4, 0}}, {3, 4, 0})}},
      {100, SetMotorRequest{3, {2.0F, 500.0F}}},
      {150, RemovePropRequest{4}},
      {200, RemoveJointRequest{3}}};
  std::map<Tick, size_t> joints;
  PublishedState state;
  for (int tick = 1; tick <= 240; ++tick) {
    std::vector<Command> commands;
    for (const auto& [at, request] : requests)
      if (at == tick) commands.push_back({0, static_cast<uint32_t>(tick), request});
    auto delta = std::make_shared<TickDelta>(world.step(commands));
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "");
    state.apply(*delta);
    joints[delta->tick] = state.joints().size();
    (*recorder)->push(delta, commands);
  }
  ASSERT_TRUE((*recorder)->finish().has_value());
  auto source = ReplaySource::open(path.string());
  ASSERT_TRUE(source.has_value()) << source.error().message;
  PublishedState played;
  for (int tick = 1; tick <= 240; ++tick) {
    const auto delta = (*source)->next();
    ASSERT_TRUE(delta.has_value() && *delta != nullptr) << tick;
    played.apply(**delta);
    EXPECT_EQ(played.joints().size(), joints.at((*delta)->tick)) << tick;
    if (tick == 120) {
      EXPECT_EQ(played.joints().at(3)->motor.speed, 2.0F);
    }
  }
  const auto back = (*source)->jump(120);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ((*back)->joints_added.size(), 2U);
  const auto start = (*source)->jump(2);
  ASSERT_TRUE(start.has_value()) << start.error().message;
  EXPECT_EQ((*start)->joints_removed.size(), 2U);
  expect_verifies(path);
}

}  // namespace
}  // namespace scree
