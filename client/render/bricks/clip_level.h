// One level of the raymarcher's world: follows the camera, generates and reads the bricks that come into
// reach, and reads edited bricks again at once.
//
// Runs on the thread of the GL context; generation runs on the pool. The cost of an edit is that of the
// bricks that it changes on this level.
#pragma once

#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "client/render/bricks/brick_atlas.h"
#include "client/render/bricks/clip_window.h"
#include "client/render/levels/level_bricks.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// The value of ClipEntry::before: the brick as generated. A mixed brick goes into the atlas, if there is
/// room.
uint32_t store_before(LevelBrick::Before kind, const AtlasBrick& brick, BrickAtlas& atlas);
/// The value of ClipEntry::looks; `old`: what stood there. Mixed looks go into the looks' atlas, if there is
/// room; else the brick looks as one of its voxels does. Gives the slot of `old` back if it has no use.
uint32_t store_looks(const BrickLooks& looks, const ClipEntry& old, CornerAtlas<Look>& atlas);
/// The same of planes.
uint32_t store_planes(const PlaneBrick* planes, const ClipEntry& old, CornerAtlas<FacePlane>& atlas);

class ClipLevel {
 public:
  /// `side`: bricks along the window. `pool` must outlive it.
  ClipLevel(WorkPool& pool, const TerrainSource& source, int level, int side, FaceEdges edges);
  ~ClipLevel();

  /// Bricks that fall out give their slots back.
  void follow(glm::vec3 eye_m, BrickAtlas& atlas);
  /// Bricks of the field whose codes changed.
  void changed(const Field& field, const std::vector<BrickCoord>& bricks, BrickAtlas& atlas);
  /// Reads up to that many chunks that have been generated, nearest first; returns how many it read.
  size_t load(const Field& field, size_t chunks_max, BrickAtlas& atlas);

  bool loaded() const { return pending_.empty(); }
  size_t waiting() const { return pending_.size(); }
  ClipWindow& window() { return window_; }
  const ClipWindow& window() const { return window_; }
  int level() const { return bricks_.level(); }
  float voxel_m() const { return bricks_.source().voxel_size_m; }
  size_t cpu_bytes() const;

 private:
  struct Inbox;

  void collect_generated(const Field& field);
  bool generated_around(const Field& field, ChunkCoord chunk);
  void read(const Field& field, BrickCoord brick, BrickAtlas& atlas);
  void release(const ClipEntry& entry, BrickAtlas& atlas);
  void list_pending(glm::vec3 eye_m);

  WorkPool& pool_;
  LevelBricks bricks_;
  ClipWindow window_;
  std::shared_ptr<Inbox> inbox_;
  bool placed_ = false;
  std::unordered_set<ChunkCoord, CoordHash> shown_;
  std::unordered_set<ChunkCoord, CoordHash> generating_;
  std::vector<ChunkCoord> pending_;  ///< nearest last
};

}  // namespace scree
