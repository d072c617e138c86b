// Scenes whose ticks are dear, with what each tick cost by the clock and by the model of work
// (server/work/work.h). What a scene builds before it begins does not count. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "server/world/world.h"

namespace scree {

struct TickCost {
  StageTimes times;
  TickWork work;
  uint64_t state_hash = 0;

  double ms() const { return times.total_ms(); }
  double model_ms() const { return 1e-3 * work.estimate_us; }
};

/// A world, with the costs of its ticks since begin().
class PricedScene {
 public:
  explicit PricedScene(const WorldConfig& config) : world_(config) {}

  void step(const std::vector<Command>& commands = {});
  void ask(const Request& request) { step({{0, 0, request}}); }
  /// Steps until no piece is left, two seconds at least.
  void settle(int ticks_max);
  /// Fills a box of terrain in parts that a fill may have.
  void build(glm::vec3 lo_m, glm::vec3 size_m);
  /// Generates the ground about a shape, as far as a blow's search goes; a server's threads do that before
  /// (server/app/terrain_ahead.h).
  void generate(const Shape& shape);
  void begin() { costs_.clear(); }
  const std::vector<TickCost>& costs() const { return costs_; }
  const TerrainSource& terrain() const { return world_.config().terrain; }

 private:
  World world_;
  size_t alive_ = 0;
  std::vector<TickCost> costs_;
};

/// A world of flat ground, 0.25 m a voxel.
WorldConfig flat_config();

/// A carve of `shape` that throws nothing.
CarveRequest still_carve(const Shape& shape, uint32_t seeds);

/// A slab of 60 × 20 × 6 m stands; a slit of half a metre cuts through it at that height.
std::vector<TickCost> cut_slab(float height_m);

/// One carve, on flat ground.
std::vector<TickCost> large_carve(Cutter cutter, float radius_m, uint32_t seeds);

/// The largest carves into few pieces, each where nobody was before; the pieces merge whole.
std::vector<TickCost> large_pieces(int carves);

/// Each tick's least time, stage by stage, over several runs of the same scene, to exclude other work of the
/// machine. The runs must be the same, bit for bit.
std::vector<TickCost> least_of(int runs, const std::function<std::vector<TickCost>()>& play);

}  // namespace scree
