// Plane sections of the bodies of a search for spans (span_bodies.h), measured by the codes, so that a beam
// of two voxels has its height to a hundredth. Lengths in voxels.
#pragma once

#include <span>
#include <vector>

#include "shared/falling/span_bodies.h"

namespace scree {

/// Area, centre, second moments about the centre, and how far the section reaches, along the two axes that
/// follow the normal's, cyclically.
struct SpanSection {
  double area = 0.0;
  double u = 0.0, v = 0.0;
  double uu = 0.0, vv = 0.0;
  double u_lo = 0.0, u_hi = 0.0, v_lo = 0.0, v_hi = 0.0;
};

class SpanSections {
 public:
  /// `bodies` must outlive this.
  explicit SpanSections(SpanBodies& bodies) : bodies_(bodies) {}

  /// A layer of voxels of a body.
  SpanSection layer(const SpanBody& body, int axis, int layer);
  /// Where two bodies touch: contacts across one plane; `layer` is the first beyond it.
  SpanSection face(std::span<const SpanContact> contacts, int axis, int layer);

 private:
  /// An empty grid over the box, across the axis.
  void begin(const VoxelBox& box, int axis);
  void enter(VoxelCoord voxel, double share);
  /// A part's voxels in the layer; then those beside them whose middle lies outside, but which hold some.
  void enter_own(const SpanPart& part, int k);
  void enter_beside(const SpanPart& part, int k);
  Code code(VoxelCoord voxel);
  SpanSection measure() const;
  size_t cell(VoxelCoord voxel) const;

  SpanBodies& bodies_;
  int axis_ = 0;
  VoxelCoord lo_;
  int wide_ = 0, high_ = 0;     ///< cells along the first and the second axis
  std::vector<double> shares_;  ///< of each voxel that is rock
  std::vector<uint8_t> own_;
  std::vector<const SpanPart*> there_;
};

/// Member of a coordinate along an axis.
template <typename C>
int along_axis(const C& at, int axis) {
  return axis == 0 ? at.x : axis == 1 ? at.y : at.z;
}
template <typename C>
int& along_axis(C& at, int axis) {
  return axis == 0 ? at.x : axis == 1 ? at.y : at.z;
}

}  // namespace scree
