// The integer model of motion: it foresees free flight, keeps its bounds whatever it is given, and its codec
// gives back what was coded.
#include "proto/motion.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "proto/known_motions.h"
#include "proto/range_coder.h"
#include "shared/base/random.h"

namespace scree {
namespace {

constexpr double degrees = 180.0 / 3.14159265358979;

double degrees_between(const glm::quat& a, const glm::quat& b) {
  const double cosine =
      std::abs(double{a.w} * b.w + double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z);
  return 2.0 * std::acos(std::min(cosine, 1.0)) * degrees;
}

int32_t within(Random& random, int32_t most) {
  return static_cast<int32_t>(random.below(2 * static_cast<uint32_t>(most) + 1)) - most;
}

glm::ivec3 some_vector(Random& random, int32_t most) {
  return {within(random, most), within(random, most), within(random, most)};
}

Motion some_motion(Random& random) {
  Motion motion =
      resting_at({within(random, 100000), within(random, 5000), within(random, 100000), random.next()});
  motion.mode = static_cast<MotionMode>(random.below(motion_modes));
  if (motion.mode == MotionMode::rest) return motion;
  motion.velocity = some_vector(random, 50000);
  motion.spin = some_vector(random, 100000);
  for (MotionTrend* trend : {&motion.position_trend, &motion.rotation_trend})
    *trend = {static_cast<uint8_t>(random.below(64)), static_cast<uint8_t>(1 + random.below(16)),
              some_vector(random, 1)};
  return motion;
}

std::optional<Correction> some_correction(Random& random) {
  if (random.below(3) == 0) return std::nullopt;
  const int32_t most = random.below(8) == 0 ? 100000 : 3;
  return Correction{static_cast<MotionMode>(random.below(motion_modes)), some_vector(random, most),
                    random.below(2) == 0 ? glm::ivec3(0) : some_vector(random, most)};
}

TEST(Motion, a_throw_is_foreseen_for_two_seconds) {
  const MotionRules rules = motion_rules(60, 1);
  Motion motion = born_at({1.0F, 2.0F, 3.0F});
  motion.velocity = glm::ivec3(64 * motion_steps_per_m / 60, 128 * motion_steps_per_m / 60, 0);
  motion.spin = {0, static_cast<int32_t>(std::tan(0.5 * 3.0 / 60.0) * motion_one), 0};
  double x_m = 1.0, y_m = 2.0, x_m_s = 4.0, y_m_s = 8.0, turned_rad = 0.0, spin_rad_s = 3.0;
  for (int tick = 0; tick < 120; ++tick) {
    motion = advance(motion, std::nullopt, rules);
    x_m_s *= 1.0 - 0.05 / 60.0;
    y_m_s = y_m_s * (1.0 - 0.05 / 60.0) - 9.81 / 60.0;
    spin_rad_s *= 1.0 - 0.2 / 60.0;
    x_m += x_m_s / 60.0;
    y_m += y_m_s / 60.0;
    turned_rad += spin_rad_s / 60.0;
  }
  const Pose pose = pose_of(motion);
  EXPECT_NEAR(pose.position_m.x, x_m, 0.02);
  EXPECT_NEAR(pose.position_m.y, y_m, 0.02);
  EXPECT_FLOAT_EQ(pose.position_m.z, 3.0F);
  const auto half = static_cast<float>(turned_rad / 2.0);
  EXPECT_LT(degrees_between(pose.rotation, {std::cos(half), 0.0F, std::sin(half), 0.0F}), 0.5);
}

TEST(Motion, a_pose_at_rest_stays_and_is_as_exact_as_it_was_packed) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const QuantisedPose packed{within(random, 1 << 20), within(random, 1 << 20), within(random, 1 << 20),
                               random.next()};
    const Motion motion = resting_at(packed);
    EXPECT_EQ(advance(motion, std::nullopt, motion_rules(60, 3)), motion);
    EXPECT_LT(glm::distance(pose_of(motion).position_m, dequantise(packed).position_m), 1e-3F);
    EXPECT_LT(degrees_between(pose_of(motion).rotation, dequantise(packed).rotation), 0.05);
  }
}

TEST(Motion, a_turn_leads_from_one_rotation_to_the_other) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const glm::ivec4 from = resting_at({0, 0, 0, random.next()}).rotation;
    const glm::ivec4 to = turned(from, some_vector(random, 1 << 18));
    const glm::ivec3 turn = turn_between(from, to);
    const glm::ivec4 again = turned(from, turn);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(again[c], to[c], 2000);
  }
}

TEST(Motion, numbers_keep_their_bounds_and_rotations_their_length_whatever_is_corrected) {
  Random random(5);
  for (const MotionRules& rules : {motion_rules(60, 1), motion_rules(10, 1000), motion_rules(1000, 1)}) {
    Motion motion = some_motion(random);
    for (int i = 0; i < 20000; ++i) {
      std::optional<Correction> correction = some_correction(random);
      if (correction && random.below(4) == 0) correction->position = some_vector(random, 0x7FFFFFFF / 2);
      if (correction && random.below(4) == 0) correction->rotation = some_vector(random, 0x7FFFFFFF / 2);
      motion = advance(motion, correction, rules);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_LE(std::abs(int64_t{motion.position[axis]}), motion_position_max);
        ASSERT_LE(std::abs(motion.velocity[axis]), motion_velocity_max);
        ASSERT_LE(std::abs(motion.spin[axis]), motion_spin_max);
      }
      const glm::dvec4 q(motion.rotation);
      ASSERT_NEAR(std::sqrt(glm::dot(q, q)), double{motion_one}, 3.0);
    }
  }
}

TEST(Motion, roots_of_squares_and_of_their_neighbours_are_exact) {
  for (int64_t n = 1; n < (int64_t{1} << 25); n += 9973) {
    ASSERT_EQ(floor_root(n * n), n);
    ASSERT_EQ(floor_root(n * n - 1), n - 1);
  }
}

TEST(RangeCoder, bits_come_back_and_likely_ones_take_less_than_a_bit) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const uint32_t one_in = 1 + random.below(300);
    const uint32_t count = random.below(3000);
    std::vector<bool> bits;
    for (uint32_t i = 0; i < count; ++i) bits.push_back(random.below(one_in) == 0);
    std::vector<uint8_t> bytes;
    RangeEncoder encoder(bytes);
    BitModel written;
    for (const bool bit : bits) {
      encoder.bit(written, bit);
      encoder.plain(bit ? 5 : 2, 3);
    }
    encoder.finish();
    RangeDecoder decoder(bytes);
    BitModel read;
    for (const bool bit : bits) {
      ASSERT_EQ(decoder.bit(read), bit) << "seed " << seed;
      ASSERT_EQ(decoder.plain(3), bit ? 5U : 2U);
    }
    EXPECT_TRUE(decoder.at_end());
  }
  std::vector<uint8_t> bytes;
  RangeEncoder encoder(bytes);
  BitModel model;
  for (int i = 0; i < 10000; ++i) encoder.bit(model, false);
  encoder.finish();
  EXPECT_LT(bytes.size(), 20U);
}

struct CodedMotions {
  std::vector<WholeMotion> wholes;
  std::vector<Motion> before;
  std::vector<std::optional<Correction>> corrections;
  std::vector<MotionStep> steps;
  std::vector<MotionBefore> known;

  explicit CodedMotions(Random& random) {
    PieceId id = 0;
    const uint32_t count = random.below(60);
    for (uint32_t i = 0; i < count; ++i) {
      before.push_back(some_motion(random));
      corrections.push_back(some_correction(random));
    }
    for (uint32_t i = 0; i < count; ++i) {
      id += 1 + random.below(random.below(20) == 0 ? 1000000 : 3);
      if (random.below(3) == 0) {
        wholes.push_back({id, before[i]});
        continue;
      }
      steps.push_back({id, &before[i], motion_check(id, before[i]), &corrections[i]});
      known.push_back({id, &before[i], motion_check(id, before[i])});
    }
  }
  Result<DecodedMotions> decode(std::span<const uint8_t> bytes) const {
    return decode_motions(bytes, 1000, [&](auto) { return known; });
  }
};

TEST(MotionCodec, motions_come_back_bit_for_bit) {
  for (uint64_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    const CodedMotions coded(random);
    const auto got = coded.decode(encode_motions(coded.wholes, coded.steps));
    ASSERT_TRUE(got.has_value()) << got.error().message << ", seed " << seed;
    ASSERT_EQ(got->wholes.size(), coded.wholes.size());
    for (size_t i = 0; i < got->wholes.size(); ++i) {
      EXPECT_EQ(got->wholes[i].id, coded.wholes[i].id);
      EXPECT_EQ(got->wholes[i].motion, coded.wholes[i].motion);
    }
    ASSERT_EQ(got->corrections.size(), coded.steps.size());
    for (size_t i = 0; i < coded.steps.size(); ++i)
      EXPECT_EQ(got->corrections[i], *coded.steps[i].correction) << "seed " << seed;
  }
}

TEST(MotionCodec, nothing_takes_no_bytes_and_a_thousand_at_rest_a_few) {
  EXPECT_TRUE(encode_motions({}, {}).empty());
  const Motion resting = resting_at({1, 2, 3, 4});
  const std::optional<Correction> none;
  std::vector<MotionStep> steps;
  for (PieceId id = 1; id <= 1000; ++id) steps.push_back({id, &resting, motion_check(id, resting), &none});
  EXPECT_LT(encode_motions({}, steps).size(), 12U);
}

TEST(MotionCodec, a_receiver_that_knows_other_pieces_or_other_motions_is_told_so) {
  Random random(8);
  CodedMotions coded(random);
  while (coded.known.size() < 3) coded = CodedMotions(random);
  const std::vector<uint8_t> bytes = encode_motions(coded.wholes, coded.steps);
  ASSERT_TRUE(coded.decode(bytes).has_value());
  std::vector<MotionBefore> known = coded.known;
  const auto decode = [&] { return decode_motions(bytes, 1000, [&](auto) { return known; }); };
  known.pop_back();
  EXPECT_FALSE(decode().has_value()) << "one piece fewer";
  known = coded.known;
  known[1].check = motion_check(known[1].id ^ 0x1000U, *known[1].motion);
  EXPECT_FALSE(decode().has_value()) << "another piece";
  known = coded.known;
  Motion other = *known[1].motion;
  other.velocity.x += 1;
  known[1].motion = &other;
  known[1].check = motion_check(known[1].id, other);
  EXPECT_FALSE(decode().has_value()) << "another velocity";
}

TEST(MotionCodec, hostile_bytes_are_refused_or_give_bounded_motions) {
  Random random(9);
  for (int round = 0; round < 3000; ++round) {
    const CodedMotions coded(random);
    std::vector<uint8_t> bytes = encode_motions(coded.wholes, coded.steps);
    if (bytes.empty()) continue;
    if (random.below(2) == 0) bytes.resize(random.below(static_cast<uint32_t>(bytes.size()) + 1));
    for (uint32_t i = random.below(4); i > 0 && !bytes.empty(); --i)
      bytes[random.below(static_cast<uint32_t>(bytes.size()))] ^= static_cast<uint8_t>(1 + random.below(255));
    const auto got = coded.decode(bytes);
    if (!got) continue;
    ASSERT_LE(got->wholes.size(), 1000U);
    for (const WholeMotion& whole : got->wholes) {
      const glm::dvec4 q(whole.motion.rotation);
      EXPECT_NEAR(std::sqrt(glm::dot(q, q)), double{motion_one}, 64.0);
      advance(whole.motion, std::nullopt, motion_rules(60, 3));
    }
  }
}

TEST(MotionCodec, more_whole_motions_than_pieces_and_bytes_too_many_are_refused) {
  const WholeMotion wholes[] = {{1, resting_at({})}, {2, resting_at({})}};
  std::vector<uint8_t> bytes = encode_motions(wholes, {});
  const auto decode = [&](size_t wholes_max) {
    return decode_motions(bytes, wholes_max, [](auto) { return std::vector<MotionBefore>(); });
  };
  EXPECT_TRUE(decode(2).has_value());
  EXPECT_FALSE(decode(1).has_value());
  bytes.insert(bytes.end(), 8, 0x55);
  EXPECT_FALSE(decode(2).has_value());
}

TEST(MotionCodec, places_come_back_however_far_they_are_apart) {
  // 131 km between: in steps 2^31, which an int32_t has as a negative number only.
  constexpr int32_t far = 1 << 26;
  const WholeMotion wholes[] = {{1, resting_at({far, -far, 0, 0})},
                                {2, resting_at({-far, far, 0, 0})},
                                {3, resting_at({far, 0, far, 0})}};
  const auto got =
      decode_motions(encode_motions(wholes, {}), 3, [](auto) { return std::vector<MotionBefore>(); });
  ASSERT_TRUE(got.has_value()) << got.error().message;
  ASSERT_EQ(got->wholes.size(), 3U);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(got->wholes[i].motion.position, wholes[i].motion.position);
}

TEST(KnownMotions, a_motion_of_a_piece_that_is_not_there_is_refused) {
  Volume volume;
  volume.centre_voxels = {4.0F, 8.0F, -2.0F};
  KnownMotions known(motion_rules(60, 3), 0.25F);
  known.add(1, volume);
  known.add_made(2, volume, std::nullopt);
  known.add_made(3, volume, 1);
  EXPECT_EQ(known.motion(1), nullptr) << "it was sent whole";
  ASSERT_NE(known.motion(2), nullptr);
  EXPECT_EQ(known.motion(2)->position, glm::ivec3(1, 2, 0) * motion_steps_per_m - glm::ivec3(0, 0, 8192));
  EXPECT_EQ(known.motion(3), nullptr) << "its parent's motion is not known";
  const std::optional<Correction> none;
  const MotionStep step{2, known.motion(2), motion_check(2, *known.motion(2)), &none};
  const WholeMotion of_one[] = {{1, resting_at({1, 2, 3, 4})}};
  const auto moved = known.advance(encode_motions(of_one, {&step, 1}));
  ASSERT_TRUE(moved.has_value()) << moved.error().message;
  EXPECT_EQ(*moved, (std::vector<PieceId>{1, 2}));
  EXPECT_EQ(*known.motion(1), of_one[0].motion);
  const WholeMotion of_nobody[] = {{9, resting_at({})}};
  EXPECT_FALSE(known.advance(encode_motions(of_nobody, {})).has_value());
}

}  // namespace
}  // namespace scree
