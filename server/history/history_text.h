// Answers of a history, for people and as JSON. Internal to server/history.
#pragma once

#include <string>
#include <vector>

#include "proto/admin_message.h"
#include "server/history/authors.h"
#include "server/history/undo_run.h"

namespace scree {

/// What answers are told with.
struct HistoryUnits {
  uint32_t tick_rate_hz = 60;
  float voxel_size_m = 0.25F;
  Tick now = 0;
};

/// What a list of edits leaves out.
struct LeftOut {
  bool more = false;     ///< older ones that fit, too
  size_t by_itself = 0;  ///< edits of the world itself, such as slides, as old as those in the list
};
std::string text_of(const std::vector<EditRow>& edits, const LeftOut& left_out, Tick known_since,
                    const Authors& authors, const HistoryUnits& units, bool as_json);

/// What an undo takes back, or would. `number`: of the one that begins; nothing: it is a preview.
struct UndoSummary {
  std::optional<uint32_t> number;
  size_t bricks = 0, pieces = 0, held = 0, earlier = 0;
  std::vector<std::pair<std::string, size_t>> holders;  ///< who edited bricks since, and how many
  std::vector<std::string> authors;                     ///< whose edits; empty: everybody's
  BrickCoord lo, hi;
  Tick since = 0, known_since = 0;
};
std::string text_of(const UndoSummary& summary, const HistoryUnits& units, bool as_json);

std::string text_of(const UndoProgress& progress, const HistoryUnits& units, bool as_json);

}  // namespace scree
