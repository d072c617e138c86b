// The study `matrix`: every combination of drawing, cutter, simplifier, collider, recombination and pattern,
// and the presets. Goes on where a run was broken off (results_log.h), in the report's folder.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "bench/support/machine.h"
#include "client/viewer/pictures/png.h"
#include "studies/matrix/matrix_report.h"
#include "studies/support/studies.h"
#include "studies/support/this_build.h"

namespace scree {

namespace {

/// Sessions that take as long as one of these, for the bar.
constexpr double drawn_weight = 12.0, profile_weight = 30.0;
constexpr size_t repeats = 5, wholes = 12, quick_wholes = 2;

/// Those that differ from the defaults in one choice, and the paper's program.
std::vector<Simulated> few_simulated() {
  const Simulated usual;
  std::vector<Simulated> few{usual};
  for (const Simulated& one : all_simulated()) {
    const int others = (one.cutter != usual.cutter) + (one.simplifier != usual.simplifier) +
                       (one.collider != usual.collider) + (one.recombine != usual.recombine) +
                       (one.pattern != usual.pattern);
    if (others == 1) few.push_back(one);
  }
  few.push_back(papers_program());
  return few;
}

/// All but the times is the same in both.
void assign_minimum(DrawnFigures& least, const DrawnFigures& again) {
  for (const FigureField<DrawnFigures>& field : DrawnFigures::fields())
    least.*field.member = std::min(least.*field.member, again.*field.member);
}

class MatrixRun {
 public:
  MatrixRun(const StudyOptions& options, ResultsLog& log)
      : options_(options),
        log_(log),
        plan_(session_plan(options.quick)),
        simulated_(options.quick ? few_simulated() : all_simulated()) {
    results_.quick = options.quick;
    results_.draw_rounds = options.quick ? 1 : 2;
    whole_work_ = static_cast<double>(simulated_.size()) + profile_weight * kind_count<Preset> +
                  drawn_weight * static_cast<double>((all_methods().size() + whole_count()) *
                                                     static_cast<size_t>(results_.draw_rounds));
  }

  Result<MatrixResults> measure() {
    // Each makes a GL context of its own, on a thread of its own. Drivers keep memory: those without come
    // first.
    for (const bool draws : {false, true})
      for (const Preset preset : all_kinds<Preset>)
        if (is_for_viewers(preset) == draws)
          if (Result<void> done = measure_preset(preset); !done) return fail(done.error().message);
    for (size_t i = 0; i < simulated_.size(); ++i)
      if (Result<void> done = measure_one(i); !done) return fail(done.error().message);
    stage_made_ = Stage::create(traits_of(DrawPlan().quality).view_radius_m);
    if (!*stage_made_) return fail("the matrix draws: " + stage_made_->error().message);
    results_.renderer = stage().renderer->description();
    if (Result<void> done = measure_drawings(); !done) return fail(done.error().message);
    if (Result<void> done = measure_wholes(); !done) return fail(done.error().message);
    return std::move(results_);
  }

 private:
  Stage& stage() { return ***stage_made_; }
  size_t whole_count() const { return options_.quick ? quick_wholes : wholes; }
  void went_on(double work) { options_.progress((done_work_ += work) / whole_work_); }

  Result<void> measure_preset(Preset preset) {
    const auto figures = read_or_measure<ProfileFigures>(log_, "preset " + std::string(name_of(preset)), [&] {
      return measure_profile(preset, options_.quick);
    });
    if (!figures) return fail(figures.error().message);
    results_.profiles.emplace_back(preset, *figures);
    went_on(profile_weight);
    return {};
  }

  Result<void> measure_one(size_t number) {
    const Simulated& one = simulated_[number];
    const auto session = read_or_measure<SessionFigures>(log_, "session " + text_of(one),
                                                         [&] { return measure_session(one, plan_); });
    if (!session) return fail(session.error().message);
    const std::string cut_name = std::string(name_of(one.cutter)) + " " + std::string(name_of(one.pattern));
    const auto cells = read_or_measure<CellErrorFigures>(
        log_, "cut " + cut_name, [&] { return measure_cell_error(one.cutter, one.pattern, plan_.seeds); });
    if (!cells) return fail(cells.error().message);
    const auto merge = read_or_measure<MergeFigures>(
        log_, "merge " + cut_name + " " + std::string(name_of(one.recombine)),
        [&] { return measure_merge(one.cutter, one.pattern, one.recombine, plan_.seeds); });
    if (!merge) return fail(merge.error().message);
    auto& kind = merges(one.recombine) ? results_.sessions : results_.frozen;
    kind.push_back({one, *session, *cells, *merge});
    went_on(1.0);
    if (number % (simulated_.size() / repeats + 1) != 0) return {};
    const auto again =
        read_or_measure<SessionFigures>(log_, "repeat " + std::to_string(results_.repeated_ms.size()),
                                        [&] { return measure_session(Simulated{}, plan_); });
    if (!again) return fail(again.error().message);
    results_.repeated_ms.push_back(again->tick_ms);
    return {};
  }

  /// In turns, so that all see the same machine; each one's least times count.
  Result<void> measure_drawings() {
    for (int round = 1; round <= results_.draw_rounds; ++round)
      for (const MethodEntry& entry : all_methods()) TRY(measure_drawing(entry, round));
    return {};
  }

  Result<void> measure_drawing(const MethodEntry& entry, int round) {
    const std::string name(entry.name);
    went_on(drawn_weight);
    if (const auto missing = entry.missing()) {
      if (round == 1) results_.left_out.push_back(name + " needs " + *missing);
      return {};
    }
    Image image;
    const auto drawn =
        read_or_measure<DrawnFigures>(log_, "drawing " + name + " " + std::to_string(round), [&] {
          return measure_drawn(stage(), entry, Simulated{}, plan_, {.judged = true, .picture = &image});
        });
    if (!drawn) return fail(drawn.error().message);
    if (image.width > 0) TRY(write_png(options_.folder + "/matrix/" + name + ".png", image));
    const auto known = std::ranges::find(results_.drawings, name, &MeasuredDrawing::drawing);
    if (known == results_.drawings.end())
      results_.drawings.push_back({name, *drawn});
    else
      assign_minimum(known->figures, *drawn);
    return {};
  }

  /// As often as the drawings that they are compared with.
  Result<void> measure_wholes() {
    for (int round = 1; round <= results_.draw_rounds; ++round)
      for (size_t i = 0; i < whole_count(); ++i) TRY(measure_whole(i, round));
    return {};
  }

  /// Spread evenly over all by the golden ratio, so that neighbours differ in most choices.
  Result<void> measure_whole(size_t i, int round) {
    constexpr double golden = 0.6180339887;
    const double place = golden * static_cast<double>(i + 1);
    const auto number =
        static_cast<size_t>((place - std::floor(place)) * static_cast<double>(combinations_of(results_)));
    const Combination combination = combination_of(results_, number);
    const auto drawn = read_or_measure<DrawnFigures>(
        log_, "whole " + text_of(combination) + " " + std::to_string(round), [&] {
          return measure_drawn(stage(), *method_named(combination.drawing), combination.simulated, plan_, {});
        });
    if (!drawn) return fail(drawn.error().message);
    went_on(drawn_weight);
    if (round == 1) {
      results_.whole.push_back({combination, *drawn});
      return {};
    }
    DrawnFigures& kept_least = results_.whole[i].figures;
    const double tick_ms = kept_least.tick_ms;
    assign_minimum(kept_least, *drawn);
    kept_least.tick_ms = tick_ms;  // the sessions that foretell it are measured once
    return {};
  }

  const StudyOptions& options_;
  ResultsLog& log_;
  SessionPlan plan_;
  std::vector<Simulated> simulated_;
  MatrixResults results_;
  std::optional<Result<std::unique_ptr<Stage>>> stage_made_;
  double whole_work_ = 1.0, done_work_ = 0.0;
};

}  // namespace

Result<StudyResult> run_matrix_study(const StudyOptions& options) {
  const std::string folder = options.folder + "/matrix";
  const ResultsIdentity identity{this_build(), slug_of(this_machine()), options.quick ? "quick" : "full"};
  Result<ResultsLog> log = ResultsLog::open(folder + "/results.jsonl", identity);
  if (!log) return fail(log.error().message);
  if (!log->begun_anew().empty()) std::fprintf(stderr, "%s; begun anew\n", log->begun_anew().c_str());
  if (log->count() > 0)
    std::fprintf(stderr, "%s/results.jsonl: goes on after %zu results\n", folder.c_str(), log->count());
  const Result<MatrixResults> results = MatrixRun(options, *log).measure();
  if (!results) return fail(results.error().message);
  if (Result<void> written = write_matrix_files(*results, folder); !written)
    return fail(written.error().message);
  return StudyResult{matrix_report(*results), matrix_figures(*results)};
}

}  // namespace scree
