#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "studies/paper/findings/analysis.h"
#include "studies/paper/findings/composition.h"

namespace scree::paper {
namespace {

/// Bytes of a vertex of the paper's grid: three floats.
constexpr double point_bytes = 12.0;
/// Exponents of what grows nearly with the cube, and nearly with the square.
constexpr double cubic_from = 2.5, square_from = 1.5;

PlotSeries series_of(const SweepFound& sweep, double (*value)(const SettingFound&),
                     const std::vector<double> SettingFound::*rounds) {
  PlotSeries series{.name = sweep.name, .points = {}};
  for (const SettingFound& setting : sweep.settings) {
    series.points.emplace_back(setting.size, value(setting));
    if (rounds != nullptr && (setting.*rounds).size() > 1)
      series.spread.push_back(half_spread(setting.*rounds));
  }
  return series;
}

std::string span_text(const SweepFound& sweep, double (*value)(const SettingFound&)) {
  return figure(value(sweep.settings.front())) + " to " + figure(value(sweep.settings.back()));
}

std::vector<const SweepFound*> pointers(const std::vector<SweepFound>& sweeps) {
  std::vector<const SweepFound*> all;
  for (const SweepFound& sweep : sweeps) all.push_back(&sweep);
  return all;
}

double stored_points_mib(double cells) {
  return cells * cells * cells * point_bytes / (1024.0 * 1024.0);
}

ReportTable settings_table(const std::vector<const SweepFound*>& sweeps, const std::string& size,
                           const std::string& caption) {
  ReportTable table{
      caption,
      {"", size, "draw, ms", "update, ms", "triangles", "sees, m", "heap, MiB", "GPU, MiB", "frames drawn"},
      {}};
  for (const SweepFound* sweep : sweeps)
    for (const SettingFound& setting : sweep->settings)
      table.rows.push_back({sweep->name, fmt::format("{:g}", setting.size), figure(draw_ms_of(setting)),
                            figure(update_ms_of(setting)), fmt::format("{:.0f}", setting.triangles),
                            figure(setting.reach_m), figure(setting.heap_mib), figure(setting.gpu_mib),
                            std::to_string(setting.frames)});
  return table;
}

std::string why_grid_draws(double exponent) {
  if (exponent >= cubic_from)
    return "The cells of the volume grow with the cube of the cells a side, and their work grows nearly so. "
           "Blocks of cells with nothing to show are left out, but finding them and drawing the rest takes "
           "most of the time.";
  if (exponent >= square_from)
    return "The cells of the volume grow with the cube of the cells a side, but blocks of 8³ cells that are "
           "air, rock or out of "
           "sight are not drawn. What is left follows the surface, which grows with the square.";
  return "What does not depend on the grid (sky, pieces, the picture's own pixels) is a large part of these "
         "frames, and blocks "
         "of 8³ cells that are air, rock or out of sight are not drawn.";
}

std::string steady_rule() {
  return fmt::format(
      "confirmed if each step takes at least {:g} times as long as the one before, and the last longer than "
      "the first; else refuted",
      steady_share);
}

std::string steps_text(double least) {
  return fmt::format("the least step takes {:.2f} times as long as the one before", least);
}

ReportSection grid_draw(const Findings& found, Conclusions& conclusions) {
  const SweepFound &uniform = found.grids[0], &growing = found.grids[1];
  const double p = exponent_between(uniform, draw_ms_of), q = exponent_between(growing, draw_ms_of);
  const bool steady = rises_steadily(uniform, steady_share) && rises_steadily(growing, steady_share);
  const std::string steps = steps_text(std::min(least_step(uniform), least_step(growing)));
  conclusions.figures.metric("grid_uniform_draw_exponent", p);
  conclusions.figures.metric("grid_growing_draw_exponent", q);
  conclusions.claims.push_back(
      {"grid_draw_rises", "16", "Drawing by the grid takes steadily longer with the grid's resolution.",
       fmt::format("uniform {} ms, growing {} ms; {}", span_text(uniform, draw_ms_of),
                   span_text(growing, draw_ms_of), steps),
       steady_rule(), steady ? Verdict::confirmed : Verdict::refuted});
  return figure_section(
      {"Figure 16: drawing by the grid", "The time of a frame rises steadily with the grid's resolution.",
       fmt::format("From {:g} to {:g} cells a side a frame takes {} ms with uniform and {} ms with growing "
                   "spacing: the "
                   "powers {:.2f} and {:.2f} of the cells a side, between the first and the last; {}.",
                   uniform.settings.front().size, uniform.settings.back().size,
                   span_text(uniform, draw_ms_of), span_text(growing, draw_ms_of), p, q, steps),
       why_grid_draws(p)},
      {{.name = "figure-16",
        .title = "Draw frame time by the grid's resolution",
        .x_label = "cells along a side of the grid",
        .y_label = "draw frame time, ms (median)",
        .series = {series_of(uniform, draw_ms_of, &SettingFound::draw_ms),
                   series_of(growing, draw_ms_of, &SettingFound::draw_ms)}}},
      {settings_table(pointers(found.grids), "cells a side", "The grid's settings, medians of the rounds.")});
}

/// A figure of update times, which do not depend on how the terrain is drawn.
ReportSection update_section(const std::vector<const SweepFound*>& sweeps, const FigureText& text,
                             const std::string& name, const std::string& x_label, const std::string& claim,
                             const std::string& says, Conclusions& conclusions) {
  const double growth = growth_of(sweeps, update_ms_of);
  const bool same = same_work(sweeps);
  conclusions.figures.metric(claim + "_last_over_first", growth);
  conclusions.figures.check(claim + "_same_work", same, "every setting ends with the same state hash");
  const Verdict verdict = same ? rule_grows.judge(growth) : Verdict::undecided;
  const std::string work = same ? "the same hash at every setting's end" : "the worlds' hashes differ";
  conclusions.claims.push_back(
      {claim, text.title.substr(7, 2), says,
       fmt::format("the last setting's median tick is {:.2f} times the first's; {}", growth, work),
       rule_grows.text(), verdict});
  FigureText full = text;
  full.scree = fmt::format(
      "While pieces move, the median tick takes {} ms at the first setting and {} ms at the last, {:.2f} "
      "times as "
      "long at the most; the longest of all settings is {:.2f} times the shortest; {}.",
      figure(update_ms_of(sweeps.front()->settings.front())),
      figure(update_ms_of(sweeps.back()->settings.back())), growth, range_ratio(sweeps, update_ms_of), work);
  full.why = same ? "All settings simulate the same ticks bit for bit, so what their times differ by is not "
                    "the simulation's work. "
                    "Bodies ask the field itself for contacts; nothing that is drawn takes part in it. The "
                    "paper's bodies "
                    "collide with the polygons that its grid has drawn."
                  : "The settings did not simulate the same ticks, so their times cannot be compared.";
  Plot plot{.name = name,
            .title = "Update time " + std::string(sweeps.size() > 1 ? "by the grid's resolution"
                                                                    : "by the picture's resolution"),
            .x_label = x_label,
            .y_label = "update time, ms (median tick)",
            .series = {}};
  for (const SweepFound* sweep : sweeps)
    plot.series.push_back(series_of(*sweep, update_ms_of, &SettingFound::update_ms));
  return figure_section(full, {std::move(plot)});
}

ReportSection grid_memory(const Findings& found, Conclusions& conclusions) {
  const auto sweeps = pointers(found.grids);
  const SweepFound& uniform = found.grids[0];
  const double ratio = range_ratio(sweeps, memory_mib_of);
  const double most_cells = uniform.settings.back().size;
  conclusions.figures.metric("grid_memory_ratio", ratio);
  const Verdict verdict = rule_grows.judge(ratio);
  conclusions.claims.push_back(
      {"grid_memory_grows", "18", "The grid's memory grows sharply with its resolution.",
       fmt::format("{} MiB with uniform spacing; the most of all is {:.3f} times the least",
                   span_text(uniform, memory_mib_of), ratio),
       rule_grows.text(), verdict});
  PlotSeries stored{.name = "a stored point for each cell, 12 bytes (computed, not measured)", .points = {}};
  for (const SettingFound& setting : uniform.settings)
    stored.points.emplace_back(setting.size, stored_points_mib(setting.size));
  return figure_section(
      {"Figure 18: memory of the grid",
       "Memory grows sharply, “somewhat exponentially”, with the grid's resolution.",
       fmt::format("World and method together take {} MiB from {:g} to {:g} cells a side; the most of all "
                   "settings is {:.3f} times "
                   "the least.",
                   span_text(uniform, memory_mib_of), uniform.settings.front().size, most_cells, ratio),
       fmt::format(
           "{} A vertex of three floats for each cell would take {} MiB at {:g} cells a side, by the cube.",
           verdict == Verdict::refuted
               ? "No point is stored: the vertex shader makes them of their number, and what is kept is the "
                 "field's copy "
                 "in the atlas, which does not depend on the grid."
               : "The atlas with the field's copy does not depend on the grid; what grows lies beside it.",
           figure(stored_points_mib(most_cells)), most_cells)},
      {{.name = "figure-18",
        .title = "Memory by the grid's resolution",
        .x_label = "cells along a side of the grid",
        .y_label = "memory, MiB (heap and GPU)",
        .series = {series_of(uniform, memory_mib_of, nullptr),
                   series_of(found.grids[1], memory_mib_of, nullptr), stored}}});
}

void claim_beats_grid(const Findings& found, Conclusions& conclusions) {
  const SettingFound &march = found.raymarch.settings.back(), &grid = found.grids[0].settings.back();
  const double times = draw_ms_of(grid) / draw_ms_of(march);
  const auto cells = size_at(found.grids[0], draw_ms_of(march));
  const bool full = march.size >= 100.0;
  constexpr RatioRule faster{same_ratio, 1.0 / same_ratio};
  conclusions.figures.metric(
      full ? std::string("grid_over_raymarch_full") : fmt::format("grid_over_raymarch_{:g}", march.size),
      times);
  if (cells) conclusions.figures.metric("grid_cells_as_dear_as_raymarch", *cells);
  const Verdict verdict = faster.judge(times);
  conclusions.figures.check("raymarch_beats_grid", verdict == Verdict::confirmed,
                            fmt::format("{} ms against {} ms: {:.2f} times, {}", figure(draw_ms_of(march)),
                                        figure(draw_ms_of(grid)), times, faster.wanted(Verdict::confirmed)));
  conclusions.claims.push_back(
      {"raymarch_beats_grid", "16, 21",
       "On fresh terrain raymarching at full resolution is considerably faster than the grid" +
           (full ? std::string(".") : fmt::format(" (here at {:g} % of it).", march.size)),
       fmt::format("{} ms at {:g} % against {} ms with {:g} cells a side: the grid takes {:.2f} times as "
                   "long and sees {} m, not {} m; {}",
                   figure(draw_ms_of(march)), march.size, figure(draw_ms_of(grid)), grid.size, times,
                   figure(grid.reach_m), figure(march.reach_m),
                   cells ? fmt::format("a grid of about {:.0f} cells a side takes as long", *cells)
                         : std::string("no grid that was measured takes as long")),
       fmt::format("confirmed if the grid takes {0:g} times as long, refuted if raymarching does",
                   faster.confirmed),
       verdict});
}

ReportSection march_draw(const Findings& found, Conclusions& conclusions) {
  const SweepFound& march = found.raymarch;
  const double p = exponent_between(march, draw_ms_of);
  const bool steady = rises_steadily(march, steady_share);
  conclusions.figures.metric("raymarch_draw_exponent", p);
  conclusions.claims.push_back(
      {"raymarch_draw_rises", "21", "Drawing by raymarching takes longer with the picture's resolution.",
       fmt::format("{} ms from {:g} to {:g} % of {} × {} pixels; {}", span_text(march, draw_ms_of),
                   march.settings.front().size, march.settings.back().size, found.conditions.full_width,
                   found.conditions.full_height, steps_text(least_step(march))),
       steady_rule(), steady ? Verdict::confirmed : Verdict::refuted});
  claim_beats_grid(found, conclusions);
  PlotSeries grid{.name = "the largest uniform grid, full picture", .style = SeriesStyle::line, .points = {}};
  for (const SettingFound& setting : march.settings)
    grid.points.emplace_back(setting.size, draw_ms_of(found.grids[0].settings.back()));
  const Claim& beats = conclusions.claims.back();
  return figure_section(
      {"Figure 21: drawing by raymarching",
       "Performance falls with the resolution of the picture; even at full resolution "
       "raymarching is considerably faster than the "
       "grid.",
       fmt::format("From {:g} to {:g} % a frame takes {} ms, the power {:.2f} of the width "
                   "(pixels are the power 2). Beside the grid: {}. "
                   "The claim is {}.",
                   march.settings.front().size, march.settings.back().size, span_text(march, draw_ms_of), p,
                   beats.found, name_of(beats.verdict)),
       p <= 2.0 ? "Each pixel is a ray of its own, and a pass over tiles of 8 × 8 pixels "
                  "lets rays begin near what they meet; what a frame "
                  "takes besides does not grow with the pixels."
                : "Each pixel is a ray of its own. That the time grows faster than the "
                  "pixels is the machine's doing, for example when "
                  "the picture's targets leave its caches."},
      {{.name = "figure-21",
        .title = "Draw frame time by the raymarched picture's resolution",
        .x_label = fmt::format("width and height, % of {} × {}", found.conditions.full_width,
                               found.conditions.full_height),
        .y_label = "draw frame time, ms (median)",
        .series = {series_of(march, draw_ms_of, &SettingFound::draw_ms), grid}}},
      {settings_table({&march}, "percent", "The raymarched pictures, medians of the rounds.")});
}

ReportSection march_memory(const Findings& found, Conclusions& conclusions) {
  const SweepFound& march = found.raymarch;
  const double ratio = range_ratio({&march}, memory_mib_of);
  conclusions.figures.metric("raymarch_memory_ratio", ratio);
  const Verdict verdict = rule_hardly.judge(ratio);
  conclusions.claims.push_back({"raymarch_memory_flat", "23",
                                "Raymarching's memory hardly grows with the picture's resolution.",
                                fmt::format("{} MiB: {:.3f} times", span_text(march, memory_mib_of), ratio),
                                rule_hardly.text(), verdict});
  return figure_section(
      {"Figure 23: memory of raymarching",
       "Memory grows much less than the grid's: there is but one texture.",
       fmt::format("From {:g} to {:g} % memory goes from {} to {} MiB; the most is {:.3f} times the least.",
                   march.settings.front().size, march.settings.back().size,
                   figure(memory_mib_of(march.settings.front())),
                   figure(memory_mib_of(march.settings.back())), ratio),
       "Only the targets of the picture (colour, depth and the tiles' distances) have its "
       "resolution. The rest is the field's copy "
       "on the GPU, the atlas, which the paper's program does not have: it evaluates noise "
       "and a list of carves for each step of "
       "each ray. Figures 24 and 25 show what that saves and costs."},
      {{.name = "figure-23",
        .title = "Memory by the raymarched picture's resolution",
        .x_label = fmt::format("width and height, % of {} × {}", found.conditions.full_width,
                               found.conditions.full_height),
        .y_label = "memory, MiB (heap and GPU)",
        .series = {series_of(march, memory_mib_of, nullptr)}}});
}

}  // namespace

std::vector<ReportSection> baseline_sections(const Findings& found, Conclusions& conclusions) {
  const auto grids = pointers(found.grids);
  std::vector<ReportSection> sections;
  sections.push_back(grid_draw(found, conclusions));
  sections.push_back(update_section(
      grids,
      {"Figure 17: update beside the grid",
       "Update times have an upward trend with the grid's resolution, “but not necessarily a correlation”.",
       "", ""},
      "figure-17", "cells along a side of the grid", "grid_update_grows",
      "Update times trend upwards with the grid's resolution.", conclusions));
  sections.push_back(grid_memory(found, conclusions));
  sections.push_back(march_draw(found, conclusions));
  sections.push_back(update_section(
      {&found.raymarch},
      {"Figure 22: update beside raymarching",
       "Update times grow with the resolution as well, but much less than with the grid.", "", ""},
      "figure-22",
      fmt::format("width and height, % of {} × {}", found.conditions.full_width,
                  found.conditions.full_height),
      "raymarch_update_grows", "Update times grow with the raymarched resolution.", conclusions));
  sections.push_back(march_memory(found, conclusions));
  return sections;
}

}  // namespace scree::paper
