// How long a client's kernels take: prints "name milliseconds" of each, the median of some places.
// Built twice, as native code and as WebAssembly, so that the two can be compared
// (docs/browser.md).
#include <algorithm>
#include <cstdio>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>

#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"

namespace scree {
namespace {

constexpr int places = 5;
constexpr int tries = 9;  ///< of which the shortest counts: other programs only make one longer
constexpr uint32_t seeds = 64;
const TerrainSource terrain{TerrainKind::noise, 3, 0.25F};

CarveOperation carve_at(int place, uint32_t pieces) {
  const float x_m = 12.0F * static_cast<float>(place);
  CarveOperation carve;
  const glm::vec3 at_m{x_m, ground_height_m(terrain, x_m, 0.0F) - 0.8F, 0.0F};
  carve.shape = crater(at_m, 2.0F);
  carve.pattern = SeedPattern::radial;
  carve.seeds = pieces;
  carve.random_seed = static_cast<uint32_t>(place);
  carve.impact_m = at_m;
  carve.first_piece = 1;
  return carve;
}

/// The median of the places, of the shortest of what `work` says of each.
double median_ms(const std::function<double(int)>& work) {
  std::vector<double> times;
  for (int place = 0; place < places; ++place) {
    double shortest = work(place);
    for (int i = 1; i < tries; ++i) shortest = std::min(shortest, work(place));
    times.push_back(shortest);
  }
  std::ranges::sort(times);
  return times[times.size() / 2];
}

/// Terrain whose bricks are generated already where the carve reads.
void warm(Field& field, const CarveOperation& carve) {
  static_cast<void>(carved_volume(field, carve.shape));
}

double carve_ms(int place, uint32_t pieces) {
  MapField field(terrain);
  PieceTable table;
  const CarveOperation carve = carve_at(place, pieces);
  warm(field, carve);
  Stopwatch stopwatch;
  static_cast<void>(apply(carve, field, table));
  return stopwatch.lap_ms();
}

/// The time to merge one piece of a carve where it was cut.
double merge_ms(int place) {
  MapField field(terrain);
  PieceTable table;
  static_cast<void>(apply(carve_at(place, 8), field, table));
  const PieceTable cut = table;
  Stopwatch stopwatch;
  for (const auto& [id, volume] : cut) {
    StampOperation stamp;
    stamp.piece = id;
    stamp.pose = quantise({volume->centre_voxels * terrain.voxel_size_m, {1.0F, 0.0F, 0.0F, 0.0F}});
    static_cast<void>(apply(stamp, field, table));
  }
  return stopwatch.lap_ms() / static_cast<double>(std::max<size_t>(cut.size(), 1));
}

/// From a frame's bytes to the mirror.
double message_ms(int place) {
  WelcomeMessage welcome;
  welcome.terrain = terrain;
  welcome.interest_radius_m = 96.0F;
  Mirror mirror(welcome);
  FrameMessage frame;
  frame.tick = 1;
  const CarveOperation carve = carve_at(place, seeds);
  frame.operations = {carve};
  warm(mirror.field(), carve);
  const std::vector<uint8_t> bytes = encode(ServerMessage(frame));
  Stopwatch stopwatch;
  const Result<ServerMessage> message = decode_server(std::span(bytes).subspan(length_prefix_bytes));
  if (!message || !mirror.apply(*message)) return -1.0;
  return stopwatch.lap_ms();
}

}  // namespace
}  // namespace scree

int main() {
  using namespace scree;
  std::printf("carve %.2f\n", median_ms([](int place) { return carve_ms(place, 1); }));
  std::printf("carve_into_%u_pieces %.2f\n", seeds,
              median_ms([](int place) { return carve_ms(place, seeds); }));
  std::printf("merge_of_a_piece %.2f\n", median_ms(merge_ms));
  std::printf("message_of_a_carve_into_%u %.2f\n", seeds, median_ms(message_ms));
}
