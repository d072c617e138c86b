// Converts cursors of persons between values and the packed bytes of a recording (recording.proto,
// Machine.cursors). Internal to proto/.
#pragma once

#include <span>

#include "proto/wire_values.h"

namespace scree {

/// Samples of a row's ticks, ascending; `first`: the first of these ticks. Leaves out samples beyond
/// limits::cursors_per_row_max, and cuts names.
std::vector<uint8_t> pack(std::span<const CursorSample> samples, Tick first);

/// Samples of the ticks first … last, ascending.
std::vector<CursorSample> unpack_cursors(const std::string& packed, Tick first, Tick last,
                                         FieldChecker& check);

}  // namespace scree
