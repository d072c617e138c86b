#include "proto/wire_values.h"

#include <cmath>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/codec.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

// Each kind has its value in scree.proto. That the names agree, too, is tested (tests/proto/kinds_test.cpp).
static_assert(wire::ShapeKind_ARRAYSIZE == kind_count<ShapeKind>);
static_assert(wire::SeedPattern_ARRAYSIZE == kind_count<SeedPattern>);
static_assert(wire::TerrainKind_ARRAYSIZE == kind_count<TerrainKind>);
static_assert(wire::Role_ARRAYSIZE == kind_count<Role>);

}  // namespace

void FieldChecker::refuse(const std::string& reason) {
  if (!failed()) error_.message = fmt::format("{}: {}", subject_, reason);
}

void FieldChecker::refuse_kind(int64_t number, const char* what) {
  refuse(fmt::format("{} {} is unknown", what, number));
}

void FieldChecker::note_unknown(int64_t number, const char* what) {
  if (unknown_.empty()) unknown_ = fmt::format("{} {}", what, number);
}

float FieldChecker::finite(float value, const char* what) {
  if (std::isfinite(value)) return value;
  refuse(std::string(what) + " is not a finite number");
  return 0.0F;
}

float FieldChecker::not_negative(float value, const char* what) {
  if (finite(value, what) >= 0.0F) return value;
  refuse(std::string(what) + " is negative");
  return 0.0F;
}

uint32_t FieldChecker::within(uint32_t value, uint32_t min, uint32_t max, const char* what) {
  if (value >= min && value <= max) return value;
  refuse(fmt::format("{} is {}, not within {} to {}", what, value, min, max));
  return min;
}

glm::vec3 FieldChecker::vec3(const wire::Vec3& value, const char* what) {
  return {finite(value.x(), what), finite(value.y(), what), finite(value.z(), what)};
}

std::string FieldChecker::bytes(const std::string& value, size_t bytes_max, const char* what) {
  if (value.size() <= bytes_max) return value;
  refuse(fmt::format("{} has {} bytes, over the limit of {}", what, value.size(), bytes_max));
  return {};
}

std::string FieldChecker::text(const std::string& value, size_t bytes_max, const char* what) {
  std::string text = bytes(value, bytes_max, what);
  if (const auto fault = fault_of_text(text)) refuse(fmt::format("{} {}", what, *fault));
  return failed() ? std::string() : text;
}

Shape FieldChecker::shape(const wire::Shape& value) {
  Shape shape;
  shape.kind = asked_kind<ShapeKind>(value.kind(), "kind of shape");
  shape.a = vec3(value.a(), "shape.a");
  if (traits_of(shape.kind).has_b) shape.b = vec3(value.b(), "shape.b");
  shape.radius_m = finite(value.radius_m(), "shape.radius_m");
  return shape;
}

std::vector<ChunkCoord> FieldChecker::chunks(const std::string& packed, size_t count_max, const char* what) {
  std::vector<ChunkCoord> chunks;
  ByteReader reader(as_span(packed), what);
  while (!reader.at_end()) {
    if (chunks.size() == count_max) {
      reader.refuse(fmt::format("more than {} chunks", count_max));
      break;
    }
    const ChunkCoord before = chunks.empty() ? ChunkCoord{} : chunks.back();
    chunks.push_back(
        read_coord(reader, before, limits::voxel_coordinate_max / chunk_size, "chunk coordinate"));
  }
  if (reader.failed()) refuse(reader.error().message);
  return chunks;
}

std::vector<glm::vec3> FieldChecker::points(const std::string& packed, size_t count_max, const char* what) {
  std::vector<glm::vec3> points;
  ByteReader reader(as_span(packed), what);
  while (!reader.at_end()) {
    if (points.size() == count_max) {
      reader.refuse(fmt::format("more than {} points", count_max));
      break;
    }
    points.push_back(reader.vec3("point"));
  }
  if (reader.failed()) refuse(reader.error().message);
  return points;
}

SettingValues FieldChecker::settings(const WireSettings& values) {
  SettingValues settings;
  if (static_cast<size_t>(values.size()) > limits::settings_max) {
    refuse(fmt::format("{} settings are over the limit of {}", values.size(), limits::settings_max));
    return settings;
  }
  for (const wire::Setting& value : values)
    settings.push_back({text(value.name(), limits::setting_name_bytes_max, "name of a setting"),
                        text(value.value(), limits::setting_value_bytes_max, "value of a setting")});
  return settings;
}

void write(wire::Vec3& to, glm::vec3 from) {
  to.set_x(from.x);
  to.set_y(from.y);
  to.set_z(from.z);
}

void write(wire::Shape& to, const Shape& from) {
  to.set_kind(static_cast<wire::ShapeKind>(from.kind));
  write(*to.mutable_a(), from.a);
  if (row_of(from.kind).has_b) write(*to.mutable_b(), from.b);
  to.set_radius_m(from.radius_m);
}

void write(WireSettings& to, const SettingValues& from) {
  for (const SettingValue& setting : from) {
    wire::Setting& added = *to.Add();
    added.set_name(showable(setting.name, limits::setting_name_bytes_max));
    added.set_value(showable(setting.value, limits::setting_value_bytes_max));
  }
}

std::string pack_chunks(const std::vector<ChunkCoord>& chunks) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  write_coords<ChunkTag>(writer, chunks);
  return to_string(bytes);
}

std::string pack_points(const std::vector<glm::vec3>& points) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  for (const glm::vec3& point : points) writer.vec3(point);
  return to_string(bytes);
}

std::vector<uint8_t> frame_of(const google::protobuf::MessageLite& message) {
  const size_t length = message.ByteSizeLong();
  std::vector<uint8_t> bytes;
  bytes.reserve(length_prefix_bytes + length);
  ByteWriter(bytes).u32(static_cast<uint32_t>(length));
  bytes.resize(length_prefix_bytes + length);
  CHECK(message.SerializeToArray(bytes.data() + length_prefix_bytes, static_cast<int>(length)));
  return bytes;
}

}  // namespace scree
