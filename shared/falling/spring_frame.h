// Rigid bodies that springs join: the elastic forces of a structure. Each spring lies in a section between
// two bodies, and resists shifts and turns along the field's axes. So a beam's bending is exact where the
// spring lies at the elastic centre of what it stands for (spans.h).
//
// Solved directly, by Cholesky's method over blocks of 6 × 6, in the order of least degree (Tinney and Walker
// 1967). Only + − × ÷ and sqrt, in a fixed order: the same bits everywhere. Not thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace scree {

/// Three shifts and three turns, or three forces and three moments.
using Six = std::array<double, 6>;

class SpringFrame {
 public:
  /// In place of a body: what does not move.
  static constexpr uint32_t fixed = UINT32_MAX;

  explicit SpringFrame(size_t bodies);

  /// `arm`: from the body's centre to the spring. All of `stiffness` must be positive.
  struct Spring {
    uint32_t lower = fixed, upper = fixed;
    glm::dvec3 lower_arm{0.0}, upper_arm{0.0};
    Six stiffness{};
  };
  void add(const Spring& spring);

  /// Call once, after all springs. False when a body is free to move, or when it takes more than `steps`
  /// products of blocks.
  bool factorise(size_t steps);
  /// Products of blocks that factorise() took.
  size_t products() const { return products_; }
  /// Loads on the bodies become their shifts and turns.
  void solve(std::vector<Six>& loads) const;

  /// Shift and turn of the upper side of a spring against its lower one.
  static Six opening(const Spring& spring, const std::vector<Six>& moves);
  /// Adds what a spring with those forces on it does to its bodies; the upper side pulls the lower one.
  static void push(const Spring& spring, const Six& forces, std::vector<Six>& loads);

 private:
  using Block = std::array<double, 36>;  ///< row by row
  static constexpr uint32_t none = UINT32_MAX;

  Block& block(uint32_t row, uint32_t column);
  void eliminate(uint32_t pivot, const std::vector<uint32_t>& later);
  /// The bodies that are left and have a block in common with it.
  std::vector<uint32_t> left_beside(uint32_t body) const;
  uint32_t least_beside() const;

  size_t bodies_;
  std::vector<uint32_t> place_;  ///< of the block of two bodies; its row is eliminated later than its column
  std::vector<Block> blocks_;
  std::vector<std::vector<uint64_t>> beside_;  ///< bits of bodies that are left
  std::vector<bool> gone_;
  size_t products_ = 0;
  struct Column {
    uint32_t body;
    std::vector<uint32_t> later;
  };
  std::vector<Column> columns_;
};

}  // namespace scree
