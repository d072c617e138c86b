#include "client/viewer/viewer_program.h"

#include <variant>

#include "client/viewer/app.h"
#include "client/viewer/viewing/options.h"
#include "shared/base/program_output.h"

namespace scree {

int viewer_program(int argc, char** argv) {
  fail_at_file_limit();
  const auto parsed = parse_options(argc, argv);
  if (const auto* exit_now = std::get_if<ExitNow>(&parsed)) return exit_now->status;
  const auto& options = std::get<ViewerOptions>(parsed);
  return options.offscreen ? run_offscreen(options) : run_window(options);
}

}  // namespace scree
