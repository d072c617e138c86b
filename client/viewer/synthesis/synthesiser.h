// Makes the sound of events (voice.h): those of one moment that are near each other are one greater sound,
// and a limiter keeps all of them within bounds. Deterministic, to the bit on every machine: the same events
// between the same samples make the same samples. Knows no device, no library and no heap, so that it is
// sound.wasm, too. Not thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "client/viewer/synthesis/limiter.h"
#include "client/viewer/synthesis/limits.h"
#include "client/viewer/synthesis/sound_event.h"
#include "client/viewer/synthesis/voice.h"

namespace scree {

class Synthesiser {
 public:
  static constexpr int rate_hz = sound_rate_hz;
  static constexpr size_t channels = 2;
  /// No sample is beyond it, however much happens at once.
  static constexpr float peak_max = Limiter::peak_max;

  /// Sounds from the next sample on, later by its way to the ears. An event with a number that no piece and
  /// no palette has is ignored.
  void add(const SoundEvent& event);
  /// The next samples, left and right in turn, −1 to 1. Zeroes while nothing sounds.
  void render(float* samples, size_t frames);
  /// How many sound.
  size_t voices() const;

 private:
  void begin_waiting();
  void begin(const Blow& blow);

  std::array<SoundEvent, limits::sound_events_max> waiting_{};
  size_t waiting_count_ = 0;
  std::array<Voice, limits::voices_max> voices_{};
  Limiter limiter_;
  uint64_t begun_ = 0;  ///< sounds so far: seeds their noise
};

}  // namespace scree
