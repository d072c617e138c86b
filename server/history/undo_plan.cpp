#include "server/history/undo_plan.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include "server/history/limits.h"

namespace scree {

namespace {

/// The run before which a brick is to be as it was; nothing: it stays. Runs are in order.
struct Choice {
  std::optional<size_t> run;
  std::optional<AuthorId> holder;  ///< the last of others who edited it since
};

Choice choose(const std::vector<ImageRow>& runs, const UndoTerms& terms) {
  Choice choice;
  const auto meant = [&](const ImageRow& run) { return terms.means(run.author); };
  const auto first = std::ranges::find_if(runs, meant);
  if (first == runs.end() || (terms.undo != 0 && runs.back().author == terms.undo)) return choice;
  const auto is_other = [&](const ImageRow& run) { return run.author != 0 && !meant(run); };
  const auto other = std::find_if(runs.rbegin(), std::make_reverse_iterator(first), is_other);
  const bool has_other = other != std::make_reverse_iterator(first);
  if (has_other) choice.holder = other->author;
  if (!has_other || terms.over_others) {
    choice.run = static_cast<size_t>(first - runs.begin());
    return choice;
  }
  const auto after_other = std::find_if(other.base(), runs.end(), meant);
  if (after_other != runs.end()) choice.run = static_cast<size_t>(after_other - runs.begin());
  return choice;
}

void sort_from_bottom(std::vector<PlannedBrick>& bricks) {
  std::ranges::sort(bricks, [](const PlannedBrick& a, const PlannedBrick& b) {
    const ChunkCoord one = chunk_of(a.image.brick), two = chunk_of(b.image.brick);
    return std::tuple(one.y, one.x, one.z, a.image.brick) < std::tuple(two.y, two.x, two.z, b.image.brick);
  });
}

}  // namespace

bool UndoTerms::holds(BrickCoord brick) const {
  if (!box) return true;
  const auto& [lo, hi] = *box;
  return brick.x >= lo.x && brick.y >= lo.y && brick.z >= lo.z && brick.x <= hi.x && brick.y <= hi.y &&
         brick.z <= hi.z;
}

Result<UndoPlan> plan_undo(HistoryFile& file, const UndoTerms& terms) {
  UndoPlan plan;
  const std::vector<AuthorId> authors(terms.authors.begin(), terms.authors.end());
  for (const BrickCoord brick : TRY(file.bricks_of(authors, terms.since))) {
    if (!terms.holds(brick)) continue;
    const std::vector<ImageRow> runs = TRY(file.runs_of(brick, terms.since));
    const Choice choice = choose(runs, terms);
    if (choice.holder && !terms.over_others) {
      ++plan.held;
      ++plan.holders[*choice.holder];
    }
    if (!choice.run) continue;
    const ImageRow& run = runs[*choice.run];
    if (run.first < terms.since) ++plan.earlier;
    plan.bricks.push_back({run, runs.back().after});
    if (plan.bricks.size() > limits::undo_bricks_max)
      return fail(fmt::format("more than {} bricks: take back a part, by a box or a shorter time",
                              limits::undo_bricks_max));
    if (plan.bricks.size() == 1) plan.lo = plan.hi = brick;
    plan.lo = {std::min(plan.lo.x, brick.x), std::min(plan.lo.y, brick.y), std::min(plan.lo.z, brick.z)};
    plan.hi = {std::max(plan.hi.x, brick.x), std::max(plan.hi.y, brick.y), std::max(plan.hi.z, brick.z)};
  }
  sort_from_bottom(plan.bricks);
  return plan;
}

}  // namespace scree
