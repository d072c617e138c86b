#include "client/render/scene/settled_stones.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "client/render/scene/limits.h"

namespace scree {

const ScenePieces& SettledStones::step(const ScenePieces& pieces, const Field& field, glm::vec3 eye_m,
                                       MirrorChanges& changes) {
  for (const PieceId id : end_stones(places_, changes.bricks, field)) forget_stone(id, changes);
  for (const SettledStone& told : changes.stones)
    if (!stones_.contains(told.id) && !pieces.contains(told.id) && add_told(told, field) &&
        !buried_.contains(told.id) && std::erase(changes.pieces_removed, told.id) == 0)
      changes.pieces_added.push_back(told.id);
  std::erase_if(changes.pieces_removed, [&](PieceId id) {
    return !stones_.contains(id) && !pieces.contains(id) &&
           std::ranges::find(changes.stones, id, &SettledStone::id) == changes.stones.end() &&
           settle(id, field) && !buried_.contains(id);
  });
  follow_burials(field, changes);
  leave_the_farthest(eye_m, changes);
  last_ = pieces;
  shown_ = pieces;
  for (const auto& [id, stone] : stones_)
    if (!buried_.contains(id)) shown_.insert_or_assign(id, stone);
  return shown_;
}

void SettledStones::forget() {
  last_.clear();
  shown_.clear();
  stones_.clear();
  places_.clear();
  surfaces_.clear();
  buried_.clear();
  voxels_ = 0;
}

/// What rock covers is not drawn, until it is dug out.
void SettledStones::follow_burials(const Field& field, MirrorChanges& changes) {
  for (const PieceId id : surfaces_.touched(changes.bricks)) {
    const bool now = is_buried(surfaces_.points(id), field);
    if (now == buried_.contains(id)) continue;
    (now ? changes.pieces_removed : changes.pieces_added).push_back(id);
    if (now)
      buried_.insert(id);
    else
      buried_.erase(id);
  }
}

/// By the last pose that was drawn, of a piece whose merge nobody told.
bool SettledStones::settle(PieceId id, const Field& field) {
  const auto found = last_.find(id);
  return found != last_.end() && add_if_rock(id, found->second, 0, field);
}

bool SettledStones::add_told(const SettledStone& told, const Field& field) {
  return add_if_rock(told.id, {told.volume, dequantise(told.pose)}, told.lies, field);
}

/// Rock may have gone since an earlier merge; and a server may tell anything.
bool SettledStones::add_if_rock(PieceId id, const ScenePiece& piece, uint32_t lies, const Field& field) {
  const float voxel_m = field.source().voxel_size_m;
  if (!has_moved(*piece.volume, piece.pose, voxel_m)) return false;
  const StonePoints all = stone_points(*piece.volume, piece.pose, voxel_m);
  const StonePoints points = chosen(all, lies != 0 ? lies : points_in_rock(all, field));
  if (points.empty() || has_rock_gone(points, field)) return false;
  places_.add(id, points);
  StonePoints surface = surface_points(*piece.volume, piece.pose, voxel_m);
  if (!surface.empty()) {
    if (is_buried(surface, field)) buried_.insert(id);
    surfaces_.add(id, std::move(surface));
  }
  stones_.emplace(id, piece);
  voxels_ += piece.volume->window.codes.size();
  return true;
}

void SettledStones::forget_stone(PieceId id, MirrorChanges& changes) {
  const auto found = stones_.find(id);
  voxels_ -= found->second.volume->window.codes.size();
  stones_.erase(found);
  if (surfaces_.contains(id)) surfaces_.remove(id);
  if (buried_.erase(id) == 0) changes.pieces_removed.push_back(id);
}

/// There are few more than the limits at any time.
void SettledStones::leave_the_farthest(glm::vec3 eye_m, MirrorChanges& changes) {
  while (stones_.size() > limits::settled_stones_max || voxels_ > limits::settled_voxels_max) {
    const auto away = [&](const auto& entry) {
      const glm::vec3 off = entry.second.pose.position_m - eye_m;
      return glm::dot(off, off);
    };
    const PieceId farthest = std::ranges::max_element(stones_, {}, away)->first;
    places_.remove(farthest);
    forget_stone(farthest, changes);
  }
}

}  // namespace scree
