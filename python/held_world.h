// A world as Python holds it. One thread at a time uses it: a call while another one is under way raises
// `scree.Error`, so that the world itself never meets two threads. Between calls no thread owns it.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "server/store/event_deriver.h"
#include "server/world/world.h"

namespace scree::python {

/// What came of some ticks in a row.
struct Step {
  Tick tick = 0;
  std::vector<Reply> replies;
  std::vector<Event> events;
  Ledger ledger;
  uint64_t state_hash = 0, field_hash = 0;
  size_t operations = 0;
  std::vector<uint32_t> numbers;  ///< of the commands that were given
};

class HeldWorld {
 public:
  explicit HeldWorld(std::unique_ptr<World> world);

  World& world() { return *world_; }
  float voxel_m() const { return voxel_m_; }
  /// Gives the commands their numbers, by which replies name them.
  std::vector<uint32_t> number(std::span<Command> commands);
  /// One tick, whose results it adds. By who has the use of it; without Python's lock.
  void advance(std::span<const Command> commands, Step& step);
  /// Forgets what it followed of earlier ticks.
  void follow_anew();
  uint64_t state_hash() const;

 private:
  friend class Use;
  std::unique_ptr<World> world_;
  const float voxel_m_;
  std::atomic<bool> in_use_{false};
  uint32_t last_number_ = 0;
  std::unique_ptr<EventDeriver> events_;
};

using Held = std::shared_ptr<HeldWorld>;

/// The use of a world, until it goes out of scope: raises RaisedError where another thread has it.
class Use {
 public:
  explicit Use(HeldWorld& held);
  ~Use();
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  HeldWorld& held_;
};

}  // namespace scree::python
