// scree-viewer: in a window, or offscreen.
#pragma once

namespace scree {

/// All of main(), which compiles in no time without it. Returns the exit status.
int viewer_program(int argc, char** argv);

}  // namespace scree
