#include "client/viewer/sound/synthesiser.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "client/viewer/base/limits.h"

namespace scree {
namespace {

/// The frequency of the lowest mode of a cube of 1 m of rock, whose pitch is 1.
constexpr float rock_pitch_hz = 190.0F;

/// How a kind of event differs from a plain blow.
struct Manner {
  float loudness;
  float noise_s;  ///< until its noise is a third as loud, of a cube of 1 m
  float grains;   ///< part of the samples with noise
  float ringing;
};

constexpr Manner manner_of(PieceEventKind kind) {
  switch (kind) {
    case PieceEventKind::strike:
      return {.loudness = 1.0F, .noise_s = 0.05F, .grains = 1.0F, .ringing = 1.0F};
    case PieceEventKind::crack:
      return {.loudness = 1.3F, .noise_s = 0.35F, .grains = 0.06F, .ringing = 0.6F};
    case PieceEventKind::settle:
      return {.loudness = 0.5F, .noise_s = 0.12F, .grains = 0.5F, .ringing = 0.0F};
  }
  return {};
}

constexpr float rate = static_cast<float>(Synthesiser::rate_hz);
constexpr float sound_m_s = 343.0F;
constexpr float loud_n_s = 4000.0F;  ///< impulse of full loudness at loud_within_m
constexpr float loud_within_m = 3.0F;
constexpr float silent = 1e-4F;
constexpr std::array overtones{1.0F, 1.83F, 2.71F};  ///< of a block that is no string

float decay_over(float seconds) {
  return std::exp(-1.0F / (std::max(seconds, 1e-3F) * rate));
}

}  // namespace

void Synthesiser::add(const PieceEvent& event, const Ears& ears) {
  const MaterialSound& timbre = event.sound;
  const Manner manner = manner_of(event.kind);
  const float size_m = std::clamp(event.size_m, 0.05F, 8.0F);
  const glm::vec3 way_m = event.place_m - ears.place_m;
  const float far_m = glm::length(way_m);
  const float loud = std::sqrt(std::clamp(event.impulse_n_s / loud_n_s, 0.0F, 4.0F)) * manner.loudness *
                     loud_within_m / std::max(far_m, loud_within_m);
  ++added_;
  if (!(loud > silent)) return;
  Voice voice;
  voice.random = Random(added_);
  voice.wait = static_cast<size_t>(std::min(far_m / sound_m_s, 2.0F) * rate);
  const float side = far_m > 0.1F ? std::clamp(glm::dot(way_m / far_m, ears.right), -1.0F, 1.0F) : 0.0F;
  voice.left = loud * std::sqrt(0.5F * (1.0F - 0.8F * side));
  voice.right = loud * std::sqrt(0.5F * (1.0F + 0.8F * side));
  voice.noise = timbre.noise;
  voice.noise_decay = decay_over(manner.noise_s * std::sqrt(size_m));
  voice.grain_share = manner.grains;
  // Large things are dull, and so is what is far: air takes the high notes first.
  const float cut_hz = 6000.0F / (0.4F + size_m) / (1.0F + far_m / 60.0F);
  voice.dull = std::min(1.0F, 2.0F * std::numbers::pi_v<float> * cut_hz / rate);
  for (size_t i = 0; i < modes; ++i) {
    const float pitch_hz =
        std::min(timbre.pitch * rock_pitch_hz / size_m * overtones[i] * (0.95F + 0.1F * voice.random.unit()),
                 0.2F * rate);
    const float decay = decay_over(timbre.damping_s * size_m / overtones[i]);
    const float turn = 2.0F * std::numbers::pi_v<float> * pitch_hz / rate;
    const float start = manner.ringing * (1.0F - timbre.noise) / static_cast<float>(i + 1);
    voice.ringing[i] = {decay * std::cos(turn), decay * std::sin(turn), 0.0F, start};
  }
  voices_.push_back(std::move(voice));
  if (voices_.size() <= limits::voices_max) return;
  voices_.erase(std::ranges::min_element(voices_, {}, &Voice::loudness));
}

float Synthesiser::next_sample(Voice& voice) {
  float sum = 0.0F;
  for (Mode& mode : voice.ringing) {
    const float x = mode.x * mode.cosine - mode.y * mode.sine;
    mode.y = mode.x * mode.sine + mode.y * mode.cosine;
    mode.x = x;
    sum += x;
  }
  const bool bursts = voice.random.unit() < voice.grain_share;
  const float hiss = voice.random.unit() * 2.0F - 1.0F;
  // Fewer grains are louder ones.
  voice.low += voice.dull * ((bursts ? hiss * voice.noise / std::sqrt(voice.grain_share) : 0.0F) - voice.low);
  voice.noise *= voice.noise_decay;
  return sum + voice.low;
}

bool Synthesiser::is_over(const Voice& voice) {
  const float most = std::max(voice.left, voice.right);
  float left = voice.noise + std::abs(voice.low);
  for (const Mode& mode : voice.ringing) left += std::abs(mode.x) + std::abs(mode.y);
  return most * left < silent;
}

std::vector<float> Synthesiser::render(size_t frames) {
  std::vector<float> samples(frames * channels, 0.0F);
  for (Voice& voice : voices_) {
    const size_t from = std::min(voice.wait, frames);
    voice.wait -= from;
    for (size_t i = from; i < frames; ++i) {
      const float sample = next_sample(voice);
      samples[i * channels] += sample * voice.left;
      samples[i * channels + 1] += sample * voice.right;
    }
  }
  std::erase_if(voices_, [](const Voice& voice) { return voice.wait == 0 && is_over(voice); });
  for (float& sample : samples) sample = peak_max * std::tanh(sample);
  return samples;
}

}  // namespace scree
