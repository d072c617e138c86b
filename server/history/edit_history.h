// The memory of a world: who edited it, and what it was before. Administrators ask it, and have it take back
// what somebody did.
//
// It follows the ticks that the simulation hands over, on a thread of its own, and keeps what they say in a
// file beside the world's. An edit has its author, a brick its runs of edits, each with the brick as it was
// before, and a piece its maker. It is no part of the world: without it, a world and its recording are the
// same. So it may forget: the oldest first, and whatever cannot be written. An undo goes by hashes: a brick
// that is not as the history knows it stays as it is.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "proto/admin_message.h"
#include "server/command/command.h"
#include "server/command/joined_person.h"
#include "server/history/limits.h"
#include "server/store/retry_pause.h"
#include "server/world/tick_delta.h"

namespace scree {

struct HistoryConfig {
  std::string path;
  uint64_t world = 0;  ///< WelcomeMessage::world
  Tick tick = 0;       ///< at which the world stands
  uint32_t tick_rate_hz = 60;
  float voxel_size_m = 0.25F;
  uint32_t mb_max = limits::history_mb;
};

/// The terrain after a tick of the world's recording; empty: there is none. On the history's thread.
using TerrainThen = std::function<Result<std::unique_ptr<Field>>(Tick)>;

struct HistoryStatus {
  StoreHealth health;  ///< lost are ticks with edits
  uint64_t bytes = 0;
  uint64_t edits = 0;  ///< since the start of the server
};

class EditHistory {
 public:
  using Answer = std::function<void(Result<std::string>)>;

  static Result<std::unique_ptr<EditHistory>> open(const HistoryConfig& config, TerrainThen then = {});
  /// Calls finish().
  ~EditHistory();
  EditHistory(const EditHistory&) = delete;
  EditHistory& operator=(const EditHistory&) = delete;

  /// Somebody joined. From any thread.
  void joined(const JoinedPerson& person);
  /// On the simulation's thread, before a tick: what an undo asks of it.
  std::vector<Command> due();
  /// On the simulation's thread, after each tick; World::want_replaced() is on.
  void note(std::shared_ptr<const TickDelta> delta);
  /// On the simulation's thread: replies to requests that no tick got.
  void refused(const std::vector<Reply>& replies);
  /// Waits until what happened up to that tick is in the file, limits::history_patience_s at most. From the
  /// thread that saves the world, so that the world's file is never ahead.
  void commit_up_to(Tick tick);
  /// Answers later, on the history's thread, with words or JSON. `who` asks, in words. From any thread.
  void ask(const HistoryRequest& request, Answer answer);
  void ask(const UndoRequest& request, const std::string& who, Answer answer);
  /// From any thread.
  HistoryStatus status() const;
  /// Writes what waits, and ends.
  void finish();

 private:
  struct State;
  explicit EditHistory(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
