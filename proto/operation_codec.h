// Operations, bricks and volumes as packed bytes: inside messages, and inside recordings.
// The layouts are specified in proto/scree.proto (Frame.operations, Frame.patches, Piece.volume).
//
// Decoders check everything, also that no byte is left over. Pure functions, safe to call from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "proto/limits.h"
#include "proto/messages.h"
#include "shared/base/result.h"
#include "shared/operation/operation.h"

namespace scree {

/// Appends one operation; a sequence of them is their bytes in order.
void append_operation(std::vector<uint8_t>& bytes, const Operation& operation);

std::vector<uint8_t> encode_operation(const Operation& operation);
std::vector<uint8_t> encode_operations(std::span<const Operation> operations);
/// Exactly one operation.
Result<Operation> decode_operation(std::span<const uint8_t> bytes);
/// All of them; at most limits::operations_per_frame_max.
Result<std::vector<Operation>> decode_operations(std::span<const uint8_t> bytes);

/// Bytes that the operation takes within a frame.
size_t operation_bytes(const Operation& operation);

/// A brick that someone else owns.
struct BrickView {
  BrickCoord coord;
  const Brick* brick = nullptr;
  std::optional<Material> paint = std::nullopt;
};

/// Coordinates, then all codes compressed as one. Any number of bricks; none gives no bytes.
std::vector<uint8_t> encode_bricks(std::span<const BrickView> bricks);
std::vector<uint8_t> encode_bricks(std::span<const BrickPatch> bricks);
/// Refuses more than `count_max` bricks, and a brick that comes twice.
Result<std::vector<BrickPatch>> decode_bricks(std::span<const uint8_t> bytes,
                                              size_t count_max = limits::bricks_per_message_max);

std::vector<uint8_t> encode_volume(const Volume& volume);
Result<Volume> decode_volume(std::span<const uint8_t> bytes);

}  // namespace scree
