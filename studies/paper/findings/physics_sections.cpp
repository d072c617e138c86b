#include <algorithm>
#include <fmt/format.h>

#include "shared/base/check.h"
#include "studies/paper/findings/analysis.h"
#include "studies/paper/findings/composition.h"

namespace scree::paper {
namespace {

/// A tick may take so much longer after a session than before it and count as back at the baseline: of an
/// idle world's tick, which takes some hundredths of a millisecond, a tenth says nothing.
constexpr double tick_slack_ms = 0.05;

/// The longest tick that counts as back.
struct TickLimit {
  double ms = 0.0;
  std::string text;
};

TickLimit back_up_to(double before_ms) {
  const double ms = std::max(same_ratio * before_ms, before_ms + tick_slack_ms);
  return {ms, fmt::format("{} ms ({:g} times as long as before or {:g} ms longer, whichever is more)",
                          figure(ms), same_ratio, tick_slack_ms)};
}

/// How a tick's times came about, in heads and in sentences.
std::string least_of(int runs) {
  return runs == 1 ? "one run" : fmt::format("least of {} runs", runs);
}

std::string the_least_of(int runs) {
  return runs == 1 ? "its time in one run" : fmt::format("the least of its times in {} runs", runs);
}

/// Ticks whose median is a session's load: half a second.
constexpr size_t load_window = 30;
constexpr size_t load_window_drawn = 10;

const SessionFound& collider_named(const RebuildFound& found, std::string_view name) {
  const auto at = std::ranges::find(found.colliders, name, &SessionFound::name);
  CHECK(at != found.colliders.end());
  return *at;
}

std::vector<PlotEvent> rebuild_events(const SessionFound& session, double from_s) {
  std::vector<PlotEvent> events;
  for (const SessionTick& tick : session.ticks) {
    if (tick.time_s < from_s) continue;
    if (tick.reshaped) events.push_back({PlotEventKind::physics, tick.time_s});
    if (tick.edited) events.push_back({PlotEventKind::edit, tick.time_s});
  }
  return events;
}

Plot rebuild_plot(const RebuildFound& found, const std::string& name, const std::string& title,
                  const std::string& y_label, const TickValue& value) {
  Plot plot{.name = name,
            .title = title,
            .x_label = "time in the session, s",
            .y_label = fmt::format("{} ({})", y_label, least_of(found.runs)),
            .series = {}};
  for (const SessionFound& session : found.colliders) {
    PlotSeries series{.name = "collider " + session.name, .style = SeriesStyle::line, .points = {}};
    for (const SessionTick& tick : session.ticks)
      if (const auto y = value(tick); y && tick.time_s >= found.carving_from_s)
        series.points.emplace_back(tick.time_s, *y);
    plot.series.push_back(std::move(series));
  }
  plot.events = rebuild_events(found.colliders.front(), found.carving_from_s);
  return plot;
}

ReportTable spikes_table(const RebuildFound& found) {
  const std::string least = least_of(found.runs);
  ReportTable table{
      fmt::format(
          "Ticks with a rebuild, as ratios to the median of the others within half a second; each tick "
          "by {}.",
          the_least_of(found.runs)),
      {"collider", fmt::format("draw ({}): median tick", least), "worst tick",
       fmt::format("bodies ({}): median tick", least), "worst tick", "more, ms",
       fmt::format("whole tick ({}): median tick", least), "worst tick"},
      {}};
  for (const SessionFound& session : found.colliders) {
    const Spikes draw = spikes_of(session, found.carving_from_s, draw_of),
                 bodies = spikes_of(session, found.carving_from_s, bodies_of),
                 update = spikes_of(session, found.carving_from_s, update_of);
    table.rows.push_back({"`" + session.name + "`", fmt::format("{:.2f}", draw.median_ratio),
                          fmt::format("{:.2f}", draw.worst_ratio), fmt::format("{:.2f}", bodies.median_ratio),
                          fmt::format("{:.2f}", bodies.worst_ratio), figure(bodies.median_extra_ms),
                          fmt::format("{:.2f}", update.median_ratio),
                          fmt::format("{:.2f}", update.worst_ratio)});
  }
  return table;
}

std::string why_draw_spikes(Verdict verdict) {
  const std::string made =
      "Scree's collision shapes are made from the field, on the processor, in the update: nothing is read "
      "back from the GPU. ";
  switch (verdict) {
    case Verdict::refuted:
      return made + "The frame after a carve uploads the bricks that it changed, and that is all.";
    case Verdict::confirmed:
      return made +
             "So the spike is not the collision mesh's: it comes with the carve, whose changed bricks the "
             "next frame uploads.";
    case Verdict::undecided:
      return made +
             "The frame after a carve uploads the bricks that it changed; how much longer it takes lies "
             "between the rule's limits.";
  }
  return made;
}

ReportSection draw_spikes(const RebuildFound& found, Conclusions& conclusions) {
  const Spikes mesh = spikes_of(collider_named(found, "mesh"), found.carving_from_s, draw_of);
  conclusions.figures.metric("draw_spike_mesh", mesh.median_ratio);
  const Verdict verdict = rule_grows.judge(mesh.median_ratio);
  conclusions.claims.push_back({"spikes_in_draw", "26",
                                "When the collision mesh is made anew, drawing has a spike.",
                                fmt::format("by the collider `mesh` the median of {} frames after a rebuild, "
                                            "each by {}, is {:.2f} times their neighbours",
                                            mesh.ticks, the_least_of(found.runs), mesh.median_ratio),
                                rule_grows.text(), verdict});
  return figure_section(
      {"Figure 26: drawing while collision shapes are made anew",
       "When the physics mesh is recalculated, drawing has a sudden spike: the GPU computes it and sends it "
       "back to the processor.",
       fmt::format("{} pieces lie about when the carves begin. After {} rebuilds by the collider `mesh`, the "
                   "next frame takes {:.2f} times as long as its neighbours in the median and {:.2f} times "
                   "at the worst, each frame by {}. The claim is {}.",
                   found.pieces, mesh.ticks, mesh.median_ratio, mesh.worst_ratio, the_least_of(found.runs),
                   name_of(verdict)),
       why_draw_spikes(verdict)},
      {rebuild_plot(found, "figure-26", "Draw frame time while collision shapes are made anew",
                    "draw frame time, ms", draw_of)},
      {spikes_table(found)});
}

std::string why_update_spikes(Verdict of_mesh, Verdict of_field) {
  const std::string mesh =
      "By `mesh` the triangles of every block near a body that the carve touched are made again in that "
      "tick";
  const std::string field =
      " By `field` a body reads the changed codes around it again, which is what it does whenever it has "
      "moved by two voxels";
  const auto ending = [](Verdict no_spike, const char* none, const char* spike) -> std::string {
    if (no_spike == Verdict::undecided) return "; whether that is a spike lies between the rule's limits.";
    return no_spike == Verdict::confirmed ? none : spike;
  };
  return mesh + ending(of_mesh, ", which hardly shows in its time.", ": that is the spike.") + field +
         ending(of_field, ", so that a carve adds little.",
                "; here that takes much longer than in other ticks.") +
         " By `rays` a body casts its rays in each tick anyway. A carve takes time of its own, by every "
         "collider: the whole tick is in the table above.";
}

ReportSection update_spikes(const RebuildFound& found, Conclusions& conclusions) {
  const Spikes mesh = spikes_of(collider_named(found, "mesh"), found.carving_from_s, bodies_of);
  const Spikes field = spikes_of(collider_named(found, "field"), found.carving_from_s, bodies_of);
  const Spikes rays = spikes_of(collider_named(found, "rays"), found.carving_from_s, bodies_of);
  for (const auto& [name, spikes] :
       {std::pair("mesh", mesh), std::pair("field", field), std::pair("rays", rays)}) {
    conclusions.figures.metric(fmt::format("bodies_spike_{}", name), spikes.median_ratio);
    conclusions.figures.metric(fmt::format("bodies_spike_{}_worst", name), spikes.worst_ratio);
    conclusions.figures.metric(fmt::format("bodies_spike_{}_more_ms", name), spikes.median_extra_ms);
  }
  const std::string ratios = fmt::format("{:.2f} times by `mesh`, {:.2f} by `rays`, {:.2f} by `field`",
                                         mesh.median_ratio, rays.median_ratio, field.median_ratio);
  const std::string more =
      fmt::format("{} ms more by `mesh`, {} by `rays`, {} by `field`", figure(mesh.median_extra_ms),
                  figure(rays.median_extra_ms), figure(field.median_extra_ms));
  const Verdict of_mesh = rule_hardly.judge(mesh.median_ratio);
  const Verdict of_field = rule_hardly.judge(field.median_ratio);
  conclusions.claims.push_back(
      {"no_spikes_in_update", "27", "The update has no spike when the collision mesh is made anew.",
       fmt::format("the bodies' part of the median tick, by {}, takes {:.2f} times its neighbours by `mesh`",
                   the_least_of(found.runs), mesh.median_ratio),
       rule_hardly.text(), of_mesh});
  conclusions.claims.push_back(
      {"field_has_no_spikes", "26, 27", "(Scree's own) Without a collision mesh there is no spike at all.",
       fmt::format("the bodies' part of the median tick, by {}, takes {:.2f} times its neighbours by `field`",
                   the_least_of(found.runs), field.median_ratio),
       rule_hardly.text(), of_field});
  conclusions.figures.check(
      "mesh_has_spikes", of_mesh == Verdict::refuted,
      fmt::format("{:.2f} times in the median, {}", mesh.median_ratio, rule_hardly.wanted(Verdict::refuted)));
  conclusions.figures.check("field_has_no_spikes", of_field == Verdict::confirmed,
                            fmt::format("{:.2f} times in the median, {}", field.median_ratio,
                                        rule_hardly.wanted(Verdict::confirmed)));
  return figure_section(
      {"Figure 27: update while collision shapes are made anew",
       "The update has no spike, since the GPU does that work while drawing.",
       fmt::format("In the ticks with a rebuild the bodies' part takes {} in the median of these ticks, "
                   "each by {} ({}). For `mesh` the "
                   "paper's finding is {}; that `field` has no spike is {}.",
                   ratios, the_least_of(found.runs), more, name_of(of_mesh), name_of(of_field)),
       why_update_spikes(of_mesh, of_field)},
      {rebuild_plot(found, "figure-27", "The bodies' part of the update while collision shapes are made anew",
                    "update time of the bodies, ms", bodies_of)});
}

PlotSeries session_series(const SessionFound& session, const std::string& name, const TickValue& value) {
  PlotSeries series{.name = name, .style = SeriesStyle::line, .points = {}};
  for (const SessionTick& tick : session.ticks)
    if (const auto y = value(tick)) series.points.emplace_back(tick.time_s, *y);
  return series;
}

std::vector<PlotEvent> merge_events(const SessionFound& session) {
  std::vector<PlotEvent> events;
  for (const SessionTick& tick : session.ticks) {
    if (tick.edited) events.push_back({PlotEventKind::edit, tick.time_s});
    if (tick.merged) events.push_back({PlotEventKind::recombination, tick.time_s});
  }
  return events;
}

/// Before the blast, at its worst, and at the session's end; milliseconds.
struct Course {
  double before_ms = 0.0, worst_ms = 0.0, after_ms = 0.0;
  double ratio() const { return after_ms / before_ms; }
};

Course course_of(const MergingFound& found, const SessionFound& session, const TickValue& value,
                 size_t window) {
  const double end_s = session.ticks.back().time_s;
  constexpr double last_s = 1.0;
  return {median_between(session, 0.0, found.blast_from_s, value).value_or(0.0),
          worst_median(session, found.blast_from_s, value, window),
          median_between(session, end_s - last_s, end_s + last_s, value).value_or(0.0)};
}

size_t most_pieces(const SessionFound& session) {
  size_t most = 0;
  for (const SessionTick& tick : session.ticks) most = std::max(most, tick.pieces);
  return most;
}

std::vector<Plot> merging_plots(const MergingFound& found) {
  const auto pieces_of = [](const SessionTick& tick) -> std::optional<double> {
    return static_cast<double>(tick.pieces);
  };
  std::vector<Plot> plots;
  plots.push_back({.name = "figure-28",
                   .title = "Frame time while pieces move and become terrain again",
                   .x_label = "time in the session, s",
                   .y_label = "frame time, ms (draw and update)",
                   .series = {session_series(found.staying, "pieces stay bodies", frame_of),
                              session_series(found.merging, "pieces become terrain", frame_of)},
                   .events = merge_events(found.merging)});
  plots.push_back({.name = "figure-28-update",
                   .title = "Update time while pieces move and become terrain again",
                   .x_label = "time in the session, s",
                   .y_label = "update time, ms",
                   .series = {session_series(found.staying, "pieces stay bodies", update_of),
                              session_series(found.merging, "pieces become terrain", update_of)},
                   .events = merge_events(found.merging)});
  plots.push_back({.name = "figure-28-pieces",
                   .title = "Pieces that are simulated",
                   .x_label = "time in the session, s",
                   .y_label = "pieces alive",
                   .series = {session_series(found.staying, "pieces stay bodies", pieces_of),
                              session_series(found.merging, "pieces become terrain", pieces_of)},
                   .events = merge_events(found.merging)});
  return plots;
}

std::string why_merging(Verdict verdict, bool tick_back, const std::string& merged) {
  const std::string written = "A piece that rests is written into the field and its body is gone";
  const std::string paper =
      " The paper's program adds a sphere to its list for each piece, which every later frame evaluates.";
  if (verdict == Verdict::confirmed)
    return written +
           "; the field is no dearer for it, because what was edited costs as much as what never was." +
           paper;
  return fmt::format("{}. At the session's end {}, and {}.{}", written, merged,
                     tick_back ? "a frame takes longer than before" : "a tick takes longer than before",
                     paper);
}

ReportSection merging(const MergingFound& found, Conclusions& conclusions) {
  const Course frame = course_of(found, found.merging, frame_of, load_window_drawn),
               update = course_of(found, found.merging, update_of, load_window),
               stays = course_of(found, found.staying, frame_of, load_window_drawn),
               stays_update = course_of(found, found.staying, update_of, load_window);
  const size_t left = found.merging.ticks.back().pieces;
  const TickLimit limit = back_up_to(update.before_ms);
  const bool tick_back = update.after_ms <= limit.ms;
  const Verdict verdict = tick_back ? rule_same.judge(frame.ratio()) : Verdict::refuted;
  conclusions.figures.metric("merged_frame_over_before", frame.ratio());
  conclusions.figures.metric("merged_update_after_ms", update.after_ms);
  conclusions.figures.metric("merged_update_before_ms", update.before_ms);
  conclusions.figures.metric("staying_frame_over_before", stays.ratio());
  const std::string told =
      fmt::format("frame {} ms before, {} at the worst, {} after: {:.2f} times; tick {}, {} and {} ms",
                  figure(frame.before_ms), figure(frame.worst_ms), figure(frame.after_ms), frame.ratio(),
                  figure(update.before_ms), figure(update.worst_ms), figure(update.after_ms));
  conclusions.claims.push_back(
      {"returns_after_merging", "28",
       "Performance falls while pieces are simulated, and returns once they are terrain.", told,
       fmt::format("the frame: {}; refuted as well if a tick takes more than {}", rule_same.text(),
                   limit.text),
       verdict});
  conclusions.figures.check("returns_after_merging", verdict == Verdict::confirmed,
                            fmt::format("{}, {} for the frame and at most {} for a tick", told,
                                        rule_same.wanted(Verdict::confirmed), limit.text));
  const std::string merged = left == 0 ? "all are terrain again" : fmt::format("{} are still pieces", left);
  return figure_section(
      {"Figure 28: pieces become terrain again",
       "While the pieces of a blast are simulated performance falls, and once they are terrain it returns to "
       "the baseline.",
       fmt::format("{} pieces at once. With recombination: {}; at the end {}. Without, {} pieces stay, and "
                   "at the end a frame takes {:.2f} times as "
                   "long as before, a tick {} ms. The claim is {}.",
                   most_pieces(found.merging), told, merged, found.staying.ticks.back().pieces, stays.ratio(),
                   figure(stays_update.after_ms), name_of(verdict)),
       why_merging(verdict, tick_back, merged)},
      merging_plots(found));
}

}  // namespace

std::vector<ReportSection> physics_sections(const Findings& found, Conclusions& conclusions) {
  std::vector<ReportSection> sections;
  sections.push_back(draw_spikes(found.rebuild, conclusions));
  sections.push_back(update_spikes(found.rebuild, conclusions));
  sections.push_back(merging(found.merging, conclusions));
  return sections;
}

}  // namespace scree::paper
