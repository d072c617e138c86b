// A game's cue as an event, which sounds and dust are made of. It shakes nothing.
#pragma once

#include "client/viewer/events/piece_event.h"
#include "shared/game/notice.h"

namespace scree {

/// As if a cube of the cue's size and material struck with its energy.
PieceEvent event_of(const Cue& cue, const Palette& palette);

}  // namespace scree
