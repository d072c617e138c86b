// What every function of scree/client.h does around its work: structs that say their size, errors in words,
// and no exception that leaves the library. Any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <glm/vec3.hpp>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "client/library/include/scree/client.h"
#include "shared/field/piece.h"

namespace scree {

inline constexpr scree_result done = SCREE_OK;
inline constexpr scree_result nothing = SCREE_NOTHING;

/// Keeps the words of an error for scree_error(), and returns its code.
scree_result fail(scree_result code, std::string words);

/// The results of `work`, or of what it threw.
template <typename Work>
scree_result guarded(Work&& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(SCREE_NO_MEMORY, "there is no memory");
  } catch (const std::exception& thrown) {
    return fail(SCREE_REFUSED, thrown.what());
  }
}

/// Bytes that the first release has of each struct: no caller's is smaller.
template <typename Struct>
inline constexpr size_t first_bytes = sizeof(Struct);
/// No release will have a larger one: a size beyond was never set.
inline constexpr size_t struct_bytes_max = 4096;

template <typename Struct>
bool has_size(const Struct* given) {
  return given != nullptr && given->size >= first_bytes<Struct> && given->size <= struct_bytes_max;
}

/// The caller's struct with the members that its release has; what it does not know is 0. Nothing: it says
/// no size that a release has.
template <typename Struct>
std::optional<Struct> read_struct(const Struct* from) {
  if (!has_size(from)) return std::nullopt;
  Struct value{};
  std::memcpy(&value, from, std::min<size_t>(from->size, sizeof value));
  return value;
}

/// Writes as much as the caller's release knows. False: it says no size that a release has.
template <typename Struct>
bool write_struct(const Struct& value, Struct* to) {
  if (!has_size(to)) return false;
  const uint32_t size = to->size;
  std::memcpy(to, &value, std::min<size_t>(size, sizeof value));
  to->size = size;
  return true;
}

/// Defaults into a struct of so many bytes, as an init function does.
template <typename Struct>
bool init_struct(Struct* to, uint32_t size, Struct value) {
  if (to == nullptr || size < first_bytes<Struct> || size > struct_bytes_max) return false;
  std::memset(to, 0, size);
  to->size = size;
  return write_struct(value, to);
}

inline glm::vec3 vec3_of(const float v[3]) {
  return {v[0], v[1], v[2]};
}
inline void write_vec3(glm::vec3 from, float to[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}
inline void write_rotation(const glm::quat& from, float to[4]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
  to[3] = from.w;
}
inline void write_pose(const Pose& from, float position[3], float rotation[4]) {
  write_vec3(from.position_m, position);
  write_rotation(from.rotation, rotation);
}
inline bool is_finite(const float* values, size_t count) {
  return std::all_of(values, values + count, [](float v) { return std::isfinite(v); });
}
inline std::string text_of(const char* text, const char* otherwise = "") {
  return text == nullptr ? otherwise : text;
}

}  // namespace scree
