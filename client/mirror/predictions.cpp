#include "client/mirror/predictions.h"

#include <algorithm>
#include <iterator>

#include "client/mirror/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/operation/price.h"

namespace scree {

namespace {

/// Whether the server's operation is what it made of the request of a predicted one. The pieces of a carve
/// may be fewer, and cut otherwise.
bool answers(const Operation& operation, const Operation& predicted) {
  return std::visit(Overloaded{[&](const CarveOperation& ours) {
                                 const auto* theirs = std::get_if<CarveOperation>(&operation);
                                 return theirs != nullptr && theirs->shape == ours.shape &&
                                        theirs->impact_m == ours.impact_m &&
                                        theirs->random_seed == ours.random_seed;
                               },
                               [&](const auto& ours) {
                                 const auto* theirs = std::get_if<std::decay_t<decltype(ours)>>(&operation);
                                 return theirs != nullptr && *theirs == ours;
                               }},
                    predicted);
}

/// Nothing for a request that edits nothing. Places that only the server can compute are scattered instead;
/// the cutter is the cheapest, whichever the server's is.
std::optional<Operation> operation_of(const Request& asked) {
  using Made = std::optional<Operation>;
  return std::visit(Overloaded{[](const CarveRequest& carve) -> Made {
                                 CarveOperation made{.shape = carve.shape,
                                                     .pattern = carve.pattern,
                                                     .seeds = carve.seeds,
                                                     .random_seed = carve.random_seed,
                                                     .impact_m = carve.impact_m,
                                                     .authored_m = carve.authored_m};
                                 if (is_relaxed(made.pattern)) made.pattern = plain_pattern;
                                 return made;
                               },
                               [](const FillRequest& fill) -> Made {
                                 return FillOperation{fill.shape, fill.material};
                               },
                               [](const PaintRequest& paint) -> Made {
                                 return PaintOperation{paint.shape, paint.material};
                               },
                               [](const DigRequest& dig) -> Made {
                                 if (dig.piece != 0) return std::nullopt;
                                 return DigOperation{dig.shape};
                               },
                               [](const auto&) -> Made { return std::nullopt; }},
                    asked);
}

}  // namespace

bool Predictions::foresee(uint32_t request, const Request& asked, double now_s,
                          const std::function<bool(ChunkCoord)>& known) {
  if (predictions_.size() >= limits::predictions_max) return false;
  const std::optional<Operation> operation = operation_of(asked);
  const float voxel_size_m = mirror_.terrain().voxel_size_m;
  if (!operation || !validate(*operation, {}, voxel_size_m)) return false;
  const VoxelBox reads = read_box(*operation, {}, voxel_size_m);
  bool all_known = true;
  for_each_chunk(reads, [&](ChunkCoord chunk) { all_known = all_known && known(chunk); });
  const float work_us = price_us(*operation, mirror_.field(), {});
  float all_us = work_us;
  for (const Prediction& other : predictions_) all_us += other.work_us;
  if (!all_known || all_us > limits::predictions_work_max_us) return false;
  predictions_.push_back({request, *operation, now_s + limits::prediction_seconds_max, work_us, reads, {}});
  carry_out(predictions_.back());
  return true;
}

/// Lays the prediction over those before it.
void Predictions::carry_out(Prediction& prediction) {
  if (!layer_) layer_ = std::make_unique<MapField>(&mirror_.field());
  if (next_piece_ > UINT32_MAX - limits::seeds_max) next_piece_ = first_predicted_piece;
  if (auto* carve = std::get_if<CarveOperation>(&prediction.operation)) carve->first_piece = next_piece_;
  const Applied applied = apply(prediction.operation, *layer_, pieces_);
  next_piece_ += static_cast<PieceId>(applied.created.size());
  prediction.changed = applied.changed;
  changes_.bricks.insert(changes_.bricks.end(), applied.changed.begin(), applied.changed.end());
  for (const CreatedPiece& piece : applied.created) changes_.pieces_added.push_back(piece.id);
}

template <typename Goes>
void Predictions::remove(Goes&& goes) {
  const auto gone = std::stable_partition(predictions_.begin(), predictions_.end(),
                                          [&](const Prediction& prediction) { return !goes(prediction); });
  if (gone == predictions_.end()) return;
  stale_ = true;
  for (auto each = gone; each != predictions_.end(); ++each)
    std::ranges::copy(each->changed, std::back_inserter(changes_.bricks));
  predictions_.erase(gone, predictions_.end());
}

void Predictions::notice(const ServerMessage& message) {
  if (predictions_.empty()) return;
  if (const auto* reply = std::get_if<ReplyMessage>(&message))
    return remove([&](const Prediction& prediction) { return prediction.request == reply->request; });
  if (std::holds_alternative<ResetMessage>(message)) return revert();
  const auto* frame = std::get_if<FrameMessage>(&message);
  if (frame == nullptr) return;
  remove([&](const Prediction& prediction) {
    return std::ranges::any_of(frame->operations, [&](const Operation& operation) {
      return answers(operation, prediction.operation);
    });
  });
}

void Predictions::revert() {
  remove([](const Prediction&) { return true; });
}

bool Predictions::reads_any(const std::vector<BrickCoord>& bricks) const {
  return std::ranges::any_of(predictions_, [&](const Prediction& prediction) {
    const BrickCoord lo = brick_of(prediction.reads.lo);
    const BrickCoord hi = brick_of(prediction.reads.hi - VoxelCoord{1, 1, 1});
    return std::ranges::any_of(bricks, [&](BrickCoord brick) {
      return brick.x >= lo.x && brick.y >= lo.y && brick.z >= lo.z && brick.x <= hi.x && brick.y <= hi.y &&
             brick.z <= hi.z;
    });
  });
}

void Predictions::drop_layer() {
  for (const Prediction& prediction : predictions_)
    std::ranges::copy(prediction.changed, std::back_inserter(changes_.bricks));
  for (const auto& [id, volume] : pieces_) changes_.pieces_removed.push_back(id);
  pieces_.clear();
  layer_.reset();
  stale_ = false;
}

void Predictions::settle(double now_s, MirrorChanges& changes) {
  remove([&](const Prediction& prediction) { return now_s >= prediction.until_s; });
  if (stale_ || reads_any(changes.bricks)) {
    drop_layer();
    for (Prediction& prediction : predictions_) carry_out(prediction);
  }
  CHECK(predictions_.empty() == (layer_ == nullptr));
  const auto move_to = [](auto& to, auto& from) {
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
  };
  move_to(changes.bricks, changes_.bricks);
  move_to(changes.pieces_added, changes_.pieces_added);
  move_to(changes.pieces_removed, changes_.pieces_removed);
}

}  // namespace scree
