#include <variant>

#include "client/viewer/app.h"
#include "client/viewer/viewing/options.h"
#include "shared/base/program_output.h"

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  const auto parsed = scree::parse_options(argc, argv);
  if (const auto* exit_now = std::get_if<scree::ExitNow>(&parsed)) return exit_now->status;
  const auto& options = std::get<scree::ViewerOptions>(parsed);
  return options.offscreen ? scree::run_offscreen(options) : scree::run_window(options);
}
