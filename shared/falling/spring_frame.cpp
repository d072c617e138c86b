#include "shared/falling/spring_frame.h"

#include <bit>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr size_t six = 6;

/// What a body's move does at the end of an arm: 6 × 6, row by row.
std::array<double, 36> at_arm(glm::dvec3 arm) {
  std::array<double, 36> out{};
  for (size_t i = 0; i < six; ++i) out[i * six + i] = 1.0;
  out[0 * six + 4] = arm.z;
  out[0 * six + 5] = -arm.y;
  out[1 * six + 3] = -arm.z;
  out[1 * six + 5] = arm.x;
  out[2 * six + 3] = arm.y;
  out[2 * six + 4] = -arm.x;
  return out;
}

/// aᵀ · diagonal · b.
std::array<double, 36> between(const std::array<double, 36>& a, const Six& diagonal,
                               const std::array<double, 36>& b) {
  std::array<double, 36> out{};
  for (size_t k = 0; k < six; ++k)
    for (size_t i = 0; i < six; ++i) {
      const double left = a[k * six + i] * diagonal[k];
      for (size_t j = 0; j < six; ++j) out[i * six + j] += left * b[k * six + j];
    }
  return out;
}

/// The lower triangle of Cholesky's factor, in place. False when the block is not positive.
bool factor(std::array<double, 36>& block) {
  for (size_t j = 0; j < six; ++j) {
    const double before = block[j * six + j];
    double pivot = before;
    for (size_t k = 0; k < j; ++k) pivot -= block[j * six + k] * block[j * six + k];
    if (!(pivot > 1e-13 * before)) return false;
    const double root = std::sqrt(pivot);
    block[j * six + j] = root;
    for (size_t i = j + 1; i < six; ++i) {
      double sum = block[i * six + j];
      for (size_t k = 0; k < j; ++k) sum -= block[i * six + k] * block[j * six + k];
      block[i * six + j] = sum / root;
    }
  }
  return true;
}

/// block · factor⁻ᵀ, in place.
void divide(std::array<double, 36>& block, const std::array<double, 36>& factor) {
  for (size_t i = 0; i < six; ++i)
    for (size_t j = 0; j < six; ++j) {
      double sum = block[i * six + j];
      for (size_t k = 0; k < j; ++k) sum -= block[i * six + k] * factor[j * six + k];
      block[i * six + j] = sum / factor[j * six + j];
    }
}

/// to −= a · bᵀ.
void subtract(std::array<double, 36>& to, const std::array<double, 36>& a,
              const std::array<double, 36>& turned) {
  for (size_t i = 0; i < six; ++i)
    for (size_t k = 0; k < six; ++k) {
      const double left = a[i * six + k];
      for (size_t j = 0; j < six; ++j) to[i * six + j] -= left * turned[k * six + j];
    }
}

std::array<double, 36> transposed(const std::array<double, 36>& block) {
  std::array<double, 36> out{};
  for (size_t i = 0; i < six; ++i)
    for (size_t j = 0; j < six; ++j) out[j * six + i] = block[i * six + j];
  return out;
}

}  // namespace

SpringFrame::SpringFrame(size_t bodies)
    : bodies_(bodies), place_(bodies * bodies, none), gone_(bodies, false) {
  beside_.assign(bodies, std::vector<uint64_t>((bodies + 63) / 64, 0));
  for (uint32_t i = 0; i < bodies; ++i) block(i, i);
}

SpringFrame::Block& SpringFrame::block(uint32_t row, uint32_t column) {
  uint32_t& place = place_[row * bodies_ + column];
  if (place == none) {
    place = static_cast<uint32_t>(blocks_.size());
    blocks_.push_back({});
    if (row != column) {
      beside_[row][column / 64] |= uint64_t{1} << (column % 64);
      beside_[column][row / 64] |= uint64_t{1} << (row % 64);
    }
  }
  return blocks_[place];
}

void SpringFrame::add(const Spring& spring) {
  const auto lower = at_arm(spring.lower_arm), upper = at_arm(spring.upper_arm);
  const auto add_to = [](Block& to, const Block& more, double sign) {
    for (size_t i = 0; i < to.size(); ++i) to[i] += sign * more[i];
  };
  if (spring.lower != fixed)
    add_to(block(spring.lower, spring.lower), between(lower, spring.stiffness, lower), 1.0);
  if (spring.upper != fixed)
    add_to(block(spring.upper, spring.upper), between(upper, spring.stiffness, upper), 1.0);
  if (spring.lower == fixed || spring.upper == fixed) return;
  CHECK(spring.lower != spring.upper);
  // Both triangles, until the order is known.
  add_to(block(spring.lower, spring.upper), between(lower, spring.stiffness, upper), -1.0);
  add_to(block(spring.upper, spring.lower), between(upper, spring.stiffness, lower), -1.0);
}

std::vector<uint32_t> SpringFrame::left_beside(uint32_t body) const {
  std::vector<uint32_t> left;
  for (size_t word = 0; word < beside_[body].size(); ++word)
    for (uint64_t bits = beside_[body][word]; bits != 0; bits &= bits - 1)
      left.push_back(static_cast<uint32_t>(word * 64 + static_cast<size_t>(std::countr_zero(bits))));
  return left;
}

uint32_t SpringFrame::least_beside() const {
  uint32_t least = none;
  int count_of_least = 0;
  for (uint32_t i = 0; i < bodies_; ++i) {
    if (gone_[i]) continue;
    int count = 0;
    for (const uint64_t word : beside_[i]) count += std::popcount(word);
    if (least != none && count >= count_of_least) continue;
    least = i;
    count_of_least = count;
  }
  return least;
}

void SpringFrame::eliminate(uint32_t pivot, const std::vector<uint32_t>& later) {
  const Block root = block(pivot, pivot);
  for (const uint32_t row : later) divide(block(row, pivot), root);
  for (size_t c = 0; c < later.size(); ++c) {
    const uint32_t column = later[c];
    const Block turned = transposed(block(column, pivot));
    for (size_t r = c; r < later.size(); ++r) {
      Block& to = block(later[r], column);
      subtract(to, block(later[r], pivot), turned);
      // Which triangle is needed is known only once both are eliminated.
      if (r != c) block(column, later[r]) = transposed(to);
    }
  }
}

bool SpringFrame::factorise(size_t steps) {
  for (size_t count = 0; count < bodies_; ++count) {
    const uint32_t pivot = least_beside();
    const std::vector<uint32_t> later = left_beside(pivot);
    products_ += later.size() * (later.size() + 3) / 2;
    if (products_ > steps || !factor(block(pivot, pivot))) return false;
    for (const uint32_t row : later)
      for (const uint32_t column : later) block(row, column);
    eliminate(pivot, later);
    for (const uint32_t row : later) beside_[row][pivot / 64] &= ~(uint64_t{1} << (pivot % 64));
    gone_[pivot] = true;
    columns_.push_back({pivot, later});
  }
  return true;
}

void SpringFrame::solve(std::vector<Six>& loads) const {
  CHECK(loads.size() == bodies_ && columns_.size() == bodies_);
  const auto at = [&](uint32_t row, uint32_t column) -> const Block& {
    return blocks_[place_[row * bodies_ + column]];
  };
  for (const Column& column : columns_) {
    Six& x = loads[column.body];
    const Block& root = at(column.body, column.body);
    for (size_t i = 0; i < six; ++i) {
      for (size_t k = 0; k < i; ++k) x[i] -= root[i * six + k] * x[k];
      x[i] /= root[i * six + i];
    }
    for (const uint32_t row : column.later) {
      const Block& below = at(row, column.body);
      for (size_t i = 0; i < six; ++i)
        for (size_t k = 0; k < six; ++k) loads[row][i] -= below[i * six + k] * x[k];
    }
  }
  for (size_t c = columns_.size(); c-- > 0;) {
    const Column& column = columns_[c];
    Six& x = loads[column.body];
    for (const uint32_t row : column.later) {
      const Block& below = at(row, column.body);
      for (size_t i = 0; i < six; ++i)
        for (size_t k = 0; k < six; ++k) x[k] -= below[i * six + k] * loads[row][i];
    }
    const Block& root = at(column.body, column.body);
    for (size_t i = six; i-- > 0;) {
      for (size_t k = i + 1; k < six; ++k) x[i] -= root[k * six + i] * x[k];
      x[i] /= root[i * six + i];
    }
  }
}

Six SpringFrame::opening(const Spring& spring, const std::vector<Six>& moves) {
  Six out{};
  const auto add = [&](uint32_t body, glm::dvec3 arm, double sign) {
    if (body == fixed) return;
    const Six& move = moves[body];
    const auto at = at_arm(arm);
    for (size_t i = 0; i < six; ++i)
      for (size_t k = 0; k < six; ++k) out[i] += sign * at[i * six + k] * move[k];
  };
  add(spring.upper, spring.upper_arm, 1.0);
  add(spring.lower, spring.lower_arm, -1.0);
  return out;
}

void SpringFrame::push(const Spring& spring, const Six& forces, std::vector<Six>& loads) {
  const auto add = [&](uint32_t body, glm::dvec3 arm, double sign) {
    if (body == fixed) return;
    const auto at = at_arm(arm);
    for (size_t i = 0; i < six; ++i)
      for (size_t k = 0; k < six; ++k) loads[body][i] += sign * at[k * six + i] * forces[k];
  };
  add(spring.lower, spring.lower_arm, 1.0);
  add(spring.upper, spring.upper_arm, -1.0);
}

}  // namespace scree
