#include <algorithm>
#include <array>

#include "shared/base/check.h"
#include "studies/paper/measure.h"
#include "studies/paper/session.h"

namespace scree::paper {
namespace {

constexpr int blows_a_side = 3;
constexpr float blow_spacing_m = 4.0F;
constexpr float blow_radius_m = 1.8F;
constexpr uint32_t blow_seeds = 30;
constexpr float blow_speed_m_s = 4.0F;
constexpr double carving_from_s = 3.0;
constexpr Tick dig_every = 15;
/// Smaller than the ridges between the blows' holes.
constexpr float dig_radius_m = 0.9F;
constexpr uint32_t dig_seeds = 2;

/// Pieces stay pieces: nothing merges, breaks or dents, so that each collider has as many.
WorldConfig rebuild_config(TerrainColliderKind collider) {
  WorldConfig config = session_config();
  config.merges_per_tick_max = 0;
  config.methods.collider = collider;
  config.methods.impacts = config.methods.dents = config.methods.islands = false;
  return config;
}

/// Where the blows fall, row by row; halves are between them.
glm::vec2 place_at(float column, float row) {
  const float middle = 0.5F * static_cast<float>(blows_a_side - 1);
  return session_middle_m + glm::vec2(column - middle, row - middle) * blow_spacing_m;
}

/// Along the ridges between the holes, again and again at other places of them.
glm::vec2 dig_place(int carve) {
  constexpr int ridges = blows_a_side - 1;
  const int ridge = carve % ridges;
  const float along = static_cast<float>(carve / ridges % 7) * static_cast<float>(blows_a_side - 1) / 6.0F;
  const float across = static_cast<float>(ridge) + 0.5F;
  return carve / (7 * ridges) % 2 == 0 ? place_at(across, along) : place_at(along, across);
}

struct RebuildRun {
  SessionFound session;
  size_t pieces = 0;
};

Result<RebuildRun> run_rebuilds(Stage& stage, const Plan& plan, DrawMethod& method,
                                TerrainColliderKind collider) {
  PaperSession session(stage, rebuild_config(collider), plan.session_picture(), far_camera());
  session.show(method, stage.pool);
  if (const Result<double> warm = session.draw(method); !warm) return fail(warm.error().message);
  const Tick from = static_cast<Tick>(carving_from_s * session.world().config().tick_rate_hz);
  const Tick end = from + static_cast<Tick>(plan.rebuild_carves) * dig_every;
  RebuildRun run{{std::string(name_of(collider)), {}}, 0};
  for (Tick at = 0; at < end; ++at) {
    std::vector<Command> commands;
    if (at < blows_a_side * blows_a_side)
      commands.push_back(
          carve_at(session.world(),
                   place_at(static_cast<float>(at % blows_a_side), static_cast<float>(at / blows_a_side)),
                   blow_radius_m, blow_seeds, blow_speed_m_s));
    if (at >= from && (at - from) % dig_every == dig_every / 2)
      commands.push_back(carve_at(session.world(), dig_place(static_cast<int>((at - from) / dig_every)),
                                  dig_radius_m, dig_seeds, 1.0F));
    SessionTick& tick = session.step(commands);
    if (at == from) run.pieces = tick.pieces;
    // Some frames fall on the ticks of carves.
    if (at < from || (at - from) % plan.rebuild_ticks_a_frame != dig_every / 2 % plan.rebuild_ticks_a_frame)
      continue;
    const Result<double> frame = session.draw(method);
    if (!frame) return fail(frame.error().message);
    tick.draw_ms = *frame;
  }
  run.session.ticks = session.ticks();
  return run;
}

void assign_minimum(SessionFound& least, const SessionFound& again) {
  CHECK_EQ(least.ticks.size(), again.ticks.size());
  for (size_t i = 0; i < least.ticks.size(); ++i) {
    SessionTick& minimum = least.ticks[i];
    const SessionTick& other = again.ticks[i];
    CHECK(minimum.state_hash == other.state_hash);
    minimum.update_ms = std::min(minimum.update_ms, other.update_ms);
    minimum.bodies_ms = std::min(minimum.bodies_ms, other.bodies_ms);
    if (minimum.draw_ms) minimum.draw_ms = std::min(*minimum.draw_ms, *other.draw_ms);
  }
}

}  // namespace

Result<RebuildFound> measure_rebuilds(Stage& stage, const Plan& plan, const Progress& progress) {
  auto method = make_method("raymarch", stage.pool);
  if (!method) return fail(method.error().message);
  constexpr std::array kinds{TerrainColliderKind::mesh, TerrainColliderKind::rays,
                             TerrainColliderKind::field};
  RebuildFound found{.colliders = {}, .carving_from_s = carving_from_s, .runs = plan.rebuild_runs};
  double done = 0.0;
  for (int round = 0; round < plan.rebuild_runs; ++round)
    for (size_t i = 0; i < kinds.size(); ++i) {
      Result<RebuildRun> run = run_rebuilds(stage, plan, **method, kinds.at(i));
      if (!run) return fail(run.error().message);
      if (round == 0) {
        found.colliders.push_back(std::move(run->session));
        found.pieces = run->pieces;
      } else {
        assign_minimum(found.colliders[i], run->session);
      }
      progress(++done / static_cast<double>(kinds.size() * static_cast<size_t>(plan.rebuild_runs)));
    }
  return found;
}

}  // namespace scree::paper
