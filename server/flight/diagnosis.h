// Why a tick was slow: the likely culprit, from what the flight recorder keeps of it. Pure functions.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "server/flight/flight_tick.h"
#include "shared/base/kind_table.h"

namespace scree {

enum class Culprit : uint8_t { none, work, crowd, disk, network, swapped_out, not_running };

struct CulpritRow {
  std::string_view name;  ///< for programs; stays as it is
};

constexpr CulpritRow row_of(Culprit culprit) {
  switch (culprit) {
    case Culprit::none:
      return {.name = "none"};
    case Culprit::work:
      return {.name = "work"};
    case Culprit::crowd:
      return {.name = "crowd"};
    case Culprit::disk:
      return {.name = "disk"};
    case Culprit::network:
      return {.name = "network"};
    case Culprit::swapped_out:
      return {.name = "swapped_out"};
    case Culprit::not_running:
      return {.name = "not_running"};
  }
  return {};
}

/// From when on something is slow.
struct SlowLimits {
  double late_ms = 0.0;
  double save_ms = 0.0;
};

struct Diagnosis {
  Culprit culprit = Culprit::none;        ///< none: the tick was not slow
  TickStage stage = TickStage::requests;  ///< that took longest; of work and crowds
  std::optional<FlightCause> cause{};     ///< the dearest of that stage
  float culprit_ms = 0.0F;                ///< what of the tick's time is its
};

/// `causes`: of this tick.
Diagnosis diagnose(const FlightTick& tick, std::span<const FlightCause> causes, const SlowLimits& limits);

/// How people call a party or session, and kinds of requests.
struct FlightNames {
  std::function<std::string(uint64_t session)> session;
  std::function<std::string_view(uint8_t request)> request;
};
/// One plain line.
std::string words_of(const FlightTick& tick, const Diagnosis& diagnosis, const FlightNames& names);

}  // namespace scree
