// One sound: what is heard of an event, in four layers.
//
// - Thud: the body is pushed, and pushes the air. Two damped oscillations, by the time of contact.
// - Ring: the body's own modes, by size and material.
// - Crack: a burst of noise in a band, by size.
// - Rattle: grains of rubble that knock at each other, fewer and fewer.
//
// Each layer has a share of the sound's energy. No library, no heap. Time goes by samples.
#pragma once

#include <array>
#include <cstddef>

#include "client/viewer/synthesis/sound_event.h"
#include "shared/base/random.h"

namespace scree {

inline constexpr int sound_rate_hz = 48000;

/// Several events as one; of the loudest one, unless a member says otherwise.
struct Blow {
  SoundEvent event;        ///< its impulse and mass are the sums
  float energy_j = 0.0F;   ///< the sum
  float volume_m3 = 1.0F;  ///< the sum
  int members = 1;
};

/// A damped oscillation, as a rotation by one sample.
struct Mode {
  float cosine = 0.0F;  ///< of the step, times the damping
  float sine = 0.0F;
  float x = 0.0F;
  float y = 0.0F;

  float next() {
    const float turned = x * cosine - y * sine;
    y = x * sine + y * cosine;
    x = turned;
    return y;
  }
  float size() const { return (x < 0.0F ? -x : x) + (y < 0.0F ? -y : y); }
};

class Voice {
 public:
  Voice() = default;
  Voice(const Blow& blow, uint64_t seed);

  /// Adds the next samples to `samples`, left and right in turn.
  void add_to(float* samples, size_t frames);
  bool is_over() const { return over_; }
  /// How loud it is now, about.
  float loudness() const;

 private:
  static constexpr size_t thud_modes = 2, ring_modes = 4;

  void set_thud(float share, float contact_s);
  void set_ring(float share, const SoundEvent& event, float size_m, float contact_s);
  void set_crack(float share, float band_hz, float seconds);
  void set_rattle(float share, const Blow& blow, float size_m, float seconds);
  void knock();
  float next();
  void look();

  std::array<Mode, thud_modes + ring_modes> modes_{};
  size_t first_mode_ = 0;  ///< those before it are over
  size_t wait_ = 0;        ///< samples until it is heard
  size_t age_ = 0;         ///< samples since then
  bool over_ = true;

  // The noise, through a filter of second order (a state-variable filter by trapezoids: Zavalishin, The Art
  // of VA Filter Design, 2012, section 4).
  float noise_ = 0.0F;
  float noise_decay_ = 0.0F;
  float band_ = 0.0F;  ///< tangent of half the turn that a sample is at the middle of the band
  float band_low_ = 0.0F, band_mid_ = 0.0F;

  // The rattle.
  std::array<Mode, 2> grains_{};
  size_t next_grain_ = 0;
  float chance_ = 0.0F;        ///< of a knock, a sample
  float knock_ = 0.0F;         ///< how hard they are now
  float rattle_decay_ = 0.0F;  ///< of both
  float grain_m_ = 0.0F;       ///< their mean size
  float grain_pitch_ = 1.0F;
  float grain_damping_ = 1.0F;  ///< turns in which a grain's ringing falls to 1/e

  float air_ = 1.0F;  ///< of a one-pole low pass; 1: none
  float aired_ = 0.0F;
  float left_ = 0.0F, right_ = 0.0F;
  Random random_{0};
};

}  // namespace scree
