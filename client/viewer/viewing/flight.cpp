#include "client/viewer/viewing/flight.h"

#include "client/viewer/pictures/png.h"
#include "shared/base/timing.h"

namespace scree {

bool Flight::over(const ViewerOptions& options) const {
  return static_cast<double>(frame_) > path_.duration_s() * options.frames_per_s;
}

Result<bool> Flight::turn(Viewing& viewing, double now_s) {
  const ViewerOptions& options = viewing.options;
  viewing.camera = path_.at(static_cast<double>(frame_) / options.frames_per_s);
  Stopwatch stopwatch;
  if (Result<void> stepped = viewing.step(now_s); !stepped) return fail(stepped.error().message);
  FrameTime time;
  time.update_ms = stopwatch.lap_ms();
  if (options.time_demo) {
    const Result<void> drawn = viewing.view->renderer().draw_unseen(
        *viewing.view->methods().shown(), viewing.camera, options.width, options.height);
    if (!drawn) return fail(drawn.error().message);
    time.draw_ms = stopwatch.lap_ms();
    time.frame_ms = time.update_ms + time.draw_ms;
    times_.push_back(time);
  } else if (!viewing.view->methods().loaded()) {
    return false;
  }
  if (!options.frames.empty()) {
    const Result<Image> image = viewing.picture(now_s);
    if (!image) return fail(image.error().message);
    if (Result<void> written = write_frame(options.frames, frame_, *image); !written)
      return fail(written.error().message);
  }
  ++frame_;
  return true;
}

std::string Flight::times(const Viewing& viewing) const {
  const ViewerOptions& options = viewing.options;
  return to_json({.path = options.path_file,
                  .method = std::string(options.method->name),
                  .driver = viewing.view->renderer().description(),
                  .width = options.width,
                  .height = options.height,
                  .frames = times_});
}

}  // namespace scree
