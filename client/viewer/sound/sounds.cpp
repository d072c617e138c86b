#include "client/viewer/sound/sounds.h"

#include <algorithm>

#include "client/viewer/base/limits.h"

namespace scree {

Result<Sounds> Sounds::begin(bool aloud, const std::string& file) {
  Sounds sounds;
  Speaker::silence_library_log();
  sounds.play_aloud(aloud);
  if (!file.empty()) {
    Result<WaveFile> wave = WaveFile::create(file, Synthesiser::rate_hz, Synthesiser::channels);
    if (!wave) return fail("--sound-file: " + wave.error().message);
    sounds.file_ = std::move(*wave);
    sounds.of_file_ = std::make_unique<Synthesiser>();
  }
  return sounds;
}

void Sounds::play_aloud(bool on) {
  if (!on) return speaker_.reset();
  if (speaker_) return;
  // Without a device there is none: nothing else depends on it.
  if (Result<std::unique_ptr<Speaker>> speaker = Speaker::open()) speaker_ = std::move(*speaker);
}

void Sounds::step(const std::vector<PieceEvent>& events, const Camera& camera, double now_s) {
  if (silent()) return;
  std::vector<SoundEvent> sounds;
  for (const PieceEvent& event : events)
    if (is_heard(event.kind)) sounds.push_back(heard(event, camera));
  if (speaker_ && !sounds.empty()) speaker_->play(sounds);
  if (!file_) return;
  write_until(now_s);
  for (const SoundEvent& sound : sounds) of_file_->add(sound);
}

void Sounds::write_until(double now_s) {
  if (!begun_s_) begun_s_ = now_s;
  const auto wanted = static_cast<size_t>(std::max((now_s - *begun_s_) * Synthesiser::rate_hz, 0.0));
  if (wanted <= written_) return;
  std::vector<float> samples(std::min(wanted - written_, limits::sound_step_frames_max) *
                             Synthesiser::channels);
  of_file_->render(samples.data(), samples.size() / Synthesiser::channels);
  file_->append(samples);
  written_ = wanted;
}

Result<void> Sounds::finish() {
  return file_ ? file_->finish() : Result<void>{};
}

}  // namespace scree
