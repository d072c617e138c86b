// Detects the pieces that have come to rest and may become terrain again.
//
// Each piece is judged by itself, not per Bullet island, where one restless piece keeps a whole heap awake. A
// piece is at rest when, for long enough, no point of it has moved farther than a leash from its anchor.
// Also, its energy is small for its mass, and it gathers no speed: it is not faster on its way from the
// anchor than it was on average. So jitter about a place and what contacts push out of an overlap are rest.
// What sets out, however slowly, is not: it is twice as fast as on average. The leash grows with the piece's
// age, and later the speed, so that every pile comes to rest. A piece at rest may merge when it lies on
// terrain, or on a piece that merges before it in the same tick: from the ground up. Deterministic. Not
// thread-safe. Metres and ticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "server/formats/world_value.h"
#include "shared/base/ids.h"
#include "shared/field/piece.h"

namespace scree {

struct RestConfig {
  float rest_s =
      1.0F / 3.0F;  ///< at the top of its flight a piece falls 0.14 m in half of it, and leaves the leash
  float leash_m = 0.06F;           ///< a quarter of a default voxel: less than a merge rounds
  float calm_m_s = 0.2F;           ///< greatest RestPiece::speed_m_s of a piece at rest
  float gathers_m_s = 0.03F;       ///< a slower piece gathers no speed: contacts have so much noise
  float gathers_share = 1.3F;      ///< speed over that on average from which on a piece gathers speed
  float stuck_s = 4.0F;            ///< age from which on a piece is stuck: it shakes without an end
  float stuck_growth_m_s2 = 0.1F;  ///< growth of the speed at which such a piece is at rest
  float patience_s = 2.0F;         ///< age at which the leash begins to grow
  float leash_growth_m_s = 0.05F;  ///< growth of the leash from that age on
  float leash_max_m = 0.25F;       ///< a default voxel; a piece that strays farther is moving
  float contact_s = 0.2F;          ///< a contact still counts so long after its last tick: contacts flicker
};

/// A piece after the bodies' step. `reach_m`: radius about its centre of mass. `speed_m_s`: of its energy,
/// the root of twice that over the mass.
struct RestPiece {
  PieceId id = 0;
  Pose pose;
  float reach_m = 0.0F;
  float speed_m_s = 0.0F;
  glm::vec3 velocity_m_s{0.0F};
};

/// `upper` lies on `lower`.
struct RestSupport {
  PieceId upper = 0;
  PieceId lower = 0;
};

class RestDetector {
 public:
  /// The tick rate must be positive.
  explicit RestDetector(const RestConfig& config, uint32_t tick_rate_hz);

  /// Call once a tick, after the bodies' step. `pieces`: every piece alive that is not frozen, ordered by id;
  /// pieces that are missing are forgotten. `on_terrain`: pieces that touch terrain, ordered. `supports`:
  /// which piece lies on which. Returns at most `merges_max` pieces that may merge now, in the order in which
  /// to merge them: those on terrain first, lowest first, then those on them. The caller may leave some of a
  /// layer out, and then all above it. `hurried`: half of the rest time is enough.
  std::vector<PieceId> update(std::span<const RestPiece> pieces, std::span<const PieceId> on_terrain,
                              std::span<const RestSupport> supports, size_t merges_max, bool hurried = false);

  /// For each piece that update() returned, in its order: 1 on terrain, n + 1 on a piece of n.
  std::span<const uint32_t> layers() const { return layers_; }
  /// So many of the pieces that update() returned do not merge now.
  void put_off_more(size_t pieces) { put_off_ += pieces; }

  /// All that update() needs to go on.
  RestValue value() const;
  /// Goes on from there. Whether the ids are of living pieces does not matter.
  void restore(const RestValue& value);

  /// Number of pieces at rest in the last update, on the ground or not.
  size_t at_rest() const { return at_rest_; }
  /// Number of pieces that could have merged in the last update, and did not.
  size_t put_off() const { return put_off_; }

 private:
  struct Timer {
    Pose anchor;  ///< pose from which the leash is measured
    uint32_t age_ticks = 0;
    uint32_t still_ticks = 0;    ///< since the anchor was set, less thrice those that are not calm
    uint32_t terrain_ticks = 0;  ///< since terrain was last touched, + 1; 0: never
  };

  /// Whether the piece is faster on its way from the anchor than it was on average.
  bool gathers_speed(const Timer& timer, const RestPiece& piece) const;
  /// Whether the piece is at rest.
  bool advance_timer(const RestPiece& piece, bool on_terrain, uint32_t rest_ticks);

  RestConfig config_;
  uint32_t rest_ticks_, patience_ticks_, contact_ticks_, stuck_ticks_;
  float leash_growth_m_tick_;
  float tick_s_;
  std::map<PieceId, Timer> timers_;
  std::vector<uint32_t> layers_;
  size_t at_rest_ = 0;
  size_t put_off_ = 0;
};

}  // namespace scree
