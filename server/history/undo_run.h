// An undo that is carried out: requests for the simulation, tick by tick, and what became of them. The
// history's thread makes requests ahead, the simulation's takes them: both may call. What changes meanwhile,
// as by pieces that merge, wants another plan, a few times.
#pragma once

#include <deque>
#include <mutex>
#include <set>
#include <vector>

#include "server/command/command.h"
#include "server/history/undo_plan.h"
#include "server/world/tick_delta.h"

namespace scree {

struct UndoProgress {
  uint32_t number = 0;
  size_t bricks_planned = 0;
  size_t bricks_done = 0;   ///< that went back
  size_t bricks_other = 0;  ///< that had changed since the plan was made, or could not be read: they stay
  size_t pieces_done = 0;
  MassUnits gain = 0;  ///< that was poured; less than 0: that was taken out
  size_t refused = 0;  ///< requests that the world refused
  bool stopped = false;
  bool over = false;

  bool operator==(const UndoProgress&) const = default;
};

class UndoRun {
 public:
  UndoRun(uint32_t number, UndoPlan plan, std::vector<PieceId> pieces);

  /// On the history's thread: makes requests ahead. `file` has the bricks.
  void prepare(HistoryFile& file);
  /// On the simulation's thread, before a tick: requests that it is to get.
  std::vector<Command> due();
  /// On the simulation's thread: after each tick; and replies to requests that it never got.
  void note(const TickDelta& delta);
  void refused(const std::vector<Reply>& replies);
  /// On the history's thread: whether all is done but for what changed meanwhile; and a plan for that. It is
  /// over where there is nothing to do.
  bool wants_plan() const;
  void go_on(UndoPlan plan, std::vector<PieceId> pieces);
  /// No more requests are made; those that wait are carried out.
  void stop();
  UndoProgress progress() const;
  AuthorId author() const { return undo_author(number_); }

 private:
  /// With the mutex, as the next one. Returns the bricks of the requests that are answered.
  size_t take_answers(const std::vector<Reply>& replies);
  void finish_if_done();

  const uint32_t number_;
  UndoPlan plan_;  ///< used by the history's thread alone, as the next ones
  std::vector<PieceId> pieces_;
  size_t next_brick_ = 0, next_piece_ = 0;
  std::set<ChunkCoord> touched_;

  mutable std::mutex mutex_;  ///< guards the members below
  std::deque<RestoreRequest> ready_;
  bool all_made_ = false, wants_plan_ = false;
  unsigned plans_ = 1;
  uint32_t next_request_;
  std::map<uint32_t, size_t> waiting_;  ///< bricks of a request, by its number
  UndoProgress progress_;
};

}  // namespace scree
