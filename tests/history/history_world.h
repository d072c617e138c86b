// A world of flat ground, its history, and persons in it.
#pragma once

#include <future>
#include <gtest/gtest.h>

#include "server/history/edit_history.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"

namespace scree {

class HistoryWorld {
 public:
  explicit HistoryWorld(uint32_t mb_max = 64) : mb_max_(mb_max) {
    world.want_replaced(true);
    open();
  }

  void open(uint64_t number = 1) {
    history.reset();
    auto opened = EditHistory::open({.path = folder / "hill.world.history",
                                     .world = number,
                                     .tick = world.tick(),
                                     .tick_rate_hz = world.config().tick_rate_hz,
                                     .voxel_size_m = world.config().terrain.voxel_size_m,
                                     .mb_max = mb_max_});
    ASSERT_TRUE(opened.has_value()) << opened.error().message;
    history = std::move(*opened);
  }

  void join(uint64_t session, const std::string& name, const std::string& ip = "192.0.2.1") {
    history->joined({.session = session, .name = name, .ip = ip});
  }

  /// One tick, with what an undo asks for.
  std::shared_ptr<const TickDelta> step(std::vector<Command> commands = {}) {
    for (Command& command : history->due()) commands.push_back(std::move(command));
    auto delta = world.step(commands);
    steps.push_back(std::move(commands));
    hashes.push_back(delta->state_hash);
    history->note(delta);
    return delta;
  }
  void ask_world(uint64_t session, Request request) { step({{session, ++request_, std::move(request)}}); }
  /// Until nothing moves and nothing is taken back.
  void settle() {
    for (int i = 0; i < 3000; ++i) {
      const auto delta = step();
      if (delta->pieces.empty() && delta->work.requests_waiting == 0) break;
    }
  }

  template <typename Asked>
  Result<std::string> ask(const Asked& asked) {
    std::promise<Result<std::string>> said;
    const auto answer = [&](Result<std::string> text) { said.set_value(std::move(text)); };
    if constexpr (std::is_same_v<Asked, UndoRequest>)
      history->ask(asked, "the test", answer);
    else
      history->ask(asked, answer);
    return said.get_future().get();
  }
  /// Waits until the history has all ticks: a question is answered after them.
  void catch_up() { static_cast<void>(ask(HistoryRequest{})); }
  /// Steps until the undo that was begun is over.
  void finish_undo() {
    for (int i = 0; i < 20'000; ++i) {
      step();
      const auto said = ask(UndoRequest{.mode = UndoMode::progress, .as_json = true});
      ASSERT_TRUE(said.has_value());
      if (said->find("\"over\":true") != std::string::npos) return;
    }
    FAIL() << "the undo does not end";
  }

  BrickPatch brick_at(glm::vec3 p_m) const {
    const glm::vec3 v = p_m / world.config().terrain.voxel_size_m;
    const BrickCoord coord =
        brick_of(VoxelCoord{static_cast<int32_t>(v.x), static_cast<int32_t>(v.y), static_cast<int32_t>(v.z)});
    return {coord, world.field().brick(coord), world.field().materials(coord)};
  }

  TestFolder folder;
  World world{flat_world()};
  std::unique_ptr<EditHistory> history;
  std::vector<std::vector<Command>> steps;
  std::vector<uint64_t> hashes;

 private:
  uint32_t mb_max_;
  uint32_t request_ = 0;
};

inline uint64_t hash_of(const BrickPatch& brick) {
  return brick_hash(brick.coord, brick.brick, brick.materials);
}

}  // namespace scree
