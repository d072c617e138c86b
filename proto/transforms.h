// The poses of many pieces as packed bytes: FrameMessage::transforms.
//
// Ordered by id, strictly ascending. For each piece: the id as a varint difference to the piece before; the
// position as three zigzag varint differences to the piece before, since neighbours were often cut from the
// same rock; 32 bits of rotation. These are 11 bytes where neighbours are within 8 m. Layout:
// proto/scree.proto, Frame.transforms.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "proto/limits.h"
#include "shared/base/result.h"
#include "shared/field/piece.h"

namespace scree {

/// `pieces` must be ordered by id without repetition, positions within ± limits::pose_coordinate_max. No
/// pieces give no bytes.
std::vector<uint8_t> pack_transforms(std::span<const PieceState> pieces);

/// Refuses ids that do not ascend, positions out of range, remaining bytes, and more than
/// limits::entries_per_frame_max pieces.
Result<std::vector<PieceState>> unpack_transforms(std::span<const uint8_t> bytes);

}  // namespace scree
