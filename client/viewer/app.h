// The viewer's two ways to run. Each returns the program's exit status and says what went wrong on stderr.
#pragma once

#include "client/viewer/options.h"

namespace scree {

/// A window, until the person ends it.
int run_window(const ViewerOptions& options);

/// No window: takes the screenshots as their moments come, then ends. 1 at the timeout.
int run_offscreen(const ViewerOptions& options);

}  // namespace scree
