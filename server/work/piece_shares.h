// Whose pieces are alive, and how many a carve may add. A party (command.h) that is alone may have all that
// there is room for. Where several have pieces, or ask, each may hold as many as are still free (dynamic
// thresholds: Choudhury and Hahne 1998). So n parties that take all they get hold 1/(n + 1) each, and as much
// stays free for one more. Part of the simulation: deterministic. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

namespace scree {

/// The room for pieces before a carve.
struct PieceRoom {
  size_t alive = 0;
  uint32_t pieces_max = 0;
  float bodies_load = 0.0F;  ///< WorkBudget::bodies_load()
  bool others_wait = false;  ///< another party has requests waiting
};

/// How many of the pieces that a carve asks for it may make.
struct PieceGrant {
  uint32_t pieces = 0;     ///< 0: none
  bool contested = false;  ///< other parties have pieces, or ask for some
  bool may_wait = false;   ///< none, but others hold more than this party: room is coming
  /// Where none: what it may make when it has waited a little in vain, because it holds less than its part of
  /// the limit of pieces. Otherwise a few parties with large pieces would keep out those with small ones.
  uint32_t pieces_at_last = 0;
  uint32_t pieces_most = 0;  ///< where none: the most that the party would have been granted a part of
};

class PieceShares {
 public:
  /// A piece of the party's begins to be alive; party 0 is the world itself.
  void add(uint64_t party);
  /// The party must have one.
  void remove(uint64_t party);
  /// Number of the party's pieces.
  uint32_t of(uint64_t party) const;
  /// Whether several parties share the pieces alive, and this one holds less than its part of them. Never
  /// the world itself.
  bool holds_little(uint64_t party) const;

  /// `wanted` is positive. The world itself is granted what there is room for.
  PieceGrant grant(uint64_t party, uint32_t wanted, const PieceRoom& room) const;

 private:
  std::map<uint64_t, uint32_t> pieces_;  ///< by party; none is 0
};

}  // namespace scree
