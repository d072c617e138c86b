// File descriptors of this process: every connection holds one.
#pragma once

#include <cstddef>

namespace scree {

/// Raises the process's limit to at least `wanted`, as far as it may; returns the limit that holds now.
size_t raise_descriptors(size_t wanted);

}  // namespace scree
