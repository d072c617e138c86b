#include "studies/matrix/matrix_tables.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <numeric>

#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr size_t ranked_rows = 5;

std::vector<std::string> figures_of(const MatrixScore& score) {
  std::vector<std::string> cells;
  for (const double value : score) cells.push_back(figure(value));
  return cells;
}

/// A value of a choice, and whether a session has it.
struct ChoiceValue {
  std::string choice;
  std::string_view value;
  std::function<bool(const Simulated&)> has;
};

template <typename Kind>
void add_values(std::vector<ChoiceValue>& values, const char* choice, Kind Simulated::*member) {
  for (const Kind kind : all_kinds<Kind>)
    values.push_back(
        {choice, name_of(kind), [member, kind](const Simulated& one) { return one.*member == kind; }});
}

std::vector<ChoiceValue> choice_values() {
  std::vector<ChoiceValue> values;
  add_values(values, "cutter", &Simulated::cutter);
  add_values(values, "simplifier", &Simulated::simplifier);
  add_values(values, "collider", &Simulated::collider);
  add_values(values, "recombination", &Simulated::recombine);
  add_values(values, "pattern", &Simulated::pattern);
  return values;
}

std::vector<std::string> medians_of(const ChoiceValue& value, const std::vector<MeasuredSession>& sessions) {
  const auto median = [&](const auto& figure_of) {
    std::vector<double> values;
    for (const MeasuredSession& session : sessions)
      if (value.has(session.simulated)) values.push_back(figure_of(session));
    return values.empty() ? std::string("–") : figure(quantile(values, 0.5));
  };
  const auto ticks = [&](double SessionFigures::*member) {
    return median([member](const MeasuredSession& session) { return session.figures.*member; });
  };
  return {value.choice,
          std::string(value.value),
          ticks(&SessionFigures::tick_ms),
          ticks(&SessionFigures::tick_p99_ms),
          ticks(&SessionFigures::carve_ms),
          ticks(&SessionFigures::heap_mib),
          ticks(&SessionFigures::pieces_left),
          ticks(&SessionFigures::dust_percent),
          median([](const MeasuredSession& session) { return session.cells.rms_voxels; }),
          median([](const MeasuredSession& session) { return session.merge.rms_voxels; }),
          ticks(&SessionFigures::depth_voxels),
          ticks(&SessionFigures::body_voxels)};
}

}  // namespace

std::string least_of_rounds(const MatrixResults& results) {
  return results.draw_rounds == 1 ? "" : fmt::format(", the least of {} sessions", results.draw_rounds);
}

ReportSection ranking_section(const MatrixResults& results, const std::vector<MatrixScore>& scores) {
  ReportSection section{
      "Ranking", {"All combinations stand in `matrix/ranking.csv`, from the best balanced to the worst."}};
  const std::vector<MatrixScore> ranks = ranks_of(scores);
  std::vector<std::string> header{"combination"};
  for (const Criterion& criterion : matrix_criteria) header.emplace_back(criterion.title);
  for (size_t by = 0; by < matrix_criteria.size(); ++by) {
    std::vector<size_t> order(scores.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto first_by = [&](size_t i) {
      return std::pair(ranks[i][by], std::accumulate(ranks[i].begin(), ranks[i].end(), 0.0));
    };
    const size_t rows = std::min(ranked_rows, order.size());
    std::ranges::partial_sort(order, order.begin() + static_cast<ptrdiff_t>(rows), {}, first_by);
    ReportTable table{"The first by " + std::string(matrix_criteria[by].title), header, {}};
    for (size_t i = 0; i < rows; ++i) {
      std::vector<std::string> row = figures_of(scores[order[i]]);
      row.insert(row.begin(), text_of(combination_of(results, order[i])));
      table.rows.push_back(std::move(row));
    }
    section.tables.push_back(std::move(table));
  }
  return section;
}

ReportSection choices_section(const MatrixResults& results) {
  ReportSection section{"What each choice decides",
                        {"Medians over all sessions that have the value and make terrain of the pieces "
                         "again; times on one thread, of the "
                         "whole tick. `off` is the control: pieces freeze where they lie and stay pieces, so "
                         "it is not ranked."}};
  ReportTable table{
      "Medians by choice",
      {"choice", "value", "tick, ms", "tick p99, ms", "tick of a blow, ms", "heap, MiB", "pieces left",
       "dust, %", "cut off, voxels", "merged off, voxels", "deep in rock, voxels", "body off, voxels"},
      {}};
  for (const ChoiceValue& value : choice_values()) {
    const bool frozen = value.value == name_of(Recombination::off);
    const std::vector<MeasuredSession>& sessions = frozen ? results.frozen : results.sessions;
    const auto has = [&](const MeasuredSession& session) { return value.has(session.simulated); };
    if (std::ranges::any_of(sessions, has)) table.rows.push_back(medians_of(value, sessions));
  }
  section.tables.push_back(std::move(table));
  return section;
}

ReportSection drawings_section(const MatrixResults& results) {
  ReportSection section{"Drawing", {situations_text(results)}};
  ReportTable table{"The session of the defaults by each drawing, at 640×360, quality `medium`, by " +
                        results.renderer + "; times are medians of a session's frames" +
                        least_of_rounds(results),
                    {"drawing", "fresh ground, ms", "pieces in flight, ms", "at the end, ms", "update, ms",
                     "until shown, ms", "memory, MiB", "depth off, voxels", "silhouette off, %"},
                    {}};
  Plot plot{.name = "drawing-situations",
            .title = "A frame's drawing, by situation",
            .x_label = "drawing",
            .y_label = "ms (median" + least_of_rounds(results) + ")",
            .series = {}};
  const std::array situations{std::pair("fresh ground", &DrawnFigures::fresh_ms),
                              std::pair("pieces in flight", &DrawnFigures::flight_ms),
                              std::pair("at the end", &DrawnFigures::settled_ms)};
  for (const auto& [name, member] : situations) {
    PlotSeries series{name, SeriesStyle::bars, {}};
    for (size_t i = 0; i < results.drawings.size(); ++i)
      series.points.emplace_back(static_cast<double>(i), results.drawings[i].figures.*member);
    plot.series.push_back(std::move(series));
  }
  for (const auto& [drawing, drawn] : results.drawings) {
    plot.x_names.push_back(drawing);
    table.rows.push_back({drawing, figure(drawn.fresh_ms), figure(drawn.flight_ms), figure(drawn.settled_ms),
                          figure(drawn.update_ms), figure(drawn.shown_ms), figure(drawn.memory_mib),
                          figure(drawn.depth_voxels), figure(drawn.silhouette_percent)});
  }
  section.tables.push_back(std::move(table));
  section.plots.push_back(std::move(plot));
  return section;
}

ReportSection profiles_section(const MatrixResults& results) {
  ReportSection section{"Presets",
                        {"`--preset` of server and viewer, each under its own constraint: `laptop` on one "
                         "core, which simulates and draws; "
                         "`desktop` on all cores that this process has, drawn by " +
                         results.renderer +
                         "; `dedicated` on all cores, without drawing. The session: sixteen blows of 64 "
                         "pieces, two a second (quick: two), 16 s "
                         "in all (quick: 2 s), the picture 1280×720."}};
  ReportTable ticks{"Each preset's simulation under its own constraint",
                    {"preset", "cores", "tick, ms", "tick p99, ms", "of", "late ticks, %", "pieces at most",
                     "at rest after, s", "blows refused"},
                    {}};
  ReportTable drawing{
      "Their memory and their frames",
      {"preset", "process, MB", "memory-max, MB", "drawing, MiB", "frame, ms", "frame p99, ms", "sees, m"},
      {}};
  for (const auto& [preset, f] : results.profiles) {
    const std::string name(name_of(preset));
    const auto if_drawn = [&](double value) { return f.frame_ms > 0.0 ? figure(value) : std::string("–"); };
    ticks.rows.push_back({name, figure(f.cores), figure(f.tick_ms), figure(f.tick_p99_ms),
                          figure(f.tick_budget_ms), figure(f.late_percent), figure(f.pieces_most),
                          f.seconds_to_rest > 0.0 ? figure(f.seconds_to_rest) : "–", figure(f.refused)});
    drawing.rows.push_back({name, figure(f.resident_mb), figure(f.memory_max_mb), if_drawn(f.draw_mib),
                            if_drawn(f.frame_ms), if_drawn(f.frame_p99_ms), if_drawn(f.view_radius_m)});
  }
  section.tables = {std::move(ticks), std::move(drawing)};
  return section;
}

std::string situations_text(const MatrixResults& results) {
  const auto fastest = [&](double DrawnFigures::*member) {
    const auto least = std::ranges::min_element(
        results.drawings, {}, [member](const MeasuredDrawing& one) { return one.figures.*member; });
    return fmt::format("`{}` ({} ms)", least->drawing, figure(least->figures.*member));
  };
  return fmt::format(
      "Fresh ground is drawn fastest by {}, pieces in flight by {}, the ground at the end by {}; a change is "
      "shown "
      "first by {}.",
      fastest(&DrawnFigures::fresh_ms), fastest(&DrawnFigures::flight_ms), fastest(&DrawnFigures::settled_ms),
      fastest(&DrawnFigures::shown_ms));
}

}  // namespace scree
