#include "client/render/details/detail_field.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

ChunkCoord chunk_at(glm::vec3 place_m, float chunk_m) {
  return {floor_to_int(place_m.x / chunk_m), floor_to_int(place_m.y / chunk_m),
          floor_to_int(place_m.z / chunk_m)};
}

glm::vec3 vector_of(ChunkCoord chunk) {
  return {static_cast<float>(chunk.x), static_cast<float>(chunk.y), static_cast<float>(chunk.z)};
}

}  // namespace

void DetailField::forget() {
  patches_.clear();
  lighting_.clear();
  offsets_.clear();
  count_ = to_light_ = generated_ = 0;
  range_m_ = chunk_m_ = 0.0F;
  scattered_ = is_light_old_ = false;
}

void DetailField::set_range(const Field& field, float range_m) {
  const float chunk_m = static_cast<float>(chunk_size) * field.source().voxel_size_m;
  if (range_m == range_m_ && chunk_m == chunk_m_) return;
  forget();
  chunk_m_ = chunk_m;
  range_m_ = std::min(range_m, chunk_m * limits::detail_range_chunks_max);
  if (range_m_ <= 0.0F) return;
  const int most = static_cast<int>(std::ceil(range_m_ / chunk_m)) + 1;
  for (int x = -most; x <= most; ++x)
    for (int y = -most; y <= most; ++y)
      for (int z = -most; z <= most; ++z) {
        // From the nearest places of the two chunks.
        const glm::vec3 gap = glm::max(glm::abs(glm::vec3(x, y, z)) - 1.0F, 0.0F) * chunk_m;
        if (glm::dot(gap, gap) < range_m_ * range_m_) offsets_.push_back({x, y, z});
      }
  std::ranges::sort(offsets_, {},
                    [](ChunkCoord o) { return std::pair(o.x * o.x + o.y * o.y + o.z * o.z, o); });
}

void DetailField::drop_far(glm::vec3 eye_m) {
  const float most_m = range_m_ + 3.0F * chunk_m_;
  std::erase_if(patches_, [&](const auto& patch) {
    const glm::vec3 middle_m = (vector_of(patch.first) + 0.5F) * chunk_m_;
    if (glm::distance(middle_m, eye_m) < most_m) return false;
    count_ -= patch.second.placed.size();
    return true;
  });
}

DetailField::Patch DetailField::patch_of(const Field& field, ChunkCoord chunk, glm::vec3 sun) const {
  Patch patch;
  patch.placed = scatter_details(field, chunk);
  check_standing(field, chunk, patch.placed);
  if (patch.placed.empty()) return patch;
  glm::vec3 lo = patch.placed.front().detail.place_m, hi = lo;
  for (PlacedDetail& one : patch.placed) {
    lo = glm::min(lo, one.detail.place_m);
    hi = glm::max(hi, one.detail.place_m);
    light_detail(field, sun, one);
  }
  patch.middle_m = 0.5F * (lo + hi);
  patch.radius_m = 0.5F * glm::distance(lo, hi) + 1.0F;
  return patch;
}

void DetailField::scatter(const Field& field, ChunkCoord home, glm::vec3 eye_m, glm::vec3 sun) {
  size_t made = 0;
  scattered_ = true;
  for (const ChunkCoord offset : offsets_) {
    const ChunkCoord chunk = home + offset;
    if (patches_.contains(chunk) || !can_scatter(field, chunk)) continue;
    const Patch& patch = patches_.emplace(chunk, patch_of(field, chunk, sun)).first->second;
    count_ += patch.placed.size();
    scattered_ = false;
    if (!patch.placed.empty() && ++made >= limits::detail_patches_a_frame) break;
  }
  if (!scattered_) drop_far(eye_m);
}

/// Goes over all again when the field has got other ground, or an edit: a wall throws a shade some chunks
/// far.
void DetailField::light(const Field& field, glm::vec3 sun) {
  if (to_light_ == 0 && is_light_old_) {
    is_light_old_ = false;
    lighting_.clear();
    for (const auto& [chunk, patch] : patches_)
      if (!patch.placed.empty()) lighting_.push_back(chunk);
    to_light_ = lighting_.size();
  }
  size_t done = 0;
  while (to_light_ > 0 && done < limits::details_lit_a_frame) {
    const auto patch = patches_.find(lighting_[--to_light_]);
    if (patch == patches_.end()) continue;
    for (PlacedDetail& one : patch->second.placed) light_detail(field, sun, one);
    done += patch->second.placed.size();
  }
}

void DetailField::follow(const Field& field, std::span<const BrickCoord> changed, glm::vec3 eye_m,
                         float range_m, glm::vec3 sun) {
  set_range(field, range_m);
  if (range_m_ <= 0.0F) {
    scattered_ = true;
    return;
  }
  ChunkCoord last{INT32_MAX, 0, 0};
  for (const BrickCoord brick : changed) {
    const ChunkCoord chunk = chunk_of(brick);
    if (chunk == last) continue;
    last = chunk;
    // What stands on the uppermost voxels of a chunk stands in the one above, too.
    for (const ChunkCoord at : {chunk, ChunkCoord{chunk.x, chunk.y - 1, chunk.z}})
      if (const auto patch = patches_.find(at); patch != patches_.end())
        check_standing(field, at, patch->second.placed);
  }
  scatter(field, chunk_at(eye_m, chunk_m_), eye_m, sun);
  const size_t generated = field.generated_chunks();
  if (std::exchange(generated_, generated) != generated || !changed.empty()) is_light_old_ = true;
  light(field, sun);
}

void DetailField::add_to(DetailLists& lists, const Frustum& frustum, glm::vec3 eye_m,
                         const Wanted& wanted) const {
  for (const auto& [chunk, patch] : patches_) {
    if (patch.placed.empty() || !frustum.touches(patch.middle_m, patch.radius_m)) continue;
    const float near_m = glm::distance(patch.middle_m, eye_m) - patch.radius_m;
    for (const PlacedDetail& one : patch.placed) {
      if (one.detail.seen() * range_m_ <= near_m) break;
      if (wanted.shadows && one.kind == DetailKind::grass) continue;
      if (one.stands && one.detail.place_m.y >= wanted.floor_m)
        lists.at(static_cast<size_t>(one.kind)).push_back(one.detail);
    }
  }
}

}  // namespace scree
