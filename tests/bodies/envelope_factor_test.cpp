// Solutions by factors of an envelope, against what the matrix makes of them.
#include "server/bodies/envelope_factor.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

/// Rows that depend on some of those before them, and more on themselves than on all others.
struct Matrix {
  std::vector<uint32_t> first;
  std::vector<std::vector<double>> values;  ///< both triangles
};

Matrix make_matrix(size_t rows, Random& random) {
  Matrix out{std::vector<uint32_t>(rows), std::vector<std::vector<double>>(rows, std::vector<double>(rows))};
  for (size_t row = 0; row < rows; ++row) {
    out.first[row] = static_cast<uint32_t>(random.below(static_cast<uint32_t>(row) + 1));
    for (size_t column = out.first[row]; column < row; ++column)
      out.values[row][column] = out.values[column][row] = random.unit() - 0.5;
    out.values[row][row] = static_cast<double>(rows) + random.unit();
  }
  return out;
}

TEST(EnvelopeFactor, solves_what_it_is_given) {
  Random random(7);
  EnvelopeFactor factor;
  for (const size_t rows : {1U, 2U, 3U, 17U, 60U}) {
    const Matrix matrix = make_matrix(rows, random);
    factor.begin(matrix.first);
    std::vector<double> expected(rows), side(rows, 0.0);
    for (size_t row = 0; row < rows; ++row) {
      expected[row] = random.unit() - 0.5;
      for (size_t column = matrix.first[row]; column <= row; ++column)
        factor.at(row, column) = matrix.values[row][column];
    }
    for (size_t row = 0; row < rows; ++row)
      for (size_t column = 0; column < rows; ++column)
        side[row] += matrix.values[row][column] * expected[column];
    factor.factorise(1e-6);
    factor.solve(side);
    for (size_t row = 0; row < rows; ++row) EXPECT_NEAR(side[row], expected[row], 1e-12) << rows;
  }
}

// Two rows that ask for the same share what they must give, and two that contradict each other stay finite.
TEST(EnvelopeFactor, a_matrix_without_an_inverse_gets_the_least_pivot) {
  EnvelopeFactor factor;
  factor.begin(std::vector<uint32_t>{0, 0});
  for (const size_t row : {0U, 1U})
    for (size_t column = 0; column <= row; ++column) factor.at(row, column) = 2.0;
  factor.factorise(1e-3);
  std::vector<double> side{1.0, 1.0};
  factor.solve(side);
  EXPECT_NEAR(side[0] + side[1], 0.5, 1e-12);
  side = {1.0, -1.0};
  factor.solve(side);
  EXPECT_LT(std::abs(side[1]), 1'001.0);
}

}  // namespace
}  // namespace scree
