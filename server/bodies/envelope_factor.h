// A symmetric matrix whose rows have their values in an unbroken run up to the diagonal, and its factors LDLᵀ
// (Jennings, A compact storage scheme for the solution of symmetric linear simultaneous equations, 1966).
// Only + − × ÷, in a fixed order: the same bits everywhere. Not thread-safe. Private to this folder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scree {

class EnvelopeFactor {
 public:
  /// `first` of each row: the column of its first value, at most the row itself. All values become 0.
  void begin(std::span<const uint32_t> first);
  size_t rows() const { return first_.size(); }
  /// `column` from the row's first one to the row itself.
  double& at(size_t row, size_t column) { return values_[start_[row] + (column - first_[row])]; }
  /// Multiplications that a row takes at most, in factorise() and twice in solve(). `width`: from its first
  /// column to itself.
  static double work_of(size_t width);

  /// The matrix becomes its factors. Its diagonal must be positive, and a pivot that rounding makes smaller
  /// than `least` times its diagonal becomes that: the matrix must be positive definite but for rounding.
  void factorise(double least);
  /// The right side becomes the solution. factorise() must have been called.
  void solve(std::span<double> side) const;

 private:
  std::vector<uint32_t> first_;
  std::vector<size_t> start_;   ///< of each row's first value
  std::vector<double> values_;  ///< of each row, behind each other; then L, and D in the diagonal's place
  std::vector<double> scaled_;  ///< a row of L times D
};

}  // namespace scree
