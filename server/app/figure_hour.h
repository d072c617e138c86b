// The figures of a server's last hour, for administrators: a sample of each ten seconds. One thread at a
// time.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "server/app/server_report.h"

namespace scree {

class FigureHour {
 public:
  /// Whether limits::figure_sample_s have passed since the last sample; `now_s` as of steady_now_s().
  bool is_due(double now_s) const { return now_s >= due_s_; }
  /// `now`: counts since the start. `worst_tick_ms`: since the last sample.
  void sample(double now_s, const ServerReport& now, double worst_tick_ms);
  /// Objects of JSON, the oldest first. Their members, each of the time since the sample before or as of
  /// then: time; tick_ms, tick_ms_max (milliseconds, a mean and the most; null without ticks); ticks, late;
  /// pieces, bodies, sessions; sent_bytes_s; memory_mb; requests, refused.
  std::vector<std::string> lines() const { return {samples_.begin(), samples_.end()}; }

 private:
  /// What a sample is the difference of.
  struct Counts {
    uint64_t ticks = 0, late = 0, bytes = 0, requests = 0, refused = 0;
    double tick_sum_ms = 0.0, seconds = 0.0;
  };

  std::deque<std::string> samples_;
  Counts before_;
  double due_s_ = 0.0;
};

}  // namespace scree
