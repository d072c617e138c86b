#include "server/work/piece_shares.h"

#include <gtest/gtest.h>

#include "server/work/limits.h"

namespace scree {
namespace {

PieceShares holding(uint64_t session, uint32_t pieces) {
  PieceShares shares;
  for (uint32_t i = 0; i < pieces; ++i) shares.add(session);
  return shares;
}

TEST(piece_shares, a_client_that_is_alone_may_have_all_room) {
  const PieceShares shares = holding(1, 600);
  const PieceRoom room{.alive = 600, .pieces_max = 2000, .bodies_load = 0.9F};
  EXPECT_EQ(shares.grant(1, 1400, room).pieces, 1400U);
  const PieceGrant over = shares.grant(1, 1401, room);
  EXPECT_EQ(over.pieces, 0U);
  EXPECT_EQ(over.pieces_most, 1400U);
  EXPECT_FALSE(over.may_wait);
  EXPECT_FALSE(over.contested);
}

TEST(piece_shares, pieces_of_the_world_itself_are_nobodys_rivals) {
  const PieceShares shares = holding(0, 100);
  EXPECT_FALSE(shares.grant(1, 10, {.alive = 100, .pieces_max = 2000}).contested);
}

TEST(piece_shares, the_world_itself_shares_with_nobody) {
  const PieceShares shares = holding(1, 100);
  EXPECT_EQ(shares.grant(0, 1900, {.alive = 100, .pieces_max = 2000}).pieces, 1900U);
}

TEST(piece_shares, clients_that_take_all_they_get_leave_as_much_for_one_more) {
  for (const uint64_t clients : {2U, 5U, 20U}) {
    PieceShares shares;
    size_t alive = 0;
    for (int round = 0; round < 200; ++round)
      for (uint64_t session = 1; session <= clients; ++session) {
        const PieceRoom room{.alive = alive, .pieces_max = 2000, .others_wait = true};
        const uint32_t pieces = shares.grant(session, 8, room).pieces;
        for (uint32_t i = 0; i < pieces; ++i) shares.add(session);
        alive += pieces;
      }
    const auto share = static_cast<double>(2000U / (clients + 1));
    for (uint64_t session = 1; session <= clients; ++session)
      EXPECT_NEAR(shares.of(session), share, 0.1 * share + 4.0) << clients;
    EXPECT_NEAR(static_cast<double>(2000 - alive), share, 0.1 * share + 4.0);
    EXPECT_GT(shares.grant(99, 8, {.alive = alive, .pieces_max = 2000}).pieces, 0U);
  }
}

TEST(piece_shares, a_carve_beside_others_gets_a_part_of_what_is_left) {
  const PieceShares shares = holding(1, 1000);
  const PieceRoom room{.alive = 1000, .pieces_max = 2000};
  EXPECT_EQ(shares.grant(2, 64, room).pieces, 64U);
  EXPECT_EQ(shares.grant(2, 1000, room).pieces, 1000U / limits::room_parts);
}

TEST(piece_shares, what_is_told_never_exceeds_the_limit_of_pieces) {
  const PieceShares shares = holding(1, 10);
  const PieceGrant grant = shares.grant(2, 4000, {.alive = 10, .pieces_max = 2000});
  EXPECT_EQ(grant.pieces, 0U);
  EXPECT_EQ(grant.pieces_most, 2000U);
}

TEST(piece_shares, bodies_that_take_their_share_of_the_tick_leave_no_room) {
  PieceShares shares = holding(1, 500);
  const PieceRoom room{.alive = 500, .pieces_max = 2000, .bodies_load = limits::bodies_share};
  const PieceGrant other = shares.grant(2, 8, room);
  EXPECT_EQ(other.pieces, 0U);
  EXPECT_TRUE(other.may_wait) << "it holds less than the others: room is coming";
  shares.add(2);
  const PieceGrant owner = shares.grant(1, 8, room);
  EXPECT_EQ(owner.pieces, 0U);
  EXPECT_FALSE(owner.may_wait) << "it holds the room itself";
}

TEST(piece_shares, who_holds_less_than_his_part_of_the_limit_gets_the_least_at_last) {
  PieceShares shares = holding(1, 500);
  PieceRoom room{.alive = 500, .pieces_max = 2000, .bodies_load = limits::bodies_share};
  EXPECT_EQ(shares.grant(2, 64, room).pieces_at_last, 64U / limits::seeds_cut_max);
  EXPECT_EQ(shares.grant(2, 1, room).pieces_at_last, 1U);
  EXPECT_EQ(shares.grant(2, 2001, room).pieces_at_last, 0U) << "more than there can ever be";
  room.pieces_max = 501;
  EXPECT_EQ(shares.grant(2, 64, room).pieces_at_last, 0U) << "a limit is a limit";
  for (int i = 0; i < 665; ++i) shares.add(2);
  room = {.alive = 1165, .pieces_max = 2000, .bodies_load = limits::bodies_share};
  EXPECT_GT(shares.grant(2, 64, room).pieces_at_last, 0U);
  for (int i = 0; i < 2; ++i) shares.add(2);
  EXPECT_EQ(shares.grant(2, 64, room).pieces_at_last, 0U) << "it holds a third";
}

TEST(piece_shares, who_holds_less_than_its_part_holds_little) {
  PieceShares shares = holding(1, 500);
  EXPECT_FALSE(shares.holds_little(1)) << "it is alone";
  EXPECT_TRUE(shares.holds_little(2));
  for (int i = 0; i < 499; ++i) shares.add(2);
  EXPECT_TRUE(shares.holds_little(2));
  shares.add(2);
  EXPECT_FALSE(shares.holds_little(2) || shares.holds_little(1)) << "each has its half";
  for (int i = 0; i < 5000; ++i) shares.add(0);
  EXPECT_FALSE(shares.holds_little(2)) << "the world's own pieces are nobody's rivals";
  EXPECT_FALSE(shares.holds_little(0));
}

TEST(piece_shares, a_piece_that_nobody_has_cannot_go) {
  PieceShares shares = holding(1, 1);
  shares.remove(1);
  EXPECT_EQ(shares.of(1), 0U);
  EXPECT_DEATH(shares.remove(1), "CHECK failed");
}

}  // namespace
}  // namespace scree
