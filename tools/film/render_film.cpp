#include "tools/film/render_film.h"

#include <array>

#include "server/app/ground_giver.h"
#include "shared/base/distinct_files.h"
#include "shared/base/timing.h"
#include "tools/film/recorded_scene.h"

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
  const auto sink = TRY(open_sink(options.format, stopped));
  const auto scene = TRY(RecordedScene::open(options.recording, plan.span.from_tick, *ground));
  const auto drawer = TRY(FrameDrawer::create(options.drawn, *scene));
  TRY(render_frames(plan, options, *scene, *drawer, *sink, stopped, progress));
  return RenderedFilm{std::move(plan), stopwatch.lap_ms() / 1000.0};
}

}  // namespace scree
