// Converts the values that several messages share between our types and Protobuf's. Internal to proto/.
#pragma once

#include <cstring>
#include <scree.pb.h>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "proto/messages.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"

namespace scree {

using WireSettings = google::protobuf::RepeatedPtrField<wire::Setting>;

/// Checks parsed fields, one a call. Keeps the first error, which names the field.
class FieldChecker {
 public:
  explicit FieldChecker(const char* subject) : subject_(subject) {}

  float finite(float value, const char* what);
  /// Finite, and at least zero.
  float not_negative(float value, const char* what);
  uint32_t within(uint32_t value, uint32_t min, uint32_t max, const char* what);
  glm::vec3 vec3(const wire::Vec3& value, const char* what);
  std::string text(const std::string& value, size_t bytes_max, const char* what);
  /// Bytes that are passed on as they are.
  std::string bytes(const std::string& value, size_t bytes_max, const char* what);
  /// A known kind by its number.
  template <HasRows Kind>
  Kind kind(int64_t number, const char* what) {
    if (is_kind<Kind>(number)) return static_cast<Kind>(number);
    refuse_kind(number, what);
    return Kind{};
  }
  /// Reads a kind of a request. An unknown one is no error: unknown() says it from then on.
  template <HasRows Kind>
  Kind asked_kind(int64_t number, const char* what) {
    if (is_kind<Kind>(number)) return static_cast<Kind>(number);
    note_unknown(number, what);
    return Kind{};
  }
  /// Reads a material of a request: one beyond every palette is noted as unknown.
  Material asked_material(uint32_t number) {
    if (number < materials_max) return static_cast<Material>(number);
    note_unknown(number, "material");
    return Material{};
  }
  /// Reads a kind where an unknown one can be taken for another.
  template <HasRows Kind>
  static Kind kind_or(int64_t number, Kind otherwise) {
    return is_kind<Kind>(number) ? static_cast<Kind>(number) : otherwise;
  }
  /// The shape of a request. Its kind is read by asked_kind().
  Shape shape(const wire::Shape& value);
  /// Coordinates of chunks, packed.
  std::vector<ChunkCoord> chunks(const std::string& packed, size_t count_max, const char* what);
  /// Points, packed as 3 × f32 each.
  std::vector<glm::vec3> points(const std::string& packed, size_t count_max, const char* what);
  SettingValues settings(const WireSettings& values);
  /// The value of another decoder's result; keeps its error if it has one.
  template <typename T>
  T value_or_refuse(Result<T> result) {
    if (result) return std::move(*result);
    refuse(result.error().message);
    return T{};
  }

  void refuse(const std::string& reason);
  bool failed() const { return !error_.message.empty(); }
  const Error& error() const { return error_; }
  /// The first unknown kind within a request, in words; empty: there is none.
  const std::string& unknown() const { return unknown_; }

 private:
  template <HasRows Kind>
  static bool is_kind(int64_t number) {
    return number >= 0 && number < static_cast<int64_t>(kind_count<Kind>);
  }
  void refuse_kind(int64_t number, const char* what);
  void note_unknown(int64_t number, const char* what);

  const char* subject_;
  Error error_;
  std::string unknown_;
};

/// Whether two values are the same to the bit: what is left out because it is the usual comes back as it was,
/// and -0 is not 0.
template <typename Value>
bool same_bits(const Value& a, const Value& b) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void write(wire::Vec3& to, glm::vec3 from);
void write(wire::Shape& to, const Shape& from);
void write(WireSettings& to, const SettingValues& from);
std::string pack_chunks(const std::vector<ChunkCoord>& chunks);
std::string pack_points(const std::vector<glm::vec3>& points);

inline std::string to_string(const std::vector<uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}
inline std::span<const uint8_t> as_span(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

/// The serialised message with its length in front.
std::vector<uint8_t> frame_of(const google::protobuf::MessageLite& message);

}  // namespace scree
