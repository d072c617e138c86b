// Bytes that this thread holds on the heap, counted by an operator new that only scree-bench has.
#pragma once

#include <cstddef>

namespace scree {

/// Bytes held now.
size_t heap_bytes();
/// Most bytes held since the last reset.
size_t heap_peak_bytes();
void reset_heap_peak();

}  // namespace scree
