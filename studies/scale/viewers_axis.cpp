// A storm seen by 1 to 3,000 viewers on loopback.
#include <algorithm>
#include <fmt/format.h>

#include "bench/wire/audience.h"
#include "studies/scale/axes.h"

namespace scree {

namespace {

constexpr double linear_max = 1.05;        ///< exponent that counts as linear
constexpr double interval_max = 0.25;      ///< half of the exponent's: more is too much noise to tell
constexpr double linear_at_end_max = 1.1;  ///< of three sizes, which tell less
constexpr double gigabit_kbit_s = 1e6;

/// The interval is not asked of a quick run, which has one degree of freedom.
Check linear_check(const Curve& fan_out, bool quick) {
  Check check{"viewers_fan_out_at_most_linear", false, "no law"};
  const auto law = fan_out.law(), end = fan_out.law_at_end();
  if (!law || !end) return check;
  check.passed = law->exponent <= linear_max && (quick || law->within <= interval_max) &&
                 end->exponent <= linear_at_end_max;
  check.detail = fmt::format(
      "exponent {}, wanted at most {}{}; {:.2f} of the last three sizes, wanted at most {}",
      exponent_text(*law), linear_max, quick ? "" : fmt::format(" and known within {}", interval_max),
      end->exponent, linear_at_end_max);
  return check;
}

Result<void> add_audience(Axis& axis, size_t viewers, double seconds) {
  const auto shown = show_storm({.viewers = viewers, .mirrors = 0, .seconds = seconds});
  TRY(shown);
  const auto size = static_cast<double>(viewers);
  axis.curve("fan-out", measure::processor_ms).add(size, shown->net_cpu_ms);
  axis.curve("simulation", measure::processor_ms).add(size, shown->tick_cpu_ms);
  axis.curve("age of a frame, median", measure::time_ms).add(size, shown->ages.quantile_ms(0.5));
  axis.curve("age of a frame, 99th percentile", measure::time_ms).add(size, shown->ages.quantile_ms(0.99));
  axis.curve("sent to all", "kbit/s").add(size, shown->kbit_s_a_viewer * size);
  if (viewers >= 100)  // of fewer, what the process holds moves by more for other reasons
    axis.curve("memory of all viewers", measure::size_mib).add(size, shown->kib_a_viewer * size / 1024.0);
  axis.checks.push_back(
      {fmt::format("viewers_{}_in_time", viewers), shown->late_ticks == 0 && shown->lost == 0,
       fmt::format("{} of {} ticks late, {} viewers lost", shown->late_ticks, shown->ticks, shown->lost)});
  return {};
}

}  // namespace

Result<Axis> measure_viewers_axis(const ScaleRun& run) {
  Axis axis{"viewers", "Viewers", "viewers", "viewers"};
  const std::vector<size_t> counts =
      run.quick ? std::vector<size_t>{1, 30, 300} : std::vector<size_t>{1, 3, 10, 30, 100, 300, 1000, 3000};
  double done = 0.0;
  for (const size_t viewers : counts) {
    const auto added = add_audience(axis, viewers, run.quick ? 2.0 : 5.0);
    TRY(added);
    run.progress(++done / static_cast<double>(counts.size()));
  }
  Curve& fan_out = axis.curve("fan-out", measure::processor_ms);
  fan_out.limit(1000.0 / 60.0, "one core's tick of 16.6 ms");
  axis.curve("age of a frame, 99th percentile", measure::time_ms).limit(100.0, "100 ms");
  axis.curve("sent to all", "kbit/s").limit(gigabit_kbit_s, "a link of 1 Gbit/s");
  axis.checks.push_back(linear_check(fan_out, run.quick));
  axis.text.push_back(
      "All viewers look at the same storm, a blow of 64 pieces twice a second, from one place, and read all "
      "they get. They are sockets of the same machine, read by one thread of lower priority. Fan-out is the "
      "processor time a tick of all threads but the simulation's and the viewers'. It includes the costs of "
      "a tick that do not depend on viewers, so the exponent over all sizes is lower than that of the last "
      "three. The age of a frame counts from the moment in which the simulation handed it over until it was "
      "read.");
  return axis;
}

}  // namespace scree
