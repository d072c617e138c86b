// Makes the sound of events: each rings in a few modes, as its size and material have them, under a burst of
// noise, as loud as its impulse, from its direction and as late and dull as it is far. Deterministic: the
// same events at the same samples make the same samples. No device. Not thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/viewer/events/piece_event.h"
#include "shared/base/random.h"

namespace scree {

/// Who hears it: `right` is a unit vector.
struct Ears {
  glm::vec3 place_m{0.0F};
  glm::vec3 right{1.0F, 0.0F, 0.0F};
};

class Synthesiser {
 public:
  static constexpr int rate_hz = 44100;
  static constexpr size_t channels = 2;
  /// No sample is beyond it, however much happens at once.
  static constexpr float peak_max = 0.95F;

  /// Sounds from the next sample on, later by its way to the ears. Beyond limits::voices_max, the quietest
  /// voices end.
  void add(const PieceEvent& event, const Ears& ears);
  /// The next `frames` samples of both channels, left and right in turn, −1 to 1. Zeroes while nothing
  /// sounds.
  std::vector<float> render(size_t frames);
  size_t voices() const { return voices_.size(); }

 private:
  static constexpr size_t modes = 3;
  /// A damped oscillation, as a rotation by one sample.
  struct Mode {
    float cosine = 1.0F;  ///< of the step, times the damping
    float sine = 0.0F;
    float x = 0.0F;
    float y = 0.0F;
  };
  struct Voice {
    size_t wait = 0;  ///< samples until it is heard
    std::array<Mode, modes> ringing{};
    float noise = 0.0F;        ///< loudness of the noise now
    float noise_decay = 0.0F;  ///< of it, after a sample
    float grain_share = 1.0F;  ///< part of the samples in which noise bursts: fewer crackle
    float dull = 1.0F;         ///< of a one-pole low pass; 1: none
    float low = 0.0F;          ///< its state
    float left = 0.0F;
    float right = 0.0F;
    Random random{0};
    float loudness() const { return (left + right) * (noise + ringing[0].x * ringing[0].x); }
  };

  static float next_sample(Voice& voice);
  static bool is_over(const Voice& voice);

  std::vector<Voice> voices_;
  uint64_t added_ = 0;  ///< events so far: seeds their noise
};

}  // namespace scree
