#include "server/app/tick_trace.h"

#include <array>

namespace scree {
namespace {

struct Stage {
  std::string_view name;
  double StageTimes::*time;
};

/// In the order in which a tick goes through them.
constexpr std::array stages{
    Stage{"carve", &StageTimes::carve_ms},     Stage{"spawn", &StageTimes::spawn_ms},
    Stage{"bodies", &StageTimes::bodies_ms},   Stage{"impacts", &StageTimes::impacts_ms},
    Stage{"rest", &StageTimes::rest_ms},       Stage{"recombine", &StageTimes::recombine_ms},
    Stage{"islands", &StageTimes::islands_ms}, Stage{"publish", &StageTimes::publish_ms}};

}  // namespace

void trace_tick(Trace& trace, Trace::Clock::time_point begin, const TickDelta& delta) {
  trace.span("simulation", "tick", begin, delta.times.total_ms);
  Trace::Clock::time_point at = begin;
  for (const Stage& stage : stages) {
    const double ms = delta.times.*stage.time;
    if (ms > 0.0) trace.span("stages", stage.name, at, ms);
    at += std::chrono::duration_cast<Trace::Clock::duration>(std::chrono::duration<double, std::milli>(ms));
  }
  trace.value("pieces", begin, static_cast<double>(delta.pieces.size()));
}

}  // namespace scree
