// The dust, grit and splinters of breaks, blows and merges. For the eye alone: of no account to ledger,
// mirror or pieces.
//
// Each event throws some particles, drawn from its piece, kind and place, so that the same event throws the
// same ones. Where one is, is a function of its age, and none is older than limits::particle_seconds_max. No
// GL; time is an argument (seconds). Not thread-safe.
#pragma once

#include <deque>
#include <vector>

#include "client/render/scene/particle.h"
#include "client/viewer/events/piece_event.h"

namespace scree {

class Dust {
 public:
  /// Above limits::particles_max the oldest end.
  void add(const std::vector<PieceEvent>& events, double now_s);
  /// As they are at that moment, the farthest from the eye first; those that are over are forgotten.
  std::vector<Particle> at(double now_s, glm::vec3 eye_m);
  void clear() { grains_.clear(); }

 private:
  /// One particle from its beginning.
  struct Grain {
    Particle first;
    glm::vec3 speed_m_s{0.0F};
    double begun_s = 0.0;
    float life_s = 1.0F;
    float spin = 0.0F;  ///< radians a second
  };

  /// Whether so many young puffs are at that place that one more would hide what breaks.
  bool is_dusty(glm::vec3 at_m, double now_s) const;
  static Particle aged(const Grain& grain, float age_s);
  void throw_puffs(const PieceEvent& event, int count, double now_s);
  void throw_chips(const PieceEvent& event, int count, double now_s);

  std::deque<Grain> grains_;  ///< the oldest first
};

}  // namespace scree
