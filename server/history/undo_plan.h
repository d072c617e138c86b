// What an undo would take back: of each brick the state to which it goes, and who edited it since. Internal
// to server/history.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "server/history/history_file.h"

namespace scree {

struct UndoTerms {
  std::set<AuthorId> authors;  ///< whose edits; none: everybody's
  Tick since = 0;              ///< edits of that tick and later
  /// Bricks within, both included; nothing: all.
  std::optional<std::pair<BrickCoord, BrickCoord>> box;
  /// Bricks that others edited since go back, too; else what others did last stays.
  bool over_others = false;
  AuthorId undo = 0;  ///< what this one did last stays: it goes on with the rest; 0: it begins

  bool means(AuthorId author) const { return authors.empty() || authors.contains(author); }
  bool holds(BrickCoord brick) const;
};

struct PlannedBrick {
  ImageRow image;                             ///< the run before which it was as it is to be
  uint64_t now = 0;                           ///< its hash after its last edit
  std::shared_ptr<const BrickPatch> exact{};  ///< what it is to be; null: as it was before the run
};

struct UndoPlan {
  std::vector<PlannedBrick> bricks;  ///< from the bottom up, chunk by chunk
  size_t held = 0;                   ///< bricks that stay as others made them, in all or in part
  std::map<AuthorId, size_t> holders;
  size_t earlier =
      0;  ///< bricks of which the same author's edits of up to limits::history_run_s before go, too
  BrickCoord lo, hi;  ///< of all planned bricks, both included
};

/// Refuses more than limits::undo_bricks_max.
Result<UndoPlan> plan_undo(HistoryFile& file, const UndoTerms& terms);

}  // namespace scree
