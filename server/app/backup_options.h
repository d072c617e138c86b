// The options of scree-server by which it makes backups of its world (backups.h).
#pragma once

#include "server/app/backups.h"

namespace CLI {
class App;
}

namespace scree {

/// `plan` outlives the parsing.
void declare_backups(CLI::App& app, BackupPlan& plan);

}  // namespace scree
