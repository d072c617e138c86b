// Decoders meet every truncation, every damaged byte, and seeded noise: they may refuse, never crash, and
// what they accept they can encode again.
#include <cstdlib>
#include <gtest/gtest.h>

#include "proto/known_motions.h"
#include "proto/operation_codec.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

constexpr uint8_t damages[] = {0x01, 0x80, 0xFF, 0x7F, 0x10};

void decode_everything(std::span<const uint8_t> bytes) {
  if (const Result<ServerMessage> message = decode_server(bytes)) {
    EXPECT_GE(encode(*message).size(), length_prefix_bytes);
  }
  if (const Result<ClientMessage> message = decode_client(bytes)) {
    EXPECT_GE(encode(*message).size(), length_prefix_bytes);
  }
}

void decode_packed(std::span<const uint8_t> bytes) {
  if (const Result<std::vector<Operation>> got = decode_operations(bytes)) {
    EXPECT_LE(encode_operations(*got).size(), bytes.size());
  }
  if (const Result<std::vector<PieceState>> got = unpack_transforms(bytes)) {
    EXPECT_LE(pack_transforms(*got).size(), bytes.size());
  }
  KnownMotions motions(motion_rules(60, 3), 0.25F);
  for (const PieceId id : {3U, 900U}) motions.add(id, samples::volume());
  motions.add_made(77, samples::volume(), std::nullopt);
  (void)motions.advance(bytes);
  (void)decode_bricks(bytes);
  (void)decode_volume(bytes);
}

std::vector<std::vector<uint8_t>> corpus() {
  std::vector<std::vector<uint8_t>> bodies;
  const auto add = [&](const std::vector<uint8_t>& framed) {
    const std::span<const uint8_t> body = samples::body_of(framed);
    bodies.emplace_back(body.begin(), body.end());
  };
  for (const ServerMessage& message : samples::server_messages()) add(encode(message));
  for (const ClientMessage& message : samples::client_messages()) add(encode(message));
  return bodies;
}

TEST(CodecFuzz, every_truncation_is_survived) {
  for (const std::vector<uint8_t>& body : corpus())
    for (size_t length = 0; length < body.size(); ++length) decode_everything(std::span(body).first(length));
}

TEST(CodecFuzz, every_damaged_byte_is_survived) {
  for (std::vector<uint8_t> body : corpus())
    for (uint8_t& byte : body)
      for (const uint8_t damage : damages) {
        byte ^= damage;
        decode_everything(body);
        byte ^= damage;
      }
}

TEST(CodecFuzz, seeded_noise_is_survived) {
  const char* given = std::getenv("SCREE_FUZZ_SEED");
  const uint64_t random_seed = given != nullptr ? std::strtoull(given, nullptr, 10) : 20160501;
  RecordProperty("random_seed", std::to_string(random_seed));
  std::printf("fuzz random seed %llu (SCREE_FUZZ_SEED)\n", static_cast<unsigned long long>(random_seed));
  Random random(random_seed);
  std::vector<std::vector<uint8_t>> bodies = corpus();
  bodies.push_back(encode_operations(samples::frame().operations));
  bodies.push_back(samples::frame().transforms);
  bodies.push_back(samples::frame().motions);
  bodies.push_back(encode_volume(samples::volume()));
  bodies.push_back(encode_bricks(samples::frame().patches));
  for (int round = 0; round < 20000; ++round) {
    std::vector<uint8_t> bytes = bodies[random.below(static_cast<uint32_t>(bodies.size()))];
    for (uint32_t change = random.below(8) + 1; change > 0 && !bytes.empty(); --change) {
      const auto at = static_cast<ptrdiff_t>(random.below(static_cast<uint32_t>(bytes.size())));
      const auto byte = static_cast<uint8_t>(random.below(256));
      switch (random.below(4)) {
        case 0:
          bytes.erase(bytes.begin() + at);
          break;
        case 1:
          bytes.insert(bytes.begin() + at, byte);
          break;
        default:
          bytes[static_cast<size_t>(at)] = byte;
      }
    }
    decode_everything(bytes);
    decode_packed(bytes);
  }
}

}  // namespace
}  // namespace scree
