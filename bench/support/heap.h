// What this thread holds on the heap. Counted by the program's own operator new, in scree-bench alone.
#pragma once

#include <cstddef>

namespace scree {

/// Bytes held now.
size_t heap_bytes();
/// Most bytes held since the last reset.
size_t heap_peak_bytes();
void reset_heap_peak();

}  // namespace scree
