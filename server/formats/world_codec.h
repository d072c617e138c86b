// Converts a world's value (world_value.h) between plain values and bytes. server/formats/world.proto is the
// specification.
//
// Encoding is canonical: equal values give equal bytes, so that a hash of them compares values. Decoders
// check every number and count before they use it: a world file is an untrusted file. Whether the parts agree
// with each other World::restore() says. Pure functions, safe to call from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/formats/world_value.h"
#include "shared/base/result.h"

namespace scree {

/// Version of the rows and tables of a world file. A reader refuses any other.
inline constexpr uint32_t world_format = 5;
inline constexpr uint32_t world_format_oldest = 1;
constexpr bool reads_world_format(uint32_t format) {
  return world_format_oldest <= format && format <= world_format;
}

struct WorldHeader {
  uint32_t format = world_format;
  uint64_t world = 0;     ///< WelcomeMessage::world; never 0 in a file
  RecordedHeader config;  ///< when it was made, and the program that made it
};

/// The edited bricks of a chunk, at least one, ordered.
struct WorldChunk {
  ChunkCoord chunk;
  Tick version = 0;
  uint64_t hash = 0;  ///< Σ brick_hash
  std::vector<BrickPatch> bricks;
  std::optional<MassUnits> ground_mass{};  ///< of the unedited ground where the bricks lie, if it is known
};

std::vector<uint8_t> encode(const WorldHeader& header);
std::vector<uint8_t> encode(const WorldChunk& chunk);
std::vector<uint8_t> encode(const PieceRecord& piece);
/// Without the pieces, which are rows of their own.
std::vector<uint8_t> encode(const WorldMoment& moment);
std::vector<uint8_t> encode(const WorldSnapshot& world);

Result<WorldHeader> decode_world_header(std::span<const uint8_t> bytes);
/// Refuses bricks of another chunk, and a hash that is not that of the bricks.
Result<WorldChunk> decode_world_chunk(std::span<const uint8_t> bytes);
Result<PieceRecord> decode_piece_record(std::span<const uint8_t> bytes);
Result<WorldMoment> decode_world_moment(std::span<const uint8_t> bytes);
Result<WorldSnapshot> decode_world(std::span<const uint8_t> bytes);

}  // namespace scree
