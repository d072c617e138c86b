#include "proto/motion_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/range_coder.h"
#include "shared/base/check.h"

// One description of the layout serves both ways: code() with a Writer takes the value, with a Reader any
// value, and both return the value.
namespace scree {

namespace {

constexpr const char* subject = "motions";
constexpr uint32_t heat_classes = 4;

uint32_t class_of(const MotionTrend& trend) {
  return trend.heat >> 4U;
}

class Writer {
 public:
  explicit Writer(std::vector<uint8_t>& bytes) : coder_(bytes) {}
  bool bit(BitModel& model, bool value) {
    coder_.bit(model, value);
    return value;
  }
  uint32_t plain(uint32_t value, uint32_t count) {
    coder_.plain(value, count);
    return value & ((1U << count) - 1U);
  }
  void finish() { coder_.finish(); }

 private:
  RangeEncoder coder_;
};

class Reader {
 public:
  explicit Reader(std::span<const uint8_t> bytes) : coder_(bytes) {}
  bool bit(BitModel& model, bool /*value*/) { return coder_.bit(model); }
  uint32_t plain(uint32_t /*value*/, uint32_t count) { return coder_.plain(count); }
  bool at_end() const { return coder_.at_end(); }

 private:
  RangeDecoder coder_;
};

uint32_t magnitude(int32_t n) {
  return n < 0 ? 0U - static_cast<uint32_t>(n) : static_cast<uint32_t>(n);
}

/// Numbers of which small ones are frequent, by Elias' gamma code of n + 1: how many digits follow the first,
/// a one for each and a zero; then these digits, the first of them learnt.
struct NumberModel {
  static constexpr uint32_t digits_max = 31;
  std::array<BitModel, 12> longer;
  std::array<BitModel, 4> highest;

  explicit NumberModel(uint32_t longer_in_64 = 32) { longer.fill(BitModel(longer_in_64)); }
};

/// 0 to 2^31; what a Reader returns may be larger.
template <typename Coder>
uint32_t code(Coder& coder, NumberModel& model, uint32_t number) {
  const auto width = static_cast<uint32_t>(std::bit_width(number + 1U)) - 1U;
  uint32_t digits = 0;
  while (digits < NumberModel::digits_max && coder.bit(model.longer[std::min(digits, 11U)], digits < width))
    ++digits;
  if (digits == 0) return 0;
  const uint32_t low = digits - 1U;
  const bool high = coder.bit(model.highest[std::min(low, 3U)], (((number + 1U) >> low) & 1U) != 0);
  return ((2U | (high ? 1U : 0U)) << low) + coder.plain(number + 1U, low) - 1U;
}

/// The nearest number that there is: differences of places have all of them, -2^31 as well.
int32_t with_sign(uint32_t size, bool negative) {
  return static_cast<int32_t>(negative ? -int64_t{std::min(size, 0x80000000U)}
                                       : int64_t{std::min(size, 0x7FFFFFFFU)});
}

struct SignedModel {
  NumberModel size;
  BitModel negative;
};

template <typename Coder>
int32_t code(Coder& coder, SignedModel& model, int32_t number) {
  const uint32_t size = code(coder, model.size, magnitude(number));
  return size == 0 ? 0 : with_sign(size, coder.bit(model.negative, number < 0));
}

template <typename Coder>
glm::ivec3 code(Coder& coder, SignedModel& model, glm::ivec3 v) {
  const int32_t x = code(coder, model, v.x);
  const int32_t y = code(coder, model, v.y);
  return {x, y, code(coder, model, v.z)};
}

/// Models of a correction's three numbers, which are usually not all zero.
struct CorrectionModel {
  /// By heat; by the numbers before (there is none, all are zero, else); by axis.
  std::array<std::array<std::array<BitModel, 3>, 3>, heat_classes> some;
  std::array<NumberModel, heat_classes> size;
  std::array<BitModel, 3> negative;

  CorrectionModel() {
    for (uint32_t heat = 0; heat < heat_classes; ++heat) size[heat] = NumberModel(12 + 12 * heat);
  }
};

template <typename Coder>
glm::ivec3 code(Coder& coder, CorrectionModel& model, uint32_t heat, glm::ivec3 v) {
  glm::ivec3 got{0};
  uint32_t before = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<size_t>(axis);
    const bool some = coder.bit(model.some[heat][before][at], v[axis] != 0);
    if (some) {
      const uint32_t size = code(coder, model.size[heat], std::max(magnitude(v[axis]), 1U) - 1U);
      got[axis] =
          with_sign(size == 0xFFFFFFFFU ? size : size + 1U, coder.bit(model.negative[at], v[axis] < 0));
    }
    before = some ? 2 : std::max(before, 1U);
  }
  return got;
}

struct WholeModel {
  NumberModel count, id;
  SignedModel position, velocity, spin, largest;
};

struct StepModel {
  BitModel woken{1};
  std::array<std::array<BitModel, heat_classes>, heat_classes> told;  ///< by both heats
  std::array<std::array<BitModel, 2>, motion_modes> mode;             ///< by the mode before
  std::array<std::array<BitModel, heat_classes>, motion_modes> moved;
  std::array<std::array<std::array<BitModel, heat_classes>, 2>, motion_modes> turned;  ///< by moved, too
  CorrectionModel position, rotation;

  StepModel() {
    for (uint32_t p = 0; p < heat_classes; ++p)
      for (uint32_t r = 0; r < heat_classes; ++r) told[p][r] = BitModel(std::min(8 + 12 * (p + r), 60U));
    for (uint32_t from = 0; from < motion_modes; ++from)
      mode[from] = {BitModel(from == 0 ? 32 : 4), BitModel(32)};
  }
};

template <typename Coder>
MotionMode code(Coder& coder, std::array<BitModel, 2>& model, MotionMode before, MotionMode now) {
  if (!coder.bit(model[0], now != before)) return before;
  const auto from = static_cast<uint32_t>(before);
  const auto next = static_cast<MotionMode>((from + 1U) % motion_modes);
  const auto other = static_cast<MotionMode>((from + 2U) % motion_modes);
  return coder.bit(model[1], now == other) ? other : next;
}

template <typename Coder>
std::optional<Correction> code(Coder& coder, StepModel& model, const Motion& before,
                               const std::optional<Correction>& correction) {
  const uint32_t position_heat = class_of(before.position_trend);
  const uint32_t rotation_heat = class_of(before.rotation_trend);
  const bool rests = before.mode == MotionMode::rest;
  BitModel& told = rests ? model.woken : model.told[position_heat][rotation_heat];
  if (!coder.bit(told, correction.has_value())) return std::nullopt;
  const Correction from = correction.value_or(Correction{});
  const auto mode = static_cast<size_t>(before.mode);
  Correction to;
  to.mode = code(coder, model.mode[mode], before.mode, from.mode);
  const bool moved = coder.bit(model.moved[mode][position_heat], from.position != glm::ivec3(0));
  if (moved) to.position = code(coder, model.position, position_heat, from.position);
  const bool turned =
      coder.bit(model.turned[mode][moved ? 1 : 0][rotation_heat], from.rotation != glm::ivec3(0));
  if (turned) to.rotation = code(coder, model.rotation, rotation_heat, from.rotation);
  return to;
}

/// The three smaller ones plainly; the largest follows from them, but for a rounding.
template <typename Coder>
glm::ivec4 code_rotation(Coder& coder, SignedModel& model, const glm::ivec4& q) {
  uint32_t largest = 0;
  for (uint32_t i = 1; i < 4; ++i)
    if (magnitude(q[static_cast<int>(i)]) > magnitude(q[static_cast<int>(largest)])) largest = i;
  largest = coder.plain(largest, 2);
  const bool negative = coder.plain(q[static_cast<int>(largest)] < 0 ? 1 : 0, 1) != 0;
  glm::ivec4 got{0};
  int64_t rest = int64_t{motion_one} * motion_one;
  for (int i = 0; i < 4; ++i) {
    if (i == static_cast<int>(largest)) continue;
    got[i] = static_cast<int32_t>(coder.plain(static_cast<uint32_t>(q[i] + motion_one), 21)) - motion_one;
    rest -= int64_t{got[i]} * got[i];
  }
  const auto expected = static_cast<int32_t>(floor_root(std::max<int64_t>(rest, 0)));
  const int32_t off =
      code(coder, model, static_cast<int32_t>(magnitude(q[static_cast<int>(largest)])) - expected);
  const int32_t size = expected + std::clamp(off, -motion_one, motion_one);
  got[static_cast<int>(largest)] = negative ? -size : size;
  return got;
}

template <typename Coder>
MotionTrend code(Coder& coder, const MotionTrend& trend) {
  MotionTrend got;
  got.heat = static_cast<uint8_t>(coder.plain(trend.heat, 6));
  got.gain = static_cast<uint8_t>(coder.plain(trend.gain - 1U, 4) + 1U);
  for (int axis = 0; axis < 3; ++axis)
    got.sign[axis] = static_cast<int32_t>(coder.plain(static_cast<uint32_t>(trend.sign[axis] + 1), 2)) - 1;
  return got;
}

template <typename Coder>
WholeMotion code(Coder& coder, WholeModel& model, const WholeMotion& before, const WholeMotion& whole) {
  const Motion& from = whole.motion;
  WholeMotion got;
  Motion& to = got.motion;
  got.id = before.id + code(coder, model.id, whole.id - before.id);
  to.mode = static_cast<MotionMode>(coder.plain(static_cast<uint32_t>(from.mode), 2));
  for (int axis = 0; axis < 3; ++axis) {
    const auto last = static_cast<uint32_t>(before.motion.position[axis]);
    const auto off = static_cast<int32_t>(static_cast<uint32_t>(from.position[axis]) - last);
    to.position[axis] = static_cast<int32_t>(static_cast<uint32_t>(code(coder, model.position, off)) + last);
  }
  to.rotation = code_rotation(coder, model.largest, from.rotation);
  if (to.mode == MotionMode::rest) return got;
  to.velocity = code(coder, model.velocity, from.velocity);
  to.spin = code(coder, model.spin, from.spin);
  to.position_trend = code(coder, from.position_trend);
  to.rotation_trend = code(coder, from.rotation_trend);
  return got;
}

bool is_within(glm::ivec3 v, int32_t max) {
  return std::max({magnitude(v.x), magnitude(v.y), magnitude(v.z)}) <= static_cast<uint32_t>(max);
}

bool is_sound(const Motion& motion) {
  const glm::i64vec4 q(motion.rotation);
  const int64_t square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const int64_t off = square - int64_t{motion_one} * motion_one;
  constexpr int64_t rounding = int64_t{1} << 26;
  return static_cast<uint32_t>(motion.mode) < motion_modes && off <= rounding && off >= -rounding &&
         is_within(motion.position, motion_position_max) && is_within(motion.velocity, motion_velocity_max) &&
         is_within(motion.spin, motion_spin_max) && is_within(motion.position_trend.sign, 1) &&
         is_within(motion.rotation_trend.sign, 1);
}

}  // namespace

uint32_t motion_check(PieceId id, const Motion& motion) {
  uint32_t sum = 0;
  const auto add = [&](uint32_t value) { sum = (sum + value) * 2654435761U; };
  add(id);
  for (int axis = 0; axis < 3; ++axis) {
    add(static_cast<uint32_t>(motion.position[axis]));
    add(static_cast<uint32_t>(motion.velocity[axis]));
    add(static_cast<uint32_t>(motion.rotation[axis]));
  }
  return sum;
}

std::vector<uint8_t> encode_motions(std::span<const WholeMotion> wholes, std::span<const MotionStep> steps) {
  std::vector<uint8_t> bytes;
  if (wholes.empty() && steps.empty()) return bytes;
  uint32_t check = 0;
  for (const MotionStep& step : steps) check += step.check;
  ByteWriter head(bytes);
  head.varint(steps.size());
  head.u8(static_cast<uint8_t>(check >> 24U));
  Writer writer(bytes);
  WholeModel whole_model;
  code(writer, whole_model.count, static_cast<uint32_t>(wholes.size()));
  WholeMotion before;
  for (const WholeMotion& whole : wholes) {
    CHECK_DEBUG(is_sound(whole.motion));
    code(writer, whole_model, before, whole);
    before = whole;
  }
  StepModel model;
  for (const MotionStep& step : steps) code(writer, model, *step.before, *step.correction);
  writer.finish();
  return bytes;
}

Result<DecodedMotions> decode_motions(
    std::span<const uint8_t> bytes, size_t wholes_max,
    const std::function<std::vector<MotionBefore>(std::span<const WholeMotion>)>& steps_besides) {
  DecodedMotions decoded;
  if (bytes.empty()) return decoded;
  ByteReader head(bytes, subject);
  const uint64_t count = head.varint("count of steps");
  const uint8_t check_byte = head.u8("check", 0xFF);
  const std::span<const uint8_t> rest = head.rest();
  if (head.failed()) return tl::unexpected(head.error());
  Reader reader(rest);
  WholeModel whole_model;
  const uint32_t wholes = code(reader, whole_model.count, 0);
  if (wholes > wholes_max) return fail("motions: more whole ones than pieces");
  WholeMotion before;
  for (uint32_t i = 0; i < wholes; ++i) {
    const WholeMotion whole = code(reader, whole_model, before, WholeMotion{});
    if (i > 0 && whole.id <= before.id) return fail("motions: piece ids are not in ascending order");
    if (!is_sound(whole.motion)) return fail("motions: a number is out of range");
    decoded.wholes.push_back(whole);
    before = whole;
  }
  const std::vector<MotionBefore> steps = steps_besides(decoded.wholes);
  uint32_t check = 0;
  for (const MotionBefore& step : steps) check += step.check;
  if (steps.size() != count || check >> 24U != check_byte)
    return fail(
        fmt::format("motions: of {} pieces, and {} are known here, or move otherwise", count, steps.size()));
  StepModel model;
  decoded.corrections.reserve(steps.size());
  for (const MotionBefore& step : steps)
    decoded.corrections.push_back(code(reader, model, *step.motion, std::nullopt));
  if (!reader.at_end()) return fail("motions: remaining bytes");
  return decoded;
}

}  // namespace scree
