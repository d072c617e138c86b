// The motions of a frame: FrameMessage::motions. Motions that both sides have go on by the same prediction,
// and the frame says what it missed; a motion that the receiver does not have comes whole. Each frame is
// coded for itself, so that all clients with the same pieces share its bytes.
// Layout: docs/motions.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "proto/motion.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

/// A motion that the receiver does not have, after the step.
struct WholeMotion {
  PieceId id = 0;
  Motion motion;
};

/// Differs, as a rule, when the motions of both sides do: each adds up those of its pieces.
uint32_t motion_check(PieceId id, const Motion& motion);

/// A motion that both sides have, before the step, and how the prediction is corrected.
struct MotionStep {
  PieceId id = 0;
  const Motion* before = nullptr;
  uint32_t check = 0;  ///< motion_check() of it, which is the same as long as it rests
  const std::optional<Correction>* correction = nullptr;
};

/// Both ordered by id, strictly ascending, and no piece in both.
std::vector<uint8_t> encode_motions(std::span<const WholeMotion> wholes, std::span<const MotionStep> steps);

/// A piece's motion before the step, as the receiver has it.
struct MotionBefore {
  PieceId id = 0;
  const Motion* motion = nullptr;
  uint32_t check = 0;
};

struct DecodedMotions {
  std::vector<WholeMotion> wholes;
  std::vector<std::optional<Correction>> corrections;  ///< of the steps, one for each
};

/// `steps_besides(wholes)`: the motions that the receiver has of other pieces than these, ordered by id; the
/// sender must have coded just these, of the same values. Refuses more than `wholes_max` whole motions, and
/// bytes that are not needed.
Result<DecodedMotions> decode_motions(
    std::span<const uint8_t> bytes, size_t wholes_max,
    const std::function<std::vector<MotionBefore>(std::span<const WholeMotion>)>& steps_besides);

}  // namespace scree
