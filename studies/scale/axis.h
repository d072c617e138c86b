// An axis of a server's scale: what was measured at its sizes, the laws that follow, the limits that are met,
// and the report's section on it. Plain values, no threads.
#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/bench.h"
#include "studies/report/report.h"
#include "studies/scale/power_law.h"

namespace scree {

/// Measures that axes share; curves of one measure share a plot.
namespace measure {
inline constexpr const char* time_ms = "time, ms";
inline constexpr const char* processor_ms = "processor time, ms";
inline constexpr const char* frame_ms = "time of a frame, ms";
inline constexpr const char* size_mib = "size, MiB";
}  // namespace measure

/// What stands for all rounds of a size: the median, or the least, where anything else of the machine only
/// adds.
enum class Typical { median, least };

/// A limit of what a curve measures.
struct CurveLimit {
  double value = 0.0;
  std::string name;  ///< "a tick of 16.6 ms"
};

/// One thing that is measured, at sizes along an axis.
class Curve {
 public:
  Curve(std::string name, std::string measure, Typical typical)
      : name_(std::move(name)), measure_(std::move(measure)), typical_(typical) {}

  void add(double size, double value) { values_[size].push_back(value); }
  void limit(double value, std::string name) { limit_ = CurveLimit{value, std::move(name)}; }
  /// The exponent of what is as cheap as it can be at any size: a check of the study.
  void flat(double exponent_max) { flat_ = exponent_max; }

  const std::string& name() const { return name_; }
  const std::string& measure() const { return measure_; }  ///< with its unit: "processor time, ms"
  const std::optional<CurveLimit>& limit() const { return limit_; }
  const std::optional<double>& flat() const { return flat_; }
  std::vector<ScalePoint> points() const;  ///< ordered by size
  /// Half of what the rounds of each point lie apart; empty where the least stands for them, about which
  /// they do not lie.
  std::vector<double> spreads() const;
  std::optional<PowerLaw> law() const { return fit_power_law(points()); }
  /// The law of the last three sizes, where fixed costs count least.
  std::optional<PowerLaw> law_at_end() const;

 private:
  std::string name_, measure_;
  Typical typical_;
  std::map<double, std::vector<double>> values_;
  std::optional<CurveLimit> limit_;
  std::optional<double> flat_;
};

struct Axis {
  std::string name;                      ///< of metrics and files: "world"
  std::string title;                     ///< "World size"
  std::string x_label;                   ///< "side of the edited world, m"
  std::string x_unit;                    ///< "m"
  std::vector<std::string> text = {};    ///< conditions, and what was found
  std::vector<ReportTable> tables = {};  ///< after the curves'
  std::vector<Check> checks = {};        ///< of what was timed
  std::list<Curve> curves = {};

  /// The curve of that name, made with the rest unless it is there; the reference stays valid.
  Curve& curve(const std::string& curve_name, const std::string& measure, Typical typical = Typical::median);
};

/// Where an axis meets a limit.
struct Wall {
  std::string axis, curve, limit;
  std::string x_unit;
  std::optional<Crossing> crossing;  ///< nothing: never, as far as the curve tells
};
std::vector<Wall> walls_of(const Axis& axis);

/// Text, a table of laws, a table of all points, and a plot for each measure.
ReportSection section_of(const Axis& axis);

/// Every point, every exponent, and the checks, as metrics and checks: "world_carve_ms_at_64",
/// "world_carve_exponent".
void add_figures(const Axis& axis, BenchReport& figures);

/// "0.98 ± 0.04"; "0.98" where there is no interval.
std::string exponent_text(const PowerLaw& law);

/// A size as it is: "4,096" as "4096", 0.15F as "0.15".
std::string size_text(double size);

/// "a tick" as part of a metric's name: "a_tick".
std::string metric_name(const std::string& text);

}  // namespace scree
