#include "server/history/undo_marks.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "server/history/limits.h"

namespace scree {

namespace {

/// Their commands have numbers from here on: those of an undo come later.
constexpr uint32_t first_mark_request = 0x7FFF'0000U;

/// Bricks of one mark lie within so many chunks a side.
constexpr int32_t mark_chunks = 2;

struct MarkedPlace {
  glm::dvec3 sum_m{0.0};
  size_t bricks = 0;
};

}  // namespace

std::vector<Command> marks_of(const UndoPlan& plan, uint64_t session, const HistoryUnits& units) {
  const double side_m = static_cast<double>(units.voxel_size_m) * brick_size;
  std::map<ChunkCoord, MarkedPlace> by_cell;
  for (const PlannedBrick& planned : plan.bricks) {
    const BrickCoord brick = planned.image.brick;
    const ChunkCoord chunk = chunk_of(brick);
    const auto cell = [](int32_t c) { return c >= 0 ? c / mark_chunks : (c + 1) / mark_chunks - 1; };
    MarkedPlace& place = by_cell[{cell(chunk.x), cell(chunk.y), cell(chunk.z)}];
    place.sum_m += (glm::dvec3(brick.x, brick.y, brick.z) + 0.5) * side_m;
    ++place.bricks;
  }
  std::vector<MarkedPlace> places;
  for (const auto& [cell, place] : by_cell) places.push_back(place);
  std::ranges::stable_sort(places, std::ranges::greater(), &MarkedPlace::bricks);
  if (places.size() > limits::undo_marks_max) places.resize(limits::undo_marks_max);
  std::vector<Command> commands;
  for (size_t i = 0; i < places.size(); ++i) {
    Sign sign{.name = fmt::format("undo {:02}", i), .kind = SignKind::marker};
    sign.to = {.kind = AudienceKind::session, .session = session};
    sign.text = fmt::format("{} bricks would go back", places[i].bricks);
    sign.place_m = glm::vec3(places[i].sum_m / static_cast<double>(places[i].bricks));
    sign.colour = {255, 160, 40};
    sign.until = units.now + static_cast<Tick>(limits::undo_marks_s * units.tick_rate_hz);
    commands.push_back(
        {0, first_mark_request + static_cast<uint32_t>(i), RulesRequest{ShowSign{std::move(sign)}}});
  }
  return commands;
}

}  // namespace scree
