#include "server/world/slide_stage.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "server/work/limits.h"
#include "server/world/limits.h"
#include "shared/operation/price.h"
#include "shared/operation/slide_operation.h"

namespace scree {

namespace {

constexpr int place_bricks = 2;

/// The highest brick of a column of bricks that holds rock, from that one down; the lowest of all where none
/// does.
int surface_brick(const Field& field, BrickCoord from) {
  const int lowest = from.y - limits::slide_depth_bricks;
  for (; from.y > lowest; --from.y)
    if (std::ranges::any_of(field.brick(from).codes, [](Code code) { return code < 0; })) break;
  return from.y;
}

int floor_to(int value, int step) {
  const int rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

/// The voxels around a place whose slopes are looked at: with the ground below them that rubble runs down to.
VoxelBox box_around(const Field& field, BrickCoord place, int cell) {
  const int margin = limits::slide_margin_cells * cell;
  const VoxelCoord first = first_voxel(place);
  VoxelBox box{first - VoxelCoord{margin, 0, margin},
               first + VoxelCoord{place_bricks * brick_size + margin, 0, place_bricks * brick_size + margin}};
  box.lo.x = floor_to(box.lo.x, cell);
  box.lo.z = floor_to(box.lo.z, cell);
  box.hi.x = floor_to(box.hi.x + cell - 1, cell);
  box.hi.z = floor_to(box.hi.z + cell - 1, cell);
  const BrickCoord lo = brick_of(box.lo), hi = brick_of(box.hi - VoxelCoord{1, 1, 1});
  const int top = place.y + place_bricks;
  int lowest = top;
  for (int x = lo.x; x <= hi.x; ++x)
    for (int z = lo.z; z <= hi.z; ++z) lowest = std::min(lowest, surface_brick(field, {x, top, z}));
  box.lo.y = lowest * brick_size;
  box.hi.y = (top + 1) * brick_size;
  return box;
}

/// The rows that voxels in and around a place say they are of, and that slide; in order.
std::set<Material> sliding_rows(const Field& field, const Palette& palette, BrickCoord place) {
  std::set<Material> rows;
  const auto enter = [&](VoxelMaterial said) {
    if (said == ground_own) return;
    const Material material = material_of(said);
    if (palette.has(material) && repose_of(palette.row(material))) rows.insert(material);
  };
  for (int x = place.x - 1; x <= place.x + place_bricks; ++x)
    for (int y = place.y - 1; y <= place.y + place_bricks; ++y)
      for (int z = place.z - 1; z <= place.z + place_bricks; ++z) {
        const BrickMaterials materials = field.materials({x, y, z});
        if (materials.is_uniform())
          enter(materials.uniform());
        else
          std::ranges::for_each(materials.list(), enter);
      }
  return rows;
}

/// What a look at a place costs besides: it reads the ground around, which may have to be generated.
float ground_price_us(const World::State& state, BrickCoord place) {
  if (state.config.rules < rules::paid_looks) return 0.0F;
  const VoxelBox around{first_voxel(place - BrickCoord{1, 1, 1}),
                        first_voxel(place + BrickCoord{place_bricks, place_bricks, place_bricks})};
  return limits::ground_chunk_cost_us * static_cast<float>(untouched_chunks(around, state.field));
}

/// Those of the rows that lie too steep there, as slides, in order.
std::vector<SlideOperation> due_slides(World::State& state, BrickCoord place,
                                       const std::set<Material>& rows) {
  const Field& field = state.field;
  const float dx = state.config.terrain.voxel_size_m;
  std::vector<SlideOperation> due;
  const uint8_t cell = slide_cell(dx);
  const VoxelBox box = box_around(field, place, cell);
  const Window codes = gather(field, slide_window(box));
  const MaterialReader materials(field, codes.box);
  for (const Material row : rows) {
    const SlideOperation operation{box, row, *repose_of(state.palette->row(row)), cell};
    if (!validate(Operation(operation), state.pieces, dx)) continue;  // at the world's edge
    if (const Region* const region = state.regions.forbidding(forbids::falls, box)) {
      state.regions.remember(region->id, place);
      continue;
    }
    if (SlideColumns(materials, codes, terms_of(operation)).steepest() >
        operation.tangent + limits::slide_excess)
      due.push_back(operation);
  }
  return due;
}

/// Whether the tick has room for a slide, and leaves some to what comes after.
bool has_room(const World::State& state, float price_us) {
  return state.work.affords(price_us + limits::slide_reserve_share * state.work.budget_us());
}

/// Looks at the first place of the party, and lets it slide if it is too steep. False, and it waits on, where
/// the tick has no room for the slide; unless it slides in any case.
bool look_at_first(World::State& state, uint64_t party, bool in_any_case, TickDelta& delta) {
  const auto waiting = state.slopes.find(party);
  const BrickCoord place = *waiting->second.begin();
  waiting->second.erase(waiting->second.begin());
  if (waiting->second.empty()) state.slopes.erase(waiting);
  const auto pay = [&](float price_us) {
    const bool pays = in_any_case || has_room(state, price_us);
    if (pays)
      state.work.spend(price_us);
    else
      state.slopes[party].insert(place);
    return pays;
  };
  state.work.spend(limits::slide_glance_cost_us);
  const std::set<Material> rows = sliding_rows(state.field, *state.palette, place);
  if (rows.empty()) return true;
  state.work.spend(limits::slide_look_cost_us);
  if (const float ground_us = ground_price_us(state, place); ground_us > 0.0F && !pay(ground_us))
    return false;
  for (const SlideOperation& operation : due_slides(state, place, rows)) {
    if (!pay(slide_price_us(operation.box))) return false;
    if (!state.apply_and_record(operation, party, delta).changed.empty()) break;
  }
  return true;
}

}  // namespace

std::optional<uint8_t> repose_of(const MaterialRow& row) {
  if (!row.rubble && !(row.loose && row.bearing.hanging_pa <= limits::slide_hanging_max_pa))
    return std::nullopt;
  const long tangent = std::lround(64.0F * row.friction);
  return static_cast<uint8_t>(std::clamp<long>(tangent, 1, limits::slide_tangent_max));
}

uint8_t slide_cell(float voxel_size_m) {
  const long columns = std::lround(limits::slide_cell_m / voxel_size_m);
  return static_cast<uint8_t>(std::clamp<long>(columns, 1, limits::slide_cell_max_voxels));
}

void slide_slopes(World::State& state, TickDelta& delta) {
  if (state.slopes.empty()) return;
  const auto rest = std::max<Tick>(
      1, static_cast<Tick>(limits::slide_rest_s * static_cast<float>(state.config.tick_rate_hz)));
  bool in_any_case = state.tick % rest == 0;
  TurnQueue<WaitingWork>& turns = state.turns.slides;
  for (const auto& [party, places] : state.slopes) turns.push(party, {});
  turns.begin_tick();
  for (size_t looks = 0; looks < limits::slide_looks_per_tick && !turns.empty(); ++looks) {
    const bool any_case = std::exchange(in_any_case, false);
    if (!any_case && !has_room(state, limits::slide_least_us)) break;
    const uint64_t party = turns.whose();
    const float left_us = state.work.left_us();
    if (!look_at_first(state, party, any_case, delta)) break;
    const float spent_us = left_us - state.work.left_us();
    if (state.slopes.contains(party))
      turns.go_on(spent_us, 0.0F);
    else
      turns.pop(spent_us);
  }
  turns.clear();
  for (const auto& [party, places] : state.slopes)
    delta.work.slides_put_off += static_cast<uint32_t>(places.size());
}

}  // namespace scree
