// scree-admin console: reads subcommands from standard input, a line each, and runs them one after the other.
#pragma once

#include "client/admin/programs/admin_app.h"

namespace scree {

/// Until the input ends, or a line says so. On a terminal with a prompt, history and completion; returns 0
/// then. Else as a script is read: returns 1 when a line failed. `settings` hold for lines that say nothing
/// else.
int run_console(const AdminServer& server, const AdminSettings& settings);

}  // namespace scree
