#include "proto/join_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/content_codec.h"
#include "proto/height_wire.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

constexpr size_t short_hash_bytes = sizeof(uint16_t);

std::string pack_hashes(const std::vector<uint16_t>& hashes) {
  std::string bytes;
  bytes.reserve(hashes.size() * short_hash_bytes);
  for (const uint16_t hash : hashes) {
    bytes.push_back(static_cast<char>(hash & 0xFFU));
    bytes.push_back(static_cast<char>(hash >> 8U));
  }
  return bytes;
}

std::vector<uint16_t> unpack_hashes(const std::string& packed, size_t count, FieldChecker& check) {
  if (packed.size() != count * short_hash_bytes) {
    check.refuse(fmt::format("{} bytes of hashes for {} chunks", packed.size(), count));
    return {};
  }
  std::vector<uint16_t> hashes(count);
  const std::span<const uint8_t> bytes = as_span(packed);
  for (size_t i = 0; i < count; ++i)
    hashes[i] = static_cast<uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8U));
  return hashes;
}

}  // namespace

void write(wire::Hello& to, const HelloMessage& from) {
  to.set_protocol(from.protocol);
  to.set_client(showable(from.client, limits::client_name_bytes_max));
  write(*to.mutable_eye(), from.eye_m);
  to.set_interest_radius_m(from.interest_radius_m);
  to.set_name(showable(from.name, limits::person_name_bytes_max));
  to.set_token(showable(from.token, limits::access_token_bytes_max));
  to.set_lacks_kernels(from.lacks_kernels);
  if (!from.lacks_kernels) to.set_operations(from.operations);
  to.set_oldest_protocol(from.oldest_protocol);
  to.set_meets(from.meets);
  to.set_administers(from.administers);
  to.set_ticket(from.ticket);
  to.set_world(from.world);
  to.set_at_spawn(from.at_spawn);
  to.set_stones(from.stones);
}

HelloMessage read_hello(const wire::Hello& from, FieldChecker& check) {
  HelloMessage hello;
  hello.protocol = from.protocol();
  hello.oldest_protocol = from.oldest_protocol();
  // In another version the fields may have another meaning: only its numbers are read, for the refusal.
  if (!shares_protocol(hello.protocol, hello.oldest_protocol)) return hello;
  hello.client = check.text(from.client(), limits::client_name_bytes_max, "client");
  hello.eye_m = check.vec3(from.eye(), "eye");
  hello.interest_radius_m = check.not_negative(from.interest_radius_m(), "interest_radius_m");
  hello.name = check.text(from.name(), limits::person_name_bytes_max, "name");
  hello.lacks_kernels = from.lacks_kernels();
  hello.operations = from.operations() == 0 ? operation_kinds_first : from.operations();
  hello.meets = from.meets();
  hello.administers = from.administers();
  hello.at_spawn = from.at_spawn();
  hello.stones = from.stones();
  hello.token = check.text(from.token(), limits::access_token_bytes_max, "token");
  hello.ticket = check.bytes(from.ticket(), limits::ticket_bytes_max, "ticket");
  hello.world = from.world();
  return hello;
}

void write(wire::Welcome& to, const WelcomeMessage& from) {
  to.set_protocol(from.protocol);
  to.set_session(from.session);
  to.set_tick(from.tick);
  to.set_tick_rate_hz(from.tick_rate_hz);
  to.set_ticks_per_transform(from.ticks_per_transform);
  to.mutable_terrain()->set_kind(static_cast<wire::TerrainKind>(from.terrain.kind));
  to.mutable_terrain()->set_random_seed(from.terrain.random_seed);
  to.mutable_terrain()->set_voxel_size_m(from.terrain.voxel_size_m);
  if (from.terrain.rows != GroundRows{}) write(*to.mutable_terrain()->mutable_rows(), from.terrain.rows);
  if (from.terrain.rubble->any) write(*to.mutable_terrain()->mutable_rubble(), *from.terrain.rubble);
  to.set_interest_radius_m(from.interest_radius_m);
  to.set_replay(from.replay);
  to.set_role(static_cast<wire::Role>(from.role));
  to.set_world(from.world);
  to.set_ticket(from.ticket);
  to.set_resumed(from.resumed);
  if (from.heights) write(*to.mutable_heights(), *from.heights);
  if (from.palette) to.set_palette(wire_digest(*from.palette));
  if (!from.spawn) return;
  write(*to.mutable_spawn(), from.spawn->eye_m);
  to.set_spawn_yaw_degrees(from.spawn->yaw_degrees);
  to.set_spawn_pitch_degrees(from.spawn->pitch_degrees);
}

WelcomeMessage read_welcome(const wire::Welcome& from, FieldChecker& check) {
  WelcomeMessage welcome;
  welcome.protocol = from.protocol();
  welcome.session = from.session();
  welcome.tick = from.tick();
  welcome.tick_rate_hz =
      check.within(from.tick_rate_hz(), limits::tick_rate_min_hz, limits::tick_rate_max_hz, "tick_rate_hz");
  welcome.ticks_per_transform =
      check.within(from.ticks_per_transform(), 1, limits::tick_rate_max_hz, "ticks_per_transform");
  welcome.terrain.kind = check.kind<TerrainKind>(from.terrain().kind(), "kind of terrain");
  welcome.terrain.random_seed = from.terrain().random_seed();
  const float voxel_size_m = check.finite(from.terrain().voxel_size_m(), "voxel_size_m");
  if (voxel_size_m < limits::voxel_size_min_m || voxel_size_m > limits::voxel_size_max_m)
    check.refuse("voxel_size_m is not within the limits (limits.voxel_size_min_m, voxel_size_max_m)");
  welcome.terrain.voxel_size_m = voxel_size_m;
  if (from.terrain().has_rows()) welcome.terrain.rows = read_rows(from.terrain().rows(), check);
  if (from.terrain().has_rubble())
    welcome.terrain.rubble = Rubble(read_rubble(from.terrain().rubble(), check));
  welcome.interest_radius_m = check.not_negative(from.interest_radius_m(), "interest_radius_m");
  welcome.replay = from.replay();
  welcome.role = check.kind_or(from.role(), Role::viewer);
  welcome.world = from.world();
  welcome.ticket = check.bytes(from.ticket(), limits::ticket_bytes_max, "ticket");
  welcome.resumed = from.resumed();
  if (from.has_heights()) welcome.heights = read_heights(from.heights(), check);
  welcome.palette = read_any_digest(from.palette(), "palette", check);
  if (from.has_spawn())
    welcome.spawn = {check.vec3(from.spawn(), "spawn"),
                     check.finite(from.spawn_yaw_degrees(), "spawn_yaw_degrees"),
                     check.finite(from.spawn_pitch_degrees(), "spawn_pitch_degrees")};
  return welcome;
}

void write(wire::Offer& to, const OfferMessage& from) {
  CHECK_EQ(from.chunks.size(), from.hashes.size());
  to.set_world(from.world);
  to.set_chunks(pack_chunks(from.chunks));
  to.set_hashes(pack_hashes(from.hashes));
}

OfferMessage read_offer(const wire::Offer& from, FieldChecker& check) {
  OfferMessage offer;
  offer.world = from.world();
  offer.chunks = check.chunks(from.chunks(), limits::offer_chunks_max, "chunks of an offer");
  if (std::ranges::adjacent_find(offer.chunks, std::ranges::greater_equal{}) != offer.chunks.end())
    check.refuse("chunks of an offer do not ascend");
  offer.hashes = unpack_hashes(from.hashes(), offer.chunks.size(), check);
  return offer;
}

void write(wire::Kept& to, const UnchangedChunksMessage& from) {
  CHECK_EQ(from.chunks.size(), from.hashes.size());
  to.set_chunks(pack_chunks(from.chunks));
  to.mutable_hashes()->Add(from.hashes.begin(), from.hashes.end());
}

UnchangedChunksMessage read_unchanged_chunks(const wire::Kept& from, FieldChecker& check) {
  UnchangedChunksMessage unchanged;
  unchanged.chunks = check.chunks(from.chunks(), limits::kept_chunks_max, "chunks kept");
  unchanged.hashes.assign(from.hashes().begin(), from.hashes().end());
  if (unchanged.hashes.size() != unchanged.chunks.size())
    check.refuse(
        fmt::format("{} hashes for {} chunks kept", unchanged.hashes.size(), unchanged.chunks.size()));
  return unchanged;
}

}  // namespace scree
