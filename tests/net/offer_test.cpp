// Clients that come back with chunks that they have kept: those that are as they were are not sent again, and
// a client that lies harms itself alone.
#include <gtest/gtest.h>

#include "tests/support/net_server_fixture.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

class OfferTest : public PublisherTest {
 protected:
  static constexpr uint64_t again = 2;
  static constexpr glm::vec3 eye_m{0.0F, 2.0F, 0.0F};

  /// Edits in several chunks, which the first client has and leaves with.
  void make_edits() {
    for (int i = 0; i < 6; ++i) tick({source.carve({12.0F * static_cast<float>(i), 0.0F, 0.0F}, 2.0F, 1)});
    join(session, eye_m, 128.0F);
    for (int i = 0; i < 6; ++i) tick();
    ASSERT_EQ(followers.at(session).field.hash(), source.field().hash());
    publisher.leave(session);
  }
  OfferMessage offer_of(const Field& field) const {
    OfferMessage offer;
    offer.chunks = field.edited_chunks();
    for (const ChunkCoord chunk : offer.chunks) offer.hashes.push_back(short_hash(field.chunk_hash(chunk)));
    return offer;
  }
  TrustingClient& come_back(const OfferMessage& offer) {
    publisher.join(again, eye_m, 128.0F, operation_kinds, true);
    TrustingClient& follower = followers[again];
    follower.before = &followers.at(session);
    publisher.offer(again, offer);
    return follower;
  }
};

TEST_F(OfferTest, chunks_that_are_as_they_were_are_not_sent_again) {
  make_edits();
  const size_t first_bytes = bytes[session];
  const TrustingClient& follower = come_back(offer_of(followers.at(session).field));
  tick();
  EXPECT_EQ(follower.chunks, 0U);
  EXPECT_EQ(follower.unchanged, source.field().edited_chunks().size());
  EXPECT_EQ(publisher.stats().chunks_kept, follower.unchanged);
  tick({source.carve({1.0F, 0.0F, 0.0F}, 2.0F, 1)});
  EXPECT_EQ(follower.operations, 1U) << "what was kept is followed as what was sent";
  EXPECT_EQ(follower.field.hash(), source.field().hash());
  EXPECT_EQ(follower.mismatches, 0U);
  EXPECT_LT(bytes[again], first_bytes / 2);
}

TEST_F(OfferTest, what_changed_meanwhile_comes_whole_among_what_was_kept) {
  make_edits();
  tick({source.carve({25.5F, -1.0F, 0.0F}, 2.0F, 1)});
  const TrustingClient& follower = come_back(offer_of(followers.at(session).field));
  tick();
  EXPECT_GT(follower.chunks, 0U);
  EXPECT_GT(follower.unchanged, follower.chunks);
  EXPECT_EQ(follower.field.hash(), source.field().hash());
}

TEST_F(OfferTest, an_announced_offer_is_waited_for_but_not_for_ever) {
  make_edits();
  publisher.join(again, eye_m, 128.0F, operation_kinds, true);
  const auto wait = static_cast<int>(limits::offer_wait_s * 60.0);
  for (int i = 0; i < wait; ++i) tick();
  EXPECT_EQ(followers.at(again).chunks, 0U);
  EXPECT_GT(followers.at(again).ticks.size(), 0U) << "frames come";
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(followers.at(again).field.hash(), source.field().hash());
}

TEST_F(OfferTest, who_announces_nothing_does_not_wait) {
  make_edits();
  join(again, eye_m, 128.0F);
  tick();
  EXPECT_GT(followers.at(again).chunks, 0U);
}

TEST_F(OfferTest, a_liar_gets_what_he_says_he_has_when_he_asks_for_it_and_nobody_else_notices) {
  make_edits();
  join(3, eye_m, 128.0F);
  TrustingClient& liar = come_back(offer_of(source.field()));
  TrustingClient nothing;
  liar.before = nullptr;  // he has none of it
  tick();
  ASSERT_EQ(liar.unchanged, source.field().edited_chunks().size());
  EXPECT_EQ(liar.field.hash(), nothing.field.hash());
  tick({source.carve({0.5F, 0.0F, 0.0F}, 2.0F, 1)});
  EXPECT_EQ(liar.mismatches, 1U) << "the check finds it";
  RepairMessage repair{source.tick(), source.field().edited_chunks(), {}};
  repair.hashes.assign(repair.chunks.size(), 0);
  publisher.repair(again, repair);
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(liar.field.hash(), source.field().hash());
  EXPECT_EQ(liar.chunks, source.field().edited_chunks().size()) << "whole, and not by a note again";
  expect_whole_field_equal(3);
}

TEST_F(OfferTest, offered_chunks_that_do_not_exist_or_agree_are_nothing) {
  make_edits();
  OfferMessage offer = offer_of(source.field());
  for (uint16_t& hash : offer.hashes) hash = static_cast<uint16_t>(~hash);
  offer.chunks.insert(offer.chunks.begin(), {-1000, 0, 0});
  offer.hashes.insert(offer.hashes.begin(), 0);
  const TrustingClient& follower = come_back(offer);
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(follower.unchanged, 0U);
  EXPECT_EQ(follower.field.hash(), source.field().hash());
}

TEST_F(OfferTest, a_reset_forgets_the_offer_for_the_client_forgets_its_edits) {
  make_edits();
  join(session, eye_m, 128.0F);
  const OfferMessage offer = offer_of(followers.at(session).field);
  backlog_bytes = limits::outbox_resync_bytes + 1;
  tick();
  publisher.offer(session, offer);
  backlog_bytes = 0;
  followers.at(session).unchanged = 0;
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(followers.at(session).resets, 1U);
  EXPECT_EQ(followers.at(session).unchanged, 0U);
  EXPECT_EQ(followers.at(session).field.hash(), source.field().hash());
}

/// Over a socket: the offer follows the hello at once.
class OfferServerTest : public NetServerTest {
 protected:
  void start_with_edits() {
    start();
    for (int i = 0; i < 4; ++i) tick({source.carve({8.0F * static_cast<float>(i), 0.0F, 0.0F}, 1.5F, 1)});
    RawClient client(server->port());
    ASSERT_TRUE(client.send(hello()));
    world = client.receive_as<WelcomeMessage>()->world;
    offer.world = world;
    offer.chunks = source.field().edited_chunks();
    for (const ChunkCoord chunk : offer.chunks)
      offer.hashes.push_back(short_hash(source.field().chunk_hash(chunk)));
  }
  /// What comes first to who says this.
  template <typename Wanted>
  std::optional<Wanted> answer_to(uint64_t announced, const OfferMessage& offered) {
    RawClient client(server->port());
    HelloMessage back = hello();
    back.world = announced;
    EXPECT_TRUE(client.send(back));
    EXPECT_TRUE(client.send(offered));
    EXPECT_TRUE(client.receive_as<WelcomeMessage>());
    const auto deadline = std::chrono::steady_clock::now() + seconds(10);
    for (;;) {
      tick();
      while (const auto message = client.receive(milliseconds(5))) {
        if (std::holds_alternative<UnchangedChunksMessage>(*message) ||
            std::holds_alternative<ChunkMessage>(*message))
          return std::holds_alternative<Wanted>(*message) ? std::optional(std::get<Wanted>(*message))
                                                          : std::nullopt;
      }
      if (std::chrono::steady_clock::now() > deadline) return std::nullopt;
    }
  }

  uint64_t world = 0;
  OfferMessage offer;
};

TEST_F(OfferServerTest, it_is_answered_by_a_note_before_any_chunk) {
  start_with_edits();
  const auto unchanged = answer_to<UnchangedChunksMessage>(world, offer);
  ASSERT_TRUE(unchanged);
  EXPECT_EQ(unchanged->chunks.size(), offer.chunks.size());
  server->flush();  // counts follow what is sent
  EXPECT_EQ(server->stats().published.chunks_kept, offer.chunks.size());
}

TEST_F(OfferServerTest, of_another_world_is_skipped) {
  start_with_edits();
  OfferMessage other = offer;
  ++other.world;
  EXPECT_TRUE(answer_to<ChunkMessage>(other.world, other)) << "and nobody waits for it";
  EXPECT_EQ(server->stats().published.chunks_kept, 0U);
}

TEST_F(OfferServerTest, a_flood_of_them_is_refused_and_nobody_else_notices) {
  start_with_edits();
  OfferMessage large{world, {}, {}};
  for (int i = 0; i < static_cast<int>(limits::offer_chunks_max); ++i)
    large.chunks.push_back({i / 64, 0, i % 64});
  large.hashes.resize(large.chunks.size());
  RawClient flood(server->port());
  ASSERT_TRUE(flood.send(hello()));
  const std::vector<uint8_t> bytes = encode(ClientMessage(large));
  for (size_t sent = 0; sent < 2 * limits::client_bytes_burst_max; sent += bytes.size())
    flood.send_bytes(bytes);
  expect_refused(flood, "limits.client_bytes_per_second_max");
}

TEST(ChunkOffer, is_forgotten_after_its_time) {
  ChunkOffer offer;
  offer.accept({1, {{1, 2, 3}}, {7}}, 3);
  EXPECT_TRUE(offer.ready());
  EXPECT_TRUE(offer.ready());
  EXPECT_EQ(offer.chunks(), 1U);
  EXPECT_TRUE(offer.ready());
  EXPECT_EQ(offer.chunks(), 0U);
  EXPECT_FALSE(offer.answers({1, 2, 3}, 7));
}

TEST(ChunkOffer, answers_once_for_a_chunk_by_the_low_bits_of_its_hash) {
  ChunkOffer offer;
  offer.accept({1, {{1, 2, 3}, {1, 2, 4}}, {7, 8}}, 100);
  EXPECT_FALSE(offer.answers({1, 2, 5}, 7));
  EXPECT_TRUE(offer.answers({1, 2, 3}, 0xABCD'0007));
  EXPECT_FALSE(offer.answers({1, 2, 3}, 0xABCD'0007));
  EXPECT_FALSE(offer.answers({1, 2, 4}, 7));
}

}  // namespace
}  // namespace scree
