// The terrain around a posed piece, united with it, and the operations by which the merge meets its mass.
// Calls come in the order shape(), place(), codes(). Integer arithmetic; voxels and codes. Not thread-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/mass.h"
#include "shared/field/window.h"
#include "shared/recombine/stamp_plan.h"

namespace scree {

/// What gives way first where the mass differs. round: edges and clefts, then the whole surface. keep: the
/// whole surface alone, so that faces stay flat and edges sharp.
enum class Edges { round, sharp };

class MergePatch {
 public:
  /// Voxels by which the terrain's window is larger than the posed piece's, on every side.
  static constexpr int margin = 2;

  /// Unites the two and closes the gaps between them. `terrain` has the piece's box grown by the margin;
  /// `piece` has at least one layer around the voxels that may become rock.
  /// `fills` are those of the terrain's window.
  MergePatch(const Window& terrain, const Window& piece, Edges edges, const MergeFills& fills = {});
  MergePatch(const MergePatch&) = delete;
  MergePatch& operator=(const MergePatch&) = delete;

  /// Rounds edges (roundness < 0) or fills clefts, and moves the surface (stamp_roundness_max); or moves it
  /// alone, by up to half a voxel. Returns the change of the terrain's mass once redistanced.
  MassUnits shape(int roundness);

  /// Mass of half a code on every voxel of the surface near the piece, before any shape().
  MassUnits single_codes() const { return single_codes_; }

  /// Moves voxels at the surface by single codes, all over the piece, until the mass has changed by `units`
  /// more, or nearly; returns the change reached, which is not more. Once after each shape().
  MassUnits place(MassUnits units);

  /// The terrain united with the piece, as shape() and place() left it, not redistanced.
  std::vector<Code> codes() const { return {codes_, codes_ + voxels_}; }

 private:
  /// The surface voxels that move: those in a cleft or at an edge; all that the piece reaches; all.
  enum class Tier { bent, piece, around };

  void enter_fills(const MergeFills& fills);
  MassUnits mass() const;
  MassUnits place_steps(MassUnits units);
  void mark_surface();
  void list_surface();
  void list_movable(int direction, Tier tier);
  MassUnits move_some(int direction, MassUnits count);
  int move_ramp_ends(int units);

  VoxelBox box_;
  Edges edges_;
  ptrdiff_t step_x_;
  ptrdiff_t step_y_;
  size_t voxels_;
  size_t all_;    ///< of each array: the voxels, and air for vectors and their neighbours that reach beyond
  size_t first_;  ///< of the voxels that have all six neighbours in the box, and those between them in memory
  size_t count_;  ///< of those, in whole vectors
  std::vector<Code> code_room_;  ///< one allocation for each type: they were a tenth of a merge's time
  std::vector<uint8_t> byte_room_;
  std::vector<int16_t> bend_room_;
  Code* terrain_;
  Code* piece_;
  Code* united_;
  Code* shaped_;
  Code* codes_;
  uint8_t* touched_;                ///< all ones where the piece changed the terrain
  uint8_t* inner_;                  ///< all ones where the voxel's mass counts: all but the outermost layer
  uint8_t* core_;                   ///< all ones where changes count in all their neighbours: two layers in
  uint8_t* marks_;                  ///< all ones at the surface near the piece, as mark_surface last found it
  int16_t* convex_;                 ///< how far rounding raises the piece here
  int16_t* concave_;                ///< how far filling lowers the union here
  std::vector<uint8_t> fill_room_;  ///< empty where all is solid
  uint8_t* were_ = nullptr;
  uint8_t* brought_ = nullptr;
  int fill_ = fill_solid;  ///< least of those that are brought
  std::vector<uint32_t> surface_;
  std::vector<uint32_t> movable_;
  MassUnits before_ = 0;
  MassUnits single_codes_ = 0;
};

/// Mass that a window, which has at least three voxels a side, gains by becoming `merged` and by being
/// redistanced then.
MassUnits merge_gain(const Window& terrain, const Window& merged, const MergeFills& fills);

}  // namespace scree
