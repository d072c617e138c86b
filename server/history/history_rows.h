// What a history keeps: who edited, what, where, and what bricks were before. Plain values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/base/ids.h"
#include "shared/field/brick_patch.h"
#include "shared/field/coord.h"

namespace scree {

/// Who edits: the number of a session, an undo's (undo_author), or 0, the world itself.
using AuthorId = uint64_t;

/// Sessions have smaller numbers.
inline constexpr AuthorId first_undo_author = AuthorId{1} << 62U;
constexpr AuthorId undo_author(uint32_t number) {
  return first_undo_author + number;
}
constexpr bool is_undo(AuthorId author) {
  return author >= first_undo_author;
}

struct Author {
  AuthorId id = 0;
  uint64_t party = 0;     ///< Command::party; 0: not known yet
  uint64_t token_id = 0;  ///< of the access token; 0: none
  uint64_t address = 0;   ///< of its IP address, a hash with the history's own key; 0: not known
  Tick since = 0;         ///< when it joined
  std::string name;       ///< of an undo: who took what back

  bool operator==(const Author&) const = default;
};

/// An operation that changed terrain or made pieces.
struct EditRow {
  Tick tick = 0;
  AuthorId author = 0;
  uint8_t kind = 0;   ///< place of the operation in its variant
  BrickCoord lo, hi;  ///< bricks that it changed lie within, both included
  uint32_t bricks = 0;
  uint32_t pieces = 0;  ///< that it made
};

/// One row for both, of the first's tick.
inline EditRow together(EditRow all, const EditRow& more) {
  all.lo = {std::min(all.lo.x, more.lo.x), std::min(all.lo.y, more.lo.y), std::min(all.lo.z, more.lo.z)};
  all.hi = {std::max(all.hi.x, more.hi.x), std::max(all.hi.y, more.hi.y), std::max(all.hi.z, more.hi.z)};
  all.bricks += more.bricks;
  all.pieces += more.pieces;
  return all;
}

/// A run of edits of a brick by one author, and what the brick was before the first.
struct ImageRow {
  int64_t key = 0;  ///< ascends in time
  BrickCoord brick;
  Tick first = 0, last = 0;  ///< of the run's edits
  AuthorId author = 0;
  uint64_t after = 0;  ///< brick_hash() after the last tick of the run; 0: not known
};

}  // namespace scree
