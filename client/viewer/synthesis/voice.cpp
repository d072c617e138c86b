#include "client/viewer/synthesis/voice.h"

#include <algorithm>
#include <cmath>

#include "client/viewer/synthesis/exact_math.h"
#include "client/viewer/synthesis/limits.h"

namespace scree {
namespace {

constexpr float rate = static_cast<float>(sound_rate_hz);
constexpr float air_m_s = 343.0F;  ///< the speed of sound
constexpr float travel_s_max = 2.0F;
constexpr float silence = 3e-5F;  ///< −90 dB

/// The frequency of the lowest mode of a cube of 1 m of rock, whose pitch is 1.
constexpr float rock_pitch_hz = 190.0F;
/// The speed of sound in a bar of rock, by which pitches are (content/materials.toml).
constexpr float rock_m_s = 4400.0F;
/// Pitches of the modes of a block, by its lowest: a block is no string.
constexpr std::array overtones{1.0F, 1.83F, 2.71F, 3.62F};

/// Energy and distance at which a sound has the full level: about that of a block of 2 m, a few steps away.
/// At most it has twice that.
constexpr float loud_j = 1.0e5F;
constexpr float loud_m = 3.0F;
constexpr float level_max = 2.0F;
/// The energy of a sound of the full level, whose unit is a full amplitude for a second: so that a stone of
/// 0.5 m has a peak of 0.7 at that distance, and only greater ones need the limiter.
constexpr float level_energy = 0.006F;
/// Nearer is no louder, metres.
constexpr float near_m = 1.5F;

/// Bounds of what is computed with: a pebble, and a block whose modes are still heard; speeds of what flies.
constexpr float heard_min_m = 0.03F, heard_max_m = 8.0F;
constexpr float heard_min_m_s = 0.1F, heard_max_m_s = 100.0F;
/// The lowest pitch of a thud, which headphones give and small speakers hint at; and the highest.
constexpr float thud_min_hz = 42.0F, thud_max_hz = 2500.0F;
/// The middle of the noise of a crack of 1 m of rock; by ear. It grows with the roots of pitch and 1 / size.
constexpr float crack_hz = 650.0F, crack_min_hz = 60.0F, crack_max_hz = 3000.0F;
/// Grains of rubble, as a share of the piece's size; and their knocks a second at first, of one piece; by
/// ear.
constexpr float grain_share = 0.06F, grain_min_m = 0.012F, grain_max_m = 0.12F;
constexpr float knocks_a_second = 90.0F;
/// More pieces make no more knocks than so many.
constexpr int members_max = 16;

/// How a kind of event sounds: the shares of the layers are of the whole, ring by what the material leaves.
struct Manner {
  float loudness;
  float thud, ring, crack, rattle;
  float crack_s;   ///< until its noise has a third of its amplitude, of 1 m
  float rattle_s;  ///< the same of the number of knocks
};

constexpr Manner manner_of(PieceEventKind kind) {
  switch (kind) {
    case PieceEventKind::strike:
      return {1.0F, 0.4F, 0.5F, 0.5F, 0.12F, 0.03F, 0.15F};
    case PieceEventKind::crack:
      return {1.0F, 0.35F, 0.25F, 0.5F, 0.3F, 0.06F, 0.35F};
    case PieceEventKind::settle:
      return {0.6F, 0.45F, 0.0F, 0.25F, 0.35F, 0.05F, 0.3F};
    case PieceEventKind::thud:  // of cues: a layer each, with a little of the others
      return {1.0F, 0.9F, 0.05F, 0.06F, 0.0F, 0.02F, 0.1F};
    case PieceEventKind::snap:
      return {1.0F, 0.1F, 0.1F, 0.9F, 0.1F, 0.05F, 0.2F};
    case PieceEventKind::ring:
      return {1.0F, 0.01F, 1.0F, 0.01F, 0.0F, 0.01F, 0.1F};
    case PieceEventKind::rattle:
      return {0.8F, 0.04F, 0.0F, 0.03F, 0.9F, 0.02F, 0.45F};
    case PieceEventKind::dust:
    case PieceEventKind::sparks:
      break;  // seen alone
  }
  return {};
}

/// Hertz: how long an elastic body touches what it strikes, 2.87 (m² / (R E*² v))^(1/5) (Johnson, Contact
/// Mechanics, 1985, section 11.4). Blocks strike with a corner, R of a twentieth of their side. Both sides
/// are of the same material, whose stiffness follows from its density and its speed of sound: E* = E / (2 (1
/// − ν²)), ν 0.25.
float contact_seconds(float mass_kg, float size_m, float speed_m_s, float pitch) {
  const float density_kg_m3 = mass_kg / (size_m * size_m * size_m);
  const float bar_m_s = rock_m_s * pitch;
  const float stiffness_pa = density_kg_m3 * bar_m_s * bar_m_s / 1.875F;
  const float ratio = mass_kg / stiffness_pa;
  return 2.87F * exact_power(ratio * ratio / (0.05F * size_m * speed_m_s), 0.2F);
}

float decay_over(float seconds) {
  return exact_exp(-1.0F / (std::max(seconds, 1e-3F) * rate));
}

/// An oscillation of that energy, whose unit is a full amplitude for a second. It falls to 1/e in `seconds`.
Mode mode_of(float energy, float pitch_hz, float seconds) {
  const float decay = decay_over(seconds), turns = pitch_hz / rate;
  return {decay * exact_cosine(turns), decay * exact_sine(turns), std::sqrt(4.0F * energy / seconds), 0.0F};
}

/// Where air has taken half of the power on the way. ISO 9613-2's table for 20 °C and 70 % of humidity, from
/// 5 dB a kilometre at 1 kHz to 77 at 8 kHz, is about 2.3 f^1.7 with f in kHz.
float air_cut_hz(float distance_m) {
  return 1000.0F * exact_power(1300.0F / std::max(distance_m, 1.0F), 1.0F / 1.7F);
}

}  // namespace

Voice::Voice(const Blow& blow, uint64_t seed) : over_(false), random_(seed) {
  const SoundEvent& event = blow.event;
  const Manner manner = manner_of(event.kind);
  const float size_m =
      std::clamp(exact_power(std::max(blow.volume_m3, 1e-6F), 1.0F / 3.0F), heard_min_m, heard_max_m);
  const float speed_m_s = std::clamp(event.impulse_n_s / event.mass_kg, heard_min_m_s, heard_max_m_s);
  const float contact_s = contact_seconds(event.mass_kg, size_m, speed_m_s, event.pitch);
  // By the fourth root of the energy, half as fast as in air: from a pebble to a tower it would be 90 dB. The
  // level is of energy and not of amplitude, because ears add up what comes within a tenth of a second.
  const float level = manner.loudness * exact_power(std::max(blow.energy_j, 1e-3F) / loud_j, 0.25F) * loud_m /
                      std::max(event.distance_m, near_m);
  const float energy = level_energy * std::min(level * level, level_max * level_max);
  const float clear = 1.0F - event.noise;
  const float ring = manner.ring * clear * clear, crack = manner.crack * event.noise;
  const float unit = energy / (manner.thud + ring + crack + manner.rattle);
  set_thud(unit * manner.thud, contact_s);
  set_ring(unit * ring, event, size_m, contact_s);
  const float root = std::sqrt(size_m);
  set_crack(unit * crack, std::clamp(crack_hz * std::sqrt(event.pitch) / root, crack_min_hz, crack_max_hz),
            manner.crack_s * root);
  set_rattle(unit * manner.rattle, blow, size_m, manner.rattle_s * root);
  wait_ = static_cast<size_t>(std::min(event.distance_m / air_m_s, travel_s_max) * rate);
  const float cut = 6.28318531F * air_cut_hz(event.distance_m) / rate;
  air_ = cut / (1.0F + cut);
  left_ = std::sqrt(0.5F * (1.0F - 0.8F * event.side));
  right_ = std::sqrt(0.5F * (1.0F + 0.8F * event.side));
}

/// What a push radiates is loudest at 0.68 / its time: the derivative of half a wave of force (Koss and
/// Alfredson, Transient sound radiated by spheres undergoing an elastic collision, 1973).
void Voice::set_thud(float share, float contact_s) {
  const float pitch_hz = std::clamp(0.68F / contact_s, thud_min_hz, thud_max_hz);
  modes_[0] = mode_of(0.75F * share, pitch_hz, 1.4F / pitch_hz);
  modes_[1] = mode_of(0.25F * share, 1.9F * pitch_hz, 1.2F / pitch_hz);
}

/// Modes of a body (van den Doel, Kry and Pai, FoleyAutomatic, 2001). A contact that lasts longer than a
/// mode's half wave leaves little of it.
void Voice::set_ring(float share, const SoundEvent& event, float size_m, float contact_s) {
  std::array<float, ring_modes> pitches_hz{}, weights{};
  float sum = 0.0F;
  for (size_t i = 0; i < ring_modes; ++i) {
    pitches_hz[i] = std::min(
        event.pitch * rock_pitch_hz / size_m * overtones[i] * (0.95F + 0.1F * random_.unit()), 0.2F * rate);
    const float waves = 2.0F * pitches_hz[i] * contact_s;
    weights[i] = 1.0F / (1.0F + waves * waves);
    sum += weights[i];
  }
  for (size_t i = 0; i < ring_modes; ++i)
    modes_[thud_modes + i] =
        mode_of(share * weights[i] / sum, pitches_hz[i],
                std::clamp(event.damping_s * size_m / overtones[i], 1.0F / pitches_hz[i], 4.0F));
}

void Voice::set_crack(float share, float band_hz, float seconds) {
  const float half_turn = 0.5F * band_hz / rate;
  band_ = exact_sine(half_turn) / exact_cosine(half_turn);
  noise_decay_ = decay_over(seconds);
  // White noise from −1 to 1 has a third of a full amplitude's power, of which a band of its middle's width
  // passes π band / rate.
  const float passes = 3.14159265F * band_hz / rate / 3.0F;
  noise_ = std::sqrt(2.0F * share / seconds / passes);
}

/// Grains that collide at random moments, fewer as they come to rest (Cook, Physically informed sonic
/// modeling, 1997).
void Voice::set_rattle(float share, const Blow& blow, float size_m, float seconds) {
  const float knocks = knocks_a_second * std::sqrt(static_cast<float>(std::min(blow.members, members_max)));
  grain_m_ = std::clamp(grain_share * size_m, grain_min_m, grain_max_m);
  grain_pitch_ = std::sqrt(blow.event.pitch);
  grain_damping_ = 1.0F + 4.0F * (1.0F - blow.event.noise);
  chance_ = knocks / rate;
  rattle_decay_ = decay_over(seconds);
  // Both their number and their strength fall, so a third of all that they would be at the beginning is
  // heard; the mean square of a knock's strength at random is 1.3.
  knock_ = std::sqrt(3.0F * share / (1.3F * std::max(knocks * seconds, 1.0F)));
}

/// The pitch of a knock by the size of the grain: 224 / d^0.9 Hz, as measured of pebbles (Thorne, Laboratory
/// and marine measurements on the acoustic detection of sediment transport, 1986).
void Voice::knock() {
  const float size = 0.5F + 1.5F * random_.unit() * random_.unit();
  const float pitch_hz =
      std::min(grain_pitch_ * 224.0F * exact_power(1.0F / (grain_m_ * size), 0.9F), 0.15F * rate);
  const float seconds = grain_damping_ / pitch_hz;
  const float strength = (0.5F + random_.unit()) * size * knock_;
  Mode& grain = grains_[next_grain_];
  next_grain_ = 1 - next_grain_;
  const Mode made = mode_of(1.0F, pitch_hz, seconds);
  grain.cosine = made.cosine;
  grain.sine = made.sine;
  grain.x += strength * made.x;
}

float Voice::next() {
  float sum = 0.0F;
  for (size_t i = first_mode_; i < modes_.size(); ++i) sum += modes_[i].next();
  if (noise_ > 0.0F) {
    const float hiss = noise_ * (2.0F * random_.unit() - 1.0F);
    constexpr float spread = 1.0F;  ///< the band is as wide as its middle
    const float high = (hiss - (spread + band_) * band_mid_ - band_low_) / (1.0F + band_ * (spread + band_));
    const float mid = band_ * high + band_mid_;
    band_mid_ = band_ * high + mid;
    const float low = band_ * mid + band_low_;
    band_low_ = band_ * mid + low;
    sum += mid;
    noise_ *= noise_decay_;
  }
  if (chance_ > 0.0F) {
    if (random_.unit() < chance_) knock();
    chance_ *= rattle_decay_;
    knock_ *= rattle_decay_;
  }
  for (Mode& grain : grains_) sum += grain.next();
  aired_ += air_ * (sum - aired_);
  return aired_;
}

/// What is too quiet to be heard ends, before its numbers become so small that processors are slow with them.
void Voice::look() {
  float left = noise_;
  if (noise_ < silence) noise_ = 0.0F;
  for (Mode& mode : modes_) {
    if (mode.size() < silence) mode.x = mode.y = 0.0F;
    left += mode.size();
  }
  for (Mode& grain : grains_) {
    if (grain.size() < silence) grain.x = grain.y = 0.0F;
    left += grain.size();
  }
  while (first_mode_ < modes_.size() && modes_[first_mode_].size() == 0.0F) ++first_mode_;
  if (knock_ < 0.1F * silence || chance_ * rate < 1.0F) chance_ = 0.0F;
  over_ = left == 0.0F && chance_ == 0.0F;
}

void Voice::add_to(float* samples, size_t frames) {
  const size_t from = std::min(wait_, frames);
  wait_ -= from;
  for (size_t i = from; i < frames && !over_; ++i) {
    const float sample = next();
    samples[2 * i] += sample * left_;
    samples[2 * i + 1] += sample * right_;
    if (++age_ % limits::voice_look_frames == 0) look();
  }
}

float Voice::loudness() const {
  float sum = noise_;
  for (const Mode& mode : modes_) sum += mode.size();
  return sum;
}

}  // namespace scree
