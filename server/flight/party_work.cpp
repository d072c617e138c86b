#include "server/flight/party_work.h"

#include <algorithm>
#include <cmath>

#include "server/flight/limits.h"

namespace scree {

void DecayingRate::add(double amount, double now_s) {
  value_ = at(now_s) + amount / limits::flight_average_s;
  at_s_ = now_s;
}

double DecayingRate::at(double now_s) const {
  return value_ * std::exp(-std::max(0.0, now_s - at_s_) / limits::flight_average_s);
}

void PartyCounts::add(const FlightTick& tick, std::span<const FlightCause> causes, const TickDelta& delta,
                      double now_s) {
  for (const FlightCause& cause : causes) {
    Counted& party = parties_[cause.party];
    party.clock_us.add(1e3 * cause.clock_ms, now_s);
    party.price_us.add(1e3 * cause.price_ms, now_s);
    if (cause.request != FlightCause::no_request) party.requests += cause.count;
  }
  for (const AppliedOperation& applied : delta.operations)
    for (const PieceId piece : applied.created) owners_[piece] = applied.party;
  if (tick.tick % limits::flight_piece_ticks == 0) count_pieces(tick, delta, now_s);
}

/// The bodies' step is shared by those whose pieces there are.
void PartyCounts::count_pieces(const FlightTick& tick, const TickDelta& delta, double now_s) {
  std::unordered_map<PieceId, uint64_t> alive;
  for (auto& [party, counted] : parties_) counted.pieces = 0;
  for (const PieceState& piece : delta.pieces) {
    const uint64_t party = party_of(piece.id);
    if (party != 0) alive[piece.id] = party;
    ++parties_[party].pieces;
  }
  owners_ = std::move(alive);
  const size_t at = index_of(TickStage::bodies);
  for (auto& [party, counted] : parties_) {
    if (counted.pieces == 0) continue;
    const double share = static_cast<double>(counted.pieces) / static_cast<double>(delta.pieces.size()) *
                         static_cast<double>(limits::flight_piece_ticks);
    counted.clock_us.add(1e3 * share * tick.stage_ms[at], now_s);
    counted.price_us.add(1e3 * share * tick.model_ms[at], now_s);
  }
  if (parties_.size() > limits::flight_parties_max) forget_least(now_s);
}

void PartyCounts::forget_least(double now_s) {
  std::vector<std::pair<double, uint64_t>> by_work;
  for (const auto& [party, counted] : parties_)
    if (counted.pieces == 0) by_work.emplace_back(counted.clock_us.at(now_s), party);
  std::ranges::sort(by_work);
  for (size_t i = 0; i < by_work.size() && parties_.size() > limits::flight_parties_max; ++i)
    parties_.erase(by_work[i].second);
}

uint64_t PartyCounts::party_of(PieceId piece) const {
  const auto found = owners_.find(piece);
  return found == owners_.end() ? 0 : found->second;
}

std::vector<PartyWork> PartyCounts::all(double now_s) const {
  std::vector<PartyWork> rows;
  for (const auto& [party, counted] : parties_)
    rows.push_back(
        {party, counted.clock_us.at(now_s), counted.price_us.at(now_s), counted.requests, counted.pieces});
  return rows;
}

}  // namespace scree
