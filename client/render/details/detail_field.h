// What stands about the eye, in patches of a chunk each: scattered once over the ground as generated, gone
// where somebody changed it. No GL. Bounded by the range; work by frame. Main thread only.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "client/render/details/scatter.h"
#include "client/render/scene/camera.h"
#include "shared/base/limits.h"

namespace scree {

class DetailField {
 public:
  /// One frame: takes in the bricks that changed, scatters a few patches, nearest first, and goes on to light
  /// them. A range of 0 has none. `sun`: unit, towards it.
  void follow(const Field& field, std::span<const BrickCoord> changed, glm::vec3 eye_m, float range_m,
              glm::vec3 sun);
  /// Another world.
  void forget();
  /// Whether all that can be told within the range is there, as it is lit now.
  bool settled() const { return scattered_ && to_light_ == 0 && !is_light_old_; }

  struct Wanted {
    bool shadows = false;                          ///< what casts shadows that are seen: no grass
    float floor_m = -limits::world_half_height_m;  ///< what stands lower is left out
  };
  /// Appends what is to be seen from there.
  void add_to(DetailLists& lists, const Frustum& frustum, glm::vec3 eye_m, const Wanted& wanted) const;

  /// As far as anything is seen, metres.
  float range_m() const { return range_m_; }
  /// All that is kept, standing or not.
  size_t count() const { return count_; }

 private:
  struct Patch {
    std::vector<PlacedDetail> placed;
    glm::vec3 middle_m{0.0F};
    float radius_m = 0.0F;
  };
  using Patches = std::unordered_map<ChunkCoord, Patch, CoordHash>;

  void set_range(const Field& field, float range_m);
  void drop_far(glm::vec3 eye_m);
  void scatter(const Field& field, ChunkCoord home, glm::vec3 eye_m, glm::vec3 sun);
  void light(const Field& field, glm::vec3 sun);
  Patch patch_of(const Field& field, ChunkCoord chunk, glm::vec3 sun) const;

  float range_m_ = 0.0F;
  float chunk_m_ = 0.0F;
  std::vector<ChunkCoord> offsets_;  ///< from the eye's chunk, nearest first, within the range
  Patches patches_;
  size_t count_ = 0;
  bool scattered_ = false;            ///< the last frame found none to scatter
  std::vector<ChunkCoord> lighting_;  ///< patches whose light is gone over
  size_t to_light_ = 0;               ///< the first of them that are still to come
  bool is_light_old_ = false;         ///< the field has changed since that began
  size_t generated_ = 0;              ///< chunks that the field had last
};

}  // namespace scree
