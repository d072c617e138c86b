// Many worlds that are stepped on all cores at once. Each world is a part of the work by itself, so that its
// hashes are those of the same world alone. One call at a time; while it runs, its worlds are in use.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "python/excavation.h"
#include "python/held_world.h"
#include "shared/base/workers.h"

namespace scree::python {

/// How an episode runs.
struct Episode {
  Excavation task;
  int ticks = 6;    ///< of one action
  int steps = 100;  ///< actions, after which it is cut off
};

/// What came of one action in one world.
struct Outcome {
  double moved_m3 = 0.0;
  uint64_t state_hash = 0;
  bool refused = false;
};

class WorldBatch {
 public:
  /// `threads`: that take part, the caller's included; 0: as many as the machine has cores.
  WorldBatch(size_t count, size_t threads, const Episode& episode)
      : episode_(episode), workers_(threads), worlds_(count), used_steps_(count), is_over_(count) {}

  const Episode& episode() const { return episode_; }
  size_t size() const { return worlds_.size(); }
  size_t threads() const { return workers_.threads(); }
  std::vector<Held>& worlds() { return worlds_; }

  /// Calls `work` with the number of each world, on all threads. Without Python's lock; the work does not
  /// throw.
  void each(const std::function<void(size_t)>& work);

  /// So many ticks of each world, with its commands before the first.
  void advance(std::span<const std::vector<Command>> commands, int64_t ticks, std::span<Step> steps);
  /// The action of each world, three numbers a world, and its heights afterwards. Worlds that `begins` marks
  /// have just begun: their actions do not count.
  void act(std::span<const float> actions, std::span<const char> begins, std::span<Outcome> outcomes,
           std::span<float> heights_m);
  void observe(std::span<float> heights_m);

  /// World `i` begins an episode.
  void begin(size_t i, Held world) {
    worlds_[i] = std::move(world);
    used_steps_[i] = 0;
    is_over_[i] = 0;
  }
  /// Whether the last action ended the episode.
  bool is_over(size_t i) const { return is_over_[i] != 0; }

 private:
  friend class BatchUse;
  size_t heights_of_one() const {
    return static_cast<size_t>(episode_.task.cells) * static_cast<size_t>(episode_.task.cells);
  }
  Outcome act_in(HeldWorld& held, std::span<const float, 3> action) const;

  Episode episode_;
  Workers workers_;
  std::vector<Held> worlds_;
  std::vector<int> used_steps_;
  std::vector<char> is_over_;
  std::atomic<bool> in_use_{false};
};

/// The use of a batch and of its worlds, as Use. Those that have no world yet are left out.
class BatchUse {
 public:
  explicit BatchUse(WorldBatch& batch, bool with_worlds = true);
  ~BatchUse();
  BatchUse(const BatchUse&) = delete;
  BatchUse& operator=(const BatchUse&) = delete;

  /// From now on also of the worlds.
  void take_worlds();

 private:
  WorldBatch& batch_;
  std::vector<std::unique_ptr<Use>> worlds_;
};

}  // namespace scree::python
