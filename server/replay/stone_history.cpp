#include "server/replay/stone_history.h"

namespace scree {

namespace {

/// Each has some kilobytes.
constexpr size_t remembered_stones_max = 32768;

}  // namespace

void StoneHistory::note(const TickDelta& delta) {
  for (const PlacedStone& one : delta.stones)
    if (rows_.size() < remembered_stones_max)
      rows_.try_emplace(one.stone.id, Row{.stone = one.stone, .began = delta.tick});
  for (const PlacedStone& one : delta.stones_gone)
    if (const auto found = rows_.find(one.stone.id); found != rows_.end()) found->second.ended = delta.tick;
}

std::vector<SettledStone> StoneHistory::at(Tick tick) const {
  std::vector<SettledStone> stones;
  for (const auto& [id, row] : rows_)
    if (row.began <= tick && tick < row.ended) stones.push_back(row.stone);
  return stones;
}

}  // namespace scree
