#include "tools/film/render_film.h"

#include <array>

#include "server/app/distinct_files.h"
#include "server/app/ground_giver.h"
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
    const auto changes = scene.go_to(plan.span.tick(frame));
    if (!changes) return tl::unexpected(changes.error());
    const Camera camera = camera_at(plan.shot, static_cast<double>(frame) / options.order.frames_per_s);
    const auto image = drawer.draw(scene, *changes, camera, stopped);
    if (!image) return tl::unexpected(image.error());
    if (auto added = sink.add(*image); !added) return added;
  }
  return sink.finish();
}

}  // namespace

Result<RenderedFilm> render_film(const FilmOptions& options, const Stopped& stopped,
                                 const std::function<void(double)>& progress) {
  Stopwatch watch;
  const std::array files{NamedFile{"the recording", options.recording, false, true},
                         NamedFile{"--ground", options.ground},
                         NamedFile{"--out", options.format.file, true}};
  if (auto distinct = check_distinct(files); !distinct) return tl::unexpected(distinct.error());
  const auto ground = ground_giver(options.recording, options.ground);
  if (!ground) return tl::unexpected(ground.error());
  auto plan = plan_film(options.order, options.recording, *ground);
  if (!plan) return tl::unexpected(plan.error());
  const auto sink = open_sink(options.format, stopped);
  if (!sink) return tl::unexpected(sink.error());
  const auto scene = RecordedScene::open(options.recording, plan->span.from_tick, *ground);
  if (!scene) return tl::unexpected(scene.error());
  const auto drawer = FrameDrawer::create(options.drawn, (*scene)->field().source());
  if (!drawer) return tl::unexpected(drawer.error());
  if (auto rendered = render_frames(*plan, options, **scene, **drawer, **sink, stopped, progress); !rendered)
    return tl::unexpected(rendered.error());
  return RenderedFilm{std::move(*plan), watch.lap_ms() / 1000.0};
}

}  // namespace scree
