// Where an undo would take bricks back, as markers on the screen of the one who asks. Internal to
// server/history.
#pragma once

#include <vector>

#include "server/command/command.h"
#include "server/history/history_text.h"
#include "server/history/undo_plan.h"

namespace scree {

/// Commands that show the places with most bricks to a session, for limits::undo_marks_s.
std::vector<Command> marks_of(const UndoPlan& plan, uint64_t session, const HistoryUnits& units);

}  // namespace scree
