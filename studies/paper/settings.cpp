#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "bench/support/heap.h"
#include "client/render/grid/grid_shape.h"
#include "shared/base/memory_count.h"
#include "shared/base/quantile.h"
#include "studies/paper/measure.h"
#include "studies/paper/session.h"

namespace scree::paper {
namespace {

constexpr double bytes_per_mib = 1024.0 * 1024.0;
constexpr Tick blast_tick = 20;
constexpr float blast_radius_m = 2.0F;
constexpr uint32_t blast_seeds = 64;
constexpr float blast_speed_m_s = 6.0F;
/// The two seconds after the blast, in which its pieces move: later the world is idle.
constexpr Tick update_ticks = 120;

/// A way to draw, at one resolution.
struct Setting {
  PictureSize picture;
  GridShape grid;
};

size_t held_since(size_t before) {
  return heap_bytes() - std::min(before, heap_bytes());
}

/// One session of a setting. Every setting draws as often: a tick after a frame finds less in the caches.
Result<void> run_setting(Stage& stage, const Plan& plan, const Setting& setting, DrawMethod& method,
                         WorkPool& pool, size_t method_bytes, SettingFound& found) {
  const size_t held_before = heap_bytes();
  method.set_options(values_of(setting.grid));
  PaperSession session(stage, session_config(), setting.picture, near_camera());
  session.show(method, pool);
  if (const Result<double> warm = session.draw(method); !warm) return fail(warm.error().message);
  std::vector<double> draw_ms, update_ms;
  for (Tick at = 0; at < plan.setting_ticks; ++at) {
    std::vector<Command> commands;
    if (at == blast_tick)
      commands.push_back(
          carve_at(session.world(), session_middle_m, blast_radius_m, blast_seeds, blast_speed_m_s));
    const SessionTick& tick = session.step(commands);
    if (at > blast_tick && at <= blast_tick + update_ticks) update_ms.push_back(tick.update_ms);
    if (at % plan.setting_ticks_a_frame != 0) continue;
    const Result<double> frame = session.draw(method);
    if (!frame) return fail(frame.error().message);
    draw_ms.push_back(*frame);
  }
  const DrawStats stats = method.stats();
  found.draw_ms.push_back(quantile(draw_ms, 0.5));
  found.update_ms.push_back(quantile(update_ms, 0.5));
  found.frames += static_cast<int>(draw_ms.size());
  found.heap_mib = static_cast<double>(method_bytes + held_since(held_before)) / bytes_per_mib;
  found.gpu_mib = static_cast<double>(gpu_bytes_of(stats.memory)) / bytes_per_mib;
  found.triangles = static_cast<double>(stats.triangles);
  found.reach_m = static_cast<double>(method.reach_m());
  found.state_hash = session.ticks().back().state_hash;
  return {};
}

/// The settings of one method, and where each one's figures go.
struct Sweep {
  std::string_view method;
  std::vector<std::pair<Setting, SettingFound*>> settings;
};

/// The rounds go through all settings in turn, so that other work of the machine slows all of them. The
/// method has no threads: what it holds is held by this one, which heap_bytes() counts.
Result<void> run_sweep(Stage& stage, const Plan& plan, Sweep& sweep, const Progress& progress) {
  const size_t held_before = heap_bytes();
  WorkPool pool(0);
  Result<std::unique_ptr<DrawMethod>> method = make_method(sweep.method, pool);
  if (!method) return fail(method.error().message);
  // The first session's world gets the chunks that the method generates; it is none of those that are
  // measured.
  PaperSession(stage, session_config(), sweep.settings.front().first.picture, near_camera())
      .show(**method, pool);
  const size_t method_bytes = held_since(held_before);
  double done = 0.0;
  for (int round = 0; round < plan.rounds; ++round)
    for (const auto& [setting, found] : sweep.settings) {
      TRY(run_setting(stage, plan, setting, **method, pool, method_bytes, *found));
      progress(++done / static_cast<double>(sweep.settings.size() * static_cast<size_t>(plan.rounds)));
    }
  return {};
}

}  // namespace

Result<void> measure_settings(Stage& stage, const Plan& plan, const Progress& progress, Findings& found) {
  Sweep grids{"grid", {}}, march{"raymarch", {}};
  found.grids.clear();
  for (const GridSpacing spacing : all_kinds<GridSpacing>) {
    SweepFound sweep{fmt::format("{} spacing", name_of(spacing)), {}};
    for (const int cells : plan.grid_cells) sweep.settings.push_back({.size = static_cast<double>(cells)});
    found.grids.push_back(std::move(sweep));
  }
  for (size_t i = 0; i < found.grids.size(); ++i)
    for (size_t j = 0; j < plan.grid_cells.size(); ++j)
      grids.settings.push_back({{plan.picture(100), {plan.grid_cells[j], 1, all_kinds<GridSpacing>.at(i)}},
                                &found.grids[i].settings[j]});
  found.raymarch = {"raymarch", {}};
  for (const int percent : plan.percents)
    found.raymarch.settings.push_back({.size = static_cast<double>(percent)});
  for (size_t j = 0; j < plan.percents.size(); ++j)
    march.settings.push_back({{plan.picture(plan.percents[j]), {}}, &found.raymarch.settings[j]});
  if (Result<void> ran = run_sweep(stage, plan, grids, [&](double part) { progress(0.6 * part); }); !ran)
    return ran;
  return run_sweep(stage, plan, march, [&](double part) { progress(0.6 + 0.4 * part); });
}

}  // namespace scree::paper
