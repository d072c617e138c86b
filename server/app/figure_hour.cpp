#include "server/app/figure_hour.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/app/limits.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

/// For people: three decimals.
double rounded(double value) {
  return std::round(value * 1e3) / 1e3;
}

}  // namespace

void FigureHour::sample(double now_s, const ServerReport& now, double worst_tick_ms) {
  due_s_ = now_s + limits::figure_sample_s;
  const Counts counts{now.ticks,        now.late_ticks,           now.net.bytes_out,
                      now.net.requests, now.net.refusals.total(), now.whole_tick.sum_ms(),
                      now.seconds};
  const Counts before = std::exchange(before_, counts);
  const uint64_t ticks = counts.ticks - before.ticks;
  const double seconds = counts.seconds - before.seconds;
  nlohmann::ordered_json json{
      {"time", iso_time(unix_now_ms())}, {"tick_ms", nullptr}, {"tick_ms_max", nullptr}};
  if (ticks > 0) {
    json["tick_ms"] = rounded((counts.tick_sum_ms - before.tick_sum_ms) / static_cast<double>(ticks));
    json["tick_ms_max"] = rounded(worst_tick_ms);
  }
  json["ticks"] = ticks;
  json["late"] = counts.late - before.late;
  json["pieces"] = now.pieces_alive;
  json["bodies"] = now.pieces_alive + now.props;
  json["sessions"] = now.net.sessions;
  json["sent_bytes_s"] =
      seconds > 0.0 ? std::round(static_cast<double>(counts.bytes - before.bytes) / seconds) : 0.0;
  json["memory_mb"] = std::round(now.resident_mb);
  json["requests"] = counts.requests - before.requests;
  json["refused"] = counts.refused - before.refused;
  samples_.push_back(json.dump());
  if (samples_.size() > limits::figure_samples_max) samples_.pop_front();
}

}  // namespace scree
