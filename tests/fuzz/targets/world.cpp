// Worlds of random commands: a configuration, then ticks with and without requests and changes of settings of
// any values; the same to a twin.
//
// Holds: the ledger balances after every tick (World::step checks it) and agrees with the field as measured;
// the twins have the same hashes at every tick. An input ends after so many ticks, and after so much work by
// the model.
#include "server/world/world.h"

#include <iterator>
#include <utility>
#include <vector>

#include "shared/base/check.h"
#include "tests/fuzz/support/any_request.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr Tick ticks_max = 64;
constexpr size_t commands_max = 16;
constexpr uint64_t work_max_us = 15'000;

WorldConfig any_config(FuzzInput& input) {
  constexpr float voxel_sizes_m[] = {1.0F, 1.0F, 1.0F, 2.0F, 2.0F, 2.0F, 0.5F, limits::voxel_size_min_m};
  constexpr uint32_t tick_rates_hz[] = {limits::tick_rate_min_hz, 20, 60, 240};
  WorldConfig config;
  config.terrain = {static_cast<TerrainKind>(input.below(kind_count<TerrainKind>)), input.byte(),
                    voxel_sizes_m[input.below(std::size(voxel_sizes_m))]};
  config.tick_rate_hz = tick_rates_hz[input.below(4)];
  config.pieces_max = input.flag() ? 2000 : 1 + input.byte();
  config.merges_per_tick_max = input.below(4) == 3 ? input.byte() : 1000;
  config.methods.support = input.flag();
  return config;
}

class Twins {
 public:
  explicit Twins(const WorldConfig& config) : one_(config), other_(config) {}

  bool may_go_on() const { return one_.tick() < ticks_max && work_us_ < work_max_us; }
  bool pieces_live() const { return pieces_live_; }

  void step(const std::vector<Command>& commands) {
    const auto delta = one_.step(commands);
    const auto same = other_.step(commands);
    CHECK(delta->field_hash == same->field_hash);
    CHECK(delta->state_hash == same->state_hash);
    CHECK(delta->ledger == same->ledger);
    CHECK(delta->replies.size() == same->replies.size());
    for (const Reply& reply : delta->replies) CHECK(reply.refusal.empty() == !reply.reason.has_value());
    work_us_ += delta->work.estimate_us;
    ledger_terrain_ = delta->ledger.terrain;
    pieces_live_ = !delta->pieces.empty();
  }
  void check_ledger() { CHECK_EQ(one_.measure_terrain(), ledger_terrain_); }

 private:
  World one_;
  World other_;
  uint64_t work_us_ = 0;
  MassUnits ledger_terrain_ = 0;
  bool pieces_live_ = false;
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  Twins twins(any_config(input));
  std::vector<Command> commands;
  uint32_t request = 0;
  while (!input.at_end() && twins.may_go_on()) {
    const uint64_t session = 1 + input.below(3);
    commands.push_back({session, ++request, any_request(input)});
    const uint32_t ticks = input.below(8);  // 0: with the next one
    if (commands.size() == commands_max) twins.step(std::exchange(commands, {}));
    for (uint32_t i = 0; i < ticks && twins.may_go_on(); ++i) twins.step(std::exchange(commands, {}));
  }
  do {
    twins.step(std::exchange(commands, {}));
  } while (twins.pieces_live() && twins.may_go_on());
  twins.check_ledger();
  return 0;
}
