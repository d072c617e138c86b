#include "server/bodies/envelope_factor.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

/// In four sums, so that a compiler can use vectors without changing the order.
double product(const double* a, const double* b, size_t count) {
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (size_t lane = 0; lane < 4; ++lane) sums[lane] += a[i + lane] * b[i + lane];
  for (; i < count; ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

void EnvelopeFactor::begin(std::span<const uint32_t> first) {
  first_.assign(first.begin(), first.end());
  start_.clear();
  size_t values = 0;
  for (size_t row = 0; row < first.size(); ++row) {
    CHECK_DEBUG(first[row] <= row);
    start_.push_back(values);
    values += row - first[row] + 1;
  }
  values_.assign(values, 0.0);
}

double EnvelopeFactor::work_of(size_t width) {
  const auto values = static_cast<double>(width);
  return 0.5 * values * values + 4.0 * values;
}

void EnvelopeFactor::factorise(double least) {
  for (size_t row = 0; row < rows(); ++row) {
    const size_t first = first_[row];
    double* const own = &values_[start_[row]];
    scaled_.resize(std::max(scaled_.size(), row - first + 1));
    for (size_t column = first; column < row; ++column) {
      const size_t common = std::max<size_t>(first, first_[column]);
      const double* const other = &values_[start_[column]];
      scaled_[column - first] =
          own[column - first] -
          product(&scaled_[common - first], other + (common - first_[column]), column - common);
    }
    const double given = own[row - first];
    CHECK_DEBUG(given > 0.0);
    double pivot = given;
    for (size_t column = first; column < row; ++column) {
      const double scaled = scaled_[column - first];
      const double factor = scaled / values_[start_[column] + (column - first_[column])];
      own[column - first] = factor;
      pivot -= factor * scaled;
    }
    own[row - first] = std::max(pivot, least * given);
  }
}

void EnvelopeFactor::solve(std::span<double> side) const {
  CHECK_EQ(side.size(), rows());
  for (size_t row = 0; row < rows(); ++row) {
    const size_t first = first_[row];
    side[row] -= product(&values_[start_[row]], &side[first], row - first);
  }
  for (size_t row = 0; row < rows(); ++row) side[row] /= values_[start_[row] + (row - first_[row])];
  for (size_t row = rows(); row-- > 0;) {
    const size_t first = first_[row];
    const double* const own = &values_[start_[row]];
    for (size_t column = first; column < row; ++column) side[column] -= own[column - first] * side[row];
  }
}

}  // namespace scree
