// The session that every combination of the matrix goes through: blows of 2 m at the canyon's floor, one a
// second, and the time in which most of the pieces come to rest.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "bench/support/followed_pieces.h"
#include "server/world/world.h"
#include "studies/matrix/combination.h"
#include "studies/matrix/results_log.h"

namespace scree {

inline const TerrainSource matrix_terrain{TerrainKind::canyon, 1, 0.25F};

struct SessionPlan {
  Tick ticks = 360;
  uint32_t blows = 2;
  uint32_t seeds = 48;
  Tick ticks_between_blows = 60;
};

SessionPlan session_plan(bool quick);

/// A world that steps through the session, and what a viewer would draw of it.
class MatrixSession {
 public:
  /// `threads`: of the world (World).
  MatrixSession(const WorldConfig& config, SeedPattern pattern, const SessionPlan& plan, size_t threads = 1);

  bool ended() const { return world_.tick() >= plan_.ticks; }
  std::shared_ptr<const TickDelta> step();
  World& world() { return world_; }
  /// Why a blow was refused; empty: none was.
  const std::string& refusal() const { return refusal_; }

  /// Pieces as they lie, and all changes since the last call.
  const ScenePieces& pieces() const { return pieces_.now(); }
  MirrorChanges drain_changes();

 private:
  SessionPlan plan_;
  SeedPattern pattern_;
  World world_;
  FollowedPieces pieces_;
  MirrorChanges changes_;
  std::string refusal_;
};

/// What a session cost, and how exact it was, on one thread.
struct SessionFigures {
  double tick_ms = 0.0;  ///< mean of all ticks
  double tick_p99_ms = 0.0;
  double carve_ms = 0.0;  ///< mean of the ticks of the blows
  double heap_mib = 0.0;  ///< most that the world held
  double pieces_made = 0.0;
  double pieces_left = 0.0;   ///< bodies at the end
  double dust_percent = 0.0;  ///< of the mass moved, at the end in neither terrain nor pieces
  double ledger_units = 0.0;  ///< worst error of the ledger, and its distance from the field measured afresh
  double depth_voxels = 0.0;  ///< RMS of how deep points of the pieces lay in rock
  double body_voxels = 0.0;   ///< mean of how far a body's surface is from its piece's, by their volumes

  static constexpr auto fields() {
    using F = FigureField<SessionFigures>;
    return std::array{
        F{"tick_ms", &SessionFigures::tick_ms},           F{"tick_p99_ms", &SessionFigures::tick_p99_ms},
        F{"carve_ms", &SessionFigures::carve_ms},         F{"heap_mib", &SessionFigures::heap_mib},
        F{"pieces_made", &SessionFigures::pieces_made},   F{"pieces_left", &SessionFigures::pieces_left},
        F{"dust_percent", &SessionFigures::dust_percent}, F{"ledger_units", &SessionFigures::ledger_units},
        F{"depth_voxels", &SessionFigures::depth_voxels}, F{"body_voxels", &SessionFigures::body_voxels}};
  }
};

Result<SessionFigures> measure_session(const Simulated& simulated, const SessionPlan& plan);

}  // namespace scree
