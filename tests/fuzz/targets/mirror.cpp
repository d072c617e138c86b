// A client's mirror and a server of any intent: messages in any order after a valid welcome, recorded ones
// and those made of the input.
//
// Holds: a message is applied or refused with a reason; after a refusal nothing follows. What the mirror asks
// for and shows is within its limits.
#include "client/mirror/mirror.h"

#include <cmath>

#include "client/mirror/limits.h"
#include "proto/codec.h"
#include "proto/transforms.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/operation/limits.h"
#include "tests/fuzz/support/any_operation.h"
#include "tests/fuzz/support/any_request.h"
#include "tests/fuzz/support/any_rules_act.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr int messages_max = 96;
constexpr int operations_max = 48;

WelcomeMessage any_welcome(FuzzInput& input) {
  WelcomeMessage welcome;
  welcome.terrain = {static_cast<TerrainKind>(input.below(kind_count<TerrainKind>)), input.byte(),
                     input.flag() ? 1.0F : 0.5F};
  welcome.tick_rate_hz = 10 + input.byte();
  welcome.ticks_per_transform = 1 + input.below(8);
  welcome.interest_radius_m = 64.0F;
  return welcome;
}

BrickCoord any_brick_coord(FuzzInput& input) {
  const VoxelCoord at = any_voxel(input);
  return {at.x / 4, at.y / 4, at.z / 4};
}

/// Uniform, but for a few voxels.
Brick any_brick(FuzzInput& input) {
  Brick brick = input.flag() ? solid_brick() : air_brick();
  for (const uint8_t byte : input.bytes(input.below(8)))
    brick.codes[(size_t{byte} * 2) % brick.codes.size()] = static_cast<Code>(byte % 255 - 127);
  return brick;
}

std::vector<BrickPatch> any_bricks(FuzzInput& input) {
  std::vector<BrickPatch> bricks;
  for (uint32_t count = input.below(6); count > 0; --count) {
    const BrickCoord coord = any_brick_coord(input);
    const bool twice = std::ranges::any_of(bricks, [&](const BrickPatch& b) { return b.coord == coord; });
    if (twice) continue;
    BrickPatch patch{coord, any_brick(input)};
    if (input.flag()) patch.materials = any_materials(input);
    bricks.push_back(patch);
  }
  return bricks;
}

/// Poses of pieces, ordered.
std::vector<uint8_t> any_transforms(FuzzInput& input) {
  std::vector<PieceState> states;
  PieceId id = 0;
  for (uint32_t count = input.below(4); count > 0; --count)
    states.push_back({id += 1 + input.below(8), any_pose(input)});
  return pack_transforms(states);
}

/// Ids by which operations are mostly carried out: pieces that the mirror has, and for new ones such as it
/// never had.
class Ids {
 public:
  explicit Ids(const Mirror& mirror) : mirror_(mirror) {}

  void settle(Operation& operation, FuzzInput& input) {
    if (input.below(8) == 7) return;
    std::visit(Overloaded{[&](CarveOperation& carve) { carve.first_piece = fresh(carve.seeds); },
                          [](FillOperation&) {},
                          [&](StampOperation& stamp) {
                            stamp.piece = known(stamp.piece);
                            for (StampedPiece& other : stamp.others) other.piece = known(other.piece);
                          },
                          [&](DiscardOperation& discard) { discard.piece = known(discard.piece); },
                          [&](ShatterOperation& shatter) {
                            shatter.piece = known(shatter.piece);
                            shatter.first_piece = fresh(shatter.seeds + limits::cut_rests_max);
                          },
                          [&](IslandOperation& island) { island.piece = fresh(1); }, [](PaintOperation&) {},
                          [](SlideOperation&) {},
                          [&](DigOperation& dig) { dig.piece = dig.piece == 0 ? 0 : known(dig.piece); },
                          [](PlaceOperation&) {},
                          [&](RestoreOperation& restore) {
                            for (PieceId& piece : restore.pieces) piece = known(piece);
                          }},
               operation);
  }

 private:
  PieceId fresh(uint32_t count) {
    const PieceId first = next_;
    next_ += std::min(count, limits::seeds_max);
    return first;
  }
  PieceId known(PieceId id) const {
    const auto& pieces = mirror_.pieces();
    if (pieces.empty()) return id;
    return std::next(pieces.begin(), static_cast<ptrdiff_t>(id % pieces.size()))->first;
  }

  const Mirror& mirror_;
  PieceId next_ = 100;
};

FrameMessage any_frame(FuzzInput& input, Ids& ids, Tick tick) {
  FrameMessage frame;
  frame.tick = tick + input.below(8);
  for (uint32_t count = input.below(5); count > 0; --count) {
    frame.operations.push_back(any_operation(input));
    ids.settle(frame.operations.back(), input);
  }
  if (input.flag()) frame.patches = any_bricks(input);
  for (uint32_t count = input.below(8) / 6; count > 0; --count)
    frame.dropped_chunks.push_back(chunk_of(any_brick_coord(input)));
  for (uint32_t count = input.below(8) / 5; count > 0; --count)
    frame.removed_pieces.push_back(any_piece(input));
  if (input.below(4) == 3) frame.transforms = any_transforms(input);
  if (input.below(4) == 3) {
    const auto motions = input.packet();
    frame.motions.assign(motions.begin(), motions.end());
  }
  frame.has_check = input.flag();
  if (frame.has_check) frame.check = input.byte();
  return frame;
}

/// Mostly with the hash of its bricks; half of them parts.
ChunkMessage any_chunk(FuzzInput& input) {
  ChunkMessage chunk;
  chunk.chunk = chunk_of(any_brick_coord(input));
  chunk.bricks = any_bricks(input);
  for (size_t i = 0; i < chunk.bricks.size(); ++i) {
    BrickPatch& patch = chunk.bricks[i];
    if (input.below(16) != 15)
      patch.coord =
          first_brick(chunk.chunk) + BrickCoord{static_cast<int>(i % 4), static_cast<int>(i / 4), 0};
    chunk.hash += brick_hash(patch.coord, patch.brick, patch.materials);
  }
  if (input.below(16) == 15) ++chunk.hash;
  if (input.flag()) return chunk;
  for (const BrickPatch& patch : chunk.bricks) chunk.edited |= uint64_t{1} << index_in_chunk(patch.coord);
  if (input.flag()) chunk.edited |= uint64_t{1} << input.below(64);
  chunk.more = input.flag();
  if (chunk.more) chunk.hash = 0;
  return chunk;
}

/// A note on chunks, as if the mirror had offered them.
UnchangedChunksMessage any_unchanged(FuzzInput& input) {
  UnchangedChunksMessage unchanged;
  for (uint32_t count = input.below(4); count > 0; --count) {
    unchanged.chunks.push_back(chunk_of(any_brick_coord(input)));
    unchanged.hashes.push_back(input.byte());
  }
  return unchanged;
}

/// Regions, of which ids and names may be wrong.
RegionsMessage any_regions(FuzzInput& input) {
  RegionsMessage message;
  RegionId id = 0;
  for (uint32_t count = input.below(4); count > 0; --count) {
    Region region = any_region(input);
    region.id = id += input.below(16) == 15 ? 0 : 1;
    message.regions.push_back(std::move(region));
  }
  return message;
}

PersonPlacesMessage any_persons(FuzzInput& input) {
  PersonPlacesMessage message{.tick = input.byte()};
  if (input.flag()) message.persons.emplace();
  for (uint32_t count = input.below(4); count > 0 && message.persons; --count)
    message.persons->push_back({input.below(8), any_piece(input)});
  if (!input.flag()) return message;
  message.own.emplace();
  message.own->taken = input.byte();
  message.own->walker.feet_m = input.place(50.0F);
  message.own->walker.speed_m_s = input.place(20.0F);
  message.own->walker.stands = input.flag();
  return message;
}

ServerMessage any_of_rules(FuzzInput& input) {
  if (input.below(4) == 0) return CuesMessage{input.byte(), {any_cue(input)}};
  if (input.below(4) == 0) return ChannelMessage{any_channel_data(input)};
  SignsMessage message;
  for (uint32_t count = input.below(4); count > 0; --count) message.signs.push_back(any_sign(input));
  if (input.below(8) != 7) std::ranges::sort(message.signs, sign_before);
  return message;
}

ServerMessage any_about_persons(FuzzInput& input) {
  switch (input.below(4)) {
    case 0:
      return any_regions(input);
    case 1:
      return any_persons(input);
    case 2:
      return any_of_rules(input);
    default: {
      StoresMessage message;
      for (uint32_t count = input.below(3); count > 0; --count)
        message.stores.push_back(
            {any_store(input),
             {{static_cast<Material>(input.byte()), static_cast<MassUnits>(input.byte())}}});
      return message;
    }
  }
}

ServerMessage any_message(FuzzInput& input, Ids& ids, Tick tick) {
  switch (input.below(9)) {
    case 0:
      return any_chunk(input);
    case 1:
    case 2: {
      PieceMessage piece;
      piece.id = any_piece(input);
      piece.volume = any_volume(input);
      piece.pose = any_pose(input);
      if (input.flag()) return StoneMessage{std::move(piece), input.number<uint32_t>()};
      return piece;
    }
    case 8:
      return input.flag() ? ServerMessage(any_unchanged(input)) : any_about_persons(input);
    case 3:
      return input.below(8) == 7 ? ServerMessage(ResetMessage{}) : ServerMessage(any_frame(input, ids, tick));
    default:
      return any_frame(input, ids, tick);
  }
}

class Session {
 public:
  explicit Session(const WelcomeMessage& welcome) : mirror_(welcome) {}

  /// False when the session is over.
  bool apply(std::span<const uint8_t> body) {
    const auto message = decode_server(body);
    if (!message) return true;  // a connection would end; go on with what follows
    if (const auto* frame = std::get_if<FrameMessage>(&*message))
      operations_ += static_cast<int>(frame->operations.size());
    if (operations_ > operations_max) return false;
    const auto applied = mirror_.apply(*message);
    if (!applied) {
      CHECK(!applied.error().message.empty());
      return false;
    }
    check_limits();
    return true;
  }
  ServerMessage next(FuzzInput& input) { return any_message(input, ids_, mirror_.tick()); }

 private:
  void check_limits() {
    while (const auto repair = mirror_.next_repair_request()) {
      CHECK(!repair->chunks.empty() && repair->chunks.size() <= limits::repair_chunks_max);
      CHECK_EQ(repair->chunks.size(), repair->hashes.size());
    }
    CHECK(mirror_.signs().size() <= limits::signs_max);
    CHECK(mirror_.held_chunks().size() <= limits::mirror_chunks_max);
    CHECK(mirror_.pieces().size() <= limits::mirror_pieces_max);
    for (const auto& [id, piece] : mirror_.pieces()) {
      CHECK(piece.volume != nullptr && piece.from_tick <= piece.to_tick);
      const Pose pose = mirror_.pose_at(piece, static_cast<double>(mirror_.tick()) - 0.5);
      CHECK(std::isfinite(pose.position_m.x + pose.position_m.y + pose.position_m.z));
    }
  }

  Mirror mirror_;
  Ids ids_{mirror_};
  int operations_ = 0;
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  Session session(any_welcome(input));
  bool goes_on = true;
  for (int i = 0; i < messages_max && goes_on && !input.at_end(); ++i) {
    if (input.flag()) {
      goes_on = session.apply(input.packet());
      continue;
    }
    const std::vector<uint8_t> bytes = encode(session.next(input));
    goes_on = session.apply(std::span(bytes).subspan(length_prefix_bytes));
  }
  return 0;
}
