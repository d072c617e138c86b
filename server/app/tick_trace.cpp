#include "server/app/tick_trace.h"

namespace scree {

void trace_tick(Trace& trace, Trace::Clock::time_point begin, const TickDelta& delta) {
  trace.span("simulation", "tick", begin, delta.times.total_ms());
  Trace::Clock::time_point at = begin;
  for (const TickStageRow& row : tick_stages) {
    const double ms = delta.times[row.stage];
    if (ms > 0.0) trace.span("stages", row.name, at, ms);
    at += std::chrono::duration_cast<Trace::Clock::duration>(std::chrono::duration<double, std::milli>(ms));
  }
  trace.value("pieces", begin, static_cast<double>(delta.pieces.size()));
}

}  // namespace scree
