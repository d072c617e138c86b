// Grass, bushes and stones that lie about on the ground: values, as the GPU takes them. Only for the eye.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "shared/base/kind_table.h"

namespace scree {

enum class DetailKind : uint8_t { grass = 0, bush = 1, stone = 2 };

struct DetailKindRow {
  std::string_view name;
};

constexpr DetailKindRow row_of(DetailKind kind) {
  switch (kind) {
    case DetailKind::grass:
      return {"grass"};
    case DetailKind::bush:
      return {"bush"};
    case DetailKind::stone:
      return {"stone"};
  }
  return {};
}

inline constexpr size_t detail_kinds = 3;

/// One of them, as client/shaders/detail.vert takes it. Metres.
struct Detail {
  glm::vec3 place_m{0.0F};  ///< where it stands on the ground
  float size_m = 0.0F;
  /// Square roots of linear light, of 255; the last: the sun's share in the upper four bits, the sky's below.
  std::array<uint8_t, 4> colour{};
  /// In 127ths. grass and bush: half turns about its axis, then x and z of the ground's normal. stone: x, y
  /// and z of a quaternion. The last: the part of the range up to which it is seen.
  std::array<int8_t, 4> turn{};

  float seen() const { return static_cast<float>(turn[3]) / 127.0F; }
  bool operator==(const Detail&) const = default;
};

/// What is drawn of each kind.
using DetailLists = std::array<std::vector<Detail>, detail_kinds>;

}  // namespace scree
