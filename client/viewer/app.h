// The viewer's two modes. Each returns the program's exit status and prints errors to stderr.
#pragma once

#include "client/viewer/viewing/options.h"

namespace scree {

/// Shows a window until the person closes it.
int run_window(const ViewerOptions& options);

/// Without a window: takes the ordered screenshots, flies along the path, then ends. 1 at the timeout,
/// 3 when the screenshot differs from its reference.
int run_offscreen(const ViewerOptions& options);

}  // namespace scree
