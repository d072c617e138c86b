// Ledgers as dictionaries.
#pragma once

#include <pybind11/pybind11.h>

#include "shared/operation/ledger.h"

namespace scree::python {

/// By place: terrain, pieces, dust, poured, moved, stored, and the error, which is 0. Units of 1/254 voxel.
pybind11::dict dict_of(const Ledger& ledger);

}  // namespace scree::python
