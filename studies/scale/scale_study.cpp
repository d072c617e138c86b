// The study `scale`: curves of cost along six axes with their exponents, what gives way first, and what one
// machine holds.
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "shared/base/timing.h"
#include "studies/scale/axes.h"
#include "studies/scale/frame_set.h"
#include "studies/support/studies.h"
#include "studies/support/this_build.h"

namespace scree {

namespace {

struct AxisPart {
  const char* name;
  Result<Axis> (*measure)(const ScaleRun&);
  double share;  ///< of the study's time
};

constexpr AxisPart axis_parts[] = {
    {"world", measure_world_axis, 0.18},   {"voxel", measure_voxel_axis, 0.12},
    {"pieces", measure_pieces_axis, 0.12}, {"viewers", measure_viewers_axis, 0.12},
    {"carves", measure_carves_axis, 0.16}, {"recording", measure_recording_axis, 0.12},
};
constexpr double machine_share = 0.18;

/// Measures one part after the other, and puts the report together.
class ScaleStudy {
 public:
  ScaleStudy(const StudyOptions& options, const std::string& worlds) : options_(options) {
    run_.quick = options.quick;
    run_.worlds = worlds;
    auto stage = Stage::create(frame_view_radius_m);
    if (!stage) {
      drawing_ = "Nothing is drawn: " + stage.error().message + ".";
      return;
    }
    stage_ = std::move(*stage);
    run_.stage = stage_.get();
    drawing_ = "Frames are drawn by " + stage_->renderer->description() + ".";
  }

  StudyResult measure() {
    for (const AxisPart& part : axis_parts) measure_axis(part);
    measure_the_machine();
    tell();
    return std::move(result_);
  }

 private:
  void begin(double share) {
    run_.progress = [this, from = done_, share](double part) { options_.progress(from + share * part); };
    stopwatch_.lap_ms();
  }
  void end(const std::string& name, double share, const std::string& failure) {
    result_.figures.metric(name + "_took_s", stopwatch_.lap_ms() * 1e-3);
    result_.figures.check(name + "_measured", failure.empty(), failure);
    options_.progress(done_ += share);
  }
  void measure_axis(const AxisPart& part) {
    begin(part.share);
    const auto axis = part.measure(run_);
    if (axis) {
      sections_.push_back(section_of(*axis));
      add_figures(*axis, result_.figures);
      const auto walls = walls_of(*axis);
      walls_.insert(walls_.end(), walls.begin(), walls.end());
    } else {
      sections_.push_back({part.name, {"Not measured: " + axis.error().message + "."}});
    }
    end(part.name, part.share, axis ? "" : axis.error().message);
  }
  void measure_the_machine() {
    begin(machine_share);
    auto machine = measure_machine(run_);
    if (machine) {
      sections_.push_back(std::move(machine->section));
      for (const Metric& metric : machine->figures.metrics) result_.figures.metrics.push_back(metric);
      for (const Check& check : machine->figures.checks) result_.figures.checks.push_back(check);
    } else {
      sections_.push_back({"What one machine holds", {"Not measured: " + machine.error().message + "."}});
    }
    end("machine", machine_share, machine ? "" : machine.error().message);
  }
  ReportSection walls_section() const;
  void tell();

  const StudyOptions& options_;
  ScaleRun run_;
  std::unique_ptr<Stage> stage_;
  std::string drawing_;
  Stopwatch stopwatch_;
  double done_ = 0.0;
  std::vector<ReportSection> sections_;
  std::vector<Wall> walls_;
  StudyResult result_;
};

std::string place_of(const Wall& wall) {
  if (!wall.crossing) return "not, as far as the curve tells";
  return fmt::format("{}{} {}", wall.crossing->measured ? "" : "about ", figure(wall.crossing->size),
                     wall.x_unit);
}

/// The wall of an axis that is met first; null when none is met.
const Wall* first_of(const std::vector<Wall>& walls, const std::string& axis) {
  const Wall* first = nullptr;
  const bool shrinks = axis == "Voxel size";
  for (const Wall& wall : walls)
    if (wall.axis == axis && wall.crossing &&
        (first == nullptr || (shrinks ? wall.crossing->size > first->crossing->size
                                      : wall.crossing->size < first->crossing->size)))
      first = &wall;
  return first;
}

ReportSection ScaleStudy::walls_section() const {
  ReportSection section{"What gives way first", {}};
  ReportTable table{"Limits", {"axis", "curve", "limit", "met at", "known"}, {}};
  for (const Wall& wall : walls_)
    table.rows.push_back({wall.axis, wall.curve, wall.limit, place_of(wall),
                          !wall.crossing            ? "–"
                          : wall.crossing->measured ? "measured"
                                                    : "by the law of the last three sizes"});
  std::string axis;
  for (const Wall& wall : walls_) {
    if (wall.axis == axis) continue;
    axis = wall.axis;
    const Wall* first = first_of(walls_, axis);
    section.text.push_back(first == nullptr
                               ? fmt::format("**{}**: none of its limits is met.", axis)
                               : fmt::format("**{}**: first is the curve “{}”, which meets {} at {}{}.", axis,
                                             first->curve, first->limit, place_of(*first),
                                             first->crossing->measured ? "" : ", beyond what was measured"));
  }
  section.tables.push_back(std::move(table));
  return section;
}

void ScaleStudy::tell() {
  StudyReport& report = result_.report;
  report.name = "scale";
  report.title = "How Scree scales, and what gives way first";
  report.command = std::string("./scree bench scale") + (options_.quick ? " --quick" : "");
  size_t passed = 0;
  std::string missed;
  for (const Check& check : result_.figures.checks) {
    passed += check.passed ? 1 : 0;
    if (!check.passed) missed += fmt::format(" `{}` ({})", check.name, check.detail);
  }
  report.summary.push_back(
      "Along each axis one thing grows, the rest stays as it is. A curve is fitted by y = factor · "
      "x^exponent: least "
      "squares in logarithms over all its sizes. Behind ± is half of the exponent's 95 % interval by "
      "Student's t. An "
      "exponent of 0 is flat, one of 1 linear. " +
      drawing_);
  report.summary.push_back(fmt::format("{} of {} checks hold.{}", passed, result_.figures.checks.size(),
                                       missed.empty() ? "" : " These do not:" + missed + "."));
  report.sections.push_back(walls_section());
  for (ReportSection& section : sections_) report.sections.push_back(std::move(section));
}

}  // namespace

Result<StudyResult> run_scale_study(const StudyOptions& options) {
  // Other builds may carve otherwise, so that their worlds are others.
  const auto worlds =
      BuildFolder::acquire((std::filesystem::path(options.folder) / "scale-worlds").string(), this_build());
  TRY(worlds);
  // Servers that the study starts within this process would tell of each session.
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::err);
  StudyResult result = ScaleStudy(options, worlds->path()).measure();
  spdlog::set_level(level);
  return result;
}

}  // namespace scree
