// The three terrain colliders on the same scenes: the pieces' depth in the rock, the number that fall
// through, the cost of a tick, and the cost of a carve.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "server/colliders/terrain_collider.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

constexpr uint32_t blows_a_side = 3;
constexpr uint32_t seeds_per_blow = 40;
constexpr float blast_speed_m_s = 15.0F;
/// Ticks between two looks at how deep the pieces are.
constexpr Tick sample_ticks = 5;
/// A piece whose centre of mass was deeper in the rock than this, voxels, fell through.
constexpr float fallen_voxels = 1.0F;
/// Points of a piece's surface that stand for it, at most.
constexpr size_t points_max = 64;

/// Pieces stay pieces: nothing merges, breaks or dents, so that each collider has the same ones.
WorldConfig scene(TerrainColliderKind kind) {
  WorldConfig config;
  config.merges_per_tick_max = 0;
  config.methods.collider = kind;
  config.methods.impacts = config.methods.dents = config.methods.islands = false;
  return config;
}

/// Voxels of the piece that lie at its surface, spread over it; metres from its centre of mass.
std::vector<glm::vec3> surface_of(const Volume& volume, float voxel_size_m) {
  constexpr Code near_surface = -64;
  std::vector<glm::vec3> all;
  const VoxelBox& box = volume.window.box;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        const Code code = volume.window.codes[volume.window.index(x, y, z)];
        if (code >= 0 || code < near_surface) continue;
        const glm::vec3 voxel(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        all.push_back((voxel - volume.centre_voxels) * voxel_size_m);
      }
  if (all.size() <= points_max) return all;
  std::vector<glm::vec3> some;
  for (size_t i = 0; i < points_max; ++i) some.push_back(all[i * all.size() / points_max]);
  return some;
}

float depth_voxels(const Field& field, glm::vec3 p_m) {
  return -sample(field, p_m / field.source().voxel_size_m).distance_voxels;
}

/// The results of one run of the scene.
struct Run {
  std::vector<double> bodies_ms;  ///< of each tick
  double depth_sum = 0.0;
  uint64_t depths = 0;
  float deepest_voxels = 0.0F;
  size_t made = 0, lost = 0;
  std::set<PieceId> fallen;  ///< whose centre was once that deep
  size_t buried = 0;         ///< those that still are at the end
  uint64_t state_hash = 0;
};

class Scene {
 public:
  explicit Scene(TerrainColliderKind kind) : world_(scene(kind)) {}

  Run play(Tick ticks) {
    BlowGrid blows(world_.config().terrain, blows_a_side, 4.5F, 2.0F, seeds_per_blow);
    std::shared_ptr<const TickDelta> last;
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (auto blow = blows.next()) {
        blow->blast_speed_m_s = blast_speed_m_s;
        commands.push_back({0, static_cast<uint32_t>(tick), *blow});
      }
      last = world_.step(commands);
      for (const SpawnedPiece& piece : last->spawned)
        surfaces_[piece.id] = surface_of(*piece.volume, world_.config().terrain.voxel_size_m);
      run_.made += last->spawned.size();
      if (commands.empty()) run_.bodies_ms.push_back(last->times[TickStage::bodies]);
      if (tick % sample_ticks == 0) observe(*last);
    }
    run_.lost = run_.made - last->pieces.size();
    for (const PieceState& piece : last->pieces)
      run_.buried += depth_voxels(world_.field(), dequantise(piece.pose).position_m) > fallen_voxels ? 1 : 0;
    run_.state_hash = last->state_hash;
    return run_;
  }
  const std::vector<std::pair<Pose, PieceId>>& poses() const { return poses_; }
  const std::map<PieceId, std::vector<glm::vec3>>& surfaces() const { return surfaces_; }
  World& world() { return world_; }

 private:
  void observe(const TickDelta& delta) {
    for (const PieceState& piece : delta.pieces) {
      const Pose pose = dequantise(piece.pose);
      const glm::mat3 turn = glm::mat3_cast(pose.rotation);
      if (depth_voxels(world_.field(), pose.position_m) > fallen_voxels) run_.fallen.insert(piece.id);
      float deepest = 0.0F;
      for (const glm::vec3& point : surfaces_.at(piece.id))
        deepest = std::max(deepest, depth_voxels(world_.field(), pose.position_m + turn * point));
      run_.depth_sum += deepest;
      ++run_.depths;
      run_.deepest_voxels = std::max(run_.deepest_voxels, deepest);
      poses_.emplace_back(pose, piece.id);
    }
  }

  World world_;
  Run run_;
  std::map<PieceId, std::vector<glm::vec3>> surfaces_;
  std::vector<std::pair<Pose, PieceId>> poses_;  ///< at every look
};

/// Runs the scene several times, and takes each tick's least time, to exclude other work of the machine.
Run play_scene(TerrainColliderKind kind, Tick ticks, int rounds) {
  Run least;
  for (int round = 0; round < rounds; ++round) {
    const Run run = Scene(kind).play(ticks);
    if (round == 0) {
      least = run;
      continue;
    }
    CHECK(run.state_hash == least.state_hash);
    for (size_t i = 0; i < run.bodies_ms.size(); ++i)
      least.bodies_ms[i] = std::min(least.bodies_ms[i], run.bodies_ms[i]);
  }
  return least;
}

void report_run(BenchReport& report, TerrainColliderKind kind, const Run& run) {
  const std::string name(name_of(kind));
  report.metric(name + "_pieces", static_cast<double>(run.made));
  report.metric(name + "_depth_mean_voxels", run.depth_sum / static_cast<double>(run.depths));
  report.metric(name + "_depth_worst_voxels", run.deepest_voxels);
  report.metric(name + "_fell_through", static_cast<double>(run.fallen.size()));
  report.metric(name + "_buried_at_the_end", static_cast<double>(run.buried));
  report.metric(name + "_left_the_world", static_cast<double>(run.lost));
  report.metric(name + "_bodies_median_ms", quantile(run.bodies_ms, 0.5));
  report.metric(name + "_bodies_p99_ms", quantile(run.bodies_ms, 0.99));
  if (kind != TerrainColliderKind::field) return;
  report.check("field_lets_nothing_through", run.fallen.empty() && run.lost == 0,
               fmt::format("{} of {} pieces fell through, {} left the world; wanted 0", run.fallen.size(),
                           run.made, run.lost));
}

/// The cost of finding contacts, at the same poses for each collider: those of one run, in order.
struct Contacts {
  double us_per_piece = 0.0;
  size_t found = 0;
};

Contacts time_contacts(TerrainColliderKind kind, Scene& lived) {
  const Field& field = lived.world().field();
  const auto collider = make_terrain_collider(kind, field);
  std::map<PieceId, std::unique_ptr<TerrainProbe>> probes;
  for (const auto& [id, points] : lived.surfaces()) probes[id] = collider->attach(points);
  const float reach_m = 0.5F * field.source().voxel_size_m;
  Contacts contacts;
  std::vector<TerrainContact> found;
  Stopwatch stopwatch;
  for (const auto& [pose, id] : lived.poses()) {
    found.clear();
    probes.at(id)->find(pose, reach_m, found);
    contacts.found += found.size();
  }
  contacts.us_per_piece = stopwatch.lap_ms() * 1e3 / static_cast<double>(lived.poses().size());
  return contacts;
}

/// A carve among pieces that lie around it: the time in which all read the ground again, and the time without
/// a change. Milliseconds, the least of some rounds.
struct Rebuild {
  double quiet_ms = 1e9;
  double after_carve_ms = 1e9;
  bool sees_the_hole = true;
};

Rebuild time_rebuild(TerrainColliderKind kind, int rounds) {
  constexpr int side = 8;
  constexpr float spacing_m = 0.7F, radius_m = 2.0F;
  const TerrainSource terrain;
  std::vector<glm::vec3> ball;
  for (int i = 0; i < 27; ++i) {
    const glm::vec3 corner(static_cast<float>(i / 9 - 1), static_cast<float>(i / 3 % 3 - 1),
                           static_cast<float>(i % 3 - 1));
    ball.push_back(0.3F * corner);
  }
  Rebuild best;
  for (int round = 0; round < rounds; ++round) {
    MapField field(terrain);
    const auto collider = make_terrain_collider(kind, field);
    std::vector<std::pair<std::unique_ptr<TerrainProbe>, Pose>> lying;
    for (int i = 0; i < side * side; ++i) {
      const float x = spacing_m * (static_cast<float>(i / side) - 0.5F * (side - 1));
      const float z = spacing_m * (static_cast<float>(i % side) - 0.5F * (side - 1));
      lying.emplace_back(collider->attach(ball), Pose{{x, ground_height_m(terrain, x, z) + 0.25F, z}});
    }
    const auto collect = [&] {
      std::vector<TerrainContact> found;
      for (const auto& [probe, pose] : lying) probe->find(pose, 0.1F, found);
      return found.size();
    };
    const size_t before = collect();
    Stopwatch stopwatch;
    collect();
    best.quiet_ms = std::min(best.quiet_ms, stopwatch.lap_ms());
    const CarveRequest blow = blow_at(terrain, 0.0F, 0.0F, radius_m, 64, 1);
    PieceTable pieces;
    const CarveOperation carve{blow.shape, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m, 1};
    apply(carve, field, pieces);
    const VoxelBox box = band_box(in_voxels(blow.shape, terrain.voxel_size_m));
    stopwatch.lap_ms();
    collider->terrain_changed(box);
    for (const auto& [probe, pose] : lying) probe->terrain_changed(box);
    const size_t after = collect();
    best.after_carve_ms = std::min(best.after_carve_ms, stopwatch.lap_ms());
    best.sees_the_hole = best.sees_the_hole && after < before;
  }
  return best;
}

}  // namespace

BenchReport run_colliders_bench(const BenchOptions& options) {
  const Tick ticks = options.quick ? 120 : 600;
  const int rounds = options.quick ? 1 : 3;
  BenchReport report;
  double done = 0.0;
  for (const TerrainColliderKind kind : all_kinds<TerrainColliderKind>) {
    report_run(report, kind, play_scene(kind, ticks, rounds));
    options.progress(0.3 * ++done);
  }
  Scene lived(TerrainColliderKind::field);
  lived.play(ticks);
  for (const TerrainColliderKind kind : all_kinds<TerrainColliderKind>) {
    const std::string name(name_of(kind));
    Contacts least = time_contacts(kind, lived);
    for (int round = 1; round < rounds; ++round)
      least.us_per_piece = std::min(least.us_per_piece, time_contacts(kind, lived).us_per_piece);
    report.metric(name + "_contacts_us_per_piece", least.us_per_piece);
    report.metric(name + "_contacts_found", static_cast<double>(least.found));
    const Rebuild rebuild = time_rebuild(kind, 4 * rounds);
    report.metric(name + "_quiet_look_ms", rebuild.quiet_ms);
    report.metric(name + "_rebuild_ms", rebuild.after_carve_ms - rebuild.quiet_ms);
    report.check(name + "_sees_the_hole", rebuild.sees_the_hole,
                 "fewer contacts after the carve than before");
  }
  options.progress(1.0);
  return report;
}

}  // namespace scree
