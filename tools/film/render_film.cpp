#include "tools/film/render_film.h"

#include <array>
#include <unistd.h>

#include "server/app/ground_giver.h"
#include "shared/base/distinct_files.h"
#include "shared/base/timing.h"
#include "tools/film/film_sound.h"

namespace scree {
namespace {

Result<void> render_frames(const FilmPlan& plan, const FilmOptions& options, RecordedScene& scene,
                           FrameDrawer& drawer, FrameSink& sink, const Stopped& stopped,
                           const std::function<void(double)>& progress) {
  for (size_t frame = 0; frame < plan.span.frames; ++frame) {
    progress(static_cast<double>(frame) / static_cast<double>(plan.span.frames));
    if (stopped()) return fail("stopped");
    const auto changes = TRY(scene.go_to(plan.span.tick(frame)));
    const Camera camera = camera_at(plan.shot, static_cast<double>(frame) / options.order.frames_per_s);
    const auto image = TRY(drawer.draw(scene, changes, camera, stopped));
    TRY(sink.add(image));
  }
  return sink.finish();
}

/// Before the pictures: an encoder wants both at once, and to read the recording twice takes little.
Result<void> make_sound(const FilmPlan& plan, const FilmOptions& options, const GroundGiver& ground,
                        const std::string& file, const Stopped& stopped) {
  auto wave = WaveFile::create(file, Synthesiser::rate_hz, Synthesiser::channels);
  if (!wave) return fail(options.format.file + " cannot be written");
  const auto scene = TRY(RecordedScene::open(options.recording, plan.span.from_tick, ground));
  return write_film_sound(plan, options.order.frames_per_s, *scene, std::move(*wave), stopped);
}

std::string sound_beside(std::string film) {
  while (film.ends_with('/')) film.pop_back();
  return film + "." + std::to_string(::getpid()) + ".sound.partial";
}

}  // namespace

Result<RenderedFilm> render_film(const FilmOptions& options, const Stopped& stopped,
                                 const std::function<void(double)>& progress) {
  Stopwatch stopwatch;
  const std::array files{NamedFile{"the recording", options.recording, false, true},
                         NamedFile{"--ground", options.ground},
                         NamedFile{"--out", options.format.file, true}};
  TRY(check_distinct(files));
  const auto ground = ground_giver(options.recording, options.ground);
  TRY(ground);
  auto plan = TRY(plan_film(options.order, options.recording, *ground));
  const TemporaryFile sound(sound_beside(options.format.file));
  FilmFormat format = options.format;
  if (options.sound) {
    TRY(make_sound(plan, options, *ground, sound.path(), stopped));
    format.sound = sound.path();
  }
  const auto sink = TRY(open_sink(format, stopped));
  const auto scene = TRY(RecordedScene::open(options.recording, plan.span.from_tick, *ground));
  const auto drawer = TRY(FrameDrawer::create(options.drawn, *scene));
  TRY(render_frames(plan, options, *scene, *drawer, *sink, stopped, progress));
  return RenderedFilm{std::move(plan), stopwatch.lap_ms() / 1000.0};
}

}  // namespace scree
