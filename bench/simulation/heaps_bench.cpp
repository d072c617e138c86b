#include <cmath>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/heap_shape.h"
#include "content/builtin_palette.h"
#include "server/world/world.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

constexpr const char* materials[] = {"rock", "concrete", "brick"};
constexpr float voxels_m[] = {0.15F, 0.25F, 0.5F};

/// The ball of stones that is dropped at once, and how high above the heap.
constexpr float ball_m = 1.2F, ball_voxels = 5.0F, height_m = 0.5F;
constexpr uint32_t stones_max = 40;
constexpr double stone_voxels = 14.0;

constexpr int quiet_ticks = 90, drop_ticks_max = 900, rest_ticks_max = 6000;

struct Heap {
  double bulk_m3 = 0.0, solid_m3 = 0.0, flank_deg = 0.0, steepest_deg = 0.0;
  double slide_ms = 0.0;
  size_t slides = 0, pieces = 0;
  MassUnits error = 0;

  double pores_percent() const { return 100.0 * (1.0 - solid_m3 / bulk_m3); }
  double swell() const { return bulk_m3 / solid_m3; }
};

class HeapScene {
 public:
  HeapScene(const char* material, float voxel_m) : voxel_m_(voxel_m), world_(config_of(voxel_m)) {
    material_ = *world_.config().palette->named(material);
    radius_m_ = std::max(ball_m, ball_voxels * voxel_m);
    reach_m_ = 4.5F * radius_m_ + 3.0F;
    ground_m3_ = HeapShape(world_.field(), box()).bulk_m3();
  }

  /// A ball of rock in the air, broken at once.
  void drop(uint32_t number) {
    const float top_m = static_cast<float>(HeapShape(world_.field(), box()).top_m());
    const auto off = [&](float turns) {
      return 0.15F * radius_m_ * std::sin(turns * static_cast<float>(number));
    };
    const glm::vec3 at(off(2.4F), std::max(top_m, 0.0F) + height_m + radius_m_, off(1.7F));
    const double voxels = 4.19 * std::pow(radius_m_ / voxel_m_, 3.0);
    CarveRequest carve;
    carve.shape = sphere(at, radius_m_ + 2.0F * voxel_m_);
    carve.pattern = SeedPattern::uniform;
    carve.seeds = std::min(stones_max, static_cast<uint32_t>(voxels / stone_voxels));
    carve.random_seed = number;
    carve.impact_m = at;
    carve.blast_speed_m_s = 0.0F;
    step({{1, 2 * number, FillRequest{sphere(at, radius_m_), material_}}, {1, 2 * number + 1, carve}});
    for (int tick = 0; tick < drop_ticks_max && !last_->pieces.empty(); ++tick) step({});
  }
  Heap rest() {
    for (int tick = 0, quiet = 0; tick < rest_ticks_max && quiet < quiet_ticks; ++tick) {
      const size_t before = heap_.slides;
      step({});
      const bool calm = last_->pieces.empty() && heap_.slides == before && last_->work.slides_put_off == 0;
      quiet = calm ? quiet + 1 : 0;
    }
    const HeapShape shape(world_.field(), box());
    heap_.bulk_m3 = shape.bulk_m3() - ground_m3_;
    heap_.solid_m3 =
        static_cast<double>(last_->ledger.terrain) / units_per_voxel * std::pow(double{voxel_m_}, 3.0);
    heap_.flank_deg = shape.flank_deg(0.0);
    heap_.steepest_deg = shape.steepest_deg();
    heap_.pieces = last_->pieces.size();
    return heap_;
  }

 private:
  static WorldConfig config_of(float voxel_m) {
    WorldConfig config;
    auto palette = std::make_shared<Palette>(*config.palette);
    palette->ground = {material::rock, material::rock, material::rock, 1.0F, 1.5F};
    config.palette = palette;
    config.terrain = {TerrainKind::flat, 1, voxel_m};
    config.terrain.rows = palette->ground;
    config.methods.impacts = false;
    return config;
  }
  VoxelBox box() const {
    const int reach = static_cast<int>(reach_m_ / voxel_m_);
    return {{-reach, -8, -reach}, {reach, reach, reach}};
  }
  void step(const std::vector<Command>& commands) {
    last_ = world_.step(commands);
    for (const AppliedOperation& applied : last_->operations)
      heap_.slides += std::holds_alternative<SlideOperation>(applied.operation) ? 1 : 0;
    heap_.slide_ms = std::max(heap_.slide_ms, last_->times[TickStage::slides]);
    heap_.error = std::max(heap_.error, std::abs(last_->ledger.error()));
  }

  float voxel_m_, radius_m_ = 0.0F, reach_m_ = 0.0F;
  World world_;
  Material material_{};
  std::shared_ptr<const TickDelta> last_;
  Heap heap_;
  double ground_m3_ = 0.0;
};

void tell(BenchReport& report, const std::string& name, const Heap& heap) {
  report.metric(name + "_bulk_m3", heap.bulk_m3);
  report.metric(name + "_solid_m3", heap.solid_m3);
  report.metric(name + "_slides", static_cast<double>(heap.slides));
  report.metric(name + "_slide_worst_ms", heap.slide_ms);
  const auto within = [&](const char* what, double got, double least, double most, const char* source) {
    report.metric(name + "_" + what, got);
    report.check(name + "_" + what, got >= least && got <= most,
                 fmt::format("{:.2f}, wanted {} to {} ({})", got, least, most, source));
  };
  within("pores_percent", heap.pores_percent(), 30.0, 45.0, "1 - 1/swell: 37 to 41 for the rocks below");
  within("swell", heap.swell(), 1.5, 1.7,
         "tables of bulking of blasted rock: basalt 1.6, gneiss 1.65, granite 1.7");
  within("angle_deg", heap.flank_deg, 33.0, 40.0,
         "coarse scree 32 to 36: Oxford Dictionary of Earth Sciences; angular rock up to 40");
  within("steepest_deg", heap.steepest_deg, 0.0, 41.0, "the steepest metre, likewise");
  report.check(name + "_ledger", heap.error == 0 && heap.pieces == 0,
               fmt::format("error {}, {} pieces left", heap.error, heap.pieces));
}

}  // namespace

BenchReport run_heaps_bench(const BenchOptions& options) {
  BenchReport report;
  const uint32_t drops = options.quick ? 3 : 20;
  double done = 0.0;
  for (const char* material : materials)
    for (const float voxel_m : voxels_m) {
      HeapScene scene(material, voxel_m);
      for (uint32_t number = 1; number <= drops; ++number) scene.drop(number);
      tell(report, fmt::format("{}_{:.2f}_m", material, voxel_m), scene.rest());
      options.progress(++done / 9.0);
    }
  return report;
}

}  // namespace scree
