#include "tools/scenes/build.h"

#include "proto/spawn_direction.h"
#include "server/store/stored_field.h"
#include "server/world/fill_joints.h"
#include "shared/base/overloaded.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

/// A tick has time for a fill of any size; those before it may have put it off.
constexpr int ticks_a_request_max = 60;

glm::vec3 place_of(const BuildStep& step) {
  return std::visit(Overloaded{[](const AddPropRequest& prop) { return prop.place_m; },
                               [](const auto& request) { return centre_of(request.shape); }},
                    step);
}

Result<void> carry_out(World& world, const BuildStep& step) {
  const Command command{.body = std::visit([](const auto& request) { return Request(request); }, step)};
  std::shared_ptr<const TickDelta> delta = world.step({&command, 1});
  for (int tick = 1; delta->replies.empty(); ++tick) {
    if (tick == ticks_a_request_max)
      return fail("the world does not answer the commands that build the scene");
    delta = world.step({});
  }
  const std::string& refusal = delta->replies.front().refusal;
  if (!refusal.empty()) return fail(refusal);
  if (delta->spawned.empty()) return {};
  const glm::vec3 at_m = place_of(step);
  return fail("something falls while the scene is built, at or before the step about " +
              std::to_string(at_m.x) + ", " + std::to_string(at_m.y) + ", " + std::to_string(at_m.z));
}

}  // namespace

Result<void> build_scene(World& world, const SceneSetup& setup) {
  for (const BuildStep& step : setup.build) TRY(carry_out(world, step));
  return {};
}

Result<std::unique_ptr<World>> scene_world(const SceneSetup& setup, size_t threads) {
  WorldConfig config = setup.config;
  config.spawn = spawn_looking_at(setup.eye_m, setup.target_m);
  auto world = World::create(config, threads);
  if (!world) return world;
  TRY(build_scene(**world, setup));
  return world;
}

void build_scene(Field& field, const SceneSetup& setup) {
  PieceTable none;
  for (const BuildStep& step : setup.build)
    std::visit(Overloaded{[&](const FillRequest& fill) {
                            for (const Shape& shape : with_joints(fill.shape, field, setup.config.rules))
                              apply(FillOperation{shape, fill.material}, field, none);
                          },
                          [&](const PaintRequest& paint) {
                            apply(PaintOperation{paint.shape, paint.material}, field, none);
                          },
                          [](const AddPropRequest&) {}},
               step);
}

Result<void> make_scene_file(const SceneSetup& setup, const std::string& path, uint64_t number) {
  auto world = TRY(scene_world(setup));
  WorldHeader header{.world = number, .config = world->moment().config};
  header.config.program = "scree-scene " SCREE_VERSION;
  return create_world(path, header, *world);
}

}  // namespace scree
