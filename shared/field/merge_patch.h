// What a stamp works on: the terrain around a posed piece, united with it, and the two ways in which its
// mass is met. All integer arithmetic. Voxels and codes.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/mass.h"
#include "shared/field/window.h"

namespace scree {

class MergePatch {
 public:
  /// `window` holds the terrain; `piece` the posed piece's codes, at least three voxels inside the window.
  /// Unites the two and closes the gaps between them.
  MergePatch(const Window& window, const Window& piece);

  /// What the terrain's mass changes by, once redistanced, with this shift. Keeps the codes for `write`.
  MassUnits gain(int shift);

  /// The codes of the last `gain` into the window given at first.
  void write(Window& window) const;

 private:
  void unite();
  void close_gaps();
  void find_curvature();
  void shape(int shift);

  VoxelBox box_;
  ptrdiff_t step_x_;
  ptrdiff_t step_y_;
  size_t first_;  ///< of the voxels that have all six neighbours in the box, and those between them in memory
  size_t last_;   ///< past it
  std::vector<Code> terrain_;
  std::vector<Code> piece_;
  std::vector<Code> united_;
  std::vector<Code> codes_;       ///< as the last shift left them
  std::vector<uint8_t> touched_;  ///< the piece changed this voxel
  std::vector<uint8_t> pits_;     ///< all ones where a lone voxel outside is to be filled
  std::vector<uint8_t> inner_;    ///< all ones where the voxel counts, else 0
  std::vector<uint8_t> core_;    ///< all ones where gaps may be closed: changes count in all their neighbours
  std::vector<int16_t> convex_;  ///< how far rounding raises the piece here
  std::vector<int16_t> concave_;    ///< how far filling lowers the union here
  std::vector<uint16_t> rounding_;  ///< where between two codes this voxel rounds
  MassUnits before_ = 0;
};

/// What redistancing alone adds to the mass of a window at least three voxels wide, but its outermost layer.
MassUnits settling_gain(const Window& window);

}  // namespace scree
