#include "proto/known_motions.h"

#include <algorithm>
#include <fmt/format.h>

#include "shared/base/check.h"

namespace scree {

void KnownMotions::set(PieceId id, Piece& piece, const Motion& motion) {
  piece.motion = motion;
  piece.check = motion_check(id, motion);
}

void KnownMotions::add(PieceId id, glm::vec3 centre_m) {
  CHECK(pieces_.try_emplace(id, Piece{centre_m, std::nullopt}).second);
}

void KnownMotions::add_made(PieceId id, const Volume& volume, std::optional<PieceId> parent) {
  Piece piece{volume.centre_voxels * voxel_size_m_, std::nullopt};
  if (!parent) {
    set(id, piece, born_at(piece.centre_m));
  } else if (const auto found = pieces_.find(*parent); found != pieces_.end() && found->second.motion) {
    set(id, piece, born_of(*found->second.motion, piece.centre_m - found->second.centre_m));
  }
  CHECK(pieces_.emplace(id, piece).second);
}

const Motion* KnownMotions::motion(PieceId id) const {
  const auto found = pieces_.find(id);
  return found != pieces_.end() && found->second.motion ? &*found->second.motion : nullptr;
}

Result<std::vector<PieceId>> KnownMotions::advance(std::span<const uint8_t> motions) {
  std::vector<PieceId> changed;
  if (motions.empty()) return changed;
  std::vector<MotionBefore> steps;
  std::vector<Piece*> pieces;  // of the steps
  const Result<DecodedMotions> decoded =
      decode_motions(motions, pieces_.size(), [&](std::span<const WholeMotion> wholes) {
        for (auto& [id, piece] : pieces_) {
          while (!wholes.empty() && wholes.front().id < id) wholes = wholes.subspan(1);
          const bool is_whole = !wholes.empty() && wholes.front().id == id;
          if (!piece.motion || is_whole) continue;
          steps.push_back({id, &*piece.motion, piece.check});
          pieces.push_back(&piece);
        }
        return steps;
      });
  TRY(decoded);
  for (const WholeMotion& whole : decoded->wholes) {
    const auto found = pieces_.find(whole.id);
    if (found == pieces_.end())
      return fail(fmt::format("the motion of piece {}, which is not known here", whole.id));
    set(whole.id, found->second, whole.motion);
    changed.push_back(whole.id);
  }
  for (size_t i = 0; i < steps.size(); ++i) {
    const Motion& motion = *steps[i].motion;
    if (motion.mode == MotionMode::rest && !decoded->corrections[i]) continue;
    set(steps[i].id, *pieces[i], scree::advance(motion, decoded->corrections[i], rules_));
    changed.push_back(steps[i].id);
  }
  std::ranges::sort(changed);
  return changed;
}

}  // namespace scree
