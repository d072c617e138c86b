// What recordings hold of stores: by owner and by material, at every tick, forwards and after jumps.
#include <gtest/gtest.h>

#include "server/replay/replay_source.h"
#include "server/store/event_deriver.h"
#include "server/store/recorder.h"
#include "server/world/published_state.h"
#include "server/world/settings.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

/// What the state after a tick says of masses.
struct Masses {
  PublishedStores stores;
  Ledger ledger;
  MaterialLedger materials;

  bool operator==(const Masses&) const = default;
};

Masses masses_of(const PublishedState& state) {
  return {state.stores(), state.ledger(), state.materials()};
}

std::vector<Command> commands_at(Tick tick) {
  const StoreName own = store_of_person(0, 3), red = named_store("red");
  const auto x_m = static_cast<float>(tick) * 0.05F;
  switch (tick % 40) {
    case 5:
      return {{3, 1, DigRequest{sphere({x_m, 0.0F, 0.0F}, 1.0F)}}};
    case 12:
      return {{3, 2, PlaceRequest{sphere({x_m, 0.5F, 9.0F}, 0.5F), material::soil}}};
    case 20:
      return {{3, 3, TransferRequest{own, red, material::soil, 1000}}};
    case 30:
      return {{3, 4, DigRequest{sphere({x_m, -1.0F, 3.0F}, 1.0F), 0, {StoreKind::token, 0xAB}}}};
    default:
      return tick == 313 ? std::vector<Command>{{3, 0, LeaveRequest{}}} : std::vector<Command>();
  }
}

TEST(StoreRecording, replays_hold_every_store_at_every_tick) {
  constexpr Tick ticks = 400;
  TestFolder folder;
  const std::string path = folder / "session.scree";
  std::map<Tick, Masses> expected;
  size_t digs = 0, places = 0;
  {
    World world(flat_world());
    auto recorder = Recorder::create(path, {"test", flat_world()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    PublishedState state;
    EventDeriver deriver(flat_world().terrain.voxel_size_m, print(flat_world()));
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands = commands_at(tick);
      auto delta = world.step(commands);
      for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "") << tick;
      for (const Event& event : deriver.events_of(*delta)) {
        digs += event.kind == EventKind::dig && event.volume_m3 > 0.5F ? 1 : 0;
        places += event.kind == EventKind::place && event.volume_m3 > 0.1F ? 1 : 0;
      }
      state.apply(*delta);
      expected[tick] = masses_of(state);
      (*recorder)->push(std::move(delta), std::move(commands));
    }
    const auto finished = (*recorder)->finish();
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
  }
  EXPECT_EQ(digs, 20U);
  EXPECT_EQ(places, 10U);
  EXPECT_EQ(expected[300].stores.size(), 3U);
  EXPECT_TRUE(expected[ticks].stores.contains(worlds_store()));
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  PublishedState state;
  const auto expect_as_recorded = [&](const Result<std::shared_ptr<const TickDelta>>& delta) {
    ASSERT_TRUE(delta.has_value()) << delta.error().message;
    ASSERT_NE(*delta, nullptr);
    if (state.tick() != 0 && (*delta)->tick != state.tick() + 1) state = PublishedState();
    state.apply(**delta);
    if (state.tick() == 0) return;
    EXPECT_EQ(masses_of(state), expected.at(state.tick())) << state.tick();
  };
  for (Tick tick = 1; tick < ticks; ++tick) expect_as_recorded((*source)->next());
  PublishedState jumped;
  for (const Tick to : {Tick{50}, Tick{390}, Tick{200}, Tick{199}}) {
    ASSERT_TRUE((*source)->seek(to).has_value());
    const auto whole = (*source)->next();
    ASSERT_TRUE(whole.has_value() && *whole != nullptr);
    PublishedState there;
    there.apply(**whole);
    EXPECT_EQ(masses_of(there), expected.at(there.tick()));
  }
  expect_verifies(path);
}

}  // namespace
}  // namespace scree
