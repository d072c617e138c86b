// Two ends of motions: a sender whose pieces move and are corrected as the input says, and a receiver that
// follows by the bytes of encode_motions alone; a second receiver gets them damaged.
//
// Holds: the first receiver has the sender's motions after every step; the second refuses or goes on.
#include <cmath>
#include <map>
#include <vector>

#include "proto/known_motions.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr size_t steps_max = 32;
constexpr float voxel_size = 0.25F;

Volume volume_at(glm::vec3 centre_voxels) {
  Volume volume;
  volume.centre_voxels = centre_voxels;
  return volume;
}

/// As decode_volume() lets through: any finite place.
glm::vec3 any_finite(FuzzInput& input) {
  glm::vec3 place = input.place(8000.0F);
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(place[axis])) place[axis] = 0.0F;
  return place;
}

int32_t within(FuzzInput& input, int32_t max) {
  return static_cast<int32_t>(input.number<int32_t>() % (int64_t{max} + 1));
}
glm::ivec3 any_within(FuzzInput& input, int32_t max) {
  const int32_t x = within(input, max);
  const int32_t y = within(input, max);
  return {x, y, within(input, max)};
}

MotionTrend any_trend(FuzzInput& input) {
  MotionTrend trend;
  trend.heat = static_cast<uint8_t>(input.below(MotionTrend::heat_max + 1));
  trend.gain = static_cast<uint8_t>(1 + input.below(MotionTrend::gain_max));
  trend.sign = any_within(input, 1);
  return trend;
}

/// A motion that a server may send whole.
Motion any_motion(FuzzInput& input) {
  Motion motion = resting_at(
      {within(input, 1 << 26), within(input, 1 << 26), within(input, 1 << 26), input.number<uint32_t>()});
  motion.mode = static_cast<MotionMode>(input.below(motion_modes));
  if (motion.mode == MotionMode::rest) return motion;
  motion.velocity = any_within(input, motion_velocity_max);
  motion.spin = any_within(input, motion_spin_max);
  motion.position_trend = any_trend(input);
  motion.rotation_trend = any_trend(input);
  return motion;
}

std::optional<Correction> any_correction(FuzzInput& input) {
  const uint32_t kind = input.below(4);
  if (kind == 0) return std::nullopt;
  const int32_t max = kind == 3 ? 0x7FFFFFFF : (1 << (kind * 6));
  Correction correction;
  correction.mode = static_cast<MotionMode>(input.below(motion_modes));
  if (input.flag()) correction.position = any_within(input, max);
  if (input.flag()) correction.rotation = any_within(input, max);
  return correction;
}

class Ends {
 public:
  explicit Ends(FuzzInput& input)
      : rules_(motion_rules(10 + input.below(240), 1 + input.below(12))),
        receiver_(rules_, voxel_size),
        damaged_(rules_, voxel_size) {
    const uint32_t count = 1 + input.below(8);
    for (PieceId id = 1; id <= count; ++id) add(id * (1 + input.below(3)) + id * 4, input);
  }

  void step(FuzzInput& input) {
    std::vector<WholeMotion> wholes;
    std::vector<MotionStep> steps;
    std::map<PieceId, std::optional<Correction>> corrections;
    std::map<PieceId, Motion> after;
    for (const auto& [id, motion] : motions_) {
      if (!motion || input.below(16) == 15) {
        if (!motion && !input.flag()) continue;
        wholes.push_back({id, after[id] = any_motion(input)});
        continue;
      }
      const auto& correction = corrections[id] = any_correction(input);
      steps.push_back({id, &*motion, motion_check(id, *motion), &correction});
      after[id] =
          motion->mode == MotionMode::rest && !correction ? *motion : advance(*motion, correction, rules_);
    }
    const std::vector<uint8_t> bytes = encode_motions(wholes, steps);
    CHECK(receiver_.advance(bytes).has_value());
    damage(bytes, input);
    for (const auto& [id, motion] : after) motions_[id] = motion;
    for (const auto& [id, motion] : motions_) {
      const Motion* got = receiver_.motion(id);
      CHECK((got != nullptr) == motion.has_value());
      CHECK(got == nullptr || *got == *motion);
    }
  }

 private:
  void add(PieceId id, FuzzInput& input) {
    if (motions_.contains(id)) return;
    const Volume volume = volume_at(any_finite(input));
    const bool cut = input.flag();
    for (KnownMotions* known : {&receiver_, &damaged_}) {
      if (cut)
        known->add_made(id, volume, std::nullopt);
      else
        known->add(id, volume);
    }
    motions_[id] = cut ? std::optional(*receiver_.motion(id)) : std::nullopt;
  }

  /// After an error the motions are of no use.
  void damage(std::vector<uint8_t> bytes, FuzzInput& input) {
    if (lost_ || bytes.empty()) return;
    for (uint32_t changes = input.below(4); changes > 0; --changes)
      bytes[input.number<uint16_t>() % bytes.size()] ^= input.byte();
    if (input.below(8) == 7) bytes.resize(input.byte() % bytes.size());
    lost_ = !damaged_.advance(bytes).has_value();
  }

  MotionRules rules_;
  KnownMotions receiver_;
  KnownMotions damaged_;
  bool lost_ = false;
  std::map<PieceId, std::optional<Motion>> motions_;
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::FuzzInput input(data, size);
  scree::Ends ends(input);
  for (size_t step = 0; step < scree::steps_max && !input.at_end(); ++step) ends.step(input);
  return 0;
}
