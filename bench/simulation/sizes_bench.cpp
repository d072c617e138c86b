#include <fmt/format.h>
#include <map>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/size_law.h"
#include "server/fracture/relaxed_seeds.h"
#include "server/world/world.h"

namespace scree {

namespace {

const TerrainSource ground{TerrainKind::flat, 1, 0.25F};
constexpr float radii_m[] = {2.0F, 3.0F};
constexpr uint32_t seeds_wanted[] = {30, 100, 200};
constexpr SeedPattern patterns[] = {SeedPattern::uniform, SeedPattern::radial, SeedPattern::clustered,
                                    SeedPattern::even, SeedPattern::natural};
constexpr int ticks_max = 600;

/// What a carve made, until nothing waits for its cut.
struct Fragments {
  std::map<PieceId, std::shared_ptr<const Volume>> pieces;
  MassUnits dust = 0;
};

/// Sums over blows.
struct Figures {
  int blows = 0;
  double pieces = 0.0, near_over_far = 0.0;
  SizeLaw law;

  void add(const Fragments& made, const CarveRequest& blow) {
    std::vector<double> masses;
    std::vector<const Volume*> volumes;
    for (const auto& [id, volume] : made.pieces) {
      masses.push_back(static_cast<double>(volume->mass));
      volumes.push_back(volume.get());
    }
    const SizeLaw one = size_law_of(masses, static_cast<double>(made.dust));
    ++blows;
    pieces += static_cast<double>(masses.size());
    near_over_far += scree::near_over_far(volumes, blow.impact_m / ground.voxel_size_m);
    law.n += one.n;
    law.d90_over_d10 += one.d90_over_d10;
    law.fines += one.fines;
    law.fines_by_law += one.fines_by_law;
  }
  double mean(double sum) const { return sum / blows; }

  void tell(BenchReport& report, const std::string& name) const {
    report.metric(name + "_pieces", mean(pieces));
    report.metric(name + "_n", mean(law.n));
    report.metric(name + "_d90_over_d10", mean(law.d90_over_d10));
    report.metric(name + "_fines_percent", 100.0 * mean(law.fines));
    report.metric(name + "_fines_by_law_percent", 100.0 * mean(law.fines_by_law));
    report.metric(name + "_near_over_far", mean(near_over_far));
  }
};

CarveRequest blow_of(SeedPattern pattern, float radius_m, uint32_t seeds, uint32_t number) {
  CarveRequest blow = blow_at(ground, 0.37F * static_cast<float>(number), 0.0F, radius_m, seeds, number);
  blow.pattern = pattern;
  blow.blast_speed_m_s = 0.0F;
  return blow;
}

/// By the operation alone, which makes all pieces at once.
Fragments cut_at_once(const CarveRequest& blow) {
  MapField field(ground);
  PieceTable pieces;
  CarveOperation carve{blow.shape, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m, 1};
  if (is_relaxed(blow.pattern)) {
    for (const glm::vec3& seed :
         relaxed_seeds(blow.pattern, carved_volume(field, blow.shape), blow.seeds, blow.random_seed))
      carve.authored_m.push_back(seed * ground.voxel_size_m);
    carve.seeds = static_cast<uint32_t>(carve.authored_m.size());
  }
  const MassUnits dust = apply(carve, field, pieces).dust;
  return {pieces, dust};
}

/// By a world, in as many ticks as it takes.
Fragments cut_in_stages(const CarveRequest& blow) {
  WorldConfig config;
  config.terrain = ground;
  config.methods.recombine = Recombination::off;
  config.methods.impacts = false;
  World world(config);
  Fragments made;
  const Command command{1, 1, blow};
  bool waits = true;
  for (int tick = 0; tick < ticks_max && waits; ++tick) {
    const auto delta = tick == 0 ? world.step({&command, 1}) : world.step({});
    for (const SpawnedPiece& piece : delta->spawned) made.pieces[piece.id] = piece.volume;
    for (const AppliedOperation& applied : delta->operations)
      for (const PieceId id : pieces_ended_by(applied.operation)) made.pieces.erase(id);
    waits = delta->work.refractures_put_off > 0;
    made.dust = delta->ledger.dust;
  }
  return made;
}

template <typename Cut>
Figures figures_of(SeedPattern pattern, float radius_m, uint32_t seeds, uint32_t blows, Cut&& cut) {
  Figures figures;
  for (uint32_t number = 1; number <= blows; ++number) {
    const CarveRequest blow = blow_of(pattern, radius_m, seeds, number);
    figures.add(cut(blow), blow);
  }
  return figures;
}

void check_natural(BenchReport& report, const std::string& name, const Figures& figures) {
  const double n = figures.mean(figures.law.n), fines = 100.0 * figures.mean(figures.law.fines);
  report.check(name + "_n", n >= 0.8 && n <= 2.2,
               fmt::format("{:.2f}, that of blasted rock is 0.8 to 2.2", n));
  report.check(name + "_fines", fines >= 2.0 && fines <= 8.0,
               fmt::format("{:.1f} % of the mass, the law has {:.1f} below the smallest piece", fines,
                           100.0 * figures.mean(figures.law.fines_by_law)));
}

/// The gradient of radial, and the law of natural, where a world cuts in stages.
void report_stages_of(BenchReport& report, SeedPattern pattern, float radius_m, uint32_t seeds,
                      uint32_t blows) {
  const std::string name = fmt::format("{}_{:.0f}_m_{}_seeds", name_of(pattern), radius_m, seeds);
  const Figures at_once = figures_of(pattern, radius_m, seeds, blows, cut_at_once);
  const Figures staged = figures_of(pattern, radius_m, seeds, blows, cut_in_stages);
  at_once.tell(report, name + "_at_once");
  staged.tell(report, name + "_in_stages");
  if (is_cut_on(pattern)) {
    check_natural(report, name + "_in_stages", staged);
    return;
  }
  const double wanted = at_once.mean(at_once.near_over_far), got = staged.mean(staged.near_over_far);
  report.check(name + "_gradient", got <= 1.15 * wanted && got >= 0.85 * wanted,
               fmt::format("nearest to farthest third {:.2f} in stages, {:.2f} at once, wanted within 15 %",
                           got, wanted));
}

}  // namespace

BenchReport run_sizes_bench(const BenchOptions& options) {
  BenchReport report;
  const uint32_t blows = options.quick ? 4 : 16;
  double done = 0.0;
  for (const SeedPattern pattern : patterns)
    for (const float radius_m : radii_m)
      for (const uint32_t seeds : seeds_wanted) {
        const std::string name = fmt::format("{}_{:.0f}_m_{}_seeds", name_of(pattern), radius_m, seeds);
        const Figures figures = figures_of(pattern, radius_m, seeds, blows, cut_at_once);
        figures.tell(report, name);
        if (is_cut_on(pattern)) check_natural(report, name, figures);
        options.progress(++done / 40.0);
      }
  for (const SeedPattern pattern : {SeedPattern::radial, SeedPattern::natural}) {
    report_stages_of(report, pattern, 3.0F, 200, blows);
    report_stages_of(report, pattern, 4.0F, 300, blows);
    report_stages_of(report, pattern, 5.0F, 400, blows);
    options.progress((done += 5.0) / 40.0);
  }
  return report;
}

}  // namespace scree
