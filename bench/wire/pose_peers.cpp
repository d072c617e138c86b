#include "bench/wire/pose_peers.h"

#include <array>
#include <cstring>

namespace scree {

namespace {

struct FloatBody {
  PieceId id = 0;
  std::array<float, 7> pose{};
};

class BitWriter {
 public:
  void bits(uint32_t value, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      if (used_ % 8 == 0) bytes.push_back(0);
      bytes.back() = static_cast<uint8_t>(bytes.back() | (((value >> i) & 1U) << (used_ % 8)));
      ++used_;
    }
  }
  std::vector<uint8_t> bytes;

 private:
  uint32_t used_ = 0;
};

class BitReader {
 public:
  explicit BitReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  uint32_t bits(uint32_t count) {
    uint32_t value = 0;
    for (uint32_t i = 0; i < count; ++i, ++used_)
      value |= ((static_cast<uint32_t>(bytes_[used_ / 8]) >> (used_ % 8)) & 1U) << i;
    return value;
  }

 private:
  std::span<const uint8_t> bytes_;
  uint32_t used_ = 0;
};

using Three = std::array<int32_t, 3>;

Three components(uint32_t rotation) {
  const auto part = [&](uint32_t low_bit) { return static_cast<int32_t>((rotation >> low_bit) & 1023U); };
  return {part(20), part(10), part(0)};
}

bool fit(const Three& off, uint32_t bits) {
  const int32_t half = 1 << (bits - 1U);
  for (const int32_t n : off)
    if (n < -half || n >= half) return false;
  return true;
}

/// Whether one of the two widths holds them, and which.
bool write_off(BitWriter& writer, const Three& off, uint32_t narrow, uint32_t wide) {
  const bool is_narrow = fit(off, narrow), is_wide = fit(off, wide);
  writer.bits(is_narrow ? 1 : 0, 1);
  if (!is_narrow) writer.bits(is_wide ? 1 : 0, 1);
  if (!is_wide) return false;
  for (const int32_t n : off) writer.bits(static_cast<uint32_t>(n), is_narrow ? narrow : wide);
  return true;
}

bool read_off(BitReader& reader, Three& off, uint32_t narrow, uint32_t wide) {
  const bool is_narrow = reader.bits(1) != 0;
  if (!is_narrow && reader.bits(1) == 0) return false;
  const uint32_t width = is_narrow ? narrow : wide;
  for (int32_t& n : off) n = static_cast<int32_t>(reader.bits(width) << (32U - width)) >> (32U - width);
  return true;
}

void write_pose(BitWriter& writer, const QuantisedPose& base, const QuantisedPose& now) {
  if (!write_off(writer, {now.x - base.x, now.y - base.y, now.z - base.z}, 5, 9))
    for (const int32_t n : {now.x, now.y, now.z}) writer.bits(static_cast<uint32_t>(n), 18);
  const Three a = components(base.rotation), b = components(now.rotation);
  const bool same = now.rotation >> 30U == base.rotation >> 30U;
  writer.bits(same ? 1 : 0, 1);
  if (!same || !write_off(writer, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, 5, 7))
    writer.bits(now.rotation, 32);
}

QuantisedPose read_pose(BitReader& reader, const QuantisedPose& base) {
  QuantisedPose now = base;
  Three off{};
  if (read_off(reader, off, 5, 9)) {
    now.x += off[0];
    now.y += off[1];
    now.z += off[2];
  } else {
    for (int32_t* n : {&now.x, &now.y, &now.z}) *n = static_cast<int32_t>(reader.bits(18) << 14U) >> 14U;
  }
  if (reader.bits(1) != 0 && read_off(reader, off, 5, 7)) {
    const Three a = components(base.rotation);
    now.rotation = (base.rotation & 0xC0000000U) | (static_cast<uint32_t>(a[0] + off[0]) << 20U) |
                   (static_cast<uint32_t>(a[1] + off[1]) << 10U) | static_cast<uint32_t>(a[2] + off[2]);
    return now;
  }
  now.rotation = reader.bits(32);
  return now;
}

}  // namespace

std::vector<uint8_t> pack_floats(std::span<const BodyPose> bodies) {
  std::vector<uint8_t> bytes(bodies.size() * sizeof(FloatBody));
  for (size_t i = 0; i < bodies.size(); ++i) {
    const glm::vec3& at = bodies[i].pose.position_m;
    const glm::quat& q = bodies[i].pose.rotation;
    const FloatBody body{bodies[i].id, {at.x, at.y, at.z, q.x, q.y, q.z, q.w}};
    std::memcpy(bytes.data() + i * sizeof(FloatBody), &body, sizeof(FloatBody));
  }
  return bytes;
}

std::vector<BodyPose> unpack_floats(std::span<const uint8_t> bytes) {
  std::vector<BodyPose> bodies(bytes.size() / sizeof(FloatBody));
  for (size_t i = 0; i < bodies.size(); ++i) {
    FloatBody body;
    std::memcpy(&body, bytes.data() + i * sizeof(FloatBody), sizeof(FloatBody));
    const auto& p = body.pose;
    bodies[i] = {body.id, {{p[0], p[1], p[2]}, {p[6], p[3], p[4], p[5]}}};
  }
  return bodies;
}

std::vector<uint8_t> SmallestThreeDeltas::pack(std::span<const PieceState> bodies) {
  BitWriter writer;
  for (const PieceState& body : bodies) {
    QuantisedPose& base = baseline_[body.id];
    writer.bits(base != body.pose ? 1 : 0, 1);
    if (base != body.pose) write_pose(writer, base, body.pose);
    base = body.pose;
  }
  return writer.bytes;
}

std::vector<PieceState> SmallestThreeDeltas::unpack(std::span<const uint8_t> bytes,
                                                    std::span<const PieceId> ids) {
  BitReader reader(bytes);
  std::vector<PieceState> bodies;
  for (const PieceId id : ids) {
    QuantisedPose& base = baseline_[id];
    if (reader.bits(1) != 0) base = read_pose(reader, base);
    bodies.push_back({id, base});
  }
  return bodies;
}

}  // namespace scree
