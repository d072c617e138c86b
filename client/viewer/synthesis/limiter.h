// A limiter that sees ahead: it turns the sound down before a peak comes, so that no sample is cut off.
// Stereo. No library, no heap.
//
// The gain is the least that any sample within the window wants, which comes back slowly after a peak, and is
// then the mean over a window: it falls in time for each peak, and never jumps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace scree {

class Limiter {
 public:
  /// Samples of the window: 5 ms at 48 kHz. The sound comes out later by so many less one.
  static constexpr size_t window = 240;
  /// No sample is beyond it.
  static constexpr float peak_max = 0.9F;

  Limiter() { gains_.fill(1.0F); }

  /// In place: left and right in turn.
  void limit(float* samples, size_t frames);

 private:
  struct Wanted {
    float gain = 1.0F;
    uint64_t at = 0;  ///< number of the sample
  };

  float least_with(float gain);
  float mean_with(float gain);

  std::array<float, 2 * window> waiting_{};
  std::array<float, window> gains_{};  ///< of the last samples
  float sum_ = window;                 ///< of these
  /// Those that count, the least first, in a ring: after a smaller one, an earlier one does not.
  std::array<Wanted, window> wanted_{};
  size_t first_ = 0, count_ = 0;
  uint64_t now_ = 0;  ///< samples so far
  float released_ = 1.0F;
};

}  // namespace scree
