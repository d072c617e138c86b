// Durations of stages, by track, written as a Chrome trace, which chrome://tracing and ui.perfetto.dev open.
// One API for the server's stages, the viewer's and the GPU's.
//
// Safe from any thread. Keeps the newest trace_spans_max spans and values; older ones are overwritten. A null
// Trace* records nothing, so code measures always and its caller decides whether to keep the result.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// 24 MiB: some minutes of a server's ticks and a viewer's frames.
inline constexpr size_t trace_spans_max = size_t{1} << 19;

class Trace {
 public:
  using Clock = std::chrono::steady_clock;

  Trace() = default;
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  /// A span of a track. Names are literals: they must outlive the trace, and hold nothing that JSON escapes.
  void span(std::string_view track, std::string_view name, Clock::time_point begin, double duration_ms);
  /// A value at a time, drawn as a curve.
  void value(std::string_view name, Clock::time_point at, double value);

  /// JSON Trace Event Format: complete events ("X") by track, counters ("C"). Times in µs since the first.
  std::string to_json() const;
  Result<void> write(const std::string& file) const;

 private:
  struct Event {
    std::string_view track;  ///< empty: a value
    std::string_view name;
    Clock::time_point begin;
    double amount;  ///< milliseconds, or the value
  };
  void add(const Event& event);
  std::vector<Event> in_order() const;

  mutable std::mutex mutex_;
  std::vector<Event> events_;
  size_t next_ = 0;  ///< the oldest event, overwritten next once events_ is full
};

/// Measures from here to the end of its block.
class TraceSpan {
 public:
  TraceSpan(Trace* trace, std::string_view track, std::string_view name)
      : trace_(trace), track_(track), name_(name) {}
  ~TraceSpan() {
    if (trace_ != nullptr) trace_->span(track_, name_, begin_, elapsed_ms());
  }
  TraceSpan(const TraceSpan&) = delete;
  TraceSpan& operator=(const TraceSpan&) = delete;

  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Trace::Clock::now() - begin_).count();
  }

 private:
  Trace* trace_;
  std::string_view track_;
  std::string_view name_;
  Trace::Clock::time_point begin_ = Trace::Clock::now();
};

}  // namespace scree
