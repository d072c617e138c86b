#include "server/formats/packed_lists.h"

#include <fmt/format.h>

#include "proto/limits.h"

namespace scree {

void refuse_more(ByteReader& reader, size_t count_max) {
  reader.refuse(fmt::format("more than {} entries", count_max));
}

namespace {

constexpr int32_t brick_max = limits::voxel_coordinate_max / brick_size;
constexpr uint8_t is_frozen = 1;
constexpr uint8_t has_bounds = 2;

/// An id after the one before; 0 is none.
PieceId next_id(ByteReader& reader, PieceId before) {
  const uint64_t step = reader.varint("id", UINT32_MAX - before);
  if (step == 0) reader.refuse("ids do not ascend");
  return static_cast<PieceId>(before + step);
}

void write_bounds(ByteWriter& writer, const BoundsM& bounds) {
  writer.vec3(bounds.lo_m);
  writer.vec3(bounds.hi_m);
}

BoundsM read_bounds(ByteReader& reader) {
  const glm::vec3 lo = reader.vec3("bounds");
  return {lo, reader.vec3("bounds")};
}

}  // namespace

std::string pack_bricks(const std::vector<BrickCoord>& bricks) {
  return packed([&](ByteWriter& writer) { write_coords<BrickTag>(writer, bricks); });
}

std::string pack_ids(const std::vector<PieceId>& ids) {
  return packed([&](ByteWriter& writer) {
    PieceId before = 0;
    for (const PieceId id : ids) writer.varint(id - before), before = id;
  });
}

std::string pack_boxes(const std::vector<VoxelBox>& boxes) {
  return packed([&](ByteWriter& writer) {
    for (const VoxelBox& box : boxes)
      for (const int32_t n : {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z}) writer.zigzag(n);
  });
}

std::string pack_bounds(const std::vector<BoundsM>& bounds) {
  return packed([&](ByteWriter& writer) {
    for (const BoundsM& one : bounds) write_bounds(writer, one);
  });
}

std::string pack_vec3s(const std::vector<glm::vec3>& points) {
  return packed([&](ByteWriter& writer) {
    for (const glm::vec3& p : points) writer.vec3(p);
  });
}

std::string pack_bodies(const std::vector<BodyMotion>& bodies) {
  return packed([&](ByteWriter& writer) {
    PieceId before = 0;
    for (const BodyMotion& body : bodies) {
      writer.varint(body.id - before);
      before = body.id;
      writer.u8(static_cast<uint8_t>((body.frozen ? is_frozen : 0) | (body.thawed ? has_bounds : 0)));
      writer.vec3(body.origin_m);
      for (const glm::vec3& row : body.basis) writer.vec3(row);
      writer.vec3(body.velocity_m_s);
      writer.vec3(body.spin_rad_s);
      if (body.thawed) write_bounds(writer, *body.thawed);
    }
  });
}

std::string pack_timers(const std::vector<StillnessTimer>& timers) {
  return packed([&](ByteWriter& writer) {
    PieceId before = 0;
    for (const StillnessTimer& timer : timers) {
      writer.varint(timer.id - before);
      before = timer.id;
      writer.vec3(timer.anchor_m);
      for (const float part : timer.anchor_rotation) writer.f32(part);
      writer.varint(timer.age_ticks);
      writer.varint(timer.still_ticks);
      writer.varint(timer.terrain_ticks);
    }
  });
}

std::string pack_turns(const std::vector<TurnsValue::Turn>& turns) {
  return packed([&](ByteWriter& writer) {
    uint64_t before = 0;
    for (const TurnsValue::Turn& turn : turns) {
      writer.varint(turn.who - before);
      before = turn.who;
      writer.varint(turn.start_ns);
      writer.u8(turn.waits ? 1 : 0);
    }
  });
}

Result<std::vector<BrickCoord>> unpack_bricks(const std::string& bytes, const char* what) {
  BrickCoord before;
  return unpacked<BrickCoord>(bytes, what, SIZE_MAX, [&](ByteReader& reader) {
    return before = read_coord(reader, before, brick_max, "brick");
  });
}

Result<std::vector<PieceId>> unpack_piece_ids(const std::string& bytes, const char* what) {
  PieceId before = 0;
  return unpacked<PieceId>(bytes, what, SIZE_MAX,
                           [&](ByteReader& reader) { return before = next_id(reader, before); });
}

Result<std::vector<VoxelBox>> unpack_boxes(const std::string& bytes, const char* what) {
  return unpacked<VoxelBox>(bytes, what, SIZE_MAX, [&](ByteReader& reader) {
    const auto corner = [&] {
      return read_coord(reader, VoxelCoord{}, limits::voxel_coordinate_max, "corner");
    };
    VoxelBox box;
    box.lo = corner();
    box.hi = corner();
    if (box.empty()) reader.refuse("an empty box");
    return box;
  });
}

Result<std::vector<BoundsM>> unpack_bounds(const std::string& bytes, const char* what) {
  return unpacked<BoundsM>(bytes, what, SIZE_MAX, [](ByteReader& reader) { return read_bounds(reader); });
}

Result<std::vector<glm::vec3>> unpack_vec3s(const std::string& bytes, const char* what, size_t count_max) {
  return unpacked<glm::vec3>(bytes, what, count_max, [](ByteReader& reader) { return reader.vec3("point"); });
}

Result<std::vector<BodyMotion>> unpack_bodies(const std::string& bytes) {
  PieceId before = 0;
  return unpacked<BodyMotion>(bytes, "bodies", SIZE_MAX, [&](ByteReader& reader) {
    BodyMotion body;
    body.id = before = next_id(reader, before);
    const uint8_t flags = reader.u8("flags", is_frozen | has_bounds);
    body.frozen = (flags & is_frozen) != 0;
    body.origin_m = reader.vec3("origin");
    for (glm::vec3& row : body.basis) row = reader.vec3("rotation");
    body.velocity_m_s = reader.vec3("velocity");
    body.spin_rad_s = reader.vec3("spin");
    if ((flags & has_bounds) != 0) body.thawed = read_bounds(reader);
    return body;
  });
}

Result<std::vector<StillnessTimer>> unpack_timers(const std::string& bytes) {
  PieceId before = 0;
  return unpacked<StillnessTimer>(bytes, "rest", SIZE_MAX, [&](ByteReader& reader) {
    StillnessTimer timer;
    timer.id = before = next_id(reader, before);
    timer.anchor_m = reader.vec3("anchor");
    for (float& part : timer.anchor_rotation) part = reader.f32("anchor's rotation");
    timer.age_ticks = static_cast<uint32_t>(reader.varint("age", UINT32_MAX - 1));
    timer.still_ticks = static_cast<uint32_t>(reader.varint("ticks still", UINT32_MAX - 1));
    timer.terrain_ticks = static_cast<uint32_t>(reader.varint("ticks since terrain", UINT32_MAX - 1));
    return timer;
  });
}

Result<std::vector<TurnsValue::Turn>> unpack_turns(const std::string& bytes) {
  uint64_t before = 0;
  bool first = true;
  return unpacked<TurnsValue::Turn>(bytes, "turns", SIZE_MAX, [&](ByteReader& reader) {
    TurnsValue::Turn turn;
    const uint64_t step = reader.varint("who", UINT64_MAX - before);
    if (step == 0 && !first) reader.refuse("turns do not ascend");
    first = false;
    turn.who = before += step;
    turn.start_ns = reader.varint("start");
    turn.waits = reader.u8("waiting", 1) != 0;
    return turn;
  });
}

}  // namespace scree
