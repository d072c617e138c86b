#include "studies/matrix/session.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>

#include "bench/support/heap.h"
#include "bench/support/scenes.h"
#include "bench/support/surface_distance.h"
#include "server/fracture/hull.h"
#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr float blow_radius_m = 2.0F;
constexpr double bytes_per_mib = 1024.0 * 1024.0;
/// Ticks between two looks at how deep the pieces are, and points of a piece that are looked at.
constexpr Tick sample_ticks = 15;
constexpr size_t sample_points = 16;

/// Side by side before the camera (drawn.h), four in a row, each in fresh ground.
CarveRequest blow_number(uint32_t number, SeedPattern pattern, uint32_t seeds) {
  constexpr float apart_m = 4.0F;
  const float x_m = 5.0F + apart_m * static_cast<float>(number % 4),
              z_m = 12.0F - apart_m * static_cast<float>(number / 4);
  CarveRequest blow = blow_at(matrix_terrain, x_m, z_m, blow_radius_m, seeds, number + 1);
  blow.pattern = pattern;
  return blow;
}

/// The distance of a piece's surface from its body's, as if both were balls: a ball of radius r whose volume
/// is off by a share e has its surface off by r·e/3.
double body_distance_voxels(const SpawnedPiece& piece, Simplifier simplifier, float voxel_size_m) {
  constexpr double ball = 4.18879;  // volume of radius 1
  const PieceHull hull = make_hull(piece.id, *piece.volume, voxel_size_m, simplifier);
  const auto size_m3 = static_cast<double>(hull.size_m3);
  const double off = std::abs(hull_volume(hull.corners_m) - size_m3) / size_m3;
  return std::cbrt(size_m3 / ball) * off / 3.0 / static_cast<double>(voxel_size_m);
}

/// Looks at a session from outside: what it allocates itself is not the world's.
class Observer {
 public:
  explicit Observer(Simplifier simplifier) : simplifier_(simplifier) {}

  void observe(World& world, const TickDelta& delta) {
    for (const SpawnedPiece& piece : delta.spawned) {
      const float dx = world.config().terrain.voxel_size_m;
      points_[piece.id] = surface_samples(*piece.volume, dx, sample_points);
      body_voxels_ += body_distance_voxels(piece, simplifier_, dx);
      made_ += 1.0;
    }
    ledger_units_ = std::max(ledger_units_, std::abs(static_cast<double>(delta.ledger.error())));
    if (delta.tick % sample_ticks != 0) return;
    for (const PieceState& piece : delta.pieces) observe(world, piece);
  }
  void fill(SessionFigures& figures) const {
    figures.pieces_made = made_;
    figures.ledger_units = std::max(figures.ledger_units, ledger_units_);
    figures.depth_voxels = depth_.rms();
    figures.body_voxels = body_voxels_ / std::max(made_, 1.0);
  }

 private:
  void observe(World& world, const PieceState& piece) {
    const Pose pose = dequantise(piece.pose);
    const float dx = world.config().terrain.voxel_size_m;
    for (const glm::vec3& point : points_.at(piece.id)) {
      const float distance =
          sample(world.field(), (pose.position_m + pose.rotation * point) / dx).distance_voxels;
      depth_.add(std::max(0.0, -static_cast<double>(distance)));
    }
  }

  Simplifier simplifier_;
  std::map<PieceId, std::vector<glm::vec3>> points_;
  SurfaceDistance depth_;
  double body_voxels_ = 0.0, made_ = 0.0, ledger_units_ = 0.0;
};

}  // namespace

SessionPlan session_plan(bool quick) {
  return quick ? SessionPlan{.ticks = 90, .blows = 1, .seeds = 24} : SessionPlan{};
}

MatrixSession::MatrixSession(const WorldConfig& config, SeedPattern pattern, const SessionPlan& plan,
                             size_t threads)
    : plan_(plan), pattern_(pattern), world_(config, threads) {
  // As a server does ahead of its ticks, around clients' eyes (server/app/terrain_ahead.h).
  for (uint32_t i = 0; i < plan.blows; ++i) {
    const Shape around = sphere(blow_number(i, pattern, plan.seeds).shape.a, 3.0F * blow_radius_m);
    gather(world_.field(), band_box(in_voxels(around, matrix_terrain.voxel_size_m)));
  }
}

std::shared_ptr<const TickDelta> MatrixSession::step() {
  std::vector<Command> commands;
  const auto number = static_cast<uint32_t>(world_.tick() / plan_.ticks_between_blows);
  if (world_.tick() % plan_.ticks_between_blows == 0 && number < plan_.blows)
    commands.push_back({0, number, blow_number(number, pattern_, plan_.seeds)});
  std::shared_ptr<const TickDelta> delta = world_.step(commands);
  for (const Reply& reply : delta->replies)
    if (!reply.refusal.empty()) refusal_ = reply.refusal;
  pieces_.follow(*delta, changes_);
  return delta;
}

MirrorChanges MatrixSession::drain_changes() {
  return std::exchange(changes_, {});
}

Result<SessionFigures> measure_session(const Simulated& simulated, const SessionPlan& plan) {
  SessionFigures figures;
  const size_t held = heap_bytes();
  reset_heap_peak();
  MatrixSession session(config_of(simulated, matrix_terrain), simulated.pattern, plan);
  Observer observer(simulated.simplifier);
  std::vector<double> times_ms, carves_ms;
  size_t own_bytes = 0, most_bytes = 0;
  std::shared_ptr<const TickDelta> delta;
  while (!session.ended()) {
    delta = session.step();
    most_bytes = std::max(most_bytes, heap_peak_bytes() - std::min(heap_peak_bytes(), held + own_bytes));
    times_ms.push_back(delta->times.total_ms());
    if (!delta->replies.empty()) carves_ms.push_back(times_ms.back());
    const size_t before = heap_bytes();
    observer.observe(session.world(), *delta);
    own_bytes += heap_bytes() - std::min(heap_bytes(), before);
    reset_heap_peak();
  }
  if (!session.refusal().empty()) return fail(text_of(simulated) + ": " + session.refusal());
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) /
           static_cast<double>(std::max<size_t>(values.size(), 1));
  };
  figures.tick_ms = mean(times_ms);
  figures.tick_p99_ms = quantile(times_ms, 0.99);
  figures.carve_ms = mean(carves_ms);
  figures.heap_mib = static_cast<double>(most_bytes) / bytes_per_mib;
  figures.pieces_left = static_cast<double>(delta->pieces.size());
  const Ledger& ledger = delta->ledger;
  figures.dust_percent =
      100.0 * static_cast<double>(ledger.dust) / static_cast<double>(std::max<MassUnits>(ledger.moved, 1));
  figures.ledger_units = std::abs(static_cast<double>(session.world().measure_terrain() - ledger.terrain));
  observer.fill(figures);
  return figures;
}

}  // namespace scree
