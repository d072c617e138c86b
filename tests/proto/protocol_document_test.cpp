// The examples of docs/protocol.md, decoded by the real codecs. The document is right about their bytes, each
// kind of message has an example, its numbers are those of the limits, and its refusals are the server's.
//
// An example is a fenced block "```example KIND", its lines "bytes: …" in hexadecimal, then the lines that
// the bytes decode to, word for word.
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "client/connection/come_again.h"
#include "proto/byte_stream.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "proto/transforms.h"
#include "server/command/refusal.h"
#include "server/doors/limits.h"
#include "server/net/limits.h"
#include "server/publish/limits.h"
#include "server/world/person_limits.h"
#include "shared/operation/added_piece_limits.h"
#include "shared/operation/limits.h"
#include "shared/prop/limits.h"
#include "shared/region/limits.h"
#include "tests/proto/message_words.h"
#include "tests/proto/prop_words.h"
#include "tests/proto/query_words.h"
#include "tests/proto/region_words.h"
#include "tests/proto/rules_words.h"
#include "tests/proto/store_words.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

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

template <typename Message>
void note(const Result<Message>& message, std::set<size_t>& kinds, std::set<size_t>& acts) {
  if (!message) return;
  kinds.insert(message->index());
  if constexpr (std::is_same_v<Message, ClientMessage>)
    if (const auto* admin = std::get_if<AdminMessage>(&*message)) acts.insert(admin->act.index());
}

TEST(ProtocolDocument, every_kind_of_message_and_act_has_an_example) {
  std::set<size_t> of_clients, of_servers, acts;
  for (const Example& example : examples()) {
    const std::span<const uint8_t> body =
        std::span(example.bytes).subspan(std::min(length_prefix_bytes, example.bytes.size()));
    if (example.kind == "client message") note(decode_client(body), of_clients, acts);
    if (example.kind == "server message") note(decode_server(body), of_servers, acts);
  }
  EXPECT_EQ(of_clients.size(), std::variant_size_v<ClientMessage>);
  EXPECT_EQ(of_servers.size(), std::variant_size_v<ServerMessage>);
  EXPECT_EQ(acts.size(), std::variant_size_v<AdminRequest>);
}

/// Limits of tiles, content, questions and bodies that the document's table names.
std::map<std::string, double> stated_limits_of_streams() {
  return {{"tiles_wanted_max", limits::tiles_wanted_max},
          {"tiles_held_max", limits::tiles_held_max},
          {"tile_bytes_max", limits::tile_bytes_max},
          {"contents_wanted_max", limits::contents_wanted_max},
          {"content_bytes_max", limits::content_bytes_max},
          {"content_part_bytes_max", limits::content_part_bytes_max},
          {"content_bytes_per_tick", limits::content_bytes_per_tick},
          {"content_bytes_per_tick_all", limits::content_bytes_per_tick_all},
          {"tile_bytes_per_tick", limits::tile_bytes_per_tick},
          {"questions_max", limits::questions_max},
          {"query_ids_max", limits::query_ids_max},
          {"queries_per_second_max", limits::queries_per_second_max},
          {"queries_burst_max", limits::queries_burst_max},
          {"queries_waiting_max", limits::queries_waiting_max},
          {"query_past_s", limits::query_past_s},
          {"query_wait_s", limits::query_wait_s},
          {"query_steps_per_tick", limits::query_steps_per_tick},
          {"query_bytes_per_tick", limits::query_bytes_per_tick},
          {"joint_gap_max_m", limits::joint_gap_max_m},
          {"kept_pieces_max", limits::kept_pieces_max},
          {"person_bodies_max", limits::person_bodies_max},
          {"walk_inputs_max", limits::walk_inputs_max},
          {"walk_numbers_ahead_max", limits::walk_numbers_ahead_max},
          {"walk_inputs_a_tick_max", limits::walk_inputs_a_tick_max},
          {"walk_inputs_burst_s", limits::walk_inputs_burst_s},
          {"eye_off_person_m", limits::eye_off_person_m},
          {"store_name_bytes_max", limits::store_name_bytes_max},
          {"stores_max", limits::stores_max},
          {"stores_a_message", limits::stores_a_message},
          {"bodies_named_max", limits::bodies_named_max},
          {"regions_max", limits::regions_max},
          {"region_name_bytes_max", limits::region_name_bytes_max},
          {"region_persons_max", limits::region_persons_max},
          {"region_half_min_m", limits::region_half_min_m},
          {"region_half_max_m", limits::region_half_max_m},
          {"regions_wait_s", limits::regions_wait_s},
          {"tile_bytes_per_tick_all", limits::tile_bytes_per_tick_all}};
}

/// Limits of what the rules of a game show and tell.
std::map<std::string, double> stated_limits_of_rules() {
  return {{"signs_max", limits::signs_max},
          {"sign_text_bytes_max", limits::sign_text_bytes_max},
          {"notices_a_tick_max", limits::notices_a_tick_max},
          {"channel_bytes_max", limits::channel_bytes_max},
          {"channel_data_bytes_max", limits::channel_data_bytes_max},
          {"signs_wait_s", limits::signs_wait_s},
          {"console_line_bytes_max", limits::console_line_bytes_max},
          {"slow_rows_max", limits::slow_rows_max},
          {"admin_text_bytes_max", limits::admin_text_bytes_max}};
}

/// All others.
std::map<std::string, double> stated_limits() {
  return {{"message_bytes_max", limits::message_bytes_max},
          {"client_message_bytes_max", limits::client_message_bytes_max},
          {"hello_bytes_max", limits::hello_bytes_max},
          {"access_token_bytes_max", limits::access_token_bytes_max},
          {"hello_seconds_max", limits::hello_seconds_max},
          {"stall_seconds_max", limits::stall_seconds_max},
          {"linger_seconds_max", limits::linger_seconds_max},
          {"idle_seconds_max", limits::idle_seconds_max},
          {"inert_seconds_max", limits::inert_seconds_max},
          {"heartbeat_s", limits::heartbeat_s},
          {"offer_chunks_max", limits::offer_chunks_max},
          {"kept_chunks_max", limits::kept_chunks_max},
          {"offer_wait_s", limits::offer_wait_s},
          {"offer_seconds_max", limits::offer_seconds_max},
          {"ticket_bytes_max", limits::ticket_bytes_max},
          {"ticket_seconds_max", limits::ticket_seconds_max},
          {"departed_max", limits::departed_max},
          {"place_kept_seconds_max", limits::place_kept_seconds_max},
          {"places_kept_part", limits::places_kept_part},
          {"outsiders_max", limits::outsiders_max},
          {"connections_per_address_max", limits::connections_per_address_max},
          {"connects_per_second_max", limits::connects_per_second_max},
          {"connects_burst_max", limits::connects_burst_max},
          {"guess_wait_min_s", limits::guess_wait_min_s},
          {"guess_wait_max_s", limits::guess_wait_max_s},
          {"client_bytes_per_second_max", limits::client_bytes_per_second_max},
          {"client_bytes_burst_max", limits::client_bytes_burst_max},
          {"requests_burst_s", limits::requests_burst_s},
          {"messages_per_second_max", limits::messages_per_second_max},
          {"messages_burst_max", limits::messages_burst_max},
          {"commands_waiting_max", limits::commands_waiting_max},
          {"interest_radius_max_m", limits::interest_radius_max_m},
          {"interest_keep_factor", limits::interest_keep_factor},
          {"edit_reach_min_m", limits::edit_reach_min_m},
          {"edit_reach_max_m", limits::edit_reach_max_m},
          {"edit_reach_max_voxels", limits::edit_reach_max_voxels},
          {"added_piece_bytes_max", limits::added_piece_bytes_max},
          {"added_piece_side_max", limits::added_piece_side_max},
          {"added_piece_voxels_max", limits::added_piece_voxels_max},
          {"cut_rests_max", limits::cut_rests_max},
          {"blast_speed_max_m_s", limits::blast_speed_max_m_s},
          {"world_half_width_m", limits::world_half_width_m},
          {"world_half_height_m", limits::world_half_height_m},
          {"bricks_per_message_max", limits::bricks_per_message_max},
          {"window_side_max", limits::window_side_max},
          {"latency_max_us", limits::latency_max_us},
          {"repair_chunks_max", limits::repair_chunks_max},
          {"ground_chunks_max", limits::ground_chunks_max},
          {"ground_work_min", limits::ground_work_min},
          {"ground_work_max", limits::ground_work_max},
          {"scanned_chunks_per_tick", limits::scanned_chunks_per_tick},
          {"bytes_out_per_address", limits::bytes_out_per_address},
          {"bytes_out_all", limits::bytes_out_all},
          {"chunk_bytes_per_tick", limits::chunk_bytes_per_tick},
          {"piece_bytes_per_tick", limits::piece_bytes_per_tick},
          {"stone_bytes_per_tick", limits::stone_bytes_per_tick},
          {"ground_bytes_per_tick", limits::ground_bytes_per_tick},
          {"patch_bricks_per_tick", limits::patch_bricks_per_tick},
          {"patch_bricks_max", limits::patch_bricks_max},
          {"outbox_soft_bytes", limits::outbox_soft_bytes},
          {"outbox_soft_min_bytes", limits::outbox_soft_min_bytes},
          {"outbox_wait_s", limits::outbox_wait_s},
          {"outbox_resync_bytes", limits::outbox_resync_bytes},
          {"admin_rows_max", limits::admin_rows_max},
          {"ban_minutes_max", limits::ban_minutes_max},
          {"outbox_hard_bytes", limits::outbox_hard_bytes}};
}

/// The document's table of limits: rows "| `name` | number | …".
TEST(ProtocolDocument, its_limits_are_the_programs) {
  std::map<std::string, double> limits_by_name = stated_limits();
  limits_by_name.merge(stated_limits_of_streams());
  limits_by_name.merge(stated_limits_of_rules());
  static const std::regex row(R"(\n\| `(\w+)` \| ([0-9.,]+) \|)");
  const std::string text = document();
  size_t found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it, ++found) {
    std::string number = (*it)[2];
    std::erase(number, ',');
    const auto limit = limits_by_name.find((*it)[1]);
    ASSERT_NE(limit, limits_by_name.end()) << (*it)[1];
    EXPECT_FLOAT_EQ(std::stof(number), static_cast<float>(limit->second)) << (*it)[1];
  }
  EXPECT_EQ(found, limits_by_name.size());
}

/// The document's table of what messages cost has a row for each.
TEST(ProtocolDocument, its_costs_are_of_every_message) {
  const std::string text = document(), heading = "| message | draws | bounded by |";
  const size_t begin = text.find(heading);
  ASSERT_NE(begin, text.npos);
  std::istringstream table(text.substr(begin));
  size_t rows = 0;
  for (std::string line; std::getline(table, line) && !line.empty();) ++rows;
  EXPECT_EQ(rows - 2, std::variant_size_v<ClientMessage>);
}

/// The document's table of refusals: rows "| `name`, `name`* | … | again |", which says what clients do.
TEST(ProtocolDocument, its_refusals_are_all_that_end_a_session) {
  std::set<std::string> stated;
  std::set<std::string> given{"edge"};  // it refuses requests as well
  const std::string text = document(), heading = "| refusals |";
  std::istringstream table(text.substr(text.find(heading)));
  static const std::regex quoted("`([a-z_]+)`");
  for (std::string line; std::getline(table, line) && !line.empty();) {
    const std::string first = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator it(first.begin(), first.end(), quoted), end; it != end; ++it) {
      stated.insert((*it)[1]);
      EXPECT_EQ(may_come_again((*it)[1].str()), line.ends_with("| later |")) << line;
    }
  }
  for (auto i = static_cast<size_t>(Refusal::connects_per_second); i < refusal_reasons; ++i)
    given.emplace(name_of(static_cast<Refusal>(i)));
  EXPECT_EQ(stated, given);
}

}  // namespace
}  // namespace scree
