#include "studies/matrix/profiles.h"

#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "bench/support/cores.h"
#include "bench/support/machine.h"
#include "client/viewer/viewing/options.h"
#include "server/app/resident_memory.h"
#include "server/app/server_options.h"
#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr uint32_t profile_seeds = 64;

/// One core for those that simulate and draw on a weak machine.
bool has_one_core(Preset preset) {
  return preset == Preset::laptop;
}

struct ProfileOptions {
  LiveConfig live;
  ViewerOptions viewer;  ///< unused by presets that draw nothing
  bool draws = false;
};

/// As the programs understand --preset.
Result<ProfileOptions> options_of(Preset preset) {
  const std::string name(name_of(preset));
  const std::array server{"scree-server", "--preset", name.c_str()};
  const auto live = parse_server_options(static_cast<int>(server.size()), server.data());
  if (!std::holds_alternative<ServerOptions>(live)) return fail("the server does not take --preset " + name);
  ProfileOptions options{std::get<ServerOptions>(live).live, {}, is_for_viewers(preset)};
  options.live.world.terrain = matrix_terrain;
  if (!options.draws) return options;
  const std::array viewer{"scree-viewer", "--preset", name.c_str(), "--cache-mib", "0"};
  auto view = parse_options(static_cast<int>(viewer.size()), viewer.data());
  if (!std::holds_alternative<ViewerOptions>(view)) return fail("the viewer does not take --preset " + name);
  options.viewer = std::move(std::get<ViewerOptions>(view));
  return options;
}

/// The session's ticks, one by one.
class ProfileRun {
 public:
  ProfileRun(const ProfileOptions& options, const SessionPlan& plan)
      : session_(options.live.world, options.viewer.pattern.value_or(SeedPattern::radial), plan,
                 options.live.sim_threads),
        rate_hz_(options.live.world.tick_rate_hz),
        last_blow_(plan.blows * plan.ticks_between_blows) {}

  MatrixSession& session() { return session_; }

  void step() {
    const auto delta = session_.step();
    ticks_ms_.push_back(delta->times.total_ms());
    for (const Reply& reply : delta->replies) refused_ += reply.refusal.empty() ? 0.0 : 1.0;
    most_ = std::max(most_, delta->pieces.size());
    const bool at_rest = delta->tick > last_blow_ && 10 * delta->pieces.size() <= most_;
    if (at_rest && rest_s_ == 0.0) rest_s_ = static_cast<double>(delta->tick - last_blow_) / rate_hz_;
  }
  ProfileFigures figures() const {
    ProfileFigures figures;
    figures.tick_budget_ms = 1000.0 / rate_hz_;
    double sum = 0.0, late = 0.0;
    for (const double ms : ticks_ms_) {
      sum += ms;
      late += ms > figures.tick_budget_ms ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(ticks_ms_.size());
    figures.tick_ms = sum / count;
    figures.tick_p99_ms = quantile(ticks_ms_, 0.99);
    figures.late_percent = 100.0 * late / count;
    figures.pieces_most = static_cast<double>(most_);
    figures.refused = refused_;
    figures.seconds_to_rest = rest_s_;
    figures.resident_mb = resident_bytes() / 1e6;
    return figures;
  }

 private:
  MatrixSession session_;
  double rate_hz_;
  Tick last_blow_;
  size_t most_ = 0;
  std::vector<double> ticks_ms_;
  double refused_ = 0.0, rest_s_ = 0.0;
};

/// Half a second between blows, and so many between frames that a session has about twenty.
SessionPlan plan_of(const WorldConfig& world, bool quick) {
  SessionPlan plan{.seeds = profile_seeds, .ticks_between_blows = world.tick_rate_hz / 2};
  plan.blows = quick ? 2 : 16;
  plan.ticks = world.tick_rate_hz * (quick ? 2U : 16U);
  return plan;
}

/// Draws some frames of the session, if it draws at all.
Result<ProfileFigures> run_profile(const ProfileOptions& options, bool quick) {
  const SessionPlan plan = plan_of(options.live.world, quick);
  if (!options.draws) {
    ProfileRun run(options, plan);
    while (!run.session().ended()) run.step();
    return run.figures();
  }
  const Quality quality = options.viewer.quality.value_or(Quality::high);
  const DrawPlan how{quality, options.viewer.width, options.viewer.height, plan.ticks / (quick ? 2 : 20)};
  const auto stage = Stage::create(traits_of(quality).view_radius_m);
  if (!stage) return fail(stage.error().message);
  const auto drawer = SessionDrawer::create(**stage, *options.viewer.method, how);
  if (!drawer) return fail(drawer.error().message);
  ProfileRun run(options, plan);
  std::vector<double> frames_ms;
  double sum_ms = 0.0;
  if (const auto first = (*drawer)->frame(run.session()); !first) return fail(first.error().message);
  while (!run.session().ended()) {
    run.step();
    if (run.session().world().tick() % how.ticks_per_frame != 0) continue;
    const Result<DrawnFrame> time = (*drawer)->frame(run.session());
    if (!time) return fail(time.error().message);
    frames_ms.push_back(time->update_ms + time->draw_ms);
    sum_ms += frames_ms.back();
  }
  ProfileFigures figures = run.figures();
  figures.frame_ms = sum_ms / static_cast<double>(frames_ms.size());
  figures.frame_p99_ms = quantile(frames_ms, 0.99);
  figures.draw_mib = (*drawer)->memory_mib();
  figures.view_radius_m = static_cast<double>(traits_of(quality).view_radius_m);
  return figures;
}

}  // namespace

Result<ProfileFigures> measure_profile(Preset preset, bool quick) {
  const Result<ProfileOptions> options = options_of(preset);
  if (!options) return fail(options.error().message);
  Result<ProfileFigures> figures;
  std::thread alone([&] {
    std::optional<OnCores> on_one;
    if (has_one_core(preset)) on_one.emplace(1, OnCores::Which::first);
    if (on_one && usable_cores() != 1) {
      figures = fail("this thread cannot be kept to one core");
      return;
    }
    figures = run_profile(*options, quick);
    if (!figures) return;
    figures->cores = usable_cores();
    figures->memory_max_mb = options->live.world.memory_max_mb;
  });
  alone.join();
  if (!figures) return fail(std::string(name_of(preset)) + ": " + figures.error().message);
  return figures;
}

}  // namespace scree
