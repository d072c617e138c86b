#include "tools/film/film_sound.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "client/viewer/synthesis/hearing.h"

namespace scree {
namespace {

/// A film's samples, from its first on.
class SoundTrack {
 public:
  explicit SoundTrack(WaveFile file)
      : file_(std::move(file)), synthesiser_(std::make_unique<Synthesiser>()) {}

  void render_to(double time_s) {
    const auto end = static_cast<size_t>(std::llround(time_s * Synthesiser::rate_hz));
    if (end <= rendered_) return;
    samples_.resize((end - rendered_) * Synthesiser::channels);
    synthesiser_->render(samples_.data(), end - rendered_);
    file_.append(samples_);
    rendered_ = end;
  }
  void add(const SoundEvent& event) { synthesiser_->add(event); }
  Result<void> finish() { return file_.finish(); }

 private:
  WaveFile file_;
  std::unique_ptr<Synthesiser> synthesiser_;
  std::vector<float> samples_;
  size_t rendered_ = 0;  ///< frames
};

}  // namespace

TemporaryFile::~TemporaryFile() {
  std::error_code gone;
  std::filesystem::remove(path_, gone);
}

Result<void> write_film_sound(const FilmPlan& plan, double frames_per_s, RecordedScene& scene, WaveFile file,
                              const Stopped& stopped) {
  SoundTrack track(std::move(file));
  for (size_t frame = 0; frame < plan.span.frames; ++frame) {
    if (stopped()) return fail("stopped");
    TRY(scene.go_to(plan.span.tick(frame)));
    for (const TickEvents& tick : scene.events()) {
      const double time_s = (tick.tick - plan.span.from_tick) / plan.span.ticks_per_frame / frames_per_s;
      if (time_s < 0.0) continue;
      track.render_to(time_s);
      const Camera camera = camera_at(plan.shot, time_s);
      for (const PieceEvent& event : tick.events)
        if (is_heard(event.kind)) track.add(heard(event, camera));
    }
  }
  track.render_to(static_cast<double>(plan.span.frames) / frames_per_s);
  return track.finish();
}

}  // namespace scree
