// Other ways to send poses, to compare with: what they take, and how long.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "shared/field/piece.h"

namespace scree {

struct BodyPose {
  PieceId id = 0;
  Pose pose;
};

/// Ids and seven floats, of every body in every step.
std::vector<uint8_t> pack_floats(std::span<const BodyPose> bodies);
std::vector<BodyPose> unpack_floats(std::span<const uint8_t> bytes);

/// Fiedler, "Snapshot Compression" (gafferongames.com, 2015): a bit whether a body changed, positions as
/// differences of 5 or 9 bits or whole, "smallest three" rotations as differences of 5 or 7 bits or whole.
/// His baseline is the last snapshot that the client acknowledged; here it is the last one, which is his best
/// case. Both sides have one of these, and the same list of bodies.
class SmallestThreeDeltas {
 public:
  std::vector<uint8_t> pack(std::span<const PieceState> bodies);
  /// `ids`: of the bodies, in order.
  std::vector<PieceState> unpack(std::span<const uint8_t> bytes, std::span<const PieceId> ids);

 private:
  std::map<PieceId, QuantisedPose> baseline_;
};

}  // namespace scree
