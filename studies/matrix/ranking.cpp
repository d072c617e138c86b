#include "studies/matrix/ranking.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "shared/base/check.h"

namespace scree {

namespace {

/// As good in all, and better in one.
bool dominates(const MatrixScore& a, const MatrixScore& b) {
  bool better = false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    better = better || a[i] < b[i];
  }
  return better;
}

double sum_of(const MatrixScore& rank) {
  return std::accumulate(rank.begin(), rank.end(), 0.0);
}

}  // namespace

std::vector<MatrixScore> ranks_of(const std::vector<MatrixScore>& scores) {
  std::vector<MatrixScore> ranks(scores.size());
  for (size_t criterion = 0; criterion < matrix_criteria.size(); ++criterion) {
    std::vector<double> sorted;
    for (const MatrixScore& score : scores) sorted.push_back(score[criterion]);
    std::ranges::sort(sorted);
    for (size_t i = 0; i < scores.size(); ++i) {
      const auto better = std::ranges::lower_bound(sorted, scores[i][criterion]) - sorted.begin();
      ranks[i][criterion] =
          static_cast<double>(better) / static_cast<double>(std::max<size_t>(scores.size() - 1, 1));
    }
  }
  return ranks;
}

std::vector<size_t> pareto_front(const std::vector<MatrixScore>& scores) {
  std::vector<size_t> front;
  for (size_t i = 0; i < scores.size(); ++i)
    if (std::ranges::none_of(scores, [&](const MatrixScore& other) { return dominates(other, scores[i]); }))
      front.push_back(i);
  return front;
}

size_t balanced_choice(const std::vector<MatrixScore>& scores) {
  CHECK(!scores.empty());
  const std::vector<MatrixScore> ranks = ranks_of(scores);
  return std::ranges::min(pareto_front(scores), {}, [&](size_t i) {
    return std::tuple(std::ranges::max(ranks[i]), sum_of(ranks[i]), i);
  });
}

size_t best_by(const std::vector<MatrixScore>& scores, size_t criterion) {
  CHECK(!scores.empty() && criterion < matrix_criteria.size());
  const std::vector<MatrixScore> ranks = ranks_of(scores);
  size_t best = 0;
  for (size_t i = 1; i < scores.size(); ++i)
    if (std::tuple(ranks[i][criterion], sum_of(ranks[i])) <
        std::tuple(ranks[best][criterion], sum_of(ranks[best])))
      best = i;
  return best;
}

}  // namespace scree
