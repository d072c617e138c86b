// A game's cue as an event, which sounds and dust are made of. It shakes nothing. Edits that make no pieces
// are heard and seen by cues, too.
#pragma once

#include <vector>

#include "client/viewer/events/piece_event.h"
#include "shared/game/notice.h"
#include "shared/operation/operation.h"

namespace scree {

/// As if a cube of the cue's size and material struck with its energy.
PieceEvent event_of(const Cue& cue, const Palette& palette);

/// Appends those of a dig, a place or a fill, of which no piece tells.
void add_cues_of(const Operation& operation, std::vector<Cue>& cues);

}  // namespace scree
