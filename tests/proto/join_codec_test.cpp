// Offers and tickets that break a rule are refused; the largest offer is no longer than a client's message
// may be.
#include <gtest/gtest.h>

#include "tests/support/wire_samples.h"

namespace scree {
namespace {

std::string refusal_of(const OfferMessage& offer) {
  const auto decoded = decode_client(samples::body_of(encode(ClientMessage(offer))));
  return decoded ? "" : decoded.error().message;
}

TEST(JoinCodec, chunks_of_an_offer_ascend_and_none_comes_twice) {
  EXPECT_EQ(refusal_of({1, {{0, 0, 0}, {0, 0, 1}, {0, 1, -5}, {1, -9, -9}}, {1, 2, 3, 4}}), "");
  EXPECT_NE(refusal_of({1, {{0, 0, 0}, {0, 0, 0}}, {1, 2}}).find("do not ascend"), std::string::npos);
  EXPECT_NE(refusal_of({1, {{1, 0, 0}, {0, 5, 5}}, {1, 2}}).find("do not ascend"), std::string::npos);
}

TEST(JoinCodec, an_offer_has_a_hash_for_each_chunk) {
  std::vector<uint8_t> bytes = encode(ClientMessage(OfferMessage{0, {{0, 0, 1}}, {0x0102}}));
  // The message, the offer, and the field of hashes are each a byte longer.
  ASSERT_EQ(bytes.size(), 15U);
  for (const size_t length : {size_t{0}, size_t{5}, size_t{12}}) ++bytes[length];
  bytes.push_back(7);
  const auto decoded = decode_client(samples::body_of(bytes));
  ASSERT_FALSE(decoded);
  EXPECT_NE(decoded.error().message.find("3 bytes of hashes for 1 chunks"), std::string::npos)
      << decoded.error().message;
}

/// The chunks within the largest radius of interest, with the smallest voxels, one in so many.
OfferMessage offer_of_many(size_t count, int one_in) {
  OfferMessage offer{~0ULL, {}, {}};
  const auto reach = static_cast<int>(limits::interest_radius_max_m * 1.1F /
                                      (limits::voxel_size_min_m * static_cast<float>(chunk_size)));
  int n = 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach && offer.chunks.size() < count; ++z)
        if (++n % one_in == 0) offer.chunks.push_back({x, y, z});
  offer.hashes.assign(offer.chunks.size(), 0xFFFF);
  return offer;
}

TEST(JoinCodec, the_most_chunks_that_may_be_offered_fit_into_a_message_and_more_are_refused) {
  for (const int one_in : {1, 61, 190}) {
    const OfferMessage most = offer_of_many(limits::offer_chunks_max, one_in);
    ASSERT_EQ(most.chunks.size(), limits::offer_chunks_max);
    EXPECT_EQ(refusal_of(most), "");
    EXPECT_LE(encode(ClientMessage(most)).size() - length_prefix_bytes, limits::client_message_bytes_max)
        << one_in;
  }
  EXPECT_NE(refusal_of(offer_of_many(limits::offer_chunks_max + 1, 1)).find("more than 8192"),
            std::string::npos);
}

TEST(JoinCodec, more_chunks_kept_than_fit_a_message_or_without_a_hash_are_refused) {
  UnchangedChunksMessage unchanged;
  unchanged.chunks.resize(limits::kept_chunks_max + 1);
  unchanged.hashes.resize(limits::kept_chunks_max + 1);
  EXPECT_FALSE(decode_server(samples::body_of(encode(ServerMessage(unchanged)))));
  unchanged.chunks.pop_back();
  unchanged.hashes.pop_back();
  EXPECT_TRUE(decode_server(samples::body_of(encode(ServerMessage(unchanged)))));
}

TEST(JoinCodec, a_ticket_that_is_too_long_is_refused) {
  HelloMessage hello;
  hello.ticket.assign(limits::ticket_bytes_max, '\xFF');
  EXPECT_TRUE(decode_client(samples::body_of(encode(ClientMessage(hello)))));
  hello.ticket.push_back('x');
  const auto decoded = decode_client(samples::body_of(encode(ClientMessage(hello))));
  ASSERT_FALSE(decoded);
  EXPECT_NE(decoded.error().message.find("ticket has 49 bytes, over the limit of 48"), std::string::npos);
}

}  // namespace
}  // namespace scree
