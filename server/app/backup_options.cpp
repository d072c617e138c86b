#include "server/app/backup_options.h"

#include <CLI/CLI.hpp>

#include "server/app/limits.h"
#include "shared/base/length_of_time.h"
#include "shared/base/option_check.h"

namespace scree {

void declare_backups(CLI::App& app, BackupPlan& plan) {
  const auto parse_every = [&plan](const std::string& text) {
    const auto seconds = seconds_of(text, limits::backup_every_min_s, limits::backup_every_max_s);
    if (!seconds) throw CLI::ValidationError("--backup-every", seconds.error().message);
    plan.every_s = *seconds;
  };
  CLI::Option* const every =
      app.add_option_function<std::string>(
             "--backup-every", parse_every,
             "makes a checked copy of the --world so often, such as 30m, 1h or 1d; the first at once")
          ->needs(app.get_option("--world"));
  bounded(app.add_option("--backup-keep", plan.keep, "the newest so many backups stay, older ones go"),
          whole_within(1, limits::backup_keep_max))
      ->capture_default_str()
      ->needs(every);
  app.add_option("--backup-dir", plan.folder,
                 "folder of the backups; default: FILE.backups, beside the world")
      ->needs(every);
}

}  // namespace scree
