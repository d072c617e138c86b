// Rows of structured arrays, as Python sees them (python/scree.pyi). Plain values without gaps that mean
// anything.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "proto/event.h"
#include "shared/operation/ledger.h"

namespace scree {
struct BodyFacts;
}

namespace scree::python {

/// A body, between ticks.
struct BodyTableRow {
  uint32_t id;
  bool is_piece, kept, awake;
  std::array<float, 3> position_m;
  std::array<float, 4> rotation;  ///< w, x, y, z
  std::array<float, 3> velocity_m_s, spin_rad_s;
  float mass_kg, reach_m;
  int64_t mass_units;  ///< of a piece; of a prop 0
  uint64_t tag;        ///< of a prop; of a piece 0
};
BodyTableRow row_of_body(const BodyFacts& facts);

/// Where the mass is after a tick, in units of 1/254 voxel.
struct LedgerRow {
  uint64_t tick;
  int64_t terrain, pieces, dust, poured, moved, stored, error;
};
LedgerRow row_of_ledger(uint64_t tick, const Ledger& ledger);

inline constexpr size_t event_kind_length = 16, event_text_length = 64;

/// An event; what it has not is 0, or NaN of its place. Texts are UCS-4, filled up with zeros.
struct EventTableRow {
  uint64_t tick;
  std::array<uint32_t, event_kind_length> kind;
  std::array<float, 3> place_m;
  float volume_m3;
  uint32_t pieces;
  uint64_t session;
  uint32_t body, other;
  float impulse_n_s, energy_j;
  std::array<uint32_t, event_text_length> text;
};
std::vector<EventTableRow> rows_of_events(std::span<const Event> events);

}  // namespace scree::python
