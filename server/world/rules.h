// By which rules a world goes: in which order it serves the work that its parties caused, what its merges
// make, what its search for support finds, and how its pieces break and fly. A recording says by which rules
// it was made, and is verified by these. A world of an older file is played on by the newest.
#pragma once

#include <cstdint>

namespace scree {

namespace rules {
/// Falls, cuts, merges and support are served as they come, as the world's own. Files that name no rules.
inline constexpr uint32_t as_they_come = 0;
/// They belong to the party that caused them, and parties take turns (server/work/turn_queue.h).
inline constexpr uint32_t by_party = 1;
/// Also, a fall or a cut that fits into no tick comes as soon as ticks with time to spare have paid for it.
inline constexpr uint32_t spare_time = 2;
/// Also, merges make rubble, of which the palette has rows.
inline constexpr uint32_t rubble = 3;
/// Also, the search for support finds spans that break between several supports (shared/falling/spans.h).
inline constexpr uint32_t spans = 4;
/// Also, what is random in blasts and breaks goes by place and not by ids of pieces, blasts push to the open
/// side, a carve in stages keeps the gradient of its pattern, and even rock breaks into natural sizes.
inline constexpr uint32_t by_place = 5;
/// Also, blows break terrain off (blow_stage.h), and dents at one place add up.
inline constexpr uint32_t blows = 6;
/// Also, rubble and loose ground that lies steeper than its angle of repose slides (slide_stage.h).
inline constexpr uint32_t slides = 7;
/// Also, a fill that lies exactly on a face of the terrain joins it, and what falls from a large island
/// becomes terrain again when all of it has fallen. Posts that were cut off topple.
inline constexpr uint32_t joints = 8;
/// Also, a look at a slope pays for the ground that it may have to generate; a break must be at its piece;
/// and a prop whose density makes it too heavy is refused.
inline constexpr uint32_t paid_looks = 9;
/// Also, blasts throw what they break out of the hole (ejecta.h).
inline constexpr uint32_t ejecta = 10;
/// New worlds have these. A program goes by its own newest where a file names newer ones.
inline constexpr uint32_t newest = ejecta;
}  // namespace rules

}  // namespace scree
