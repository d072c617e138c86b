#include "client/mirror/mirror.h"

#include <algorithm>
#include <fmt/format.h>

#include "client/mirror/limits.h"
#include "client/mirror/pose_between.h"
#include "proto/operation_codec.h"
#include "proto/transforms.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/operation/price.h"

namespace scree {

namespace {

uint32_t fold(uint64_t hash) {
  return static_cast<uint32_t>(hash >> 32U) ^ static_cast<uint32_t>(hash);
}

}  // namespace

Mirror::Mirror(const WelcomeMessage& welcome, FindCachedChunk find_cached)
    : find_cached_(std::move(find_cached)),
      field_(welcome.terrain),
      session_(welcome.session),
      known_motions_(motion_rules(welcome.tick_rate_hz, welcome.ticks_per_transform),
                     welcome.terrain.voxel_size_m),
      tick_(welcome.tick),
      ticks_per_transform_(welcome.ticks_per_transform) {}

Result<MirrorChanges> Mirror::apply(const ServerMessage& message) {
  using Done = Result<void>;
  MirrorChanges changes;
  Done applied = std::visit(
      Overloaded{
          [](const WelcomeMessage&) -> Done { return fail("a second welcome on one connection"); },
          [](const RefusalMessage& refusal) -> Done { return fail("the server refused: " + refusal.reason); },
          [&](const FrameMessage& frame) { return apply_frame(frame, changes); },
          [&](const ChunkMessage& chunk) { return apply_chunk(chunk, changes); },
          [&](const UnchangedChunksMessage& unchanged) -> Done {
            apply_unchanged(unchanged, changes);
            return {};
          },
          [&](const PieceMessage& piece) { return apply_piece(piece, changes); },
          [&](const StoneMessage& stone) { return apply_stone(stone, changes); },
          [&](const PropMessage& prop) { return apply_prop(prop, changes); },
          [&](const JointsMessage& joints) { return apply_joints(joints, changes); },
          [&](const KeptPiecesMessage& kept) { return apply_kept(kept); },
          [&](const RegionsMessage& all) { return apply_regions(all, changes); },
          [&](const PersonPlacesMessage& places) { return apply_persons(places); },
          [&](const StoresMessage& stores) { return apply_stores(stores); },
          [&](const SignsMessage& signs) -> Done {
            signs_ = signs.signs;
            return {};
          },
          [&](const ResetMessage&) -> Done {
            apply_reset(changes);
            return {};
          },
          [&](const StatusMessage& status) -> Done {
            status_ = status;
            return {};
          },
          // A message of a later release has nothing that this one must apply.
          [](const UnknownMessage&) -> Done { return {}; },
          // For the person; nothing of the world.
          [](const ReplyMessage&) -> Done { return {}; },
          [](const AnswerMessage&) -> Done { return {}; },
          [](const AdminListMessage&) -> Done { return {}; },
          [](const CursorsMessage&) -> Done { return {}; },
          [](const CuesMessage&) -> Done { return {}; },
          [](const ChannelMessage&) -> Done { return {}; },
          [](const PersonsMessage&) -> Done { return {}; },
          [](const SaidMessage&) -> Done { return {}; },
          [](const HealthMessage&) -> Done { return {}; },
          [](const PlaybackMessage&) -> Done { return {}; },
          [](const MarksMessage&) -> Done { return {}; },
          [](const RecordedCursorsMessage&) -> Done { return {}; },
          [](const PhysicsMessage&) -> Done { return {}; },
          [](const ContactsMessage&) -> Done { return {}; },
          // Never asked for: the field generates it.
          [](const GroundMessage&) -> Done { return {}; },
          // For the ground (client/cache/received_tiles.h), which the field asks.
          [](const TileMessage&) -> Done { return {}; },
          [](const ContentMessage&) -> Done { return {}; },
          [](const PaletteChangedMessage&) -> Done { return {}; },
      },
      message);
  if (applied) applied = within_limits();
  TRY(applied);
  for (const BrickCoord brick : changes.bricks) scenes_.forget(chunk_of(brick));
  return changes;
}

Result<void> Mirror::apply_frame(const FrameMessage& frame, MirrorChanges& changes) {
  if (frame.tick < tick_)
    return fail(fmt::format("a frame of tick {} came after that of tick {}", frame.tick, tick_));
  ChunkSet changed;
  float work_us = 0.0F;
  for (const Operation& operation : frame.operations) {
    Result<void> applied = apply_operation(operation, frame.tick, work_us, changed, changes);
    if (!applied) return fail(fmt::format("tick {}: {}", frame.tick, applied.error().message));
    if (applied = within_limits(); !applied) return applied;
  }
  apply_patches(frame.patches, changed, changes);
  held_.insert(changed.begin(), changed.end());
  tick_ = frame.tick;
  // Before the drops: the check covers the state after operations and patches.
  check(frame, changed);
  for (const ChunkCoord chunk : frame.dropped_chunks) {
    forget_chunk(chunk, changes);
    held_.erase(chunk);
    repairs_awaited_.erase(chunk);
    incomplete_.erase(chunk);
    ++counters_.dropped_chunks;
  }
  for (const PieceId id : frame.removed_pieces) remove(id, changes);
  ++counters_.frames;
  TRY(apply_transforms(frame.transforms, frame.tick));
  return apply_motions(frame.motions, frame.tick);
}

Result<void> Mirror::apply_operation(const Operation& operation, Tick tick, float& work_us, ChunkSet& changed,
                                     MirrorChanges& changes) {
  TRY(validate(operation, table_, field_.source().voxel_size_m));
  work_us += price_us(operation, field_, table_);
  if (work_us > limits::mirror_frame_work_max_us)
    return fail("more work than any tick's (limits.mirror_frame_work_max_us)");
  const PieceIds made = ids_made_by(operation);
  const auto taken = table_.lower_bound(made.first);
  if (taken != table_.end() && taken->first - made.first < made.count)
    return fail(fmt::format("piece {} is made a second time", taken->first));
  const auto prop = props_.lower_bound(made.first);
  if (prop != props_.end() && prop->first - made.first < made.count)
    return fail(fmt::format("piece {} has the id of a prop", prop->first));
  const Birthplace birthplace = birthplace_of(operation);
  note_merge(operation, changes);
  const Applied applied = scree::apply(operation, field_, table_);
  for (const BrickCoord brick : applied.changed) changed.insert(chunk_of(brick));
  changes.bricks.insert(changes.bricks.end(), applied.changed.begin(), applied.changed.end());
  for (const CreatedPiece& piece : applied.created) {
    const std::shared_ptr<const Volume>& volume = table_.at(piece.id);
    const glm::vec3 off_m = (volume->centre_voxels - birthplace.centre_voxels) * field_.source().voxel_size_m;
    const Pose pose{birthplace.pose.position_m + birthplace.pose.rotation * off_m, birthplace.pose.rotation};
    known_motions_.add_made(piece.id, *volume, parent_of(operation));
    add_piece(piece.id, volume, pose, tick, changes);
  }
  counters_.pieces_made += applied.created.size();
  count(operation);
  for (const PieceId ended : pieces_ended_by(operation)) remove_piece(ended, changes);
  return {};
}

/// Fragments of a piece begin at the piece's last pose; all other pieces at the place of their cut.
Mirror::Birthplace Mirror::birthplace_of(const Operation& operation) const {
  const std::optional<PieceId> id = parent_of(operation);
  if (!id) return {};
  const PieceMotion& parent = motions_.at(*id);
  return {parent.to, parent.volume->centre_voxels};
}

void Mirror::count(const Operation& operation) {
  counters_.operation_bytes += operation_bytes(operation);
  ++counters_.operations[operation];
  counters_.pieces_merged += pieces_merged_by(operation);
}

void Mirror::apply_patches(const std::vector<BrickPatch>& patches, ChunkSet& changed,
                           MirrorChanges& changes) {
  set_bricks(patches, changes);
  for (const BrickPatch& patch : patches) changed.insert(chunk_of(patch.coord));
  counters_.patched_bricks += patches.size();
}

void Mirror::check(const FrameMessage& frame, const ChunkSet& changed) {
  if (!frame.has_check) return;
  ++counters_.checks;
  uint64_t sum = 0;
  for (const ChunkCoord chunk : changed) sum += field_.chunk_hash(chunk);
  if (fold(sum) == frame.check) return;
  ++counters_.mismatches;
  for (const ChunkCoord chunk : changed) {
    const auto awaited = repairs_awaited_.find(chunk);
    if (awaited != repairs_awaited_.end() && frame.tick < awaited->second + limits::repair_patience_ticks)
      continue;
    mismatched_[chunk] = {frame.tick, field_.chunk_hash(chunk)};
  }
}

std::optional<RepairMessage> Mirror::next_repair_request() {
  if (mismatched_.empty()) return std::nullopt;
  RepairMessage request;
  request.tick = mismatched_.begin()->second.tick;
  for (auto entry = mismatched_.begin(); entry != mismatched_.end();) {
    if (request.chunks.size() == limits::repair_chunks_max) break;
    if (entry->second.tick != request.tick) {
      ++entry;
      continue;
    }
    request.chunks.push_back(entry->first);
    request.hashes.push_back(entry->second.hash);
    repairs_awaited_[entry->first] = request.tick;
    entry = mismatched_.erase(entry);
  }
  counters_.repairs_asked += request.chunks.size();
  return request;
}

Result<void> Mirror::apply_transforms(const std::vector<uint8_t>& packed, Tick tick) {
  const std::vector<PieceState> states = TRY(unpack_transforms(packed));
  for (const PieceState& state : states) {
    BetweenPoses* const moving = find_moving(state.id);
    if (moving == nullptr)
      return fail(fmt::format("the pose of piece {}, which is not known here", state.id));
    move(*moving, dequantise(state.pose), tick);
  }
  counters_.transforms += states.size();
  counters_.transform_bytes += packed.size();
  return {};
}

Result<void> Mirror::apply_motions(const std::vector<uint8_t>& motions, Tick tick) {
  const std::vector<PieceId> moved = TRY(known_motions_.advance(motions));
  for (const PieceId id : moved) {
    BetweenPoses* const moving = find_moving(id);
    CHECK(moving != nullptr);
    move(*moving, pose_of(*known_motions_.motion(id)), tick);
  }
  counters_.transforms += moved.size();
  counters_.transform_bytes += motions.size();
  return {};
}

void Mirror::move(BetweenPoses& motion, const Pose& to, Tick tick) const {
  // The server tells nothing of a piece at rest: its motion starts at the last tick, not at its last pose's.
  const Tick start = tick > ticks_per_transform_ ? tick - ticks_per_transform_ : 0;
  motion.from = motion.to;
  motion.from_tick = std::max(motion.to_tick, start);
  motion.to = to;
  motion.to_tick = tick;
}

void Mirror::replace_chunk(ChunkCoord chunk, const std::vector<BrickPatch>& bricks, MirrorChanges& changes) {
  forget_chunk(chunk, changes);
  set_bricks(bricks, changes);
  incomplete_.erase(chunk);
}

void Mirror::set_bricks(const std::vector<BrickPatch>& bricks, MirrorChanges& changes) {
  for (const BrickPatch& patch : bricks) {
    field_.set_brick(patch.coord, patch.brick, patch.materials);
    changes.bricks.push_back(patch.coord);
  }
}

Result<void> Mirror::apply_chunk(const ChunkMessage& message, MirrorChanges& changes) {
  if (message.is_part()) return apply_part(message, changes);
  replace_chunk(message.chunk, message.bricks, changes);
  if (field_.chunk_hash(message.chunk) != message.hash)
    return fail(fmt::format("chunk ({}, {}, {}) does not have the hash that came with it", message.chunk.x,
                            message.chunk.y, message.chunk.z));
  held_.insert(message.chunk);
  mismatched_.erase(message.chunk);
  counters_.repairs_arrived += repairs_awaited_.erase(message.chunk);
  ++counters_.chunks;
  return {};
}

/// Bricks that the server takes for right here may be wrong: then the hash that follows the last part is
/// sent, and the chunk comes again.
Result<void> Mirror::apply_part(const ChunkMessage& message, MirrorChanges& changes) {
  const ChunkCoord chunk = message.chunk;
  forget_all_but(message.edited, chunk, changes);
  set_bricks(message.bricks, changes);
  mismatched_.erase(chunk);
  ++counters_.chunk_parts;
  if (message.more) {
    held_.erase(chunk);
    incomplete_.insert(chunk);
    return {};
  }
  incomplete_.erase(chunk);
  held_.insert(chunk);
  counters_.repairs_arrived += repairs_awaited_.erase(chunk);
  ++counters_.chunks;
  if (field_.chunk_hash(chunk) == message.hash) return {};
  ++counters_.mismatches;
  mismatched_[chunk] = {tick_, field_.chunk_hash(chunk)};
  return {};
}

void Mirror::forget_all_but(uint64_t edited, ChunkCoord chunk, MirrorChanges& changes) {
  std::vector<BrickPatch> kept;
  const std::vector<BrickCoord> before = field_.edited_bricks(chunk);
  for (const BrickCoord brick : before)
    if (((edited >> index_in_chunk(brick)) & 1U) != 0)
      kept.push_back({brick, field_.brick(brick), field_.materials(brick)});
  if (kept.size() == before.size()) return;
  forget_chunk(chunk, changes);
  set_bricks(kept, changes);
}

/// Where what was kept is not what the server takes it for, its hash is sent, and the chunk comes whole.
void Mirror::apply_unchanged(const UnchangedChunksMessage& message, MirrorChanges& changes) {
  for (size_t i = 0; i < message.chunks.size(); ++i) {
    const ChunkCoord chunk = message.chunks[i];
    replace_chunk(chunk, find_cached_ ? find_cached_(chunk) : std::vector<BrickPatch>(), changes);
    held_.insert(chunk);
    repairs_awaited_.erase(chunk);
    ++counters_.chunks_kept;
    if (field_.chunk_hash(chunk) == message.hashes[i]) continue;
    ++counters_.mismatches;
    mismatched_[chunk] = {tick_, field_.chunk_hash(chunk)};
  }
}

Result<void> Mirror::apply_piece(const PieceMessage& message, MirrorChanges& changes) {
  if (motions_.contains(message.id)) return fail(fmt::format("piece {} is sent a second time", message.id));
  if (props_.contains(message.id)) return fail(fmt::format("piece {} has the id of a prop", message.id));
  auto volume = std::make_shared<const Volume>(message.volume);
  known_motions_.add(message.id, *volume);
  table_[message.id] = volume;
  add_piece(message.id, std::move(volume), dequantise(message.pose), tick_, changes);
  ++counters_.pieces_sent;
  return {};
}

void Mirror::apply_reset(MirrorChanges& changes) {
  for (const ChunkCoord chunk : field_.edited_chunks()) forget_chunk(chunk, changes);
  for (const auto& [id, motion] : motions_) changes.pieces_removed.push_back(id);
  for (const auto& [id, motion] : props_) changes.props_removed.push_back(id);
  while (!joints_.empty()) forget_joint({joints_.begin()->first, JointEnd::body_gone}, changes);
  motions_.clear();
  props_.clear();
  kept_.clear();
  regions_.clear();
  signs_.clear();
  changes.regions = true;
  persons_.clear();
  own_person_.reset();
  known_motions_.clear();
  table_.clear();
  piece_voxels_ = 0;
  held_.clear();
  incomplete_.clear();
  mismatched_.clear();
  repairs_awaited_.clear();
  tick_ = 0;  // a recording may go on from anywhere
  ++counters_.resets;
}

void Mirror::forget_chunk(ChunkCoord chunk, MirrorChanges& changes) {
  const std::vector<BrickCoord> bricks = field_.edited_bricks(chunk);
  changes.bricks.insert(changes.bricks.end(), bricks.begin(), bricks.end());
  field_.forget_chunk(chunk);
  mismatched_.erase(chunk);
}

void Mirror::add_piece(PieceId id, std::shared_ptr<const Volume> volume, const Pose& pose, Tick tick,
                       MirrorChanges& changes) {
  piece_voxels_ += volume->window.codes.size();
  motions_[id] = {{pose, pose, tick, tick}, std::move(volume)};
  changes.pieces_added.push_back(id);
}

void Mirror::remove_piece(PieceId id, MirrorChanges& changes) {
  table_.erase(id);
  known_motions_.remove(id);
  const auto found = motions_.find(id);
  if (found == motions_.end()) return;
  forget_joints_of(id, changes);
  piece_voxels_ -= found->second.volume->window.codes.size();
  motions_.erase(found);
  kept_.erase(id);
  changes.pieces_removed.push_back(id);
}

Pose Mirror::pose_at(const BetweenPoses& motion, double tick) const {
  if (motion.to_tick <= motion.from_tick || tick >= static_cast<double>(motion.to_tick)) return motion.to;
  if (tick <= static_cast<double>(motion.from_tick)) return motion.from;
  const auto t = static_cast<float>((tick - static_cast<double>(motion.from_tick)) /
                                    static_cast<double>(motion.to_tick - motion.from_tick));
  return pose_between(motion.from, motion.to, t);
}

}  // namespace scree
