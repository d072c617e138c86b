#include "server/world/settings_change.h"

#include "server/work/memory.h"
#include "server/world/person_requests.h"
#include "server/world/request_stage.h"
#include "server/world/settings.h"
#include "shared/base/check.h"

namespace scree {

void change_settings(World::State& state, const SettingsRequest& request, TickDelta& delta) {
  const WorldConfig before = state.config;
  const Result<void> done = set_all(state.config, request.settings);
  CHECK(done);
  if (state.config != before) publish_settings(state, delta);
  CHECK(delta.settings.size() <= limits::settings_max);
  if (!merges(before.methods.recombine) && merges(state.config.methods.recombine)) state.bodies.thaw_all();
  state.bodies.set_terrain_collider(state.config.methods.collider);
  state.bodies.set_air_drag(drag_of(state.config));
  if (before.material_numbers != state.config.material_numbers) {
    state.palette = palette_with(state.config.palette, state.config.material_numbers);
    state.bodies.set_palette(state.palette);
  }
  state.field.bound_generated(generated_bytes_within(state.config.memory_max_mb));
  state.work.allow(state.config.work_percent);
  state.requests.expect(client_us_per_s(state.work, state.config));
  if (state.config.service.persons != Persons::walk) leave_on_foot(state, delta);
}

}  // namespace scree
