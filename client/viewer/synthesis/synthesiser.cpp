#include "client/viewer/synthesis/synthesiser.h"

#include <algorithm>
#include <cmath>

namespace scree {
namespace {

/// Two places seem one: so much of the distance between them, at least so many metres, and so much of the way
/// from left to right.
constexpr float near_share = 0.35F;
constexpr float near_least_m = 3.0F;
constexpr float near_side = 0.5F;

/// A sound of so much less amplitude than those of the same moment is not heard beside them.
constexpr float masked = 0.03F;

float energy_of(const SoundEvent& event) {
  return event.impulse_n_s * event.impulse_n_s / (2.0F * event.mass_kg);
}

/// As it arrives, for comparison.
float strength_of(const Blow& blow) {
  return std::sqrt(std::sqrt(blow.energy_j)) / std::max(blow.event.distance_m, 1.0F);
}

/// Whether its numbers are such as pieces and palettes have (shared/material/material_members.cpp).
bool is_sound(const SoundEvent& event) {
  const auto within = [](float number, float least, float most) { return number >= least && number <= most; };
  constexpr float huge = 1e12F;
  return is_heard(event.kind) && within(event.size_m, 1e-3F, 1e4F) && within(event.mass_kg, 1e-3F, huge) &&
         within(event.impulse_n_s, 1e-6F, huge) && within(event.pitch, 0.05F, 20.0F) &&
         within(event.damping_s, 0.005F, 5.0F) && within(event.noise, 0.0F, 1.0F) &&
         within(event.distance_m, 0.0F, huge) && within(event.side, -1.0F, 1.0F);
}

bool is_near(const SoundEvent& a, const SoundEvent& b) {
  return a.kind == b.kind && std::abs(a.side - b.side) < near_side &&
         std::abs(a.distance_m - b.distance_m) < std::max(near_least_m, near_share * a.distance_m);
}

void join(Blow& blow, const SoundEvent& event) {
  blow.energy_j += energy_of(event);
  blow.volume_m3 += event.size_m * event.size_m * event.size_m;
  blow.event.mass_kg += event.mass_kg;
  blow.event.impulse_n_s += event.impulse_n_s;
  ++blow.members;
}

/// Makes sounds of the events of one moment, the heaviest first. Returns how many.
size_t gather(const SoundEvent* events, size_t count, std::array<Blow, limits::sounds_begun_max>& blows) {
  size_t made = 0;
  for (size_t i = 0; i < count; ++i) {
    const SoundEvent& event = events[i];
    Blow* const end = blows.data() + made;
    Blow* const found =
        std::find_if(blows.data(), end, [&](const Blow& blow) { return is_near(blow.event, event); });
    if (found != end) {
      join(*found, event);
    } else if (made < blows.size()) {
      blows[made++] = {event, energy_of(event), event.size_m * event.size_m * event.size_m, 1};
    }
  }
  return made;
}

}  // namespace

void Synthesiser::add(const SoundEvent& event) {
  if (waiting_count_ < waiting_.size() && is_sound(event)) waiting_[waiting_count_++] = event;
}

void Synthesiser::begin_waiting() {
  std::array<Blow, limits::sounds_begun_max> blows;
  const size_t count = gather(waiting_.data(), waiting_count_, blows);
  waiting_count_ = 0;
  float strongest = 0.0F;
  for (size_t i = 0; i < count; ++i) strongest = std::max(strongest, strength_of(blows[i]));
  for (size_t i = 0; i < count; ++i)
    if (strength_of(blows[i]) > masked * strongest) begin(blows[i]);
}

void Synthesiser::begin(const Blow& blow) {
  ++begun_;
  Voice* place =
      std::find_if(voices_.begin(), voices_.end(), [](const Voice& voice) { return voice.is_over(); });
  if (place == voices_.end())
    place = std::min_element(voices_.begin(), voices_.end(),
                             [](const Voice& a, const Voice& b) { return a.loudness() < b.loudness(); });
  *place = Voice(blow, begun_);
}

void Synthesiser::render(float* samples, size_t frames) {
  if (waiting_count_ > 0) begin_waiting();
  std::fill(samples, samples + frames * channels, 0.0F);
  for (Voice& voice : voices_)
    if (!voice.is_over()) voice.add_to(samples, frames);
  limiter_.limit(samples, frames);
}

size_t Synthesiser::voices() const {
  return static_cast<size_t>(
      std::count_if(voices_.begin(), voices_.end(), [](const Voice& voice) { return !voice.is_over(); }));
}

}  // namespace scree
