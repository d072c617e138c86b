#include "server/publish/client_view.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "server/publish/chunks_near.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"
#include "shared/field/chunk_distance.h"

namespace scree {

namespace {

uint32_t fold(uint64_t hash) {
  return static_cast<uint32_t>(hash >> 32U) ^ static_cast<uint32_t>(hash);
}

glm::vec3 place_of(const QuantisedPose& pose) {
  return glm::vec3(pose.x, pose.y, pose.z) / pose_steps_per_m;
}

constexpr uint64_t all_bricks = ~uint64_t{0};
static_assert(chunk_bricks * chunk_bricks * chunk_bricks == 64);

uint64_t bits_of(const std::vector<const BrickState*>& bricks) {
  uint64_t bits = 0;
  for (const BrickState* brick : bricks) bits |= uint64_t{1} << index_in_chunk(brick->coord);
  return bits;
}

ChunkCoord coord_of(ChunkCoord chunk) {
  return chunk;
}
ChunkCoord coord_of(const std::pair<const ChunkCoord, uint64_t>& stale) {
  return stale.first;
}

uint32_t check_of(const ChunkSet& chunks, const PublishedState& state) {
  uint64_t sum = 0;
  for (const ChunkCoord chunk : chunks) {
    const auto found = state.chunks().find(chunk);
    if (found != state.chunks().end()) sum += found->second.hash;
  }
  return fold(sum);
}

}  // namespace

ClientView::ClientView(glm::vec3 eye_m, float radius_m, size_t operations)
    : eye_m_(eye_m),
      radius_m_(radius_m),
      next_eye_m_(eye_m),
      next_radius_m_(radius_m),
      operations_(operations),
      patch_credit_bricks_(limits::patch_bricks_max) {
  CHECK(radius_m >= 0.0F);
}

void ClientView::set_interest(glm::vec3 eye_m, float radius_m) {
  CHECK(radius_m >= 0.0F);
  next_eye_m_ = eye_m;
  next_radius_m_ = radius_m;
  rescan_due_ = true;
}

void ClientView::reset() {
  held_.clear();
  stale_.clear();
  wanted_.clear();
  known_.clear();
  sent_poses_.clear();
  stepped_ = 0;
  rescan_due_ = true;
  rescanned_ = 0;
}

float ClientView::distance_m(ChunkCoord chunk, float voxel_size_m) const {
  return distance_to_chunk_m(eye_m_, chunk, voxel_size_m);
}

bool ClientView::may_see(ChunkCoord chunk, float voxel_size_m) const {
  return distance_to_chunk_m(next_eye_m_, chunk, voxel_size_m) <=
         next_radius_m_ * limits::interest_keep_factor;
}

bool ClientView::near(ChunkCoord chunk, float voxel_size_m) const {
  return distance_m(chunk, voxel_size_m) <= radius_m_;
}

bool ClientView::near(glm::vec3 place_m, float factor) const {
  const glm::vec3 off_m = place_m - eye_m_;
  const float within_m = radius_m_ * factor;
  return glm::dot(off_m, off_m) <= within_m * within_m;
}

/// Whether the client knows the operation and has, bit for bit, every brick that it reads: in held chunks,
/// and in chunks that nothing but operations of this frame has ever changed.
bool ClientView::can_apply(size_t operation, const TickChanges& changes, const ChunkSet& tainted) const {
  if (changes.delta.operations[operation].operation.index() >= operations_) return false;
  const auto is_tainted = [&](ChunkCoord chunk) { return tainted.contains(chunk); };
  const auto is_held = [&](ChunkCoord chunk) { return held_.contains(chunk); };
  const AppliedOperation& applied = changes.delta.operations[operation];
  if (!tainted.empty() &&
      (std::ranges::any_of(applied.reads, is_tainted) || std::ranges::any_of(applied.writes, is_tainted)))
    return false;
  // After a jump back, a client that reads slowly may still have the piece that the operation makes again.
  const auto has = [this](PieceId piece) { return known_.contains(piece); };
  return std::ranges::none_of(applied.created, has) &&
         std::ranges::all_of(changes.needs[operation], is_held) &&
         std::ranges::includes(tiles_, changes.tiles[operation]) &&
         std::ranges::all_of(changes.ended[operation], [this](PieceId piece) { return knows(piece); });
}

bool ClientView::concerns(size_t operation, const TickChanges& changes) const {
  const AppliedOperation& applied = changes.delta.operations[operation];
  if (std::ranges::any_of(changes.ended[operation], [this](PieceId piece) { return knows(piece); }))
    return true;
  const auto followed = [&](ChunkCoord chunk) {
    return held_.contains(chunk) || near(chunk, changes.voxel_size_m);
  };
  if (std::ranges::any_of(applied.writes, followed)) return true;
  return std::ranges::any_of(applied.created, [&](PieceId id) {
    const auto piece = changes.state.pieces().find(id);
    return piece != changes.state.pieces().end() && near(place_of(piece->second.pose), 1.0F);
  });
}

bool ClientView::forget(PieceId piece) {
  const auto known = known_.find(piece);
  sent_poses_.erase(piece);
  return known != known_.end() && !std::exchange(known->second.gone, true);
}

size_t ClientView::known_pieces() const {
  return static_cast<size_t>(
      std::ranges::count_if(known_, [](const auto& known) { return !known.second.gone; }));
}

void ClientView::select_operations(const TickChanges& changes, FrameSelection& frame, ChunkSet& tainted,
                                   ChunkSet& changed) {
  for (uint32_t i = 0; i < changes.delta.operations.size(); ++i) {
    const AppliedOperation& operation = changes.delta.operations[i];
    const std::vector<PieceId>& ended = changes.ended[i];
    if (!can_apply(i, changes, tainted) || !concerns(i, changes)) {
      tainted.insert(operation.writes.begin(), operation.writes.end());
      for (const PieceId id : ended)
        if (forget(id)) frame.removed.push_back(id);
      continue;
    }
    frame.operations.push_back(i);
    changed.insert(operation.writes.begin(), operation.writes.end());
    // A written chunk beyond the interest is followed, too, until the next scan drops it. Others are held.
    for (const ChunkCoord chunk : changes.opens[i])
      if (held_.insert(chunk).second && !near(chunk, changes.voxel_size_m)) rescan_due_ = true;
    const std::optional<PieceId> parent = parent_of(operation.operation);
    const bool has_motion = !parent || (knows(*parent) && known_.at(*parent).has_motion);
    for (const PieceId id : operation.created) known_[id] = {.has_motion = has_motion};
    for (const PieceId id : ended) forget(id);
  }
}

/// Bricks that the frame may patch.
size_t ClientView::patch_room(size_t most) {
  if (has_kernels()) return most;
  patch_credit_bricks_ =
      std::min(patch_credit_bricks_ + limits::patch_bricks_per_tick, limits::patch_bricks_max);
  return std::min(most, patch_credit_bricks_);
}

void ClientView::select_patches(const TickChanges& changes, const ChunkSet& tainted, size_t room,
                                FrameSelection& frame, ChunkSet& changed) {
  std::vector<std::pair<float, ChunkCoord>> order;
  for (const ChunkCoord chunk : tainted) order.emplace_back(distance_m(chunk, changes.voxel_size_m), chunk);
  std::ranges::sort(order);
  size_t bricks = 0;
  for (const auto& [distance, chunk] : order) {
    const auto found = changes.bricks.find(chunk);
    if (found == changes.bricks.end()) continue;
    const bool is_held = held_.contains(chunk);
    const bool is_near = distance <= radius_m_;
    const bool complete = is_held || (is_near && changes.fresh.contains(chunk) && !stale_.contains(chunk));
    if (complete && bricks + found->second.size() <= room) {
      bricks += found->second.size();
      frame.patched.push_back(chunk);
      held_.insert(chunk);
      changed.insert(chunk);
      continue;
    }
    miss(chunk, bits_of(found->second));
    if (is_held || is_near) wanted_.insert(chunk);
  }
  if (!has_kernels()) patch_credit_bricks_ -= bricks;
}

/// Follows the eye: edited chunks that came into the interest are wanted, chunks that left it are dropped.
void ClientView::rescan(const TickChanges& changes, const ChunkSet& changed, FrameSelection& frame) {
  eye_m_ = next_eye_m_;
  radius_m_ = next_radius_m_;
  rescan_due_ = false;
  rescanned_ = changes.delta.tick;
  const float keep_m = radius_m_ * limits::interest_keep_factor;
  const auto drop_far = [&](auto& chunks) {
    std::erase_if(chunks, [&](const auto& entry) {
      const ChunkCoord chunk = coord_of(entry);
      if (distance_m(chunk, changes.voxel_size_m) <= keep_m) return false;
      if (changed.contains(chunk)) {  // this frame's check covers it: the next scan drops it
        rescan_due_ = true;
        return false;
      }
      frame.dropped.push_back(chunk);
      return true;
    });
  };
  drop_far(held_);
  drop_far(stale_);
  wanted_.clear();
  for_each_chunk_near(changes.state.chunks(), eye_m_, radius_m_, changes.voxel_size_m, [&](ChunkCoord chunk) {
    if (!held_.contains(chunk)) wanted_.insert(chunk);
  });
  for (const auto& [chunk, lacking] : stale_) wanted_.insert(chunk);
}

void ClientView::select_pose(const TrackedMotion& piece, const TickChanges& changes, Known& known,
                             FrameSelection& frame) {
  if (!has_kernels()) {
    const QuantisedPose& pose = piece.target.pose;
    const auto [sent, is_first] = sent_poses_.try_emplace(piece.id, pose);
    if (is_first || sent->second != pose) frame.moved.push_back({piece.id, pose});
    sent->second = pose;
    return;
  }
  // The client's motion is of the step before, or the piece has rested since the last one that it got.
  const bool follows = stepped_ == changes.motions.stepped_before() || piece.changed <= stepped_;
  (known.has_motion && follows ? frame.steps : frame.wholes).push_back(piece.id);
  known.has_motion = true;
}

void ClientView::select_poses(const TickChanges& changes, FrameSelection& frame) {
  CHECK_EQ(changes.motions.stepped(), changes.delta.tick);
  const std::vector<TrackedMotion>& alive = changes.motions.all();
  auto piece = alive.begin();
  bool moves = false;
  if (has_kernels()) frame.steps.reserve(known_.size());
  auto retained = known_.begin();
  for (auto known = known_.begin(); known != known_.end(); ++known) {
    if (known->second.gone) continue;
    while (piece != alive.end() && piece->id < known->first) ++piece;
    if (piece == alive.end() || piece->id != known->first ||
        !near(piece->place_m, limits::interest_keep_factor)) {
      frame.removed.push_back(known->first);
      sent_poses_.erase(known->first);
      continue;
    }
    select_pose(*piece, changes, known->second, frame);
    moves = moves || piece->changed == changes.delta.tick;
    if (retained != known) *retained = *known;
    ++retained;
  }
  known_.erase(retained, known_.end());
  if (!moves && frame.wholes.empty()) frame.steps.clear();  // all rest where the client has them
  stepped_ = changes.delta.tick;
}

bool ClientView::is_sound(const ChunkSet& changed) const {
  const auto is_held = [this](ChunkCoord chunk) { return held_.contains(chunk); };
  return std::ranges::all_of(changed, is_held) && std::ranges::none_of(wanted_, is_held) &&
         std::ranges::all_of(stale_, [&](const auto& stale) {
           return !is_held(stale.first) && wanted_.contains(stale.first);
         });
}

/// No patch takes an edit back: such a chunk comes whole, or is dropped when it has none left.
void ClientView::select_reverted(const TickChanges& changes, FrameSelection& frame, ChunkSet& tainted) {
  for (const ChunkCoord chunk : changes.reverted) {
    tainted.erase(chunk);
    if (changes.state.chunks().contains(chunk)) {
      miss(chunk, all_bricks);
      if (near(chunk, changes.voxel_size_m)) wanted_.insert(chunk);
      continue;
    }
    wanted_.erase(chunk);
    if (held_.erase(chunk) + stale_.erase(chunk) != 0) frame.dropped.push_back(chunk);
  }
}

FrameSelection ClientView::select_frame(const TickChanges& changes, FrameScope parts) {
  CHECK_EQ(changes.state.tick(), changes.delta.tick);
  FrameSelection frame;
  ChunkSet tainted = changes.orphan;
  ChunkSet changed;
  select_reverted(changes, frame, tainted);
  select_operations(changes, frame, tainted, changed);
  // In a tainted chunk, some operations of this tick were sent and others not. Unless its bricks are patched,
  // the client's copy is wrong until the whole chunk arrives, and the frame must not carry a check over it.
  ChunkSet half_told;
  for (const ChunkCoord chunk : tainted)
    if (changed.erase(chunk) != 0) half_told.insert(chunk);
  select_patches(changes, tainted, patch_room(parts.patch_bricks), frame, changed);
  if (parts.scan && wants_scan(changes.delta.tick)) rescan(changes, changed, frame);
  if (parts.poses) select_poses(changes, frame);
  std::ranges::sort(frame.removed);
  std::ranges::sort(frame.dropped);
  CHECK_DEBUG(is_sound(changed));
  CHECK_DEBUG(std::ranges::adjacent_find(frame.removed, std::ranges::greater_equal{}) == frame.removed.end());
  const auto told = [&](ChunkCoord chunk) { return changed.contains(chunk); };
  frame.has_check = !changed.empty() && std::ranges::all_of(half_told, told);
  if (frame.has_check) frame.check = check_of(changed, changes.state);
  return frame;
}

std::vector<ChunkCoord> ClientView::next_chunks(const TickChanges& changes, size_t count) const {
  std::vector<std::pair<float, ChunkCoord>> candidates;
  candidates.reserve(wanted_.size());
  for (const ChunkCoord chunk : wanted_)
    candidates.emplace_back(distance_m(chunk, changes.voxel_size_m), chunk);
  retain_nearest(candidates, count);
  std::vector<ChunkCoord> chunks;
  for (const auto& [distance, chunk] : candidates) chunks.push_back(chunk);
  return chunks;
}

std::vector<PieceId> ClientView::next_pieces(const Motions& motions, size_t count) const {
  if (known_.size() == motions.all().size()) return {};  // it has all that are alive, and no others
  std::vector<std::pair<float, PieceId>> candidates;
  auto known = known_.begin();
  for (const TrackedMotion& piece : motions.all()) {
    while (known != known_.end() && known->first < piece.id) ++known;
    if (known != known_.end() && known->first == piece.id) continue;
    if (near(piece.place_m, 1.0F)) candidates.emplace_back(glm::distance(piece.place_m, eye_m_), piece.id);
  }
  retain_nearest(candidates, count);
  std::vector<PieceId> pieces;
  for (const auto& [distance, id] : candidates) pieces.push_back(id);
  return pieces;
}

uint64_t ClientView::lacks(ChunkCoord chunk) const {
  const auto stale = stale_.find(chunk);
  return stale == stale_.end() ? all_bricks : stale->second;
}

bool ClientView::sent_bricks(ChunkCoord chunk, uint64_t bricks, uint64_t edited) {
  CHECK(wanted_.contains(chunk) && edited != 0);
  uint64_t& lacking = stale_.try_emplace(chunk, all_bricks).first->second;
  lacking &= ~bricks;
  if ((lacking & edited) != 0) return false;
  sent_chunk(chunk);
  return true;
}

void ClientView::sent_chunk(ChunkCoord chunk) {
  wanted_.erase(chunk);
  stale_.erase(chunk);
  held_.insert(chunk);
}

void ClientView::sent_piece(PieceId piece, const QuantisedPose& pose) {
  known_[piece] = {};
  if (!has_kernels()) sent_poses_.insert_or_assign(piece, pose);
}

void ClientView::distrust(ChunkCoord chunk) {
  if (held_.contains(chunk)) miss(chunk, all_bricks);
}

void ClientView::miss(ChunkCoord chunk, uint64_t bricks) {
  if (held_.erase(chunk) != 0) {
    stale_[chunk] = bricks;
    wanted_.insert(chunk);
  } else if (const auto stale = stale_.find(chunk); stale != stale_.end()) {
    stale->second |= bricks;
  }
}

}  // namespace scree
