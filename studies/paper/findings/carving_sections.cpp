#include <fmt/format.h>

#include "studies/paper/findings/analysis.h"
#include "studies/paper/findings/composition.h"

namespace scree::paper {
namespace {

/// Length of the stretches whose frames are compared: after the last carve, and at the session's end.
constexpr double stretch_s = 1.0;
/// Two atlases of the same field draw the same picture, in turns.
constexpr double as_new_ratio = 1.05;

/// Medians of the draw frame times of one of the two sessions, milliseconds.
struct CarvedTimes {
  double fresh_ms = 0.0;
  double carved_ms = 0.0;
  double grid_ms = 0.0;      ///< after the switch
  double returned_ms = 0.0;  ///< by the first method again

  double growth() const { return carved_ms / fresh_ms; }
};

CarvedTimes times_of(const CarvingFound& found, const SessionFound& session) {
  const auto draw = [&](double from_s, double until_s) {
    return median_between(session, from_s, until_s, draw_of).value_or(0.0);
  };
  const double end_s = session.ticks.back().time_s + stretch_s;
  return {.fresh_ms = draw(0.0, found.fresh_until_s),
          .carved_ms = draw(found.switched_at_s - stretch_s, found.switched_at_s),
          .grid_ms = draw(found.switched_at_s + found.settle_s, found.returned_at_s),
          .returned_ms = draw(found.returned_at_s + found.settle_s, end_s)};
}

PlotSeries draw_series(const SessionFound& session, double from_s, double until_s) {
  PlotSeries series{.name = session.name, .style = SeriesStyle::line, .points = {}};
  for (const SessionTick& tick : session.ticks)
    if (tick.draw_ms && tick.time_s >= from_s && tick.time_s < until_s)
      series.points.emplace_back(tick.time_s, *tick.draw_ms);
  return series;
}

/// The events of the user, who did the same in both sessions.
std::vector<PlotEvent> user_events(const SessionFound& session, double from_s, double until_s) {
  std::vector<PlotEvent> events;
  for (const SessionTick& tick : session.ticks) {
    if (tick.time_s < from_s || tick.time_s >= until_s) continue;
    if (tick.edited) events.push_back({PlotEventKind::edit, tick.time_s});
    if (tick.switched) events.push_back({PlotEventKind::method, tick.time_s});
  }
  return events;
}

Plot draw_plot(const CarvingFound& found, const std::string& name, const std::string& title, double from_s,
               double until_s) {
  return {.name = name,
          .title = title,
          .x_label = "time in the session, s",
          .y_label = "draw frame time, ms",
          .series = {draw_series(found.list, from_s, until_s), draw_series(found.atlas, from_s, until_s)},
          .events = user_events(found.atlas, from_s, until_s)};
}

ReportSection degradation(const CarvingFound& found, const CarvedTimes& list, const CarvedTimes& atlas,
                          Conclusions& conclusions) {
  conclusions.figures.metric("list_carved_over_fresh", list.growth());
  conclusions.figures.metric("atlas_carved_over_fresh", atlas.growth());
  const std::string says = "Raymarching gets slower fairly quickly as carves add up.";
  const std::string rule = rule_degrades.text();
  const auto told = [&](const CarvedTimes& times) {
    return fmt::format("{} ms fresh, {} ms after {} carves: {:.2f} times", figure(times.fresh_ms),
                       figure(times.carved_ms), found.carves, times.growth());
  };
  const Verdict of_list = rule_degrades.judge(list.growth());
  const Verdict of_atlas = rule_degrades.judge(atlas.growth());
  conclusions.claims.push_back(
      {"list_degrades", "24", says, "the paper's list of carves: " + told(list), rule, of_list});
  conclusions.claims.push_back(
      {"atlas_degrades", "24", says, "Scree's atlas of bricks: " + told(atlas), rule, of_atlas});
  const double as_new = found.atlas_lived_ms / found.atlas_new_ms;
  conclusions.figures.metric("atlas_lived_over_new", as_new);
  conclusions.figures.check("list_degrades", of_list == Verdict::confirmed,
                            told(list) + ", " + rule_degrades.wanted(Verdict::confirmed));
  conclusions.figures.check("atlas_flat", of_atlas == Verdict::refuted,
                            told(atlas) + ", " + rule_degrades.wanted(Verdict::refuted));
  conclusions.figures.check(
      "atlas_as_new", as_new <= as_new_ratio,
      fmt::format("{:.2f} times an atlas made from the carved field, wanted at most {:g}", as_new,
                  as_new_ratio));
  return figure_section(
      {"Figure 24: repeated carving while raymarching",
       "As carves add up, raymarching gets slower fairly quickly.",
       fmt::format("By the paper's own way, a list of carves, a frame takes {}. By Scree's, an atlas of "
                   "bricks, it takes {}; "
                   "one that is made anew from the carved field draws the same picture in {} ms, the one "
                   "that saw every carve in {} ms. "
                   "The paper's finding is {} for its list and {} for the atlas. {}",
                   told(list), told(atlas), figure(found.atlas_new_ms), figure(found.atlas_lived_ms),
                   name_of(of_list), name_of(of_atlas), list_draws_otherwise),
       fmt::format(
           "With a list, each step of each ray evaluates every carve so far, so that a step's cost is a sum "
           "that grows with each. "
           "With the atlas, a carve changes the codes of the bricks that it touches, once; a step then reads "
           "the brick where it "
           "is. {}",
           as_new <= as_new_ratio
               ? "What a frame takes more than before is the picture's: holes have more edges, and rays into "
                 "them are longer."
               : "That the atlas which saw the carves is slower than a new one is not explained by that.")},
      {draw_plot(found, "figure-24", "Draw frame time while the terrain is carved again and again", 0.0,
                 found.switched_at_s)});
}

ReportSection switching(const CarvingFound& found, const CarvedTimes& list, const CarvedTimes& atlas,
                        Conclusions& conclusions) {
  const double grid_ratio = list.grid_ms / found.grid_fresh_ms;
  const double returned_ratio = atlas.returned_ms / atlas.fresh_ms;
  conclusions.figures.metric("grid_carved_over_fresh", grid_ratio);
  conclusions.figures.metric("atlas_returned_over_fresh", returned_ratio);
  const Verdict verdict = rule_same.judge(grid_ratio);
  conclusions.figures.check("grid_does_not_mind_carves", verdict == Verdict::confirmed,
                            fmt::format("{:.2f} times the frame before any carve, {}", grid_ratio,
                                        rule_same.wanted(Verdict::confirmed)));
  conclusions.claims.push_back(
      {"grid_does_not_mind_carves", "25",
       "After a switch to the grid performance is back at the baseline: it copes with carves.",
       fmt::format("the grid takes {} ms after {} carves and {} ms before any: {:.2f} times",
                   figure(list.grid_ms), found.carves, figure(found.grid_fresh_ms), grid_ratio),
       rule_same.text(), verdict});
  return figure_section(
      {"Figure 25: another method in mid-session",
       "After a switch from raymarching to the grid the frame time returns to the baseline: the grid is "
       "slower on average, but "
       "deals better with changes that add up.",
       fmt::format("The grid ({}) takes {} ms a frame after the carves, {:.2f} times what it took before "
                   "any. Back in the first method, "
                   "the list takes {} ms again, {:.2f} times its first frames; the atlas {} ms, {:.2f} times "
                   "its own. {} So it is not judged whether the switch from the list to the grid pays.",
                   found.grid, figure(list.grid_ms), grid_ratio, figure(list.returned_ms),
                   list.returned_ms / list.fresh_ms, figure(atlas.returned_ms), returned_ratio,
                   list_draws_otherwise),
       "Scree's grid reads the field's copy, in which carves are codes like all others. In the paper's "
       "program both methods "
       "evaluate the list, the grid at its points and raymarching at each step of each ray, which are many "
       "more. In Scree a switch "
       "waits for nothing: the old method draws until the new one is loaded beside it."},
      {draw_plot(found, "figure-25", "Draw frame time when the method is switched to the grid, and back",
                 found.switched_at_s - 2.0 * stretch_s, found.atlas.ticks.back().time_s + stretch_s)});
}

}  // namespace

std::vector<ReportSection> carving_sections(const Findings& found, Conclusions& conclusions) {
  const CarvedTimes list = times_of(found.carving, found.carving.list);
  const CarvedTimes atlas = times_of(found.carving, found.carving.atlas);
  std::vector<ReportSection> sections;
  sections.push_back(degradation(found.carving, list, atlas, conclusions));
  sections.push_back(switching(found.carving, list, atlas, conclusions));
  return sections;
}

}  // namespace scree::paper
