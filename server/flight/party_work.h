// How much each party (Command::party) makes the server work, as averages of the last seconds. Time comes in
// as an argument, seconds. Not thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/flight/flight_tick.h"
#include "server/world/tick_delta.h"

namespace scree {

/// A sum a second, over limits::flight_average_s by an exponential decay.
class DecayingRate {
 public:
  void add(double amount, double now_s);
  double at(double now_s) const;

 private:
  double value_ = 0.0;
  double at_s_ = 0.0;
};

struct PartyWork {
  uint64_t party = 0;  ///< 0: the server itself
  double clock_us_per_s = 0.0;
  double price_us_per_s = 0.0;
  uint64_t requests = 0;  ///< that were carried out, since the party was first seen
  uint32_t pieces = 0;    ///< alive
  std::string name{};     ///< of the person who was there first, also after it left; empty: not known
};

class PartyCounts {
 public:
  /// After each tick. `causes`: of it.
  void add(const FlightTick& tick, std::span<const FlightCause> causes, const TickDelta& delta, double now_s);
  std::vector<PartyWork> all(double now_s) const;
  /// Whose piece it is; 0: the server's, or not known.
  uint64_t party_of(PieceId piece) const;

 private:
  struct Counted {
    DecayingRate clock_us, price_us;
    uint64_t requests = 0;
    uint32_t pieces = 0;
  };
  void count_pieces(const FlightTick& tick, const TickDelta& delta, double now_s);
  void forget_least(double now_s);

  std::map<uint64_t, Counted> parties_;
  std::unordered_map<PieceId, uint64_t> owners_;
};

}  // namespace scree
