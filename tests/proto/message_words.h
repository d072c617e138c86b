// Messages and packed values in words, line by line, as the examples of docs/protocol.md state them. Hashes
// and checks that a message holds are compared with those of its bricks.
#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <span>
#include <string>

#include "proto/messages.h"
#include "proto/transforms.h"
#include "shared/base/overloaded.h"
#include "shared/field/field.h"
#include "tests/proto/admin_words.h"

namespace scree {

using Lines = std::vector<std::string>;

// ---- values in words

template <typename Tag>
std::string words(const Coord<Tag>& c) {
  return fmt::format("({}, {}, {})", c.x, c.y, c.z);
}
inline std::string words(glm::vec3 v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
inline std::string words(const QuantisedPose& pose) {
  return fmt::format("({}, {}, {}), rotation 0x{:08x}", pose.x, pose.y, pose.z, pose.rotation);
}
inline std::string words(std::span<const Code> codes) {
  if (std::ranges::count(codes, codes.front()) == static_cast<ptrdiff_t>(codes.size()))
    return fmt::format("all {} codes {}", codes.size(), codes.front());
  return fmt::format("codes {} … {}", fmt::join(codes.first(3), " "), codes.back());
}
inline std::string words(const Shape& shape) {
  std::string b = row_of(shape.kind).has_b ? ", b " + words(shape.b) : "";
  return fmt::format("{}, a {}{}, radius {} m", row_of(shape.kind).name, words(shape.a), b, shape.radius_m);
}

template <typename Tag>
std::string words(const std::vector<Coord<Tag>>& coords) {
  std::string all;
  for (const Coord<Tag>& coord : coords) all += (all.empty() ? "" : " ") + words(coord);
  return all.empty() ? "none" : all;
}

inline std::string words(const BrickMaterials& materials) {
  if (materials.is_ground()) return "the ground's materials";
  if (materials.is_uniform()) return fmt::format("material {}", row_number(material_of(materials.uniform())));
  return fmt::format("voxels of {} kinds", materials.list().size());
}

inline Lines words(const std::vector<BrickPatch>& bricks) {
  Lines lines;
  for (const BrickPatch& patch : bricks) {
    const std::string paint = words(patch.materials);
    lines.push_back(fmt::format("brick: {}, {}, {}, hash 0x{:016x}", words(patch.coord), paint,
                                words(std::span<const Code>(patch.brick.codes)),
                                brick_hash(patch.coord, patch.brick, patch.materials)));
  }
  return lines;
}

inline Lines words(const Volume& volume) {
  const VoxelBox& box = volume.window.box;
  return {
      fmt::format("volume: first voxel {}, sides {}, mass {}", words(box.lo), words(box.size()), volume.mass),
      fmt::format("centre of mass: {} voxels, material {}", words(volume.centre_voxels),
                  row_number(main_material(volume))),
      words(std::span<const Code>(volume.window.codes))};
}

inline Lines words(const std::vector<PieceState>& pieces) {
  Lines lines;
  for (const PieceState& piece : pieces)
    lines.push_back(fmt::format("pose: piece {} {}", piece.id, words(piece.pose)));
  return lines;
}

inline void append(Lines& lines, const Lines& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

// ---- messages in words

/// Bytes that nobody reads, as a ticket is.
inline std::string words_of_bytes(const std::string& bytes) {
  std::string hex;
  for (const char byte : bytes) hex += fmt::format("{:02x}", static_cast<uint8_t>(byte));
  return hex.empty() ? "none" : hex;
}

inline Lines describe(const HelloMessage& m) {
  Lines lines{fmt::format("hello: protocol {}, client '{}', name '{}', token '{}'", m.protocol, m.client,
                          m.name, m.token),
              fmt::format("eye {}, radius {} m, kernels: {}{}", words(m.eye_m), m.interest_radius_m,
                          m.lacks_kernels ? "none" : "has them", m.meets ? ", meets others" : "")};
  if (m.administers) lines.emplace_back("administers alone");
  if (m.stones) lines.emplace_back("wants stones");
  if (m.world != 0 || !m.ticket.empty())
    lines.push_back(fmt::format("comes back: world 0x{:016x}, ticket {}", m.world, words_of_bytes(m.ticket)));
  return lines;
}
inline Lines describe(const UnknownMessage& m) {
  if (!m.request) return {"unknown: skipped"};
  return {fmt::format("unknown: {}, request {} is refused", m.value, *m.request)};
}
inline Lines describe(const OfferMessage& m) {
  Lines lines{fmt::format("offer: world 0x{:016x}", m.world)};
  for (size_t i = 0; i < m.chunks.size(); ++i)
    lines.push_back(fmt::format("chunk: {}, hash 0x…{:04x}", words(m.chunks[i]), m.hashes[i]));
  return lines;
}
inline Lines describe(const UnchangedChunksMessage& m) {
  Lines lines{"kept:"};
  for (size_t i = 0; i < m.chunks.size(); ++i)
    lines.push_back(fmt::format("chunk: {}, hash 0x{:016x}", words(m.chunks[i]), m.hashes[i]));
  return lines;
}
inline Lines describe(const InterestMessage& m) {
  return {fmt::format("interest: eye {}, radius {} m", words(m.eye_m), m.interest_radius_m)};
}
inline Lines describe(const CarveMessage& m) {
  const std::string of = m.piece != 0 ? fmt::format(", out of piece {}", m.piece) : "";
  return {fmt::format("carve: request {}, {}{}", m.request, words(m.shape), of),
          fmt::format("pattern {}, {} seeds, random seed 0x{:08x}, impact {}, blast {} m/s",
                      row_of(m.pattern).name, m.seeds, m.random_seed, words(m.impact_m), m.blast_speed_m_s)};
}
inline Lines describe(const FillMessage& m) {
  const std::string of = m.material ? fmt::format(", material {}", row_number(*m.material)) : "";
  return {fmt::format("fill: request {}, {}{}", m.request, words(m.shape), of)};
}
inline Lines describe(const PaintMessage& m) {
  return {
      fmt::format("paint: request {}, {}, material {}", m.request, words(m.shape), row_number(m.material))};
}
inline Lines describe(const RepairMessage& m) {
  Lines lines{fmt::format("repair: tick {}", m.tick)};
  for (size_t i = 0; i < m.chunks.size(); ++i)
    lines.push_back(fmt::format("chunk: {}, hash 0x{:016x}", words(m.chunks[i]), m.hashes[i]));
  return lines;
}
inline Lines describe(const AckMessage& m) {
  return {fmt::format("ack: tick {}", m.tick)};
}
inline Lines describe(const AdminMessage& m) {
  Lines lines{fmt::format("admin: request {}, token '{}'", m.request, m.token)};
  append(lines, admin_words(m.act));
  return lines;
}
inline Lines describe(const CursorMessage& m) {
  return {fmt::format("cursor: eye {}, aim {}", words(m.eye_m), words(m.aim_m))};
}
inline Lines describe(const PhysicsSubscriptionMessage& m) {
  const std::string contacts =
      m.contacts_j > 0.0F ? fmt::format(", contacts of {} J and more", m.contacts_j) : "";
  return {fmt::format("watch: physics {}{}", m.physics, contacts)};
}
inline Lines describe(const SayMessage& m) {
  return {fmt::format("say: '{}'", m.text)};
}
inline Lines describe(const PersonsMessage& m) {
  Lines lines{fmt::format("persons: {} more, chat: {}", m.more, m.chat)};
  for (const Person& person : m.persons)
    lines.push_back(
        fmt::format("person: session {}, name '{}', {}", person.session, person.name, name_of(person.role)));
  return lines;
}
inline Lines describe(const SaidMessage& m) {
  return {fmt::format("said: session {}, name '{}', text '{}'", m.session, m.name, m.text)};
}
inline Lines describe(const PlaybackMessage& m) {
  return {fmt::format("playback: moment {} of {} to {}, speed {}, playing: {}, {} heeded", m.moment, m.first,
                      m.last, m.speed, m.playing, m.heeded),
          fmt::format("grows: {}, refusal '{}'", m.grows, m.refusal)};
}
inline Lines describe(const MarksMessage& m) {
  Lines lines{fmt::format("marks: after tick {}, {} ticks a column, from column {}, read to tick {}", m.first,
                          m.ticks_per_column, m.from, m.read_to)};
  for (const Mark& mark : m.marks)
    lines.push_back(fmt::format("mark: {} {} in column {}", mark.count, name_of(mark.kind), mark.column));
  return lines;
}
inline Lines describe(const RecordedCursorsMessage& m) {
  Lines lines{"recorded cursors"};
  for (const PlayerCursor& cursor : m.cursors)
    lines.push_back(fmt::format("cursor: session {}, name '{}', eye {}, aim {}", cursor.session, cursor.name,
                                words(cursor.eye_m), words(cursor.aim_m)));
  return lines;
}
inline Lines describe(const AskHealthMessage&) {
  return {"ask health"};
}
inline Lines describe(const HealthMessage& m) {
  Lines lines{fmt::format("health: alive {}, well {}, ready {}, tick {}", m.alive, m.well, m.ready, m.tick)};
  for (const HealthFault& fault : m.faults)
    lines.push_back(fmt::format("fault: {}, '{}'", fault.name, fault.words));
  return lines;
}
inline Lines describe(const GoodbyeMessage&) {
  return {"goodbye"};
}
inline Lines describe(const AskGroundMessage& m) {
  return {fmt::format("ground: {}", words(m.chunks))};
}
inline Lines words(const HeightGround& m) {
  const HeightLayout& layout = m.layout;
  Lines lines{fmt::format("heights: {} × {} samples every {} m, {} to {} / 256 m", layout.columns,
                          layout.rows, layout.cell_m, layout.lowest, layout.highest),
              fmt::format("soil below {} m, ice above {} m, coarsest tile {}", layout.layers.soil_below_m,
                          layout.layers.ice_above_m, hex_of(m.top))};
  if (m.bricks)
    lines.push_back(fmt::format("stored chunks: {} to {}, voxels of {} m, root {}",
                                words(m.bricks->layout.lo), words(m.bricks->layout.hi),
                                m.bricks->layout.voxel_size_m, hex_of(m.bricks->root)));
  return lines;
}
inline std::string words(const std::vector<TileKey>& keys) {
  std::string text;
  for (const TileKey key : keys)
    text += key.kind == TileKind::bricks
                ? fmt::format(" chunk ({}, {}, {}, {})", key.level, key.x, key.y, key.z)
                : fmt::format(" ({}, {}, {})", key.level, key.x, key.z);
  return text;
}
inline Lines describe(const AskTilesMessage& m) {
  return {"tiles wanted:" + words(m.wanted), "tiles held:" + words(m.held)};
}
inline Lines describe(const TileMessage& m) {
  return {fmt::format("tile{}: {} bytes", words(std::vector{m.key}), m.bytes.size())};
}
inline Lines describe(const AskContentMessage& m) {
  Lines lines{"content:"};
  for (const Digest& digest : m.wanted) lines.push_back("digest: " + hex_of(digest));
  return lines;
}
inline Lines describe(const ContentMessage& m) {
  if (m.total == 0) return {"content: none of " + hex_of(m.digest)};
  return {fmt::format("content: {} of {} bytes, from {} on, of {}", m.part.size(), m.total, m.offset,
                      hex_of(m.digest))};
}
inline Lines describe(const PaletteChangedMessage& m) {
  return {"palette changed: " + hex_of(m.palette)};
}
inline Lines describe(const WelcomeMessage& m) {
  Lines lines{
      fmt::format("welcome: protocol {}, session {}, tick {}, role {}", m.protocol, m.session, m.tick,
                  name_of(m.role)),
      fmt::format("{} ticks a second, transforms every {} ticks, radius {} m, replay: {}", m.tick_rate_hz,
                  m.ticks_per_transform, m.interest_radius_m, m.replay),
      fmt::format("terrain: {}, seed {}, voxels of {} m", row_of(m.terrain.kind).name, m.terrain.random_seed,
                  m.terrain.voxel_size_m),
      fmt::format("world 0x{:016x}, ticket {}, resumed: {}", m.world, words_of_bytes(m.ticket), m.resumed)};
  if (m.heights) append(lines, words(*m.heights));
  if (m.palette) lines.push_back("palette: " + hex_of(*m.palette));
  if (m.spawn) lines.push_back("spawn: " + text_of(*m.spawn));
  return lines;
}
inline Lines describe(const RefusalMessage& m) {
  return {fmt::format("refusal: '{}', name '{}'", m.reason, m.name)};
}
/// The check is compared with that of the patches, which replace all edits of their chunks here.
inline Lines describe(const FrameMessage& m) {
  Lines lines{fmt::format("frame: tick {}, {} operations", m.tick, m.operations.size())};
  append(lines, words(m.patches));
  uint64_t sum = 0;
  for (const BrickPatch& patch : m.patches) sum += brick_hash(patch.coord, patch.brick, patch.materials);
  const auto folded = static_cast<uint32_t>(sum >> 32U) ^ static_cast<uint32_t>(sum);
  if (m.has_check) {
    lines.push_back(fmt::format("check: 0x{:08x}", m.check));
    EXPECT_EQ(m.check, folded);
  }
  if (!m.dropped_chunks.empty()) lines.push_back("dropped: " + words(m.dropped_chunks));
  if (!m.removed_pieces.empty())
    lines.push_back(fmt::format("removed: {}", fmt::join(m.removed_pieces, " ")));
  append(lines, words(*unpack_transforms(m.transforms)));
  return lines;
}
inline Lines describe(const ChunkMessage& m) {
  Lines lines{fmt::format("chunk: {}, version {}, hash 0x{:016x}", words(m.chunk), m.version, m.hash)};
  if (m.is_part()) lines.push_back(fmt::format("part: edited 0x{:016x}, more: {}", m.edited, m.more));
  uint64_t sum = 0;
  for (const BrickPatch& patch : m.bricks) sum += brick_hash(patch.coord, patch.brick, patch.materials);
  if (!m.is_part()) {
    EXPECT_EQ(m.hash, sum);
  }
  append(lines, words(m.bricks));
  return lines;
}
inline Lines describe(const PieceMessage& m) {
  Lines lines{fmt::format("piece: {} {}", m.id, words(m.pose))};
  append(lines, words(m.volume));
  return lines;
}
inline Lines describe(const ResetMessage&) {
  return {"reset"};
}
inline Lines describe(const ReplyMessage& m) {
  Lines lines{fmt::format("reply: request {}, refusal '{}', name '{}', {} pieces", m.request, m.refusal,
                          m.refusal_name, m.pieces)};
  if (m.latency != ServerLatency{})
    lines.push_back(fmt::format("waiting {} µs, tick {} µs, sending {} µs", m.latency.waiting_us,
                                m.latency.tick_us, m.latency.sending_us));
  if (m.painted) lines.push_back(fmt::format("{} bricks painted", *m.painted));
  if (m.prop) lines.push_back(fmt::format("prop {}", *m.prop));
  if (m.mass) lines.push_back(fmt::format("mass {}", *m.mass));
  if (m.tick != 0) lines.push_back(fmt::format("tick {}", m.tick));
  return lines;
}
inline Lines describe(const StatusMessage& m) {
  Lines lines{fmt::format("status: tick {}, {} clients, {} pieces, field hash 0x{:016x}", m.tick, m.clients,
                          m.pieces, m.field_hash)};
  if (!m.saving.empty()) lines.push_back(fmt::format("saving '{}', saved tick {}", m.saving, m.saved_tick));
  if (m.chunks_waiting != 0) lines.push_back(fmt::format("{} chunks waiting", m.chunks_waiting));
  if (m.paging != PagingStatus{})
    lines.push_back(fmt::format("chunks: {} in memory, {} out, {} read, {} waits, {} requests held",
                                m.paging.chunks_in, m.paging.chunks_out, m.paging.chunks_read,
                                m.paging.chunk_waits, m.paging.requests_held));
  return lines;
}
inline Lines describe(const CursorsMessage& m) {
  Lines lines{"cursors:"};
  for (const PlayerCursor& cursor : m.cursors)
    lines.push_back(fmt::format("cursor: session {}, name '{}', eye {}, aim {}", cursor.session, cursor.name,
                                words(cursor.eye_m), words(cursor.aim_m)));
  return lines;
}
inline Lines describe(const PhysicsMessage& m) {
  Lines lines{fmt::format("physics: tick {}", m.tick)};
  for (const BodyView& body : m.bodies)
    lines.push_back(fmt::format("body: {}, awake: {}, island: {}, {} corners", body.id, body.awake,
                                body.island, body.hull_m.size()));
  for (const ContactView& contact : m.contacts)
    lines.push_back(fmt::format("contact: {}, normal {}, {} N s", words(contact.point_m),
                                words(contact.normal), contact.impulse_n_s));
  lines.push_back("searched: " + words(m.searched));
  return lines;
}
inline Lines describe(const GroundMessage& m) {
  if (m.beyond) return {fmt::format("ground: {} lies beyond the interest", words(m.chunk))};
  Lines lines{fmt::format("ground: {}, rock 0x{:016x}, hash 0x{:016x}", words(m.chunk), m.rock, m.hash)};
  append(lines, words(m.bricks));
  uint64_t sum = 0;
  for (int i = 0; i < 64; ++i) {
    const BrickCoord coord = brick_in_chunk(m.chunk, i);
    const auto listed = std::ranges::find(m.bricks, coord, &BrickPatch::coord);
    const bool rock = ((m.rock >> i) & 1U) != 0;
    sum += brick_hash(coord, listed != m.bricks.end() ? listed->brick : (rock ? solid_brick() : air_brick()));
  }
  EXPECT_EQ(m.hash, sum);
  return lines;
}
}  // namespace scree
