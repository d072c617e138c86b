#include "studies/paper/findings/composition.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

#include "studies/paper/findings/analysis.h"

namespace scree::paper {
namespace {

Verdict verdict_of(const std::vector<Claim>& claims, std::string_view name) {
  const auto found = std::ranges::find(claims, name, &Claim::name);
  return found == claims.end() ? Verdict::undecided : found->verdict;
}

std::string pixels(int width, int height) {
  return fmt::format("{} × {}", width, height);
}

ReportSection conditions_section(const Conditions& conditions) {
  ReportSection section{.title = "Conditions", .text = {}};
  section.text.push_back(fmt::format(
      "One world is stepped in this process at {} ticks a second, and drawn without a window by {}{}. Draw "
      "and update are measured apart, by "
      "the clock, as in the paper: draw is from the changes of the tick until the GPU has finished the "
      "frame, update is the tick. Where no "
      "frame is drawn after a tick, the session goes on without: its time is the world's, not the clock's.",
      conditions.tick_rate_hz, conditions.driver,
      conditions.software ? ", which is software: no GPU was reached" : ""));
  section.text.push_back(fmt::format(
      "Terrain is the paper's kind, repeating noise, with voxels of 0.25 m; the view radius is 48 m; like "
      "the paper's program it is drawn with "
      "one sample a pixel and without shadows. Each setting of section 3.1 and 3.2 is a session of its own "
      "of {:g} s, {} for each, with one "
      "blast of 64 pieces, pictures of {} pixels at 100 %. The sessions of section 3.3 are drawn at {} "
      "pixels.",
      conditions.setting_s, counted(conditions.rounds, "round"),
      pixels(conditions.full_width, conditions.full_height),
      pixels(conditions.session_width, conditions.session_height)));
  section.text.emplace_back(
      "A setting's time is the median of its rounds, each by its own median: of two rounds, the mean. Its "
      "bar "
      "is as long as the rounds lie apart, and has the time in its middle. Where a session is measured in "
      "several runs, each tick has its least time of them, and the figure says so.");
  section.text.push_back("In figures 24 and 25 the paper's list of carves is a program of its own. " +
                         std::string(list_draws_otherwise));
  section.text.emplace_back(
      "The paper's machine had a Core i5 2500K, a GTX 680 and 1280 × 720 pixels; its times are in its "
      "figures. Ratios and courses can be "
      "compared, milliseconds cannot.");
  return section;
}

/// Section 4.3: which combination is the most efficient.
ReportSection efficiency_section(const Findings& found, Conclusions& conclusions) {
  const auto is = [&](std::string_view name, Verdict verdict) {
    return verdict_of(conclusions.claims, name) == verdict;
  };
  const bool faster = is("raymarch_beats_grid", Verdict::confirmed),
             flat = is("atlas_degrades", Verdict::refuted),
             back = is("returns_after_merging", Verdict::confirmed);
  const bool refuted =
      is("raymarch_beats_grid", Verdict::refuted) || is("returns_after_merging", Verdict::refuted);
  const Verdict verdict = faster && flat && back ? Verdict::confirmed
                          : refuted              ? Verdict::refuted
                                                 : Verdict::undecided;
  conclusions.claims.push_back(
      {"raymarch_most_efficient", "section 4.3",
       "Raymarching with a simple fracture and recombination is the most efficient way of the ones compared.",
       fmt::format(
           "faster than the largest grid on fresh terrain: {}; as fast when carved, by the atlas: {}; "
           "back at the baseline after merging: {}",
           faster ? "yes" : "no", flat ? "yes" : "no", back ? "yes" : "no"),
       "confirmed if all three hold, refuted if the first or the last is refuted", verdict});
  const SettingFound& march = found.raymarch.settings.back();
  const SweepFound& uniform = found.grids.front();
  const auto cells = size_at(uniform, draw_ms_of(march));
  ReportSection section{.title = "Which combination is the most efficient, and when", .text = {}};
  section.text.push_back(
      fmt::format("**Of the paper's two methods**, its answer, raymarching, is {} here.", name_of(verdict)));
  if (cells)
    section.text.push_back(fmt::format(
        "On this machine raymarching at {:g} % takes as long as a uniform grid of about {:.0f} cells a side. "
        "Below that the grid is the cheaper one, "
        "for whom its reach will do ({} m with {:g} cells, {} m with {:g}; raymarching sees {} m); above it, "
        "raymarching is.",
        march.size, *cells, figure(uniform.settings.front().reach_m), uniform.settings.front().size,
        figure(uniform.settings.back().reach_m), uniform.settings.back().size, figure(march.reach_m)));
  else
    section.text.push_back(fmt::format(
        "On this machine the grid is {} at every resolution that was measured.",
        draw_ms_of(uniform.settings.front()) > draw_ms_of(march) ? "the dearer one" : "the cheaper one"));
  section.text.push_back(found.conditions.matrix.empty()
                             ? "**Of all combinations** of drawing, cutter, simplifier, collider, "
                               "recombination and pattern: that is the matrix study's question "
                               "(`./scree bench matrix`)."
                             : "**Of all combinations** of drawing, cutter, simplifier, collider, "
                               "recombination and pattern: see " +
                                   found.conditions.matrix + ", made by `./scree bench matrix`.");
  return section;
}

void append(std::vector<ReportSection>& to, std::vector<ReportSection> sections) {
  std::ranges::move(sections, std::back_inserter(to));
}

std::string summary_of(const std::vector<Claim>& claims) {
  const auto count = [&](Verdict verdict) { return std::ranges::count(claims, verdict, &Claim::verdict); };
  return fmt::format(
      "There are {} claims: {} are confirmed here, {} refuted, and {} undecided. A claim is judged by the "
      "rule beside it.",
      claims.size(), count(Verdict::confirmed), count(Verdict::refuted), count(Verdict::undecided));
}

void add_times(const Findings& found, BenchReport& figures) {
  const auto add_times_of = [&](const SweepFound& sweep, const std::string& name) {
    for (const SettingFound& setting : sweep.settings) {
      figures.metric(fmt::format("{}_{:g}_draw_ms", name, setting.size), draw_ms_of(setting));
      figures.metric(fmt::format("{}_{:g}_update_ms", name, setting.size), update_ms_of(setting));
      figures.metric(fmt::format("{}_{:g}_memory_mib", name, setting.size), memory_mib_of(setting));
    }
  };
  add_times_of(found.grids[0], "grid_uniform");
  add_times_of(found.grids[1], "grid_growing");
  add_times_of(found.raymarch, "raymarch");
}

}  // namespace

ReportSection figure_section(const FigureText& text, std::vector<Plot> plots,
                             std::vector<ReportTable> tables) {
  return {.title = text.title,
          .text = {"**The paper:** " + text.paper, "**Scree:** " + text.scree, "**Why:** " + text.why},
          .tables = std::move(tables),
          .plots = std::move(plots)};
}

StudyResult compose(const Findings& found) {
  Conclusions conclusions;
  std::vector<ReportSection> figures = baseline_sections(found, conclusions);
  append(figures, carving_sections(found, conclusions));
  append(figures, physics_sections(found, conclusions));
  ReportSection efficiency = efficiency_section(found, conclusions);
  StudyReport report{
      .name = "paper",
      .title = "The paper's experiments on Scree",
      .command = std::string("./scree bench paper") + (found.conditions.quick ? " --quick" : ""),
      .summary = {"“Real-Time Physics-Based Destruction with Scalar Field Terrains” measures two ways to "
                  "draw a terrain that is "
                  "destroyed, and sessions in which it is. Here its experiments (sections 2.5 and 3) are run "
                  "on Scree. Under the number of "
                  "each of its figures stands what the paper found, what Scree shows, and why.",
                  summary_of(conclusions.claims)},
      .sections = {}};
  report.sections.push_back(
      {.title = "The paper's claims, one by one", .text = {}, .tables = {claims_table(conclusions.claims)}});
  report.sections.push_back(conditions_section(found.conditions));
  append(report.sections, std::move(figures));
  report.sections.push_back(std::move(efficiency));
  add_times(found, conclusions.figures);
  return {std::move(report), std::move(conclusions.figures)};
}

}  // namespace scree::paper
