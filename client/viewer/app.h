// The viewer's two ways to run. Each returns the program's exit status and says what went wrong on stderr.
#pragma once

#include "client/viewer/viewing/options.h"

namespace scree {

/// A window, until the person ends it.
int run_window(const ViewerOptions& options);

/// No window: takes the screenshots as their moments come, flies along the path, then ends. 1 at the timeout,
/// 3 when the screenshot differs from its reference.
int run_offscreen(const ViewerOptions& options);

}  // namespace scree
