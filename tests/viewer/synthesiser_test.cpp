// The synthesiser: rock sounds as rock, near and far; a crowd of sounds is neither cut off nor hiss; and the
// same events make the same samples.
#include "client/viewer/synthesis/synthesiser.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "client/viewer/synthesis/exact_math.h"
#include "content/builtin_palette.h"
#include "tests/support/spectrum.h"

namespace scree {
namespace {

constexpr size_t second_frames = Synthesiser::rate_hz;
constexpr float near_m = 3.0F, far_m = 60.0F;

std::vector<float> samples_of(Synthesiser& synthesiser, size_t frames) {
  std::vector<float> samples(frames * Synthesiser::channels);
  synthesiser.render(samples.data(), frames);
  return samples;
}

std::vector<float> samples_of(const std::vector<SoundEvent>& events, size_t frames) {
  Synthesiser synthesiser;
  for (const SoundEvent& event : events) synthesiser.add(event);
  return samples_of(synthesiser, frames);
}

float peak_of(const std::vector<float>& samples) {
  float most = 0.0F;
  for (const float sample : samples) most = std::max(most, std::abs(sample));
  return most;
}

double energy_of(const std::vector<float>& samples) {
  double sum = 0.0;
  for (const float sample : samples) sum += static_cast<double>(sample) * static_cast<double>(sample);
  return sum;
}

/// What the tests of spectra are about: from a stone to a block, thrown, broken and laid down.
struct NamedBlow {
  const char* name;
  PieceEventKind kind;
  float size_m;
  float speed_m_s;
};
constexpr NamedBlow blows[] = {{"a stone of 0.1 m strikes", PieceEventKind::strike, 0.1F, 3.0F},
                               {"one of 0.5 m strikes", PieceEventKind::strike, 0.5F, 4.0F},
                               {"one of 2 m strikes", PieceEventKind::strike, 2.0F, 5.0F},
                               {"2 m crack off", PieceEventKind::crack, 2.0F, 3.0F},
                               {"1 m settles", PieceEventKind::settle, 1.0F, 0.4F}};
constexpr const char* materials[] = {"rock", "soil", "steel"};

SoundEvent event_of(const NamedBlow& blow, const char* material, float distance_m) {
  const Palette& palette = builtin_palette();
  const MaterialRow& row = palette.row(*palette.named(material));
  const float mass_kg = row.density_kg_m3 * blow.size_m * blow.size_m * blow.size_m;
  return {blow.kind,       blow.size_m,         mass_kg,         mass_kg * blow.speed_m_s,
          row.sound.pitch, row.sound.damping_s, row.sound.noise, distance_m,
          /*side=*/0.0F};
}

Spectrum spectrum_of_blow(const NamedBlow& blow, const char* material, float distance_m) {
  return spectrum_of(samples_of({event_of(blow, material, distance_m)}, second_frames), Synthesiser::rate_hz);
}

TEST(SoundSpectra, five_blows_of_three_materials_are_no_hiss_near_and_far) {
  for (const NamedBlow& blow : blows)
    for (const char* material : materials) {
      const Spectrum close = spectrum_of_blow(blow, material, near_m),
                     far = spectrum_of_blow(blow, material, far_m);
      const std::string what = std::string(blow.name) + ", " + material;
      EXPECT_GT(close.centroid_hz, 100.0) << what;
      EXPECT_LT(close.centroid_hz, 2500.0) << what;
      EXPECT_LT(close.above_3000, 0.2) << what;
      EXPECT_LT(far.above_3000, close.above_3000) << what << ": air takes the high part";
      EXPECT_LT(far.centroid_hz, close.centroid_hz) << what;
      if (blow.size_m >= 0.5F) {
        EXPECT_GT(close.below_300, 1.0 / 3.0) << what;
      }
    }
}

TEST(SoundSpectra, a_blow_of_two_metres_of_rock_is_low) {
  for (const NamedBlow& blow : {blows[2], blows[3]}) {
    const Spectrum spectrum = spectrum_of_blow(blow, "rock", near_m);
    EXPECT_LT(spectrum.centroid_hz, 2000.0) << blow.name;
    EXPECT_GT(spectrum.below_300, 1.0 / 3.0) << blow.name;
  }
}

/// Thorne, 1986: 224 / d^0.9 Hz, of pebbles.
TEST(SoundSpectra, stones_knock_at_the_pitch_that_was_measured_of_pebbles) {
  for (const float size_m : {0.05F, 0.1F, 0.2F}) {
    const double measured_hz = 224.0 / std::pow(static_cast<double>(size_m), 0.9);
    const double centroid_hz =
        spectrum_of_blow({"", PieceEventKind::strike, size_m, 2.0F}, "rock", near_m).centroid_hz;
    EXPECT_GT(centroid_hz, measured_hz / 2.0) << size_m;
    EXPECT_LT(centroid_hz, measured_hz * 2.0) << size_m;
  }
}

TEST(Synthesiser, a_blow_is_within_its_bounds_and_dies_away) {
  Synthesiser synthesiser;
  for (int i = 0; i < 12; ++i) synthesiser.add(event_of(blows[1], "rock", 6.0F));
  const std::vector<float> first = samples_of(synthesiser, second_frames / 2);
  EXPECT_GT(peak_of(first), 0.1F);
  EXPECT_LE(peak_of(first), Synthesiser::peak_max);
  samples_of(synthesiser, 6 * second_frames);
  EXPECT_EQ(synthesiser.voices(), 0U);
  EXPECT_EQ(peak_of(samples_of(synthesiser, second_frames)), 0.0F);
}

TEST(Synthesiser, without_events_there_is_silence) {
  EXPECT_EQ(peak_of(samples_of(std::vector<SoundEvent>{}, second_frames)), 0.0F);
}

TEST(Synthesiser, the_same_events_make_the_same_samples_however_many_at_once) {
  Synthesiser at_once, piecewise;
  for (const NamedBlow& blow : blows)
    for (Synthesiser* one : {&at_once, &piecewise}) one->add(event_of(blow, "rock", 20.0F));
  const std::vector<float> whole = samples_of(at_once, 9600);
  std::vector<float> joined;
  for (const size_t frames : {1U, 127U, 128U, 1000U, 2344U, 6000U}) {
    const std::vector<float> part = samples_of(piecewise, frames);
    joined.insert(joined.end(), part.begin(), part.end());
  }
  EXPECT_EQ(whole, joined);
}

TEST(Synthesiser, pieces_that_land_one_after_another_are_a_rumble_and_no_hiss) {
  Synthesiser synthesiser;
  std::vector<float> all;
  for (int frame = 0; frame < 180; ++frame) {
    NamedBlow blow = blows[1];
    blow.size_m = 0.3F + 0.1F * static_cast<float>(frame % 5);
    SoundEvent event = event_of(blow, "rock", 5.0F + static_cast<float>(frame % 7));
    event.side = static_cast<float>(frame % 3 - 1);
    if (frame < 64) synthesiser.add(event);
    const std::vector<float> part = samples_of(synthesiser, 800);
    all.insert(all.end(), part.begin(), part.end());
    EXPECT_LE(synthesiser.voices(), limits::voices_max);
  }
  EXPECT_LE(peak_of(all), Synthesiser::peak_max);
  const Spectrum spectrum = spectrum_of(all, Synthesiser::rate_hz);
  EXPECT_LT(spectrum.above_3000, 0.2);
  EXPECT_GT(spectrum.below_300, 1.0 / 3.0);
}

TEST(Synthesiser, a_blast_into_64_is_one_sound_of_a_greater_thing) {
  const SoundEvent piece = event_of({"", PieceEventKind::crack, 0.5F, 3.0F}, "rock", 6.0F);
  Synthesiser synthesiser;
  for (int i = 0; i < 64; ++i) synthesiser.add(piece);
  const std::vector<float> blast = samples_of(synthesiser, second_frames);
  EXPECT_EQ(synthesiser.voices(), 1U);
  const Spectrum of_all = spectrum_of(blast, Synthesiser::rate_hz);
  const Spectrum of_one = spectrum_of(samples_of({piece}, second_frames), Synthesiser::rate_hz);
  EXPECT_LT(of_all.centroid_hz, of_one.centroid_hz);
  EXPECT_LT(of_all.above_3000, 0.1);
}

/// Cut-off peaks are flat: samples at the bound, one after the other.
TEST(Synthesiser, what_is_too_loud_is_turned_down_and_not_cut_off) {
  Synthesiser synthesiser;
  std::vector<float> all;
  for (int i = 0; i < 60; ++i) {
    for (const float side : {-1.0F, 0.0F, 1.0F}) {
      SoundEvent event = event_of({"", PieceEventKind::strike, 4.0F, 30.0F}, "steel", 0.5F);
      event.side = side;
      synthesiser.add(event);
    }
    const std::vector<float> part = samples_of(synthesiser, 800);
    all.insert(all.end(), part.begin(), part.end());
  }
  EXPECT_GT(peak_of(all), 0.5F);
  EXPECT_LE(peak_of(all), Synthesiser::peak_max);
  size_t flat = 0;
  for (size_t i = 2; i < all.size(); ++i)
    if (std::abs(all[i]) > 0.999F * Synthesiser::peak_max && all[i] == all[i - 2]) ++flat;
  EXPECT_EQ(flat, 0U);
}

TEST(Synthesiser, no_number_that_is_none_is_heard) {
  SoundEvent odd = event_of(blows[1], "rock", near_m);
  odd.impulse_n_s = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(peak_of(samples_of({odd}, second_frames)), 0.0F);
  odd.impulse_n_s = std::numeric_limits<float>::infinity();
  EXPECT_EQ(peak_of(samples_of({odd}, second_frames)), 0.0F);
  odd = event_of(blows[1], "rock", near_m);
  odd.side = 2.0F;
  EXPECT_EQ(peak_of(samples_of({odd}, second_frames)), 0.0F);
  const SoundEvent huge{PieceEventKind::strike, 1e4F, 1e12F, 1e12F, 0.05F, 5.0F, 0.0F, 0.0F, 0.0F};
  const std::vector<float> samples = samples_of({huge}, second_frames);
  EXPECT_LE(peak_of(samples), Synthesiser::peak_max);
}

TEST(Synthesiser, a_material_rings_as_its_row_says) {
  const auto heard = [](float pitch, float damping_s, float noise) {
    return samples_of({{PieceEventKind::strike, 1.0F, 2600.0F, 4000.0F, pitch, damping_s, noise, 2.0F, 0.0F}},
                      second_frames);
  };
  const auto later = [](const std::vector<float>& samples) {
    return energy_of({samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2), samples.end()});
  };
  EXPECT_GT(later(heard(1.0F, 0.5F, 0.1F)), 16.0 * later(heard(1.0F, 0.05F, 0.1F)));
  EXPECT_NE(heard(1.0F, 0.1F, 0.5F), heard(2.0F, 0.1F, 0.5F));
}

TEST(Synthesiser, far_is_quieter_and_later_and_sides_are_heard) {
  const std::vector<float> close = samples_of({event_of(blows[1], "rock", 3.0F)}, second_frames);
  const std::vector<float> far = samples_of({event_of(blows[1], "rock", 100.0F)}, second_frames);
  EXPECT_GT(energy_of(close), 100.0 * energy_of(far));
  const auto silent_s = [](const std::vector<float>& samples) {
    const auto heard = std::ranges::find_if(samples, [](float sample) { return sample != 0.0F; });
    return static_cast<double>(heard - samples.begin()) / (Synthesiser::channels * second_frames);
  };
  EXPECT_NEAR(silent_s(far), 100.0 / 343.0, 0.01);
  SoundEvent aside = event_of(blows[1], "rock", 5.0F);
  aside.side = 1.0F;
  double left = 0.0, right = 0.0;
  const std::vector<float> samples = samples_of({aside}, second_frames);
  for (size_t i = 0; i < samples.size(); i += 2) {
    left += std::abs(static_cast<double>(samples[i]));
    right += std::abs(static_cast<double>(samples[i + 1]));
  }
  EXPECT_GT(right, 2.0 * left);
}

TEST(ExactMath, is_as_exact_as_it_says) {
  for (float x = -100.0F; x < 100.0F; x += 0.0373F)
    EXPECT_NEAR(exact_exp2(x) / std::exp2(x), 1.0F, 2e-6F) << x;
  for (float x = 1e-20F; x < 1e20F; x *= 1.037F) EXPECT_NEAR(exact_log2(x), std::log2(x), 2e-5F) << x;
  for (float turns = -4.0F; turns < 4.0F; turns += 0.00371F)
    EXPECT_NEAR(exact_sine(turns), std::sin(6.28318531 * static_cast<double>(turns)), 4e-6) << turns;
}

}  // namespace
}  // namespace scree
