#include "server/history/undo_run.h"

#include <algorithm>

#include "server/history/limits.h"
#include "shared/operation/limits.h"

namespace scree {

namespace {

/// Requests of an undo have numbers from here on: a host's own begin at 0.
constexpr uint32_t first_undo_request = 0x8000'0000U;

}  // namespace

UndoRun::UndoRun(uint32_t number, UndoPlan plan, std::vector<PieceId> pieces)
    : number_(number), plan_(std::move(plan)), pieces_(std::move(pieces)), next_request_(first_undo_request) {
  progress_.number = number;
  progress_.bricks_planned = plan_.bricks.size();
}

/// Pieces go first, so that none is buried; then bricks from the bottom up; at last the world looks at all of
/// it for what hangs loose.
void UndoRun::prepare(HistoryFile& file) {
  for (;;) {
    {
      const std::scoped_lock lock(mutex_);
      if (all_made_ || ready_.size() >= limits::undo_requests_ready) return;
      if (progress_.stopped) next_piece_ = pieces_.size(), next_brick_ = plan_.bricks.size();
    }
    RestoreRequest request;
    size_t lost = 0;
    if (next_piece_ < pieces_.size()) {
      while (next_piece_ < pieces_.size() && request.pieces.size() < limits::restored_pieces_max)
        request.pieces.push_back(pieces_[next_piece_++]);
    } else if (next_brick_ < plan_.bricks.size()) {
      const ChunkCoord chunk = chunk_of(plan_.bricks[next_brick_].image.brick);
      auto bricks = std::make_shared<std::vector<RestoreRequest::Brick>>();
      while (next_brick_ < plan_.bricks.size() && bricks->size() < limits::restored_bricks_max &&
             chunk_of(plan_.bricks[next_brick_].image.brick) == chunk) {
        const PlannedBrick& planned = plan_.bricks[next_brick_++];
        Result<BrickPatch> was =
            planned.exact ? Result<BrickPatch>(*planned.exact) : file.before(planned.image);
        if (!was) {
          ++lost;
          continue;
        }
        bricks->push_back({std::move(*was), planned.now});
      }
      touched_.insert(chunk);
      if (!bricks->empty()) request.bricks = std::move(bricks);
    } else {
      while (!touched_.empty() && request.loose.size() < limits::loose_chunks_max)
        request.loose.push_back(touched_.extract(touched_.begin()).value());
    }
    const bool is_last =
        next_piece_ == pieces_.size() && next_brick_ == plan_.bricks.size() && touched_.empty();
    const std::scoped_lock lock(mutex_);
    progress_.bricks_other += lost;
    ready_.push_back(std::move(request));
    all_made_ = is_last;
  }
}

std::vector<Command> UndoRun::due() {
  const std::scoped_lock lock(mutex_);
  std::vector<Command> commands;
  while (!ready_.empty() && waiting_.size() < limits::undo_requests_waiting) {
    // The world looks around once all is back.
    const auto has_bricks = [](const auto& one) { return one.second > 0; };
    if (!ready_.front().loose.empty() && std::ranges::any_of(waiting_, has_bricks)) break;
    const size_t bricks = ready_.front().bricks == nullptr ? 0 : ready_.front().bricks->size();
    waiting_[next_request_] = bricks;
    commands.push_back({0, next_request_++, std::move(ready_.front())});
    ready_.pop_front();
  }
  finish_if_done();
  return commands;
}

void UndoRun::note(const TickDelta& delta) {
  const std::scoped_lock lock(mutex_);
  if (progress_.over) return;
  size_t restored = 0;
  for (const AppliedOperation& applied : delta.operations)
    if (const auto* restore = std::get_if<RestoreOperation>(&applied.operation)) {
      restored += restore->bricks == nullptr ? 0 : restore->bricks->size();
      progress_.pieces_done += restore->pieces.size();
    }
  const size_t asked = take_answers(delta.replies);
  progress_.bricks_done += restored;
  progress_.bricks_other += asked - std::min(asked, restored);
  finish_if_done();
}

void UndoRun::refused(const std::vector<Reply>& replies) {
  const std::scoped_lock lock(mutex_);
  progress_.bricks_other += take_answers(replies);
  finish_if_done();
}

size_t UndoRun::take_answers(const std::vector<Reply>& replies) {
  size_t asked = 0;
  for (const Reply& reply : replies) {
    if (reply.session != 0) continue;
    const auto found = waiting_.find(reply.request);
    if (found == waiting_.end()) continue;
    asked += found->second;
    waiting_.erase(found);
    if (!reply.refusal.empty()) ++progress_.refused;
    progress_.gain += reply.mass.value_or(0);
  }
  return asked;
}

void UndoRun::finish_if_done() {
  if (progress_.over || wants_plan_ || !all_made_ || !ready_.empty() || !waiting_.empty()) return;
  wants_plan_ = progress_.bricks_other > 0 && !progress_.stopped && plans_ < limits::undo_plans_max;
  progress_.over = !wants_plan_;
}

bool UndoRun::wants_plan() const {
  const std::scoped_lock lock(mutex_);
  return wants_plan_;
}

void UndoRun::go_on(UndoPlan plan, std::vector<PieceId> pieces) {
  const std::scoped_lock lock(mutex_);
  wants_plan_ = false;
  ++plans_;
  if (plan.bricks.empty() && pieces.empty()) {
    progress_.over = true;
    return;
  }
  plan_ = std::move(plan);
  pieces_ = std::move(pieces);
  progress_.bricks_planned = progress_.bricks_done + plan_.bricks.size();
  next_brick_ = next_piece_ = 0;
  progress_.bricks_other = 0;
  all_made_ = false;
}

void UndoRun::stop() {
  const std::scoped_lock lock(mutex_);
  progress_.stopped = true;
  std::erase_if(ready_, [](const RestoreRequest& request) { return request.loose.empty(); });
}

UndoProgress UndoRun::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

}  // namespace scree
