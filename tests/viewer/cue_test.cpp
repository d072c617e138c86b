// A game's cues: what is heard and what is seen of them.
#include <algorithm>
#include <gtest/gtest.h>

#include "client/viewer/events/cue_event.h"
#include "client/viewer/events/dust.h"
#include "client/viewer/synthesis/hearing.h"
#include "client/viewer/synthesis/synthesiser.h"
#include "client/viewer/viewing/shake.h"
#include "content/builtin_palette.h"
#include "shared/game/notice.h"
#include "tests/support/spectrum.h"

namespace scree {
namespace {

Cue cue_of(CueKind kind, float size_m = 1.0F, float energy_j = 1000.0F, const char* material = "rock") {
  return {kind, {0.0F, 0.0F, -4.0F}, size_m, energy_j, *builtin_palette().named(material)};
}

std::vector<float> samples_of(const Cue& cue) {
  Synthesiser synthesiser;
  synthesiser.add(heard(event_of(cue, builtin_palette()), Camera{}));
  std::vector<float> samples(static_cast<size_t>(Synthesiser::rate_hz) * Synthesiser::channels);
  synthesiser.render(samples.data(), samples.size() / Synthesiser::channels);
  return samples;
}

double loudness_of(const Cue& cue) {
  double sum = 0.0;
  for (const float sample : samples_of(cue)) sum += static_cast<double>(sample) * static_cast<double>(sample);
  return sum;
}

Spectrum spectrum_of_cue(const Cue& cue) {
  return spectrum_of(samples_of(cue), Synthesiser::rate_hz);
}

std::vector<Particle> particles_of(const Cue& cue) {
  Dust dust;
  dust.add({event_of(cue, builtin_palette())}, 5.0);
  return dust.at(5.2, {});
}

TEST(Cues, of_digs_places_and_fills_are_heard_and_seen_for_no_piece_tells_of_them) {
  const Shape ball = sphere({0.0F, 1.0F, -4.0F}, 1.5F);
  for (const Operation& edit :
       {Operation(DigOperation{ball}), Operation(PlaceOperation{ball, material::soil}),
        Operation(FillOperation{ball})}) {
    std::vector<Cue> cues;
    add_cues_of(edit, cues);
    ASSERT_EQ(cues.size(), 2U);
    EXPECT_GT(loudness_of(cues[0]), 0.1);
    EXPECT_GT(particles_of(cues[1]).size(), 3U);
    EXPECT_EQ(cues[0].place_m, ball.a);
  }
  std::vector<Cue> none;
  add_cues_of(CarveOperation{ball, SeedPattern::uniform, 1, 5, {}, 1}, none);
  add_cues_of(DigOperation{.shape = {}, .piece = 7}, none);
  EXPECT_TRUE(none.empty());
}

TEST(Cues, sounds_are_heard_alone_and_puffs_are_seen_alone) {
  for (const CueKind kind : all_kinds<CueKind>) {
    const bool sounds = row_of(kind).sounds;
    EXPECT_EQ(loudness_of(cue_of(kind)) > 0.0, sounds) << name_of(kind);
    EXPECT_EQ(particles_of(cue_of(kind)).empty(), sounds) << name_of(kind);
  }
}

TEST(Cues, a_thud_is_dull_and_a_ring_of_steel_is_bright) {
  const Spectrum thud = spectrum_of_cue(cue_of(CueKind::thud)),
                 crack = spectrum_of_cue(cue_of(CueKind::crack)),
                 ring = spectrum_of_cue(cue_of(CueKind::ring, 0.2F, 1000.0F, "steel")),
                 rattle = spectrum_of_cue(cue_of(CueKind::rattle));
  EXPECT_LT(thud.centroid_hz, 500.0);
  EXPECT_LT(thud.centroid_hz, crack.centroid_hz);
  EXPECT_LT(crack.centroid_hz, ring.centroid_hz);
  EXPECT_LT(thud.centroid_hz, rattle.centroid_hz);
  EXPECT_LT(ring.above_3000, 0.9);
}

TEST(Cues, more_energy_is_louder_and_raises_more) {
  for (const CueKind kind : {CueKind::thud, CueKind::crack, CueKind::ring, CueKind::rattle})
    EXPECT_GT(loudness_of(cue_of(kind, 1.0F, 5000.0F)), loudness_of(cue_of(kind, 1.0F, 50.0F)))
        << name_of(kind);
  for (const CueKind kind : {CueKind::dust, CueKind::sparks})
    EXPECT_GT(particles_of(cue_of(kind, 1.0F, 5000.0F)).size(),
              particles_of(cue_of(kind, 1.0F, 50.0F)).size())
        << name_of(kind);
}

TEST(Cues, the_bounds_of_a_cue_can_be_heard_and_seen) {
  for (const CueKind kind : all_kinds<CueKind>)
    for (const float size_m : {1e-20F, limits::cue_size_max_m})
      for (const float energy_j : {1e-20F, limits::cue_energy_max_j})
        for (const uint8_t material : {uint8_t{0}, uint8_t{63}}) {
          const Cue cue{kind, {1.0F, 2.0F, 3.0F}, size_m, energy_j, static_cast<Material>(material)};
          for (const float sample : samples_of(cue)) ASSERT_LE(std::abs(sample), Synthesiser::peak_max);
          EXPECT_LT(particles_of(cue).size(), 400U);
        }
}

TEST(Cues, shake_nothing) {
  Shake shake;
  const std::vector<PieceEvent> events{event_of(cue_of(CueKind::thud, 4.0F, 1e9F), builtin_palette())};
  shake.add(events, {}, 1.0);
  EXPECT_EQ(shake.strength(1.0), 0.0F);
}

}  // namespace
}  // namespace scree
