#include "studies/programs/run_study.h"

#include <cstdio>
#include <filesystem>
#include <system_error>
#include <unistd.h>

#include "bench/programs/exit_codes.h"
#include "bench/programs/print_result.h"
#include "shared/base/option_check.h"
#include "shared/base/progress_bar.h"

namespace scree {

int run_study(const Study& study, const StudyRun& run) {
  // Asked before minutes of measuring.
  std::error_code failure;
  std::filesystem::create_directories(run.folder, failure);
  if (const std::string no = check_writable(run.folder + "/" + study.name + ".md"); !no.empty()) {
    std::fprintf(stderr, "scree-studies: %s: %s\n", study.name.c_str(), no.c_str());
    return exit_not_done;
  }
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  const Result<StudyResult> found =
      study.run({.quick = run.quick, .folder = run.folder, .progress = [&](double part) { bar.show(part); }});
  bar.end();
  const auto give_up = [&](const Error& error) {
    std::fprintf(stderr, "scree-studies: %s: %s\n", study.name.c_str(), error.message.c_str());
    return exit_not_done;
  };
  if (!found) return give_up(found.error());
  if (const Result<void> written = write_report(found->report, run.folder); !written)
    return give_up(written.error());
  StoredResult result = summarised(ResultKind::study, study.name, {&found->figures, 1});
  if (run.quick) result.options["quick"] = "yes";
  result.machine = this_machine();
  print_result(study.summary, found->figures, result);
  std::printf("report: %s/%s.md and .html\n", run.folder.c_str(), found->report.name.c_str());
  if (!run.json_file.empty() && !write_stored(result, run.json_file)) return exit_not_done;
  return run.strict && result.missed() > 0 ? exit_worse : exit_done;
}

}  // namespace scree
