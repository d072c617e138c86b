// A publisher without sockets, fed by a TickSource, and clients that apply what it selects for them.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "proto/codec.h"
#include "proto/known_motions.h"
#include "proto/transforms.h"
#include "server/publish/limits.h"
#include "server/publish/publisher.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/tick_source.h"

namespace scree {

/// A client that believes every message, and checks each frame's check.
class TrustingClient {
 public:
  void receive(const Outgoing& outgoing) {
    const std::span<const uint8_t> bytes(*outgoing.bytes);
    const auto message = decode_server(bytes.subspan(length_prefix_bytes));
    ASSERT_TRUE(message.has_value()) << message.error().message;
    if (const auto* chunk = std::get_if<ChunkMessage>(&*message)) {
      chunk_bytes += bytes.size();
      chunk_order.push_back(chunk->chunk);
      largest_chunk_bytes = std::max(largest_chunk_bytes, bytes.size());
    }
    if (std::holds_alternative<PieceMessage>(*message)) piece_bytes += bytes.size();
    std::visit([this](const auto& m) { apply(m); }, *message);
  }

  MapField field{flat_terrain};
  PieceTable pieces;
  std::map<PieceId, Prop> props;
  std::vector<Tick> ticks;
  size_t operations = 0, patches = 0, chunks = 0, piece_messages = 0, resets = 0, drops = 0, mismatches = 0;
  size_t operation_kinds_seen = 0;  ///< the highest number of a kind, and one
  size_t unchecked = 0;             ///< frames that changed something, but carried no check
  size_t chunk_bytes = 0;           ///< on the wire
  size_t largest_chunk_bytes = 0;
  size_t chunk_parts = 0, bricks_of_parts = 0;
  size_t piece_bytes = 0;
  std::vector<ChunkCoord> chunk_order;
  std::map<PieceId, QuantisedPose> poses;  ///< as told: whole, or by motions
  KnownMotions motions{motion_rules(60, 3), flat_terrain.voxel_size_m};
  size_t motion_bytes = 0, transform_bytes = 0;
  std::vector<ReplyMessage> replies;
  std::vector<StatusMessage> statuses;
  std::vector<AnswerMessage> answers;
  std::vector<GroundMessage> grounds;
  std::vector<TileMessage> tiles;
  std::vector<StoneMessage> stones;
  std::vector<PlaybackMessage> playbacks;
  MarksMessage marks;
  RecordedCursorsMessage recorded_cursors;
  TrustingClient* before = nullptr;  ///< has the chunks that this one offered
  size_t unchanged = 0;

 private:
  void apply(const FrameMessage& frame) {
    ticks.push_back(frame.tick);
    std::map<ChunkCoord, bool> changed;
    for (const Operation& operation : frame.operations) {
      ++operations;
      operation_kinds_seen = std::max(operation_kinds_seen, operation.index() + 1);
      ASSERT_TRUE(validate(operation, pieces, field.source().voxel_size_m).has_value());
      const Applied applied = scree::apply(operation, field, pieces);
      for (const BrickCoord brick : applied.changed) changed[chunk_of(brick)] = true;
      for (const CreatedPiece& piece : applied.created)
        motions.add_made(piece.id, *pieces.at(piece.id), parent_of(operation));
      for (const PieceId piece : pieces_ended_by(operation)) motions.remove(piece);
    }
    for (const BrickPatch& patch : frame.patches) {
      ++patches;
      field.set_brick(patch.coord, patch.brick);
      field.set_materials(patch.coord, patch.materials);
      changed[chunk_of(patch.coord)] = true;
    }
    for (const ChunkCoord chunk : frame.dropped_chunks) {
      ++drops;
      field.forget_chunk(chunk);
    }
    for (const PieceId piece : frame.removed_pieces) {
      EXPECT_EQ(pieces.erase(piece), 1U);
      motions.remove(piece);
    }
    transform_bytes += frame.transforms.size();
    motion_bytes += frame.motions.size();
    const auto moved = unpack_transforms(frame.transforms);
    ASSERT_TRUE(moved.has_value());
    for (const PieceState& piece : *moved) {
      EXPECT_TRUE(pieces.contains(piece.id));
      poses[piece.id] = piece.pose;
    }
    const auto advanced = motions.advance(frame.motions);
    ASSERT_TRUE(advanced.has_value()) << advanced.error().message;
    for (const PieceId piece : *advanced) poses[piece] = quantise(pose_of(*motions.motion(piece)));
    uint64_t sum = 0;
    for (const auto& [chunk, yes] : changed) sum += field.chunk_hash(chunk);
    EXPECT_FALSE(changed.empty() && frame.has_check);
    if (!changed.empty() && !frame.has_check) ++unchecked;
    const uint32_t check = static_cast<uint32_t>(sum >> 32U) ^ static_cast<uint32_t>(sum);
    if (frame.has_check && frame.check != check) ++mismatches;
  }
  void apply(const ChunkMessage& message) {
    if (message.is_part()) {
      ++chunk_parts;
      bricks_of_parts += message.bricks.size();
      for (const BrickCoord brick : field.edited_bricks(message.chunk))
        EXPECT_NE((message.edited >> index_in_chunk(brick)) & 1U, 0U) << "what is edited stays so here";
    } else {
      field.forget_chunk(message.chunk);
    }
    for (const BrickPatch& patch : message.bricks) {
      field.set_brick(patch.coord, patch.brick);
      field.set_materials(patch.coord, patch.materials);
    }
    if (message.more) return;
    ++chunks;
    EXPECT_EQ(field.chunk_hash(message.chunk), message.hash);
  }
  void apply(const UnchangedChunksMessage& message) {
    for (size_t i = 0; i < message.chunks.size(); ++i) {
      ++unchanged;
      const ChunkCoord chunk = message.chunks[i];
      chunk_order.push_back(chunk);
      if (before == nullptr) continue;
      for (const BrickCoord brick : before->field.edited_bricks(chunk)) {
        field.set_brick(brick, before->field.brick(brick));
        field.set_materials(brick, before->field.materials(brick));
      }
      EXPECT_EQ(field.chunk_hash(chunk), message.hashes[i]);
    }
  }
  void apply(const PieceMessage& message) {
    ++piece_messages;
    EXPECT_FALSE(pieces.contains(message.id));
    pieces[message.id] = std::make_shared<const Volume>(message.volume);
    motions.add(message.id, message.volume);
    poses[message.id] = message.pose;
  }
  void apply(const PropMessage& message) {
    EXPECT_TRUE(props.emplace(message.id, message.prop).second);
    motions.add(message.id, glm::vec3(0.0F));
    poses[message.id] = message.pose;
  }
  void apply(const ResetMessage&) {
    props.clear();
    ++resets;
    for (const ChunkCoord chunk : field.edited_chunks()) field.forget_chunk(chunk);
    pieces.clear();
    motions.clear();
  }
  void apply(const GroundMessage& message) { grounds.push_back(message); }
  void apply(const TileMessage& message) { tiles.push_back(message); }
  void apply(const ContentMessage&) {}
  void apply(const PaletteChangedMessage&) {}
  void apply(const JointsMessage&) {}
  void apply(const KeptPiecesMessage&) {}
  void apply(const StoneMessage& message) { stones.push_back(message); }
  void apply(const RegionsMessage&) {}
  void apply(const SignsMessage&) {}
  void apply(const CuesMessage&) {}
  void apply(const ChannelMessage&) {}
  void apply(const PersonPlacesMessage&) {}
  void apply(const StoresMessage&) {}
  void apply(const AnswerMessage& message) { answers.push_back(message); }
  void apply(const ReplyMessage& message) { replies.push_back(message); }
  void apply(const StatusMessage& message) { statuses.push_back(message); }
  void apply(const WelcomeMessage&) { ADD_FAILURE() << "a welcome is not the publisher's"; }
  void apply(const RefusalMessage&) { ADD_FAILURE() << "a refusal is not the publisher's"; }
  void apply(const CursorsMessage&) { ADD_FAILURE() << "cursors are not the publisher's"; }
  void apply(const PlaybackMessage& message) { playbacks.push_back(message); }
  void apply(const MarksMessage& message) { apply_news(marks, message); }
  void apply(const RecordedCursorsMessage& message) { recorded_cursors = message; }
  void apply(const HealthMessage&) { ADD_FAILURE() << "health is not the publisher's"; }
  void apply(const PersonsMessage&) { ADD_FAILURE() << "persons are not the publisher's"; }
  void apply(const SaidMessage&) { ADD_FAILURE() << "what persons say is not the publisher's"; }
  void apply(const AdminListMessage&) { ADD_FAILURE() << "lists are not the publisher's"; }
  void apply(const UnknownMessage&) { ADD_FAILURE() << "a message of this version is known"; }
  void apply(const ContactsMessage&) { ADD_FAILURE() << "nobody asked for contacts"; }
  void apply(const PhysicsMessage&) { ADD_FAILURE() << "what bodies do is not the publisher's"; }
};

class PublisherTest : public ::testing::Test {
 protected:
  static constexpr uint64_t session = 1;

  void tick(const std::vector<Operation>& operations = {}) { deliver(*source.step(operations)); }
  void deliver(const TickDelta& delta) {
    const auto backlog = [this](uint64_t id) {
      return id == session ? Backlog{backlog_bytes, soft_bytes} : Backlog();
    };
    receive(publisher.publish(delta, backlog));
    receive(publisher.answer(delta, [this](const Reply&) { return latency; }));
    receive(publisher.stream(backlog));
  }
  void receive(const std::vector<Outgoing>& outgoing) {
    for (const Outgoing& each : outgoing) {
      bytes[each.session] += each.bytes->size();
      last[each.session] = each.bytes;
      followers[each.session].receive(each);
    }
  }
  void join(uint64_t id, glm::vec3 eye_m, float radius_m, bool has_kernels = true) {
    publisher.join(id, eye_m, radius_m, has_kernels ? operation_kinds : 0);
    followers.try_emplace(id);
  }
  /// Every chunk that the client holds reads as the server's.
  void expect_held_equal(uint64_t id) {
    for (const ChunkCoord chunk : publisher.view(id)->held())
      EXPECT_EQ(followers.at(id).field.chunk_hash(chunk), source.field().chunk_hash(chunk));
  }
  void expect_whole_field_equal(uint64_t id) {
    EXPECT_EQ(followers.at(id).field.hash(), source.field().hash());
    EXPECT_EQ(followers.at(id).pieces.size(), source.pieces().size());
    EXPECT_EQ(followers.at(id).mismatches, 0U);
    EXPECT_EQ(followers.at(id).unchecked, 0U);
  }
  /// Bricks of whole layers of chunks between the origin and 136 m from it, so many that those nearest fill a
  /// frame's patches and leave no room for a single one.
  static std::vector<std::pair<BrickCoord, Brick>> flood() {
    static_assert(limits::patch_bricks_max % (chunk_bricks * chunk_bricks) == 0);
    std::vector<std::pair<BrickCoord, Brick>> bricks;
    for (int x = 0; x < 32; ++x)
      for (int z = 0; z < 60; ++z) bricks.emplace_back(BrickCoord{x, 0, z}, solid_brick());
    return bricks;
  }
  /// A tick in which bricks changed by no operation, as in a keyframe; the source's field changes alike.
  void change(const std::vector<std::pair<BrickCoord, Brick>>& bricks) {
    deliver(*changed(source.step(), bricks));
  }
  /// The tick, and these bricks changed besides.
  std::shared_ptr<const TickDelta> changed(const std::shared_ptr<const TickDelta>& tick,
                                           const std::vector<std::pair<BrickCoord, Brick>>& bricks) {
    auto delta = std::make_shared<TickDelta>(*tick);
    for (const auto& [coord, brick] : bricks) {
      source.field().set_brick(coord, brick);
      delta->bricks.push_back({coord, std::make_shared<const Brick>(brick), brick_hash(coord, brick)});
    }
    std::ranges::sort(delta->bricks, {}, &BrickState::coord);
    delta->field_hash = source.field().hash();
    return delta;
  }
  /// The client's copy of an edited chunk goes wrong, and the client says so.
  void spoil(uint64_t id, ChunkCoord chunk) {
    TrustingClient& follower = followers.at(id);
    follower.field.set_brick(follower.field.edited_bricks(chunk).front(), solid_brick());
    publisher.repair(id, {source.tick(), {chunk}, {follower.field.chunk_hash(chunk)}});
  }

  TickSource source{flat_terrain};
  Workers workers{2};
  Publisher publisher{PublisherConfig{.terrain = flat_terrain}, workers};
  std::map<uint64_t, TrustingClient> followers;
  std::map<uint64_t, size_t> bytes;
  std::map<uint64_t, SharedBytes> last;
  size_t backlog_bytes = 0;  ///< of `session`, as soft_bytes
  size_t soft_bytes = limits::outbox_soft_bytes;
  ServerLatency latency;  ///< that replies state
};

}  // namespace scree
