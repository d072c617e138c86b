// Converts the messages of a bus between plain values and bytes (server/formats/bus.proto).
//
// Decoders check everything: a program that may write to the bus may write anything. Pure functions, safe to
// call from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/formats/recording_codec.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

namespace limits {
/// Bytes of a keyframe on a bus, in all its parts. Above: it is not told, and edges cannot begin.
inline constexpr size_t told_keyframe_bytes_max = size_t{512} << 20U;

/// Likewise of a tick. Above: a keyframe follows in its place.
inline constexpr size_t told_tick_bytes_max = size_t{16} << 20U;

/// Bytes of a part at most, whatever a server of NATS would take: ticks come in between.
inline constexpr size_t told_part_bytes_max = size_t{256} << 10U;

/// Parts of a value; above: refused.
inline constexpr uint32_t told_parts_max = 1U << 16U;

/// Bytes of a pipe in one message.
inline constexpr size_t pipe_bytes_max = size_t{64} << 10U;
}  // namespace limits

struct ToldPart {
  uint64_t run = 0;  ///< not 0
  Tick tick = 0;
  uint32_t number = 0;
  uint32_t count = 1;
  std::vector<uint8_t> bytes;
};

struct ToldWhole {
  uint64_t run = 0;  ///< not 0
  Tick tick = 0;
  uint64_t begins = 0;  ///< place in the stream, from 1 on
};

/// A keyframe whose terrain and pieces are rows.
struct ToldKeyframe {
  uint64_t world = 0;  ///< as of WelcomeMessage::world
  std::vector<uint8_t> header;
  std::vector<uint8_t> state;
  struct Chunk {
    uint64_t key = 0;
    uint64_t hash = 0;
    std::vector<uint8_t> data;
  };
  std::vector<Chunk> chunks;
  std::vector<std::vector<uint8_t>> pieces;
};

struct PipeMessage {
  uint64_t edge_run = 0;  ///< not 0
  uint64_t pipe = 0;      ///< 0: the edge says that it lives
  uint64_t number = 0;
  std::vector<uint8_t> bytes;
  bool ends = false;
};

std::vector<uint8_t> encode(const ToldPart& part);
std::vector<uint8_t> encode(const ToldWhole& whole);
std::vector<uint8_t> encode(const ToldKeyframe& keyframe);
std::vector<uint8_t> encode(const PipeMessage& message);
std::vector<uint8_t> encode_told(const RecordedFrame& frame);

Result<ToldPart> decode_told_part(std::span<const uint8_t> bytes);
Result<ToldWhole> decode_told_whole(std::span<const uint8_t> bytes);
Result<ToldKeyframe> decode_told_keyframe(std::span<const uint8_t> bytes);
Result<PipeMessage> decode_pipe_message(std::span<const uint8_t> bytes);
Result<RecordedFrame> decode_told(std::span<const uint8_t> bytes);

}  // namespace scree
