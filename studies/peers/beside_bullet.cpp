// The same pieces in the same flight: our bodies, and Bullet as it comes.
#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "bench/peers/stock_bullet.h"
#include "bench/support/scenes.h"
#include "server/formats/world_value.h"
#include "server/world/world.h"
#include "shared/base/timing.h"
#include "studies/peers/beside.h"

namespace scree {

namespace {

constexpr uint32_t seeds_per_blow = 64;
constexpr float spacing_m = 4.5F;
const VoxelBox ground_box{{-128, -96, -128}, {128, 128, 128}};
constexpr float fallen_m = 40.0F;  ///< below the origin: no ground is there

struct BlastScene {
  const char* name;
  const char* what;
  uint32_t blows_a_side;
  int seconds;  ///< stock Bullet takes five of these for each of the storm's
};
constexpr BlastScene scenes[] = {{"blast", "one blast", 1, 20}, {"storm", "16 blasts", 4, 10}};
constexpr int steps_per_s = 60;
constexpr int lives_of_ours = 5;  ///< odd

/// What became of the pieces.
struct Life {
  int steps = 0;
  int steps_moved = 0;  ///< the last step at which something moved
  double total_ms = 0.0;
  double first_second_ms = 0.0;  ///< of a step, on average
  size_t fallen = 0;             ///< below fallen_m at any step, or out of the world
  size_t lost = 0;               ///< out of the world, by any side
  float lowest_m = 0.0F;         ///< of all heights at all steps; 0: none was lower

  double step_ms() const { return total_ms / steps; }
  bool rests() const { return steps_moved < steps; }
  /// When nothing moved any more, or the length of it all.
  double rest_s() const { return static_cast<double>(std::min(steps_moved + 1, steps)) / steps_per_s; }
};

WorldConfig config_of(bool merging) {
  WorldConfig config;
  config.methods.impacts = config.methods.dents = config.methods.islands = false;
  if (!merging) config.merges_per_tick_max = 0;
  return config;
}

/// The blows, one a tick. Both worlds make the same pieces.
std::shared_ptr<const TickDelta> strike(World& world, const BlastScene& scene) {
  gather(world.field(), ground_box);
  BlowGrid blows(world.config().terrain, scene.blows_a_side, spacing_m, 2.0F, seeds_per_blow);
  std::shared_ptr<const TickDelta> last;
  for (uint32_t number = 0; const auto blow = blows.next(); ++number) {
    const Command command{0, number, *blow};
    last = world.step({&command, 1});
  }
  while (last->work.requests_waiting + last->work.refractures_put_off > 0) last = world.step({});
  return last;
}

/// The pieces of that world, as they fly now.
std::vector<peers::StockPiece> pieces_of(World& world, const TickDelta& now) {
  const WorldMoment moment = world.moment();
  std::vector<peers::StockPiece> pieces;
  for (size_t i = 0; i < moment.pieces.size(); ++i) {
    const BodyShape& shape = *moment.pieces[i].shape;
    const BodyMotion& motion = moment.motion.bodies[i];
    pieces.push_back({.hull_m = shape.hull_m,
                      .mass_kg = shape.mass_kg,
                      .friction = shape.friction,
                      .pose = dequantise(now.pieces[i].pose),
                      .velocity_m_s = motion.velocity_m_s,
                      .spin_rad_s = motion.spin_rad_s});
  }
  return pieces;
}

/// Steps either kind of world, to its last step before `end`. `observe`, whose time does not count, returns
/// whether anything still moves.
template <typename Step, typename Observe>
void live(Life& life, int end, Step step, Observe observe) {
  while (life.steps < end) {
    const double before_s = thread_cpu_s();
    step();
    life.total_ms += (thread_cpu_s() - before_s) * 1e3;
    if (++life.steps == steps_per_s) life.first_second_ms = life.total_ms / life.steps;
    if (observe(life)) life.steps_moved = life.steps;
  }
}

Life live_here(World& world, int steps) {
  std::shared_ptr<const TickDelta> last;
  std::set<PieceId> fallen;
  Life life;
  live(
      life, steps, [&] { last = world.step({}); },
      [&](Life& so_far) {
        for (const AppliedOperation& applied : last->operations)
          if (const auto* discarded = std::get_if<DiscardOperation>(&applied.operation)) {
            ++so_far.lost;
            fallen.insert(discarded->piece);
          }
        for (const PieceState& piece : last->pieces) {
          const float height_m = dequantise(piece.pose).position_m.y;
          so_far.lowest_m = std::min(so_far.lowest_m, height_m);
          if (height_m < -fallen_m) fallen.insert(piece.id);
        }
        return !last->pieces.empty();
      });
  life.fallen = fallen.size();
  return life;
}

/// Who does not rest within the session has its length: Bullet's makes the ratio a lower bound, Scree's makes
/// it void.
std::string rest_text(const Life& ours, const Life& theirs, int seconds) {
  const std::string text = "until the last lies still, s";
  if (!ours.rests()) return text + fmt::format(" (Scree: not within {} s, the ratio says nothing)", seconds);
  if (!theirs.rests())
    return text + fmt::format(" (Bullet: not within {} s, the ratio is at least this)", seconds);
  return text;
}

std::string rest_label(const Life& ours, const Life& theirs) {
  if (!ours.rests()) return "";
  return theirs.rests() ? "rest" : "rest at least";
}

Life one_life(const BlastScene& scene, bool merging, int steps) {
  World world(config_of(merging));
  strike(world, scene);
  return live_here(world, steps);
}

/// Lives that differ in nothing but their time: one with the median of each time.
Life typical(std::vector<Life> lives) {
  const auto middle = [&](double Life::*value) {
    std::ranges::nth_element(lives, lives.begin() + lives_of_ours / 2, {}, value);
    return lives[lives_of_ours / 2].*value;
  };
  Life life = lives.front();
  life.first_second_ms = middle(&Life::first_second_ms);
  life.total_ms = middle(&Life::total_ms);
  return life;
}

void run_scene(const BlastScene& scene, int seconds, PeerFindings& findings) {
  const int steps = seconds * steps_per_s;
  World struck(config_of(false));
  const auto now = strike(struck, scene);
  const std::vector<peers::StockPiece> pieces = pieces_of(struck, *now);
  peers::StockBullet bullet(struck.field(), ground_box);
  for (const peers::StockPiece& piece : pieces) bullet.add(piece);
  // In turns: a life of ours is short, and the machine's moods are long.
  std::vector<Life> lives_alone, lives_whole;
  Life stock;
  for (int i = 1; i <= lives_of_ours; ++i) {
    lives_alone.push_back(one_life(scene, false, steps));
    lives_whole.push_back(one_life(scene, true, steps));
    live(
        stock, steps * i / lives_of_ours, [&] { bullet.step(); }, [&](Life&) { return bullet.awake() > 0; });
  }
  stock.fallen = bullet.below(-fallen_m);
  const Life alone = typical(lives_alone), whole = typical(lives_whole);

  const auto put = [&](const std::string& name, const std::string& label, const std::string& what,
                       double noise_percent, double ours, double theirs) {
    Comparison& figure =
        findings.figure(fmt::format("{}_{}", scene.name, name),
                        fmt::format("{}, {} pieces: {}", scene.what, pieces.size(), what), noise_percent);
    if (!label.empty()) figure.label = fmt::format("{}, {}", scene.name, label);
    figure.ours.push_back(ours);
    figure.theirs.push_back(theirs);
  };
  put("first_second_ms", "", "a step while they fly, no merging, ms", 25.0, alone.first_second_ms,
      stock.first_second_ms);
  put("step_ms", "step", fmt::format("a step over {} s, no merging, ms", seconds), 15.0, alone.step_ms(),
      stock.step_ms());
  put("life_ms", "life", fmt::format("all of {} s, ours with merging, ms", seconds), 15.0, whole.total_ms,
      stock.total_ms);
  put("rest_s", rest_label(whole, stock), rest_text(whole, stock, seconds), 0.0, whole.rest_s(),
      stock.rest_s());
  findings.check(std::string(scene.name) + "_all_merged", whole.rests() && whole.lost == 0,
                 (whole.rests() ? fmt::format("no piece is left after {:.1f} s", whole.rest_s())
                                : fmt::format("some are still pieces after {} s", seconds)) +
                     fmt::format(", {} left the world", whole.lost));
  findings.check(
      std::string(scene.name) + "_none_falls_through", alone.fallen + whole.fallen == 0,
      fmt::format("{} of Scree's pieces at any step, the lowest at {:.1f} m; {} of Bullet's at the end",
                  alone.fallen + whole.fallen, std::min(alone.lowest_m, whole.lowest_m), stock.fallen));
}

/// What a carve costs who collides with triangles; our bodies read the field itself.
void run_rebuild(PeerFindings& findings) {
  World world(config_of(false));
  strike(world, scenes[0]);
  peers::StockBullet bullet(world.field(), ground_box);
  const double before_s = thread_cpu_s();
  bullet.rebuild_ground(world.field(), ground_box);
  findings
      .figure("rebuild_ms",
              fmt::format("the ground's {} triangles made anew after a carve, ms (ours reads the field)",
                          bullet.triangles()),
              15.0)
      .theirs.push_back((thread_cpu_s() - before_s) * 1e3);
}

}  // namespace

PeerFindings beside_bullet(const PeerOptions& options) {
  PeerFindings findings;
  findings.peer = "Bullet " + peers::StockBullet::version() + ", stock";
  findings.name = "bullet";
  findings.conditions = {
      "Balls of 2 m are struck out of hills of 0.25 m voxels, each into 64 Voronoi cells. Bullet gets the "
      "pieces as they are in Scree after the last blow: the same hulls, masses, poses and speeds. There "
      "they fall on a `btBvhTriangleMeshShape` of the same carved ground, 64 m wide, as "
      "`btConvexHullShape`s with the default margin, by the default broadphase, dispatcher, solver (10 "
      "iterations) and sleeping.",
      "Steps are 1/60 s, on one thread; times are the thread's processor time. Scree's is that of the "
      "whole tick, hashes and poses included, the median of five lives of the same pieces, each followed by "
      "a "
      "fifth of Bullet's only one, which takes longer than all of ours. No merging: pieces stay bodies, as "
      "Bullet's do. With "
      "merging, pieces at rest become terrain, as in a session. Pieces do not break again in either.",
      "Rest is the time from the last blow until Scree has no piece left, and until Bullet has put all to "
      "sleep; what has not come to rest when the session ends has the session's length."};
  const size_t count = options.quick ? 1 : std::size(scenes);
  for (int run = 0; run < options.runs; ++run) {
    for (size_t i = 0; i < count; ++i) {
      run_scene(scenes[i], options.quick ? 2 : scenes[i].seconds, findings);
      options.progress((run + static_cast<double>(i + 1) / static_cast<double>(count)) / options.runs);
    }
    run_rebuild(findings);
  }
  return findings;
}

}  // namespace scree
