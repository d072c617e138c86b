#include "studies/matrix/matrix_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "studies/matrix/matrix_tables.h"

namespace scree {

namespace {

/// A median frame may be so far from what its parts foretell, as a share, for drawing and session to count
/// as independent.
constexpr double foretelling_error_max = 0.15;

std::string percent(double share) {
  return figure(100.0 * share) + " %";
}

std::string sessions_text(const MatrixResults& results) {
  const SessionPlan plan = session_plan(results.quick);
  return fmt::format(
      "Drawing × cutter × simplifier × collider × recombination × pattern: {} × {} × {} × {} × {} × {}. The "
      "pattern "
      "`authored` is left out: it is no method, but points that somebody sends. So is `natural`, whose "
      "pieces are no cells of its seeds. The other five choices change what a "
      "session does, and each other, so {}: {} sessions, {} of them without recombination (`off`), as a "
      "control that is "
      "not ranked. A session is {} blow(s) of 2 m into {} pieces, one a second, in {} ticks of 1/60 s, in "
      "the canyon, on "
      "one thread.",
      all_methods().size(), kind_count<Cutter>, kind_count<Simplifier>, kind_count<TerrainColliderKind>,
      kind_count<Recombination>, compared_patterns.size(),
      results.quick ? "with `--quick` those that differ from the defaults in one of them are measured"
                    : "all are measured",
      results.sessions.size() + results.frozen.size(), results.frozen.size(), plan.blows, plan.seeds,
      plan.ticks);
}

ReportSection method_section(const MatrixResults& results) {
  ReportSection section{"What was measured", {}};
  section.text = {
      sessions_text(results),
      fmt::format(
          "Drawing reads the field and the pieces, and the simulation never reads the drawing. So each "
          "drawing is "
          "measured over the session of the defaults, and added to each session: {} combinations. Section "
          "\"Drawing apart\" checks that sum. Pictures have 640×360 pixels and the quality `medium`, every "
          "twentieth tick has one, and they are drawn by {}.",
          combinations_of(results), results.renderer),
      "**Frame**: the mean tick, and the frame's drawing: the method's update, and the drawing until the GPU "
      "has finished, by the median of a session's frames" +
          least_of_rounds(results) +
          ". **Tick**: the mean of all ticks. **Memory**: the most that the world held on the heap, and the "
          "drawing method's on both sides. **Mass error**: of the mass that was moved, what is dust at the "
          "end, in neither terrain nor pieces; the ledger itself is exact, and is compared with the field "
          "measured afresh. **Surface error**, in voxels: the root of the sum of five squares. These are the "
          "distances of cut pieces from their exact cells, of merged terrain from the exact union, of bodies "
          "from their pieces and of the drawn surface from the field, and the depth of pieces' points in "
          "rock."};
  for (const std::string& missing : results.left_out) section.text.push_back("Left out: " + missing + ".");
  if (!results.repeated_ms.empty()) {
    const auto [least, most] = std::ranges::minmax(results.repeated_ms);
    section.text.push_back(
        fmt::format("Noise: the mean tick of the defaults, measured {} times between the others, is "
                    "{} to {} ms.",
                    results.repeated_ms.size(), figure(least), figure(most)));
  }
  return section;
}

/// What recombination brings: the control beside the same sessions with it.
std::string control_text(const MatrixResults& results) {
  const auto median = [](const std::vector<MeasuredSession>& sessions, double SessionFigures::*member) {
    std::vector<double> values;
    for (const MeasuredSession& session : sessions) values.push_back(session.figures.*member);
    return figure(quantile(values, 0.5));
  };
  return fmt::format(
      "Without recombination (`off`, {} sessions) a tick takes {} ms in the median, with it {} ms, as pieces "
      "that freeze cost a tick nothing either; but {} pieces stay, against {}.",
      results.frozen.size(), median(results.frozen, &SessionFigures::tick_ms),
      median(results.sessions, &SessionFigures::tick_ms),
      median(results.frozen, &SessionFigures::pieces_left),
      median(results.sessions, &SessionFigures::pieces_left));
}

ReportSection answer_section(const MatrixResults& results, const std::vector<MatrixScore>& scores) {
  ReportSection section{"Which is the most efficient, and when", {}};
  const size_t balanced = balanced_choice(scores);
  ReportTable table{"The best by each criterion, and what the others have there",
                    {"criterion", "best combination", "its value", "balanced", "defaults", "paper's program"},
                    {}};
  const auto value = [&](size_t number, size_t criterion) {
    return number < scores.size() ? figure(scores[number][criterion]) : std::string("–");
  };
  const size_t defaults = number_of(results, "mesh", {}),
               paper = number_of(results, "raymarch", papers_program());
  for (size_t i = 0; i < matrix_criteria.size(); ++i) {
    const size_t best = best_by(scores, i);
    table.rows.push_back({std::string(matrix_criteria[i].title), text_of(combination_of(results, best)),
                          value(best, i), value(balanced, i), value(defaults, i), value(paper, i)});
  }
  section.tables.push_back(std::move(table));
  section.text = {
      "A combination is named by drawing, cutter, simplifier, collider, recombination and pattern. The "
      "paper's program is "
      "`raymarch` with `" +
          text_of(papers_program()) + "`; the defaults are `mesh` with `" + text_of(Simulated{}) + "`.",
      fmt::format("**The balanced choice is `{}`.** The rule: on the Pareto front ({} of {}) choose the "
                  "combination whose worst rank is the least. A combination is on that front if no other is "
                  "as good in all five criteria and better in one. A rank is the share of all combinations "
                  "that are better. Its worst rank is {}.",
                  text_of(combination_of(results, balanced)), pareto_front(scores).size(), scores.size(),
                  figure(std::ranges::max(ranks_of(scores)[balanced]))),
      situations_text(results), control_text(results)};
  return section;
}

ReportSection front_section(const MatrixResults& results, const std::vector<MatrixScore>& scores) {
  ReportSection section{"The Pareto front", {"The plots show two of the five criteria: time and exactness."}};
  const std::vector<size_t> front = pareto_front(scores);
  const std::set<size_t> on_front(front.begin(), front.end());
  const auto point = [&](size_t i, size_t x) { return std::pair(scores[i][x], scores[i][4]); };
  const auto plot_by = [&](const char* name, const char* title, const char* label, size_t x) {
    PlotSeries others{"others", SeriesStyle::points, {}}, best{"Pareto front", SeriesStyle::points, {}};
    for (size_t i = 0; i < scores.size(); ++i)
      (on_front.contains(i) ? best : others).points.push_back(point(i, x));
    PlotSeries balanced{"balanced", SeriesStyle::points, {point(balanced_choice(scores), x)}};
    std::vector<PlotSeries> series{others, best, balanced};
    for (const auto& [who, number] :
         {std::pair("defaults", number_of(results, "mesh", {})),
          std::pair("paper's program", number_of(results, "raymarch", papers_program()))})
      if (number < scores.size()) series.push_back({who, SeriesStyle::points, {point(number, x)}});
    section.plots.push_back({name, title, label, "surface error, voxels", true, false, std::move(series)});
  };
  plot_by("pareto-frame", "Frame time and surface error of every combination", "frame, ms", 0);
  plot_by("pareto-tick", "Tick time and surface error of every combination", "tick, ms", 1);
  return section;
}

ReportSection whole_section(const MatrixResults& results) {
  ReportSection section{"Drawing apart", {}};
  ReportTable table{"Whole combinations beside the sum of their parts",
                    {"combination", "measured whole, ms", "foretold, ms", "off"},
                    {}};
  double worst = 0.0;
  for (const auto& [combination, figures] : results.whole) {
    const double whole = figures.frame_ms + figures.tick_ms, foretold = foretold_ms(results, combination);
    worst = std::max(worst, std::abs(whole / foretold - 1.0));
    table.rows.push_back(
        {text_of(combination), figure(whole), figure(foretold), percent(whole / foretold - 1.0)});
  }
  section.text = {fmt::format(
      "{} combinations, spread over all, were measured whole: drawn over their own session, its frames by "
      "the median of a session{}, as the drawings are, and its mean tick of one session, as the sessions' "
      "are. "
      "Their frame is off what their parts foretell by {} in the median, and by {} at worst.",
      results.whole.size(), least_of_rounds(results), percent(foretelling_error(results)), percent(worst))};
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace

double foretelling_error(const MatrixResults& results) {
  std::vector<double> errors;
  for (const auto& [combination, figures] : results.whole)
    errors.push_back(
        std::abs((figures.frame_ms + figures.tick_ms) / foretold_ms(results, combination) - 1.0));
  return quantile(errors, 0.5);
}

StudyReport matrix_report(const MatrixResults& results) {
  const std::vector<MatrixScore> scores = scores_of(results);
  const size_t balanced = balanced_choice(scores);
  StudyReport report;
  report.name = "matrix";
  report.title = "Every combination of methods";
  report.command = results.quick ? "./scree bench matrix --quick" : "./scree bench matrix";
  report.summary = {
      fmt::format("Among {} combinations, `{}` is the balanced choice: {} ms a frame, {} ms a tick and {} "
                  "MiB; {} % of the mass moved is dust, and surfaces are {} voxels off.",
                  scores.size(), text_of(combination_of(results, balanced)), figure(scores[balanced][0]),
                  figure(scores[balanced][1]), figure(scores[balanced][2]), figure(scores[balanced][3]),
                  figure(scores[balanced][4]))};
  report.sections = {answer_section(results, scores), ranking_section(results, scores),
                     choices_section(results),        front_section(results, scores),
                     drawings_section(results),       whole_section(results),
                     profiles_section(results),       method_section(results)};
  return report;
}

BenchReport matrix_figures(const MatrixResults& results) {
  BenchReport report;
  const std::vector<MatrixScore> scores = scores_of(results);
  const std::vector<MatrixScore> ranks = ranks_of(scores);
  const size_t balanced = balanced_choice(scores);
  report.metric("combinations", static_cast<double>(scores.size()));
  report.metric("pareto_front", static_cast<double>(pareto_front(scores).size()));
  for (size_t i = 0; i < matrix_criteria.size(); ++i) {
    const std::string name(matrix_criteria[i].name);
    report.metric("best_" + name, scores[best_by(scores, i)][i]);
    report.metric("balanced_" + name, scores[balanced][i]);
  }
  report.metric("foretelling_error_median", foretelling_error(results));
  double ledger_units = 0.0;
  for (const auto* sessions : {&results.sessions, &results.frozen})
    for (const MeasuredSession& session : *sessions)
      ledger_units = std::max(ledger_units, session.figures.ledger_units);
  report.check("ledger_exact", ledger_units == 0.0,
               fmt::format("{} units off at worst, over {} sessions; wanted 0", ledger_units,
                           results.sessions.size() + results.frozen.size()));
  report.check("drawing_is_apart", foretelling_error(results) <= foretelling_error_max,
               fmt::format("whole frames are {:.3f} off their parts in the median, wanted at most {}",
                           foretelling_error(results), foretelling_error_max));
  const double worst_rank = std::ranges::max(ranks[balanced]);
  report.check(
      "balanced_above_the_median", worst_rank < 0.5,
      fmt::format("{}: {:.2f} of all combinations are better in its worst criterion, wanted less than half",
                  text_of(combination_of(results, balanced)), worst_rank));
  const size_t paper = number_of(results, "raymarch", papers_program());
  if (paper < scores.size())
    report.check("ticks_faster_than_the_papers_program", scores[paper][1] > scores[balanced][1],
                 fmt::format("{:.3f} ms a tick by the paper's program, {:.3f} balanced", scores[paper][1],
                             scores[balanced][1]));
  for (const auto& [preset, figures] : results.profiles) {
    const std::string name = "preset_" + std::string(name_of(preset));
    report.metric(name + "_tick_ms", figures.tick_ms);
    report.metric(name + "_tick_p99_ms", figures.tick_p99_ms);
    report.metric(name + "_resident_mb", figures.resident_mb);
    if (figures.frame_ms > 0.0) report.metric(name + "_frame_ms", figures.frame_ms);
    report.check(
        name + "_holds",
        figures.tick_p99_ms <= figures.tick_budget_ms && figures.resident_mb <= figures.memory_max_mb &&
            figures.refused == 0.0,
        fmt::format("p99 {:.2f} ms of {:.1f}, {:.0f} MB of {:.0f}, on {} core(s), {} blows refused, wanted 0",
                    figures.tick_p99_ms, figures.tick_budget_ms, figures.resident_mb, figures.memory_max_mb,
                    figures.cores, figures.refused));
  }
  return report;
}

}  // namespace scree
