#include "server/replay/recorded_field.h"

#include <fmt/format.h>

#include "shared/base/check.h"

namespace scree {

void follow_bricks(const TickDelta& delta, Field& field) {
  CHECK(delta.reverted.empty());
  for (const BrickState& brick : delta.bricks) field.set_brick(brick.coord, *brick.brick, brick.materials);
}

Result<std::shared_ptr<const TickDelta>> state_at_start(ReplaySource& source) {
  if (source.tick() == 0) return source.same();
  return source.next();
}

Result<std::unique_ptr<Field>> field_at(const std::string& path, Tick tick, const GroundGiver& ground) {
  auto source = TRY(ReplaySource::open(path, 0, ground));
  if (tick < source->first_tick() || tick > source->last_tick())
    return fail(fmt::format("{}: there is no tick {} in it; its ticks are {} to {}", path, tick,
                            source->first_tick(), source->last_tick()));
  TRY(source->seek(tick));
  const auto state = TRY(state_at_start(*source));
  auto field = std::make_unique<MapField>(source->header().world.terrain);
  follow_bricks(*state, *field);
  return field;
}

}  // namespace scree
