#include "studies/paper/session.h"

#include <algorithm>
#include <thread>

#include "bench/support/scenes.h"
#include "client/render/scene/look_at.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree::paper {
namespace {

/// Around the middle: more than what a session's pieces reach.
constexpr float looked_at_m = 16.0F;
/// Work of a pool without threads between two looks whether all is loaded.
constexpr double loading_s = 0.05;

float middle_height_m(const TerrainSource& terrain) {
  return ground_height_m(terrain, session_middle_m.x, session_middle_m.y);
}

/// From a place so high above the ground, at the middle.
Camera over_ground(glm::vec2 place_m, float height_m) {
  const TerrainSource terrain = session_config().terrain;
  const glm::vec3 eye_m(place_m.x, ground_height_m(terrain, place_m.x, place_m.y) + height_m, place_m.y);
  return look_at(eye_m, {session_middle_m.x, middle_height_m(terrain), session_middle_m.y});
}

}  // namespace

WorldConfig session_config() {
  WorldConfig config;
  config.terrain = {TerrainKind::noise, 1, 0.25F};
  return config;
}

Camera near_camera() {
  return over_ground({0.0F, 0.0F}, 1.8F);
}

Camera far_camera() {
  return over_ground({2.0F, 6.0F}, 4.0F);
}

Camera high_camera() {
  return look_at({0.0F, 18.0F, 26.0F}, glm::vec3(0.0F));
}

PaperSession::PaperSession(Stage& stage, const WorldConfig& config, PictureSize picture, const Camera& camera)
    : stage_(stage), world_(config), picture_(picture), camera_(camera) {
  stage_.renderer->set_terrain(config.terrain);
  stage_.renderer->set_palette(config.palette);
  generate_around(world_);
}

PaperSession::~PaperSession() {
  MirrorChanges forgotten;
  forgotten.bricks = edited_;
  for (DrawMethod* method : methods_) method->changed(forgotten);
}

void PaperSession::show(DrawMethod& method, WorkPool& pool) {
  methods_.push_back(&method);
  const Scene scene{world_.field(), pieces_.now()};
  for (method.update(scene, camera_); !method.complete(); method.update(scene, camera_)) {
    pool.run_for(loading_s);
    std::this_thread::yield();
  }
}

SessionTick& PaperSession::step(std::span<const Command> commands) {
  const bool pieces_before = !pieces_.now().empty();
  SessionTick tick{.time_s = static_cast<double>(world_.tick()) / world_.config().tick_rate_hz};
  Stopwatch stopwatch;
  const std::shared_ptr<const TickDelta> delta = world_.step(commands);
  tick.update_ms = stopwatch.lap_ms();
  for (const Reply& reply : delta->replies) CHECK(reply.refusal.empty());
  apply(*delta);
  tick.bodies_ms = delta->times[TickStage::bodies];
  tick.pieces = delta->pieces.size();
  tick.edited = !commands.empty();
  tick.reshaped = pieces_before && !delta->bricks.empty();
  for (const AppliedOperation& applied : delta->operations)
    tick.merged = tick.merged || pieces_merged_by(applied.operation) > 0;
  tick.state_hash = delta->state_hash;
  ticks_.push_back(tick);
  return ticks_.back();
}

void PaperSession::apply(const TickDelta& delta) {
  MirrorChanges changes;
  pieces_.follow(delta, changes);
  edited_.insert(edited_.end(), changes.bricks.begin(), changes.bricks.end());
  for (DrawMethod* method : methods_) method->changed(changes);
}

Result<double> PaperSession::draw(DrawMethod& method) {
  CHECK(std::ranges::find(methods_, &method) != methods_.end());
  Stopwatch stopwatch;
  method.update(Scene{world_.field(), pieces_.now()}, camera_);
  const Result<void> drawn = stage_.renderer->draw_unseen(method, camera_, picture_.width, picture_.height);
  if (!drawn) return fail(drawn.error().message);
  return stopwatch.lap_ms();
}

Result<std::unique_ptr<DrawMethod>> make_method(std::string_view name, WorkPool& pool) {
  const MethodEntry& entry = *method_named(name);
  if (const auto missing = entry.missing())
    return fail("the method " + std::string(name) + " needs " + *missing);
  return entry.make(pool, view_radius_m);
}

void generate_around(World& world) {
  const TerrainSource& terrain = world.config().terrain;
  const Shape all = sphere({session_middle_m.x, middle_height_m(terrain), session_middle_m.y}, looked_at_m);
  gather(world.field(), band_box(in_voxels(all, terrain.voxel_size_m)));
}

Command carve_at(const World& world, glm::vec2 place_m, float radius_m, uint32_t seeds,
                 float blast_speed_m_s) {
  CarveRequest blow = blow_at(world.config().terrain, place_m.x, place_m.y, radius_m, seeds, 1);
  blow.blast_speed_m_s = blast_speed_m_s;
  return {0, 0, blow};
}

}  // namespace scree::paper
