#include "studies/paper/measure.h"
#include "studies/paper/session.h"

namespace scree::paper {
namespace {

constexpr int side = 3;
constexpr float apart_m = 3.6F;
constexpr float burst_radius_m = 1.8F;
constexpr float burst_speed_m_s = 6.0F;
constexpr double before_s = 2.0;
constexpr double after_s = 3.0;  ///< that the session goes on once all pieces are terrain
constexpr double longest_s = 40.0;

/// `ticks`: how long it lasts; 0: until all pieces are terrain and a little longer.
Result<SessionFound> run_blast(Stage& stage, const Plan& plan, DrawMethod& method, Recombination recombine,
                               Tick ticks, const Progress& progress) {
  WorldConfig config = session_config();
  config.methods.recombine = recombine;
  PaperSession session(stage, config, plan.session_picture(), far_camera());
  session.show(method, stage.pool);
  if (const Result<double> warm = session.draw(method); !warm) return fail(warm.error().message);
  const auto of = [&](double seconds) {
    return static_cast<Tick>(seconds * plan.session_seconds_scale * config.tick_rate_hz);
  };
  const Tick longest = ticks == 0 ? of(longest_s) : ticks;
  Tick quiet_since = 0;
  for (Tick at = 0; at < longest; ++at) {
    std::vector<Command> commands;
    const Tick blow = at - of(before_s);
    if (at >= of(before_s) && blow < side * side) {
      const glm::vec2 off(static_cast<float>(blow % side) - 1.0F, static_cast<float>(blow / side) - 1.0F);
      commands.push_back(carve_at(session.world(), session_middle_m + off * apart_m, burst_radius_m,
                                  plan.blast_seeds, burst_speed_m_s));
    }
    SessionTick& tick = session.step(commands);
    if (tick.pieces > 0 || at < of(before_s)) quiet_since = at;
    progress(static_cast<double>(at) / static_cast<double>(longest));
    if (at % plan.ticks_a_frame == 0) {
      const Result<double> frame = session.draw(method);
      if (!frame) return fail(frame.error().message);
      tick.draw_ms = *frame;
    }
    if (ticks == 0 && at >= quiet_since + of(after_s)) break;
  }
  return SessionFound{"", session.ticks()};
}

}  // namespace

Result<MergingFound> measure_merging(Stage& stage, const Plan& plan, const Progress& progress) {
  auto method = make_method("raymarch", stage.pool);
  if (!method) return fail(method.error().message);
  auto merging = run_blast(stage, plan, **method, WorldConfig().methods.recombine, 0,
                           [&](double part) { progress(0.5 * part); });
  if (!merging) return fail(merging.error().message);
  auto staying = run_blast(stage, plan, **method, Recombination::off, merging->ticks.size(),
                           [&](double part) { progress(0.5 + 0.5 * part); });
  if (!staying) return fail(staying.error().message);
  MergingFound found{.merging = std::move(*merging), .staying = std::move(*staying)};
  found.blast_from_s = before_s * plan.session_seconds_scale;
  return found;
}

}  // namespace scree::paper
