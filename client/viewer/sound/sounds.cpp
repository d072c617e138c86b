#include "client/viewer/sound/sounds.h"

#include "client/viewer/base/limits.h"

namespace scree {

Result<Sounds> Sounds::begin(bool aloud, const std::string& file) {
  Sounds sounds;
  if (aloud) {
    // Without a device there is none: nothing else depends on it.
    if (Result<std::unique_ptr<Speaker>> speaker = Speaker::open()) sounds.speaker_ = std::move(*speaker);
  }
  if (!file.empty()) {
    Result<WaveFile> wave = WaveFile::create(file, Synthesiser::rate_hz, Synthesiser::channels);
    if (!wave) return fail("--sound-file: " + wave.error().message);
    sounds.file_ = std::move(*wave);
  }
  return sounds;
}

void Sounds::step(std::vector<PieceEvent> events, const Camera& camera, double now_s) {
  if (silent()) return;
  if (events.size() > limits::sounds_per_step_max) events.resize(limits::sounds_per_step_max);
  const Ears ears{camera.eye_m, camera.right()};
  if (speaker_ && !events.empty()) speaker_->play(events, ears);
  if (!file_) return;
  if (!begun_s_) begun_s_ = now_s;
  const double frames = (now_s - *begun_s_) * Synthesiser::rate_hz;
  const auto wanted = static_cast<size_t>(std::max(frames, 0.0));
  if (wanted > written_)
    file_->append(of_file_.render(std::min(wanted - written_, limits::sound_step_frames_max)));
  written_ = std::max(written_, wanted);
  for (const PieceEvent& event : events) of_file_.add(event, ears);
}

Result<void> Sounds::finish() {
  return file_ ? file_->finish() : Result<void>{};
}

}  // namespace scree
