// The field at one level of detail, as bricks for the atlas: level k has a sample every 2^k voxels. Level 0
// is the field itself; a coarser level is generated at its spacing, and takes the samples of edited bricks
// from the field.
//
// Distances of edits end after three voxels of the field, less than one of a coarse level. So coarser air
// gets its distances from the samples around (air_distances.h), else rays would step through thin walls.
//
// Keeps no copies of edits: a brick that is read again is always the current field's.
#pragma once

#include <memory>

#include "client/render/levels/atlas_brick.h"
#include "client/render/levels/face_edges.h"
#include "client/render/levels/look_window.h"
#include "client/render/levels/plane_brick.h"
#include "shared/field/field.h"

namespace scree {

/// The looks of samples 0 … 8 of a brick along each axis, for rays that end in it: half a voxel beneath a
/// surface in the brick, the nearest voxel is one of them. Air has the looks of rock beside it.
using LookBrick = std::array<Look, corner_brick_side * corner_brick_side * corner_brick_side>;

struct BrickLooks {
  Look all{};
  std::unique_ptr<LookBrick> each;  ///< null: all alike
};

/// The looks of the brick that begins at `first`; what is beyond `now` is air. `looks` holds its box.
BrickLooks looks_of(const LookWindow& looks, const Window& now, VoxelCoord first);

struct LevelBrick {
  enum class Kind { empty, solid, stored } kind = Kind::empty;
  AtlasBrick field;  ///< when stored

  /// The generated field: `same` without edits; else it distinguishes fresh rock and rubble.
  enum class Before { same, mixed, air, rock } before_kind = Before::same;
  AtlasBrick before;                     ///< when mixed
  BrickLooks looks;                      ///< when stored
  std::unique_ptr<PlaneBrick> planes{};  ///< when stored, and faces meet; coarse samples of edits know none
};

/// By the samples of its own cells, not the rest of its apron.
LevelBrick::Kind kind_of(const AtlasBrick& brick);
/// Air or rock where all is so far from the surface that its looks do not change any more.
LevelBrick::Before before_kind_of(const AtlasBrick& brick);

/// The same terrain with a sample every 2^level voxels.
TerrainSource spaced(TerrainSource source, int level);

/// Writes the edited codes of the field, which is level 0, into a window of that level. Its air that is as
/// far from rock as a code can tell, three voxels of its own or more, becomes `far_air`.
void copy_edits(const Field& field, int level, Window& window, Code far_air);

class LevelBricks {
 public:
  /// Rounded edges need no planes.
  LevelBricks(const TerrainSource& source, int level, FaceEdges edges = FaceEdges::sharp);

  int level() const { return level_; }
  const TerrainSource& source() const { return source_; }  ///< with this level's spacing

  /// Chunks of this level. `field` is always the world's, of level 0.
  bool has_generated(const Field& field, ChunkCoord chunk) const;
  void adopt_generated(const Field& field, ChunkCoord chunk, GeneratedChunk&& generated);

  LevelBrick read(const Field& field, BrickCoord brick);

  /// The bricks of this level that a change of a brick of the field affects: lo inside, hi outside.
  struct Range {
    BrickCoord lo;
    BrickCoord hi;
  };
  Range shown_in(BrickCoord changed) const;

 private:
  int step() const { return 1 << level_; }
  const Field& generator(const Field& field) const { return coarse_ ? *coarse_ : field; }
  const Brick* uniform_around(const Field& field, BrickCoord brick) const;
  bool edited_around(const Field& field, BrickCoord brick) const;
  Window edited_window(const Field& field, BrickCoord brick) const;
  LookWindow looks_around(const Field& field, BrickCoord brick, const Window& around, bool edited) const;

  int level_;
  FaceEdges edges_;
  TerrainSource source_;
  std::unique_ptr<MapField> coarse_;  ///< generates; none on level 0
};

}  // namespace scree
