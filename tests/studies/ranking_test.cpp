// Ranks, the front and the balanced choice of combinations.
#include "studies/matrix/ranking.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(Ranking, is_the_share_of_those_that_are_better) {
  const std::vector<MatrixScore> ranks = ranks_of({{1, 9, 5, 0, 0}, {2, 8, 5, 0, 0}, {3, 7, 5, 0, 1}});
  EXPECT_EQ(ranks[0], (MatrixScore{0.0, 1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(ranks[1], (MatrixScore{0.5, 0.5, 0.0, 0.0, 0.0}));
  EXPECT_EQ(ranks[2], (MatrixScore{1.0, 0.0, 0.0, 0.0, 1.0}));
}

TEST(Ranking, front_has_all_that_none_dominates_and_equals) {
  const std::vector<MatrixScore> scores{{1, 5, 0, 0, 0}, {5, 1, 0, 0, 0}, {5, 5, 0, 0, 0},
                                        {1, 5, 0, 0, 0}, {3, 3, 0, 0, 0}, {3, 3, 0, 0, 1}};
  EXPECT_EQ(pareto_front(scores), (std::vector<size_t>{0, 1, 3, 4}));
}

TEST(Ranking, balanced_is_the_one_of_the_front_with_the_least_worst_rank) {
  const std::vector<MatrixScore> scores{{1, 9, 1, 1, 1}, {9, 1, 1, 1, 1}, {3, 3, 1, 1, 1}, {4, 4, 1, 1, 1}};
  EXPECT_EQ(balanced_choice(scores), 2U);
  EXPECT_EQ(balanced_choice({{7, 7, 7, 7, 7}}), 0U);
}

TEST(Ranking, best_by_a_criterion_is_that_of_the_least_ranks_among_equals) {
  const std::vector<MatrixScore> scores{{1, 9, 9, 9, 9}, {1, 2, 2, 2, 2}, {0.5, 9, 9, 9, 9}, {2, 1, 1, 1, 1}};
  EXPECT_EQ(best_by(scores, 0), 2U);
  EXPECT_EQ(best_by({scores[0], scores[1]}, 0), 1U);
  EXPECT_EQ(best_by(scores, 4), 3U);
}

}  // namespace
}  // namespace scree
