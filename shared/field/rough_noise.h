// The roughness of generated terrain: the paper's repeating noise (section 2.2), as a sum of octaves of value
// noise, and bounds of it over a box. Pure functions of place and seed; lengths in metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/field/coord.h"

namespace scree {

struct Octave {
  float amplitude_m;
  float cell_m;
};
inline constexpr std::array<Octave, 3> octaves = {{{8.0F, 16.0F}, {7.0F, 7.0F}, {1.5F, 3.0F}}};
inline constexpr float amplitude_sum_m =
    octaves[0].amplitude_m + octaves[1].amplitude_m + octaves[2].amplitude_m;

/// A value in [-1, 1) of a lattice point; repeats every 64 points, as the paper's noise texture does.
inline float lattice_value(uint32_t x, uint32_t y, uint32_t z, uint32_t random_seed) {
  uint32_t h = ((x & 63U) | ((y & 63U) << 6U) | ((z & 63U) << 12U)) * 0x9E3779B1U + random_seed * 0x85EBCA77U;
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12U)) * 0x297A2D39U;
  h ^= h >> 15U;
  return static_cast<float>(h >> 8U) * (2.0F / 16777216.0F) - 1.0F;
}

/// A smooth step from 0 to 1 over that interval.
inline float blend(float t) {
  return t * t * (3.0F - 2.0F * t);
}

/// Value noise in [-1, 1), cells of one unit, along z at one (x, y): the corners of a cell are hashed once
/// for all the points in it. Interpolates along x, then y, then z.
class NoiseColumn {
 public:
  NoiseColumn(float x, float y, uint32_t random_seed)
      : x_(floor_to_int(x)),
        y_(floor_to_int(y)),
        u_(blend(x - static_cast<float>(x_))),
        v_(blend(y - static_cast<float>(y_))),
        random_seed_(random_seed) {}

  float at(float z) {
    const int cell = floor_to_int(z);
    if (!started_ || cell != cell_) {
      low_ = started_ && cell == cell_ + 1 ? high_ : face(cell);
      high_ = face(cell + 1);
      cell_ = cell;
      started_ = true;
    }
    return low_ + (high_ - low_) * blend(z - static_cast<float>(cell));
  }

 private:
  float face(int z) const {
    const auto corner = [&](int i, int j) {
      return lattice_value(static_cast<uint32_t>(x_ + i), static_cast<uint32_t>(y_ + j),
                           static_cast<uint32_t>(z), random_seed_);
    };
    const float a = corner(0, 0), b = corner(0, 1);
    const float near = a + (corner(1, 0) - a) * u_;
    const float far = b + (corner(1, 1) - b) * u_;
    return near + (far - near) * v_;
  }

  int x_;
  int y_;
  float u_;
  float v_;
  uint32_t random_seed_;
  bool started_ = false;
  int cell_ = 0;
  float low_ = 0.0F;
  float high_ = 0.0F;
};

/// Seed of an octave's lattice.
constexpr uint32_t octave_seed(uint32_t random_seed, uint32_t octave) {
  return random_seed * 31U + octave;
}

/// The octaves' sum along z at one (x, y), metres.
class RoughColumn {
 public:
  RoughColumn(float x_m, float y_m, uint32_t random_seed)
      : columns_{column(x_m, y_m, random_seed, 0), column(x_m, y_m, random_seed, 1),
                 column(x_m, y_m, random_seed, 2)} {}

  float at(float z_m) {
    float sum = 0.0F;
    for (size_t i = 0; i < octaves.size(); ++i)
      sum += octaves[i].amplitude_m * columns_[i].at(z_m / octaves[i].cell_m);
    return sum;
  }

 private:
  static NoiseColumn column(float x_m, float y_m, uint32_t random_seed, uint32_t octave) {
    return {x_m / octaves[octave].cell_m, y_m / octaves[octave].cell_m, octave_seed(random_seed, octave)};
  }

  std::array<NoiseColumn, octaves.size()> columns_;
};

/// No value of the octaves' sum in the box lies outside, whatever rounding does.
struct RoughRange {
  float least_m = 0.0F;
  float most_m = 0.0F;
};

/// The range over a closed box: interpolated values lie between those of the cells' corners. Costs a
/// thousandth of the noise in a chunk. `lo` is not above `hi`.
RoughRange rough_range(glm::vec3 lo_m, glm::vec3 hi_m, uint32_t random_seed);

}  // namespace scree
