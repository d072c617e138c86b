// One's own edits shown before the server answers: over an exact mirror, and gone when the answer is there.
#include "client/mirror/predictions.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "client/mirror/limits.h"
#include "tests/support/flat_welcome.h"

namespace scree {
namespace {

bool everywhere(ChunkCoord) {
  return true;
}

const VoxelBox looked_at{{-40, -40, -40}, {40, 24, 40}};

/// A client with predictions beside one without; both get the same messages.
struct Foreseeing {
  Mirror mirror{flat_welcome()};
  Mirror plain{flat_welcome()};
  Predictions predictions{mirror};
  std::set<PieceId> shown;  ///< pieces, as the changes tell
  Tick tick = 0;
  PieceId next_piece = 1;

  static CarveRequest carve(float x_m = 1.0F, uint32_t seeds = 8) {
    CarveRequest request;
    request.shape = sphere({x_m, -0.5F, 1.0F}, 1.5F);
    request.pattern = SeedPattern::uniform;
    request.seeds = seeds;
    request.random_seed = 7;
    request.impact_m = {x_m, 0.0F, 1.0F};
    return request;
  }
  /// What a server makes of it, with as many pieces.
  CarveOperation made_of(const CarveRequest& request, uint32_t seeds) {
    CarveOperation made{.shape = request.shape,
                        .pattern = request.pattern,
                        .seeds = seeds,
                        .random_seed = request.random_seed,
                        .impact_m = request.impact_m,
                        .first_piece = next_piece};
    next_piece += seeds;
    return made;
  }
  bool foresee(uint32_t request, const Request& asked, double now_s = 0.0) {
    return predictions.foresee(request, asked, now_s, everywhere);
  }
  MirrorChanges apply(const ServerMessage& message) {
    const auto changes = mirror.apply(message);
    EXPECT_TRUE(changes.has_value()) << changes.error().message;
    EXPECT_TRUE(plain.apply(message).has_value());
    predictions.notice(message);
    return changes ? *changes : MirrorChanges{};
  }
  MirrorChanges settle(double now_s = 0.0, MirrorChanges changes = {}) {
    predictions.settle(now_s, changes);
    for (const PieceId piece : changes.pieces_removed) shown.erase(piece);
    for (const PieceId piece : changes.pieces_added) shown.insert(piece);
    // An id that was added and taken away again between two frames is in both lists.
    std::erase_if(shown, [&](PieceId piece) {
      return !mirror.pieces().contains(piece) && !predictions.pieces().contains(piece);
    });
    return changes;
  }
  MirrorChanges frame(const std::vector<Operation>& operations) {
    FrameMessage message;
    message.tick = ++tick;
    message.operations = operations;
    return apply(message);
  }
  std::vector<Code> seen() { return gather(predictions.field(), looked_at).codes; }
  std::vector<Code> exact() { return gather(plain.field(), looked_at).codes; }
  /// Nothing of any prediction is left.
  void expect_plain() {
    EXPECT_EQ(predictions.outstanding(), 0U);
    EXPECT_EQ(&predictions.field(), &mirror.field());
    EXPECT_TRUE(predictions.pieces().empty());
    EXPECT_EQ(seen(), exact());
    EXPECT_EQ(mirror.field().hash(), plain.field().hash());
    std::set<PieceId> alive;
    for (const auto& [id, motion] : plain.pieces()) alive.insert(id);
    EXPECT_EQ(shown, alive);
  }
};

TEST(Predictions, a_carve_is_seen_at_once_and_the_mirror_stays_exact) {
  Foreseeing client;
  ASSERT_TRUE(client.foresee(1, Foreseeing::carve()));
  const MirrorChanges changes = client.settle();
  EXPECT_FALSE(changes.bricks.empty());
  EXPECT_EQ(changes.pieces_added.size(), client.predictions.pieces().size());
  EXPECT_GT(client.predictions.pieces().size(), 4U);
  EXPECT_EQ(client.predictions.outstanding(), 1U);
  EXPECT_EQ(client.mirror.field().hash(), 0U);
  EXPECT_EQ(client.mirror.pieces().size(), 0U);

  // It is what the server's operation makes, voxel by voxel, and piece by piece.
  Foreseeing other;
  other.frame({other.made_of(Foreseeing::carve(), 8)});
  EXPECT_EQ(client.seen(), other.exact());
  ASSERT_EQ(client.predictions.pieces().size(), other.mirror.pieces().size());
  auto real = other.mirror.pieces().begin();
  for (const auto& [id, volume] : client.predictions.pieces())
    EXPECT_EQ(volume->window.codes, (real++)->second.volume->window.codes);
}

TEST(Predictions, the_servers_operation_takes_the_place_of_the_prediction) {
  Foreseeing client;
  ASSERT_TRUE(client.foresee(1, Foreseeing::carve()));
  client.settle();
  // Its client's room was small: fewer pieces than asked for.
  const MirrorChanges changes = client.settle(0.1, client.frame({client.made_of(Foreseeing::carve(), 3)}));
  EXPECT_FALSE(changes.pieces_removed.empty());
  client.expect_plain();
  EXPECT_NE(client.seen(), Foreseeing().seen());
  client.settle(0.1, client.apply(ReplyMessage{1, "", 3}));
  client.expect_plain();
}

TEST(Predictions, the_reply_takes_back_what_was_refused) {
  Foreseeing client;
  ASSERT_TRUE(client.foresee(4, Foreseeing::carve()));
  const MirrorChanges before = client.settle();
  client.settle(0.1, client.apply(ReplyMessage{3, "another one's", 0}));
  EXPECT_EQ(client.predictions.outstanding(), 1U);
  const MirrorChanges after = client.settle(0.1, client.apply(ReplyMessage{4, "no room for pieces", 0}));
  EXPECT_EQ(std::set(after.bricks.begin(), after.bricks.end()),
            std::set(before.bricks.begin(), before.bricks.end()));
  EXPECT_EQ(after.pieces_removed, before.pieces_added);
  client.expect_plain();
}

TEST(Predictions, what_is_not_answered_in_time_is_taken_back) {
  Foreseeing client;
  ASSERT_TRUE(client.foresee(1, Foreseeing::carve(), 10.0));
  client.settle(10.0 + limits::prediction_seconds_max - 0.01);
  EXPECT_EQ(client.predictions.outstanding(), 1U);
  client.settle(10.0 + limits::prediction_seconds_max);
  client.expect_plain();
  // The server was only slow.
  client.settle(20.0, client.frame({client.made_of(Foreseeing::carve(), 8)}));
  client.expect_plain();
}

TEST(Predictions, anothers_carve_in_between_is_beneath_ones_own) {
  Foreseeing client;
  ASSERT_TRUE(client.foresee(1, Foreseeing::carve(1.0F)));
  client.settle();
  const std::vector<Code> alone = client.seen();
  CarveRequest others = Foreseeing::carve(2.0F);
  others.random_seed = 8;
  client.settle(0.1, client.frame({client.made_of(others, 8)}));
  EXPECT_EQ(client.predictions.outstanding(), 1U);
  EXPECT_NE(client.seen(), alone);
  Foreseeing both;
  both.frame({both.made_of(others, 8), both.made_of(Foreseeing::carve(1.0F), 8)});
  EXPECT_EQ(client.seen(), both.exact()) << "carried out anew over the other one";
  client.settle(0.2, client.frame({client.made_of(Foreseeing::carve(1.0F), 8)}));
  client.expect_plain();
}

TEST(Predictions, changes_elsewhere_cost_nothing) {
  Foreseeing client;
  ASSERT_TRUE(client.foresee(1, Foreseeing::carve()));
  client.settle();
  const PieceTable before = client.predictions.pieces();
  CarveRequest far = Foreseeing::carve(30.0F);
  far.random_seed = 8;
  client.settle(0.1, client.frame({client.made_of(far, 8)}));
  EXPECT_EQ(client.predictions.pieces(), before) << "carried out anew for nothing";
}

TEST(Predictions, several_lie_over_each_other_in_the_order_of_asking) {
  Foreseeing client, server;
  for (uint32_t i = 1; i <= 3; ++i) {
    CarveRequest request = Foreseeing::carve(static_cast<float>(i));
    request.random_seed = i;
    ASSERT_TRUE(client.foresee(i, request));
    server.frame({server.made_of(request, 8)});
  }
  client.settle();
  EXPECT_EQ(client.predictions.outstanding(), 3U);
  EXPECT_EQ(client.seen(), server.exact());
  // The second is refused, the third carried out first.
  client.settle(0.1, client.apply(ReplyMessage{2, "refused", 0}));
  CarveRequest third = Foreseeing::carve(3.0F);
  third.random_seed = 3;
  client.settle(0.1, client.frame({client.made_of(third, 8)}));
  EXPECT_EQ(client.predictions.outstanding(), 1U);
  client.settle(0.1, client.apply(ReplyMessage{1, "refused", 0}));
  client.expect_plain();
}

TEST(Predictions, fills_and_paint_are_seen_and_taken_back_alike) {
  Foreseeing client;
  const FillRequest fill{box({0.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})};
  const PaintRequest paint{sphere({1.0F, 0.0F, 1.0F}, 2.0F), material::ice};
  ASSERT_TRUE(client.foresee(1, fill));
  ASSERT_TRUE(client.foresee(2, paint));
  EXPECT_FALSE(client.foresee(3, SettingsRequest{{{"impacts", "false"}}})) << "edits nothing";
  client.settle();
  Foreseeing other;
  other.frame({FillOperation{fill.shape}, PaintOperation{paint.shape, paint.material}});
  EXPECT_EQ(client.predictions.field().hash(), other.plain.field().hash());
  client.settle(0.1, client.frame({FillOperation{fill.shape}}));
  EXPECT_EQ(client.predictions.outstanding(), 1U);
  EXPECT_EQ(client.predictions.field().hash(), other.plain.field().hash());
  client.settle(0.1, client.apply(ReplyMessage{2, "that takes the role builder", 0}));
  client.expect_plain();
}

TEST(Predictions, a_reset_takes_all_back) {
  Foreseeing client;
  client.settle(0.0, client.frame({client.made_of(Foreseeing::carve(-3.0F), 4)}));
  ASSERT_TRUE(client.foresee(1, Foreseeing::carve()));
  client.settle();
  client.settle(0.1, client.apply(ResetMessage{}));
  client.expect_plain();
}

TEST(Predictions, places_that_only_the_server_computes_are_scattered) {
  Foreseeing client;
  CarveRequest request = Foreseeing::carve();
  request.pattern = SeedPattern::even;
  ASSERT_TRUE(client.foresee(1, request));
  EXPECT_GT(client.predictions.pieces().size(), 1U);
  CarveOperation made = client.made_of(request, 2);
  made.authored_m = {{1.0F, -1.0F, 1.0F}, {1.5F, -0.5F, 1.0F}};
  client.settle(0.1, client.frame({made}));
  client.expect_plain();
}

TEST(Predictions, are_bounded_valid_and_over_known_ground_alone) {
  Foreseeing client;
  const auto known = [](ChunkCoord chunk) { return chunk != ChunkCoord{0, -1, 0}; };
  EXPECT_FALSE(client.predictions.foresee(1, Foreseeing::carve(), 0.0, known));
  CarveRequest wrong = Foreseeing::carve();
  wrong.seeds = 0;
  EXPECT_FALSE(client.foresee(2, wrong));
  wrong = Foreseeing::carve();
  wrong.shape.radius_m = 1e9F;
  EXPECT_FALSE(client.foresee(3, wrong));
  CarveRequest dear = Foreseeing::carve();
  dear.shape = box({0.0F, 0.0F, 0.0F}, {8.0F, 8.0F, 8.0F});
  dear.seeds = 4096;
  EXPECT_FALSE(client.foresee(4, dear)) << "more work than a frame may have";
  EXPECT_EQ(client.predictions.outstanding(), 0U);
  uint32_t shown = 0;
  for (uint32_t i = 10; i < 30; ++i) {
    CarveRequest small = Foreseeing::carve(static_cast<float>(i), 2);
    small.shape.radius_m = 0.5F;
    shown += client.foresee(i, small) ? 1 : 0;
  }
  EXPECT_EQ(shown, limits::predictions_max);
  client.settle();
  client.predictions.revert();
  client.settle();
  client.expect_plain();
}

}  // namespace
}  // namespace scree
