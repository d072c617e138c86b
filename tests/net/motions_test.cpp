// Motions on both sides: clients that come, go, skip frames and start anew have the server's, bit for bit,
// and poses near the published ones.
#include "server/publish/motions.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/publish/limits.h"
#include "shared/base/random.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

class MotionsTest : public PublisherTest {
 protected:
  const TrackedMotion& tracked(PieceId id) const {
    const auto found = std::ranges::find(publisher.motions().all(), id, &TrackedMotion::id);
    EXPECT_NE(found, publisher.motions().all().end());
    return *found;
  }
  /// Every motion that the client has is the server's; says how many there are.
  size_t expect_motions_equal(uint64_t id) {
    size_t equal = 0;
    for (const TrackedMotion& piece : publisher.motions().all()) {
      const Motion* motion = followers.at(id).motions.motion(piece.id);
      if (motion == nullptr) continue;
      EXPECT_EQ(*motion, piece.motion) << "piece " << piece.id << " of client " << id;
      ++equal;
    }
    return equal;
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
};

TEST_F(MotionsTest, clients_that_join_skip_frames_and_start_anew_have_the_servers_motions) {
  Random random(11);
  uint64_t newest = 3;
  for (uint64_t id = 1; id <= newest; ++id) join(id, {0.0F, 2.0F, 0.0F}, 64.0F);
  size_t equal = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<Operation> operations;
    if (i % 40 == 0)
      operations.emplace_back(source.carve({static_cast<float>(random.below(40)), 0.0F, 0.0F}, 1.5F, 5));
    const auto some_piece = [&] {
      auto piece = source.pieces().begin();
      std::advance(piece, random.below(static_cast<uint32_t>(source.pieces().size())));
      return piece->first;
    };
    if (source.pieces().size() > 60) operations.emplace_back(source.stamp(some_piece()));
    if (source.pieces().size() > 5 && i % 300 == 7) {
      const PieceId parent = some_piece();
      CarveOperation ids = source.carve({}, 1.0F, 3);
      operations = {ShatterOperation{parent, SeedPattern::radial, 3, 3,
                                     source.pieces().at(parent)->centre_voxels, ids.first_piece}};
    }
    for (int move = 0; move < 6 && !source.pieces().empty(); ++move)
      source.move(some_piece(), glm::vec3(random.unit(), random.unit(), random.unit()) * 0.1F - 0.05F);
    backlog_bytes = random.below(12) == 0 ? limits::outbox_soft_bytes + 1 : 0;
    if (i % 500 == 250) backlog_bytes = limits::outbox_resync_bytes + 1;
    if (i % 200 == 100) publisher.set_interest(2, {i % 400 == 100 ? 200.0F : 10.0F, 2.0F, 0.0F}, 24.0F);
    if (i % 700 == 350) join(++newest, {0.0F, 2.0F, 0.0F}, 64.0F);
    tick(operations);
    if (HasFailure()) FAIL() << "at tick " << i;
    for (uint64_t id = 2; id <= newest; ++id) equal += expect_motions_equal(id);
    if (publisher.motions().stepped() == source.tick() && backlog_bytes == 0)
      equal += expect_motions_equal(session);
  }
  EXPECT_GT(equal, 50000U);
  EXPECT_GE(followers.at(session).resets, 3U);
}

TEST_F(MotionsTest, poses_are_near_the_published_ones_and_nearer_at_rest) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  Random random(12);
  const TrustingClient& follower = followers.at(session);
  const auto expect_near = [&](float most_m) {
    for (const TrackedMotion& piece : publisher.motions().all())
      EXPECT_LE(glm::distance(pose_of(*follower.motions.motion(piece.id)).position_m, piece.place_m), most_m);
  };
  for (int i = 0; i < 600; ++i) {
    for (const auto& [id, volume] : source.pieces())
      source.move(id, glm::vec3(random.unit(), random.unit(), random.unit()) * 0.2F - 0.1F);
    tick();
    if (publisher.motions().stepped() == source.tick()) expect_near(0.006F);
  }
  ticks(12);
  expect_near(0.002F);
  for (const TrackedMotion& piece : publisher.motions().all()) EXPECT_EQ(piece.motion.mode, MotionMode::rest);
}

TEST_F(MotionsTest, pieces_at_rest_take_no_bytes_even_after_frames_without_poses) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  ticks(20);
  TrustingClient& follower = followers.at(session);
  follower.motion_bytes = 0;
  backlog_bytes = limits::outbox_soft_bytes + 1;
  ticks(9);
  backlog_bytes = 0;
  ticks(9);
  EXPECT_EQ(follower.motion_bytes, 0U);
  EXPECT_EQ(follower.transform_bytes, 0U);
  source.move(3, {0.5F, 0.0F, 0.0F});
  ticks(3);
  EXPECT_GT(follower.motion_bytes, 0U);
  EXPECT_LT(follower.motion_bytes, 24U) << "none of the others came whole";
  EXPECT_EQ(expect_motions_equal(session), source.pieces().size());
}

TEST_F(MotionsTest, a_piece_that_moved_while_a_client_skipped_frames_comes_whole_and_then_goes_on) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  join(2, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  ticks(20);
  backlog_bytes = limits::outbox_soft_bytes + 1;
  for (int i = 0; i < 9; ++i) {
    source.move(3, {0.05F, 0.0F, 0.0F});
    tick();
  }
  EXPECT_NE(*followers.at(session).motions.motion(3), tracked(3).motion);
  backlog_bytes = 0;
  followers.at(session).motion_bytes = followers.at(2).motion_bytes = 0;
  for (int i = 0; i < 3; ++i) {
    source.move(3, {0.05F, 0.0F, 0.0F});
    tick();
  }
  EXPECT_EQ(expect_motions_equal(session), source.pieces().size());
  EXPECT_GT(followers.at(session).motion_bytes, followers.at(2).motion_bytes);
  for (int i = 0; i < 3; ++i) {
    source.move(3, {0.05F, 0.0F, 0.0F});
    tick();
  }
  EXPECT_EQ(last.at(session).get(), last.at(2).get()) << "both get the same bytes again";
}

TEST_F(MotionsTest, a_client_that_does_not_predict_gets_whole_poses_and_no_motions) {
  publisher.join(session, {0.0F, 2.0F, 0.0F}, 64.0F, 0);
  followers.try_emplace(session);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  ticks(20);
  TrustingClient& follower = followers.at(session);
  EXPECT_EQ(follower.piece_messages, source.pieces().size());
  EXPECT_EQ(follower.transform_bytes, 0U) << "each piece came with its pose";
  follower.poses.clear();
  source.move(3, {0.5F, 0.25F, 0.0F});
  ticks(3);
  EXPECT_EQ(follower.motion_bytes, 0U);
  EXPECT_GT(follower.transform_bytes, 0U);
  ASSERT_EQ(follower.poses.size(), 1U);
  EXPECT_EQ(follower.poses.at(3), tracked(3).target.pose);
}

TEST(Correction, a_body_is_never_farther_off_than_promised_at_60_hz) {
  const MotionRules rules = motion_rules(60, 1);
  Random random(13);
  Motion motion = resting_at(quantise({}));
  MotionTarget target;
  glm::vec3 place_m{0.0F}, speed_m_s{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 spin{0.0F};
  const auto some = [&] { return glm::vec3(random.unit(), random.unit(), random.unit()) - 0.5F; };
  for (int i = 0; i < 20000; ++i) {
    if (random.below(10) == 0) {
      speed_m_s = some() * 10.0F;
      spin = some() * 10.0F;
    }
    if (random.below(50) == 0) speed_m_s = spin = glm::vec3(0.0F);
    place_m += speed_m_s / 60.0F;
    if (glm::length(place_m) > 100.0F) place_m = some();
    rotation = glm::normalize(rotation + glm::quat(0.0F, spin * (0.5F / 60.0F)) * rotation);
    const QuantisedPose pose = quantise({place_m, rotation});
    const uint32_t still = pose == target.pose ? target.still_steps + 1 : 0;
    const Motion at = resting_at(pose);
    target = {pose, at, at.position - target.at.position, still};
    motion = advance(motion, correction_of(motion, target, rules), rules);
    const glm::dvec3 off = glm::dvec3(motion.position - at.position) / double{motion_steps_per_m};
    ASSERT_LE(glm::length(off), 0.0012) << "step " << i;
    const glm::dvec3 turn = glm::dvec3(turn_between(motion.rotation, at.rotation)) / double{motion_one};
    ASSERT_LE(glm::length(turn), std::tan(0.13 / 57.29577951)) << "step " << i;
  }
}

}  // namespace
}  // namespace scree
