// The kinds of what a piece does that is heard and seen; and those of a game's cues, which are heard alone or
// seen alone.
#pragma once

#include <cstdint>

namespace scree {

enum class PieceEventKind : uint32_t { strike, crack, settle, thud, snap, ring, rattle, dust, sparks };

constexpr bool is_heard(PieceEventKind kind) {
  return kind < PieceEventKind::dust;
}
constexpr bool is_cue(PieceEventKind kind) {
  return kind >= PieceEventKind::thud;
}

}  // namespace scree
