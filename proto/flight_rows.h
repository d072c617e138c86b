// Rows of what a server keeps of its last ticks, for administrators (proto/access.proto).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/ids.h"
#include "shared/base/kind_table.h"

namespace scree {

enum class FlightList : uint8_t { slow = 0, worst = 1, parties = 2 };

struct FlightListRow {
  std::string_view name;
};

constexpr FlightListRow row_of(FlightList list) {
  switch (list) {
    case FlightList::slow:  // ticks that were slow
      return {"slow"};
    case FlightList::worst:  // those that made the game latest, slow or not
      return {"worst"};
    case FlightList::parties:  // work by party
      return {"parties"};
  }
  return {};
}

/// Answered by an AdminListMessage with slow ticks or parties.
struct ListFlightRequest {
  FlightList list = FlightList::slow;
  uint32_t since_s = 0;  ///< ticks of the last seconds; 0: all that there are
  uint32_t most = 0;     ///< rows of FlightList::worst, at most limits::slow_rows_max
};

struct SlowTickRow {
  Tick tick = 0;
  uint64_t unix_ms = 0;
  uint32_t ticks = 0;
  float late_ms = 0.0F;
  float wall_ms = 0.0F;
  float cpu_ms = 0.0F;
  std::string culprit{};
  std::string stage{};  ///< empty: it was none
  float clock_ms = 0.0F;
  float price_ms = 0.0F;
  uint64_t party = 0;
  uint64_t session = 0;
  std::string name{};
  std::string request{};
  std::optional<glm::vec3> place_m{};
  std::string words{};

  bool operator==(const SlowTickRow&) const = default;
};

struct PartyRow {
  uint64_t party = 0;
  uint32_t sessions = 0;
  std::string name{};
  std::string address{};
  float clock_us_per_s = 0.0F;
  float price_us_per_s = 0.0F;
  uint32_t pieces = 0;
  uint64_t requests = 0;
  uint64_t refused = 0;
  uint64_t sent_bytes = 0;

  bool operator==(const PartyRow&) const = default;
};

}  // namespace scree
