// scree-render: makes a film of a recording. Exit status: 0 made, 1 not, 2 wrong usage.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "shared/base/program_output.h"
#include "shared/base/progress_bar.h"
#include "tools/film/render_film.h"
#include "tools/film/stop_signals.h"

namespace scree {
namespace {

constexpr int failed = 1;

/// What was made, as one line.
std::string line_of(const FilmOptions& options, const RenderedFilm& film) {
  const FilmSpan& span = film.plan.span;
  const auto frames = static_cast<double>(span.frames);
  nlohmann::ordered_json line{{"file", options.format.file},
                              {"frames", span.frames},
                              {"seconds", frames / options.order.frames_per_s},
                              {"from_tick", span.from_tick},
                              {"to_tick", span.tick(span.frames - 1)}};
  if (const auto& event = film.plan.event)
    line["event"] = {
        {"kind", std::string(name_of(event->kind))}, {"tick", event->tick}, {"volume_m3", event->volume_m3}};
  line["frames_per_s"] = frames / film.seconds;
  return line.dump();
}

int run(int argc, char** argv) {
  StopSignals signals;
  const auto parsed = parse_film_options(argc, argv);
  if (const int* ended = std::get_if<int>(&parsed)) return *ended;
  const auto& options = std::get<FilmOptions>(parsed);
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  const auto film = render_film(
      options, [&] { return signals.asked(); }, [&](double part) { bar.show(part); });
  bar.end();
  if (film) {
    std::printf("%s\n", line_of(options, *film).c_str());
    const auto printed = flush_output();
    if (!printed) std::fprintf(stderr, "scree-render: %s\n", printed.error().message.c_str());
    return printed ? 0 : failed;
  }
  const std::string why = signals.asked() ? "stopped: the film is not complete; only complete PNGs are kept"
                                          : film.error().message;
  std::fprintf(stderr, "scree-render: %s\n", why.c_str());
  return failed;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  return scree::run(argc, argv);
}
