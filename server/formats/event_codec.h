// Converts events between plain values and the blobs of a recording. server/formats/recording.proto is the
// specification. Decoders check everything. Pure functions, safe to call from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "proto/event.h"
#include "shared/base/result.h"

namespace scree {

namespace limits {
/// Events of one row of a recording: more than a tick's operations, or a second's sessions. Above: a writer
/// leaves the rest out, a reader refuses the row.
inline constexpr size_t events_per_row_max = 4096;

/// Length of an event's text, bytes: a name, or a setting. An encoder cuts a longer one.
inline constexpr size_t event_text_bytes_max = 256;

/// Ticks of one row of durations: a second at the highest tick rate.
inline constexpr size_t ticks_per_row_max = 1000;

/// Entries of persons' cursors in one row: 64 persons who all move, ten times a second, take a sixth. Above:
/// a writer leaves the row's later ones out, a reader refuses the row.
inline constexpr size_t cursors_per_row_max = 4096;

/// Persons of one row, where a part of a recording begins: as many as a server has places. Above: a writer
/// leaves the rest out, a reader refuses the row.
inline constexpr size_t persons_per_row_max = 4096;
}  // namespace limits

/// The world events of one tick.
std::vector<uint8_t> encode(std::span<const Event> events);
Result<std::vector<Event>> decode_recorded_events(std::span<const uint8_t> bytes, Tick tick);

std::vector<uint8_t> encode(const RecordedMachine& machine);
Result<RecordedMachine> decode_recorded_machine(std::span<const uint8_t> bytes);

}  // namespace scree
