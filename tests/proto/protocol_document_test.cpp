// The examples of docs/protocol.md, decoded by the real codecs: what the document says of their bytes is so,
// each kind of message has an example, and numbers that the document names are those of the limits.
//
// An example is a fenced block "```example KIND", its lines "bytes: …" in hexadecimal, then the lines that
// the bytes decode to, word for word.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "proto/byte_stream.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "proto/transforms.h"
#include "server/net/limits.h"
#include "shared/base/overloaded.h"
#include "shared/field/field.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

using Lines = std::vector<std::string>;

struct Example {
  std::string kind;
  std::vector<uint8_t> bytes;
  Lines lines;
};

std::string document() {
  std::ifstream in(std::string(SCREE_SOURCE_DIR) + "/docs/protocol.md", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<Example> examples() {
  static const std::string fence = "```example ";
  std::vector<Example> found;
  std::istringstream text(document());
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(fence)) {
      found.push_back({line.substr(fence.size()), {}, {}});
      inside = true;
    } else if (line == "```") {
      inside = false;
    } else if (inside && line.starts_with("bytes: ")) {
      std::istringstream hex(line.substr(7));
      for (std::string byte; hex >> byte;)
        found.back().bytes.push_back(static_cast<uint8_t>(std::stoul(byte, nullptr, 16)));
    } else if (inside) {
      found.back().lines.push_back(line);
    }
  }
  return found;
}

// ---- values in words

template <typename Tag>
std::string words(const Coord<Tag>& c) {
  return fmt::format("({}, {}, {})", c.x, c.y, c.z);
}
std::string words(glm::vec3 v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
std::string words(const QuantisedPose& pose) {
  return fmt::format("({}, {}, {}), rotation 0x{:08x}", pose.x, pose.y, pose.z, pose.rotation);
}
std::string words(std::span<const Code> codes) {
  if (std::ranges::count(codes, codes.front()) == static_cast<ptrdiff_t>(codes.size()))
    return fmt::format("all {} codes {}", codes.size(), codes.front());
  return fmt::format("codes {} … {}", fmt::join(codes.first(3), " "), codes.back());
}
std::string words(const Shape& shape) {
  std::string b = row_of(shape.kind).has_b ? ", b " + words(shape.b) : "";
  return fmt::format("{}, a {}{}, radius {} m", row_of(shape.kind).name, words(shape.a), b, shape.radius_m);
}

template <typename Tag>
std::string words(const std::vector<Coord<Tag>>& coords) {
  std::string all;
  for (const Coord<Tag>& coord : coords) all += (all.empty() ? "" : " ") + words(coord);
  return all.empty() ? "none" : all;
}

Lines words(const std::vector<BrickPatch>& bricks) {
  Lines lines;
  for (const BrickPatch& patch : bricks) {
    const std::string paint =
        patch.paint ? fmt::format("painted {}", row_of(*patch.paint).name) : "not painted";
    lines.push_back(fmt::format("brick: {}, {}, {}, hash 0x{:016x}", words(patch.coord), paint,
                                words(std::span<const Code>(patch.brick.codes)),
                                brick_hash(patch.coord, patch.brick, patch.paint)));
  }
  return lines;
}

Lines words(const Volume& volume) {
  const VoxelBox& box = volume.window.box;
  return {
      fmt::format("volume: first voxel {}, sides {}, mass {}", words(box.lo), words(box.size()), volume.mass),
      fmt::format("centre of mass: {} voxels, material {}", words(volume.centre_voxels),
                  row_of(volume.material).name),
      words(std::span<const Code>(volume.window.codes))};
}

Lines words(const std::vector<PieceState>& pieces) {
  Lines lines;
  for (const PieceState& piece : pieces)
    lines.push_back(fmt::format("pose: piece {} {}", piece.id, words(piece.pose)));
  return lines;
}

void append(Lines& lines, const Lines& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

// ---- messages in words

Lines describe(const HelloMessage& m) {
  return {fmt::format("hello: protocol {}, client '{}', name '{}', eye {}, radius {} m, kernels: {}",
                      m.protocol, m.client, m.name, words(m.eye_m), m.interest_radius_m,
                      m.lacks_kernels ? "none" : "has them")};
}
Lines describe(const InterestMessage& m) {
  return {fmt::format("interest: eye {}, radius {} m", words(m.eye_m), m.interest_radius_m)};
}
Lines describe(const CarveMessage& m) {
  return {fmt::format("carve: request {}, {}", m.request, words(m.shape)),
          fmt::format("pattern {}, {} seeds, random seed 0x{:08x}, impact {}, blast {} m/s",
                      row_of(m.pattern).name, m.seeds, m.random_seed, words(m.impact_m), m.blast_speed_m_s)};
}
Lines describe(const FillMessage& m) {
  return {fmt::format("fill: request {}, {}", m.request, words(m.shape))};
}
Lines describe(const PaintMessage& m) {
  return {
      fmt::format("paint: request {}, {}, material {}", m.request, words(m.shape), row_of(m.material).name)};
}
Lines describe(const RepairRequest& m) {
  Lines lines{fmt::format("repair: tick {}", m.tick)};
  for (size_t i = 0; i < m.chunks.size(); ++i)
    lines.push_back(fmt::format("chunk: {}, hash 0x{:016x}", words(m.chunks[i]), m.hashes[i]));
  return lines;
}
Lines describe(const AckMessage& m) {
  return {fmt::format("ack: tick {}", m.tick)};
}
Lines describe(const AdminMessage& m) {
  Lines lines{fmt::format("admin: request {}, token '{}'", m.request, m.token)};
  for (const SettingValue& setting : m.settings)
    lines.push_back(fmt::format("setting: {} = {}", setting.name, setting.value));
  return lines;
}
Lines describe(const CursorMessage& m) {
  return {fmt::format("cursor: eye {}, aim {}", words(m.eye_m), words(m.aim_m))};
}
Lines describe(const WatchMessage& m) {
  return {fmt::format("watch: physics {}", m.physics)};
}
Lines describe(const GroundRequest& m) {
  return {fmt::format("ground: {}", words(m.chunks))};
}
Lines describe(const WelcomeMessage& m) {
  return {fmt::format("welcome: protocol {}, session {}, tick {}", m.protocol, m.session, m.tick),
          fmt::format("{} ticks a second, transforms every {} ticks, radius {} m, replay: {}", m.tick_rate_hz,
                      m.ticks_per_transform, m.interest_radius_m, m.replay),
          fmt::format("terrain: {}, seed {}, voxels of {} m", row_of(m.terrain.kind).name,
                      m.terrain.random_seed, m.terrain.voxel_size_m)};
}
Lines describe(const RefusalMessage& m) {
  return {fmt::format("refusal: '{}'", m.reason)};
}
/// The check is compared with that of the patches, which replace all edits of their chunks here.
Lines describe(const FrameMessage& m) {
  Lines lines{fmt::format("frame: tick {}, {} operations", m.tick, m.operations.size())};
  append(lines, words(m.patches));
  uint64_t sum = 0;
  for (const BrickPatch& patch : m.patches) sum += brick_hash(patch.coord, patch.brick, patch.paint);
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
Lines describe(const ChunkMessage& m) {
  Lines lines{fmt::format("chunk: {}, version {}, hash 0x{:016x}", words(m.chunk), m.version, m.hash)};
  uint64_t sum = 0;
  for (const BrickPatch& patch : m.bricks) sum += brick_hash(patch.coord, patch.brick, patch.paint);
  EXPECT_EQ(m.hash, sum);
  append(lines, words(m.bricks));
  return lines;
}
Lines describe(const PieceMessage& m) {
  Lines lines{fmt::format("piece: {} {}", m.id, words(m.pose))};
  append(lines, words(m.volume));
  return lines;
}
Lines describe(const ResetMessage&) {
  return {"reset"};
}
Lines describe(const ReplyMessage& m) {
  return {fmt::format("reply: request {}, refusal '{}', {} pieces", m.request, m.refusal, m.pieces)};
}
Lines describe(const StatusMessage& m) {
  return {fmt::format("status: tick {}, {} clients, {} pieces, field hash 0x{:016x}", m.tick, m.clients,
                      m.pieces, m.field_hash)};
}
Lines describe(const CursorsMessage& m) {
  Lines lines{"cursors:"};
  for (const PlayerCursor& cursor : m.cursors)
    lines.push_back(fmt::format("cursor: session {}, name '{}', eye {}, aim {}", cursor.session, cursor.name,
                                words(cursor.eye_m), words(cursor.aim_m)));
  return lines;
}
Lines describe(const PhysicsMessage& m) {
  Lines lines{fmt::format("physics: tick {}", m.tick)};
  for (const WatchedBody& body : m.bodies)
    lines.push_back(fmt::format("body: {}, awake: {}, island: {}, {} corners", body.id, body.awake,
                                body.island, body.hull_m.size()));
  for (const WatchedContact& contact : m.contacts)
    lines.push_back(fmt::format("contact: {}, normal {}, {} N s", words(contact.point_m),
                                words(contact.normal), contact.impulse_n_s));
  lines.push_back("searched: " + words(m.searched));
  return lines;
}
Lines describe(const GroundMessage& m) {
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

// ---- kinds of examples

template <typename Message>
Lines of_message(const Result<Message>& message) {
  if (!message) return {message.error().message};
  return std::visit([](const auto& m) { return describe(m); }, *message);
}

Lines decoded(const std::string& kind, std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, "example");
  const auto body = [&] {
    EXPECT_EQ(reader.u32("length"), bytes.size() - length_prefix_bytes);
    return bytes.subspan(length_prefix_bytes);
  };
  if (kind == "client message") return of_message(decode_client(body()));
  if (kind == "server message") return of_message(decode_server(body()));
  if (kind == "code") return {fmt::format("distance: {:.4f} voxels", decode(static_cast<Code>(bytes[0])))};
  if (kind == "varint") return {fmt::format("number: {}", reader.varint("number"))};
  if (kind == "zigzag") return {fmt::format("number: {}", reader.zigzag("number", int64_t{1} << 62U))};
  if (kind == "coords") {
    std::vector<ChunkCoord> coords;
    while (!reader.at_end())
      coords.push_back(read_coord(reader, coords.empty() ? ChunkCoord{} : coords.back(), 1 << 20, "coord"));
    return {"coords: " + words(coords)};
  }
  if (kind == "bricks") return words(*decode_bricks(bytes, limits::bricks_per_message_max));
  if (kind == "volume") return words(*decode_volume(bytes));
  if (kind == "transforms") return words(*unpack_transforms(bytes));
  if (kind == "rotation") {
    const glm::quat q = dequantise({0, 0, 0, reader.u32("rotation")}).rotation;
    return {fmt::format("quaternion: x {:.4f}, y {:.4f}, z {:.4f}, w {:.4f}", q.x, q.y, q.z, q.w)};
  }
  return {"no such kind of example: " + kind};
}

std::string block(const Lines& lines) {
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

TEST(ProtocolDocument, every_example_decodes_to_what_stands_under_it) {
  const std::vector<Example> all = examples();
  EXPECT_GE(all.size(), 30U);
  for (const Example& example : all) {
    SCOPED_TRACE(example.kind + ", stated:\n" + block(example.lines));
    EXPECT_EQ(block(decoded(example.kind, example.bytes)), block(example.lines));
  }
}

TEST(ProtocolDocument, every_kind_of_message_has_an_example) {
  std::set<size_t> of_clients, of_servers;
  for (const Example& example : examples()) {
    const std::span<const uint8_t> body =
        std::span(example.bytes).subspan(std::min<size_t>(4, example.bytes.size()));
    if (example.kind == "client message")
      if (const auto message = decode_client(body)) of_clients.insert(message->index());
    if (example.kind == "server message")
      if (const auto message = decode_server(body)) of_servers.insert(message->index());
  }
  EXPECT_EQ(of_clients.size(), std::variant_size_v<ClientMessage>);
  EXPECT_EQ(of_servers.size(), std::variant_size_v<ServerMessage>);
}

/// The document's table of limits: rows "| `name` | number | …".
TEST(ProtocolDocument, its_limits_are_the_programs) {
  const std::map<std::string, double> limits_by_name = {
      {"message_bytes_max", limits::message_bytes_max},
      {"hello_seconds_max", limits::hello_seconds_max},
      {"stall_seconds_max", limits::stall_seconds_max},
      {"linger_seconds_max", limits::linger_seconds_max},
      {"pending_sessions_max", limits::pending_sessions_max},
      {"messages_per_second_max", limits::messages_per_second_max},
      {"messages_burst_max", limits::messages_burst_max},
      {"commands_waiting_max", limits::commands_waiting_max},
      {"interest_radius_max_m", limits::interest_radius_max_m},
      {"interest_keep_factor", limits::interest_keep_factor},
      {"edit_reach_min_m", limits::edit_reach_min_m},
      {"edit_reach_max_m", limits::edit_reach_max_m},
      {"blast_speed_max_m_s", limits::blast_speed_max_m_s},
      {"world_half_width_m", limits::world_half_width_m},
      {"world_half_height_m", limits::world_half_height_m},
      {"bricks_per_message_max", limits::bricks_per_message_max},
      {"window_side_max", limits::window_side_max},
      {"repair_chunks_max", limits::repair_chunks_max},
      {"ground_chunks_max", limits::ground_chunks_max},
      {"chunk_bytes_per_tick", limits::chunk_bytes_per_tick},
      {"piece_bytes_per_tick", limits::piece_bytes_per_tick},
      {"ground_bytes_per_tick", limits::ground_bytes_per_tick},
      {"patch_bricks_per_tick", limits::patch_bricks_per_tick},
      {"patch_bricks_max", limits::patch_bricks_max},
      {"outbox_soft_bytes", limits::outbox_soft_bytes},
      {"outbox_resync_bytes", limits::outbox_resync_bytes},
      {"outbox_hard_bytes", limits::outbox_hard_bytes}};
  static const std::regex row(R"(\n\| `(\w+)` \| ([0-9.,]+) \|)");
  const std::string text = document();
  size_t found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it, ++found) {
    std::string number = (*it)[2];
    std::erase(number, ',');
    const auto limit = limits_by_name.find((*it)[1]);
    ASSERT_NE(limit, limits_by_name.end()) << (*it)[1];
    EXPECT_EQ(std::stod(number), limit->second) << (*it)[1];
  }
  EXPECT_EQ(found, limits_by_name.size());
}

}  // namespace
}  // namespace scree
