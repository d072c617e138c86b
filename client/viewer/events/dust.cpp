#include "client/viewer/events/dust.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/viewer/base/limits.h"
#include "shared/base/random.h"

namespace scree {
namespace {

/// Air stops a puff: part of its speed that is lost, a second.
constexpr float drag_per_s = 2.2F;
constexpr float dust_rise_m_s = 0.10F;
/// Metres that the middle of a puff rises while its radius grows by one.
constexpr float rises_per_swelling = 0.8F;
/// Beyond it, an event throws no more; what it throws lies as far apart as the piece is wide.
constexpr float size_max_m = 3.0F, width_max_m = 4.0F;
constexpr float puff_max_m = 0.9F;

/// Puffs of one moment, about, and young ones at one place: more would hide what breaks.
constexpr int puffs_at_once = 45, puffs_at_a_place = 7;
constexpr float place_m = 1.5F;
constexpr double young_s = 0.8;

/// How much a kind of event throws, from a piece of 1 m.
struct Throw {
  float puffs;
  float chips;
  float speed_m_s;
  float thickness;  ///< opacity of a new puff
};

constexpr Throw throw_of(PieceEventKind kind) {
  switch (kind) {
    case PieceEventKind::crack:
      return {.puffs = 4.0F, .chips = 16.0F, .speed_m_s = 3.6F, .thickness = 0.46F};
    case PieceEventKind::strike:
      return {.puffs = 5.0F, .chips = 7.0F, .speed_m_s = 1.7F, .thickness = 0.50F};
    case PieceEventKind::settle:
      return {.puffs = 4.0F, .chips = 0.0F, .speed_m_s = 0.8F, .thickness = 0.42F};
    case PieceEventKind::dust:
      return {.puffs = 7.0F, .chips = 0.0F, .speed_m_s = 2.0F, .thickness = 0.46F};
    case PieceEventKind::sparks:
      return {.puffs = 0.0F, .chips = 24.0F, .speed_m_s = 4.5F, .thickness = 0.0F};
    case PieceEventKind::thud:
    case PieceEventKind::snap:
    case PieceEventKind::ring:
    case PieceEventKind::rattle:
      return {.puffs = 0.0F, .chips = 0.0F, .speed_m_s = 0.0F, .thickness = 0.0F};  // heard alone
  }
  return {};
}

std::array<uint8_t, 4> bytes(glm::vec3 colour, float opacity) {
  const auto byte = [](float part) {
    return static_cast<uint8_t>(std::clamp(part, 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return {byte(colour.x), byte(colour.y), byte(colour.z), byte(opacity)};
}

/// The same for the same event: its piece, its kind, and where it was, in steps of a pose.
uint64_t seed_of(const PieceEvent& event, uint64_t what) {
  uint64_t seed = (uint64_t{event.piece} << 4U) | (static_cast<uint64_t>(event.kind) << 2U) | what;
  for (const float along : {event.place_m.x, event.place_m.y, event.place_m.z})
    seed = seed * 0x9E3779B97F4A7C15ULL + static_cast<uint64_t>(static_cast<int64_t>(along * 1024.0F));
  return seed;
}

float either_way(Random& random) {
  return 2.0F * random.unit() - 1.0F;
}

/// Within a ball of radius 1.
glm::vec3 anywhere(Random& random) {
  const glm::vec3 in_cube(either_way(random), either_way(random), either_way(random));
  return in_cube / std::max(glm::length(in_cube), 1.0F);
}

/// How hard it was, 0..1: a blow of 6 m/s is as hard as any. Cracks and merges have no speed of their own. A
/// cue of 1 kJ is as hard as these; by the fourth root of the energy, at most twice that.
float hardness(const PieceEvent& event) {
  if (is_cue(event.kind)) {
    const float energy_j = 0.5F * event.impulse_n_s * event.impulse_n_s / std::max(event.mass_kg, 1e-3F);
    return std::clamp(std::sqrt(std::sqrt(energy_j / 1000.0F)), 0.2F, 2.0F);
  }
  if (event.kind != PieceEventKind::strike) return 1.0F;
  return std::clamp(event.impulse_n_s / std::max(event.mass_kg, 1e-3F) / 6.0F, 0.1F, 1.0F);
}

int count_of(float per_metre, float size_m) {
  return static_cast<int>(std::ceil(per_metre * size_m));
}

}  // namespace

void Dust::add(const std::vector<PieceEvent>& events, double now_s) {
  const auto puffs_of = [](const PieceEvent& event) {
    return count_of(throw_of(event.kind).puffs, std::min(event.size_m, size_max_m) * hardness(event));
  };
  int puffs = 0;
  for (const PieceEvent& event : events) puffs += puffs_of(event);
  // The pieces of one blast share its dust.
  const size_t every = 1 + static_cast<size_t>(puffs / puffs_at_once);
  for (size_t i = 0; i < events.size(); ++i) {
    const float size_m = std::min(events[i].size_m, size_max_m) * hardness(events[i]);
    if (i % every == 0) throw_puffs(events[i], puffs_of(events[i]), now_s);
    throw_chips(events[i], count_of(throw_of(events[i].kind).chips, size_m), now_s);
  }
  while (grains_.size() > limits::particles_max) grains_.pop_front();
}

bool Dust::is_dusty(glm::vec3 at_m, double now_s) const {
  int near = 0;
  for (auto grain = grains_.rbegin(); grain != grains_.rend() && now_s - grain->begun_s < young_s; ++grain) {
    const glm::vec3 off_m = grain->first.place_m - at_m;
    near += grain->first.slender == 0.0F && glm::dot(off_m, off_m) < place_m * place_m ? 1 : 0;
  }
  return near >= puffs_at_a_place;
}

void Dust::throw_puffs(const PieceEvent& event, int count, double now_s) {
  Random random(seed_of(event, 0));
  const Throw thrown = throw_of(event.kind);
  const float half_m = 0.5F * std::min(event.size_m, width_max_m);
  const float puff_m = std::min(0.5F * event.size_m, puff_max_m);
  for (int i = 0; i < count; ++i) {
    Grain grain;
    const glm::vec3 out = anywhere(random);
    // What strikes or settles raises dust at its foot, along the ground.
    const bool rises = event.kind == PieceEventKind::strike || event.kind == PieceEventKind::settle;
    const float down = rises ? 0.7F : 0.0F;
    grain.first.place_m = event.place_m + half_m * (out - glm::vec3(0.0F, down, 0.0F));
    grain.speed_m_s = thrown.speed_m_s * (0.4F + random.unit()) *
                      glm::vec3(out.x, down > 0.0F ? 0.25F * random.unit() : 0.6F * out.y, out.z);
    if (is_dusty(grain.first.place_m, now_s)) continue;
    grain.first.radius_m = puff_m * (0.7F + 0.6F * random.unit());
    const glm::vec3 shade(0.88F + 0.24F * random.unit());
    grain.first.colour = bytes(event.dust * shade, thrown.thickness * hardness(event));
    grain.first.turn = 6.2831853F * random.unit();
    grain.spin = 0.5F * either_way(random);
    grain.begun_s = now_s;
    grain.life_s = limits::particle_seconds_max * (0.5F + 0.5F * random.unit());
    grains_.push_back(grain);
  }
}

void Dust::throw_chips(const PieceEvent& event, int count, double now_s) {
  Random random(seed_of(event, 1));
  const Throw thrown = throw_of(event.kind);
  const float half_m = 0.5F * std::min(event.size_m, size_max_m);
  for (int i = 0; i < count; ++i) {
    Grain grain;
    const glm::vec3 out = anywhere(random);
    grain.first.place_m = event.place_m + half_m * out;
    grain.speed_m_s = thrown.speed_m_s * (1.2F * out + glm::vec3(0.0F, 0.9F * random.unit(), 0.0F));
    // Most are grit; splinters are longer.
    const bool splinter = random.below(4) == 0;
    grain.first.radius_m = (splinter ? 0.05F : 0.018F) * (0.6F + random.unit());
    grain.first.slender = splinter ? 0.2F + 0.25F * random.unit() : 0.9F;
    grain.first.colour = bytes(event.dust * (0.55F + 0.45F * random.unit()), 1.0F);
    grain.first.turn = 6.2831853F * random.unit();
    grain.spin = 14.0F * either_way(random);
    grain.begun_s = now_s;
    grain.life_s = limits::particle_seconds_max * (0.3F + 0.4F * random.unit());
    grains_.push_back(grain);
  }
}

Particle Dust::aged(const Grain& grain, float age_s) {
  Particle now = grain.first;
  const float share = age_s / grain.life_s;
  float left = 1.0F;
  if (now.slender > 0.0F) {
    now.place_m += grain.speed_m_s * age_s + 0.5F * age_s * age_s * gravity_m_s2;
    left = std::min(1.0F, 5.0F * (1.0F - share));
  } else {
    const float way_s = (1.0F - std::exp(-drag_per_s * age_s)) / drag_per_s;
    now.place_m += grain.speed_m_s * way_s + glm::vec3(0.0F, dust_rise_m_s * age_s, 0.0F);
    now.radius_m *= 1.0F + 2.0F * std::sqrt(share);
    // It swells upwards: the ground beneath would cut it in a line.
    now.place_m.y += rises_per_swelling * (now.radius_m - grain.first.radius_m);
    left = std::min(1.0F, 12.0F * share) * (1.0F - share) * (1.0F - share);
  }
  now.turn += grain.spin * age_s;
  now.colour[3] = static_cast<uint8_t>(static_cast<float>(now.colour[3]) * left);
  return now;
}

std::vector<Particle> Dust::at(double now_s, glm::vec3 eye_m) {
  std::erase_if(grains_, [&](const Grain& grain) {
    return now_s - grain.begun_s >= static_cast<double>(grain.life_s);
  });
  std::vector<Particle> particles;
  particles.reserve(grains_.size());
  for (const Grain& grain : grains_)
    particles.push_back(aged(grain, static_cast<float>(now_s - grain.begun_s)));
  const auto away = [eye_m](const Particle& particle) {
    const glm::vec3 off = particle.place_m - eye_m;
    return glm::dot(off, off);
  };
  std::ranges::stable_sort(particles, std::ranges::greater(), away);
  return particles;
}

}  // namespace scree
