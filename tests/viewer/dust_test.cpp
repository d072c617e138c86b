// Dust, grit and splinters: bounded, over after a while, and the same for the same events.
#include "client/viewer/events/dust.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/viewer/base/limits.h"

namespace scree {
namespace {

PieceEvent event_of(PieceEventKind kind, PieceId piece = 1) {
  return {kind, {static_cast<float>(piece), 2.0F, -3.0F}, 1.0F, 9000.0F, material::rock, piece};
}

bool same(const std::vector<Particle>& a, const std::vector<Particle>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Particle)) == 0;
}

std::vector<Particle> thrown(const PieceEvent& event, double age_s) {
  Dust dust;
  dust.add({event}, 10.0);
  return dust.at(10.0 + age_s, {});
}

TEST(Dust, the_same_event_throws_the_same_particles_and_another_throws_others) {
  const PieceEvent crack = event_of(PieceEventKind::crack);
  ASSERT_GT(thrown(crack, 0.2).size(), 5U);
  EXPECT_TRUE(same(thrown(crack, 0.2), thrown(crack, 0.2)));
  EXPECT_FALSE(same(thrown(crack, 0.2), thrown(event_of(PieceEventKind::crack, 2), 0.2)));
}

TEST(Dust, a_break_throws_dust_and_chips_and_a_merge_dust_alone) {
  const auto chips = [](const std::vector<Particle>& particles) {
    return std::ranges::count_if(particles, [](const Particle& p) { return p.slender > 0.0F; });
  };
  const std::vector<Particle> broken = thrown(event_of(PieceEventKind::crack), 0.1);
  EXPECT_GT(chips(broken), 0);
  EXPECT_LT(chips(broken), static_cast<long>(broken.size()));
  const std::vector<Particle> merged = thrown(event_of(PieceEventKind::settle), 0.1);
  EXPECT_FALSE(merged.empty());
  EXPECT_EQ(chips(merged), 0);
  PieceEvent touch = event_of(PieceEventKind::strike);
  touch.impulse_n_s = 1.0F;
  EXPECT_LT(thrown(touch, 0.1).size(), thrown(event_of(PieceEventKind::strike), 0.1).size());
}

TEST(Dust, has_the_colour_of_what_breaks) {
  PieceEvent event = event_of(PieceEventKind::crack);
  event.dust = {0.05F, 0.05F, 0.9F};
  for (const Particle& particle : thrown(event, 0.1)) EXPECT_GT(particle.colour[2], 4 * particle.colour[0]);
}

TEST(Dust, all_of_it_is_over_in_its_time) {
  for (const PieceEventKind kind : {PieceEventKind::crack, PieceEventKind::strike, PieceEventKind::settle}) {
    EXPECT_FALSE(thrown(event_of(kind), 0.3).empty());
    EXPECT_TRUE(thrown(event_of(kind), static_cast<double>(limits::particle_seconds_max)).empty());
  }
  EXPECT_LT(static_cast<double>(limits::particle_seconds_max), limits::settled_s);
}

TEST(Dust, no_crowd_of_events_throws_more_than_the_bound) {
  Dust dust;
  std::vector<PieceEvent> events;
  for (PieceId piece = 1; piece <= 1000; ++piece) {
    events.push_back(event_of(PieceEventKind::crack, piece));
    events.back().size_m = 1e6F;
  }
  dust.add(events, 5.0);
  EXPECT_EQ(dust.at(5.1, {}).size(), limits::particles_max);
  dust.clear();
  EXPECT_TRUE(dust.at(5.1, {}).empty());
}

TEST(Dust, the_farthest_comes_first) {
  Dust dust;
  for (PieceId piece = 1; piece <= 20; ++piece) dust.add({event_of(PieceEventKind::crack, piece)}, 1.0);
  const glm::vec3 eye_m(4.0F, 1.0F, 2.0F);
  const std::vector<Particle> particles = dust.at(1.3, eye_m);
  EXPECT_TRUE(std::ranges::is_sorted(particles, std::ranges::greater(), [&](const Particle& particle) {
    return glm::distance(particle.place_m, eye_m);
  }));
}

}  // namespace
}  // namespace scree
