// scree-bot: carves by script and reports as JSON.
#pragma once

namespace scree {

/// All of main(), which compiles in no time without it. Returns the exit status: 0 fine, 1 failed, 2 wrong
/// usage, 3 every carve was refused.
int bot_program(int argc, char** argv);

}  // namespace scree
