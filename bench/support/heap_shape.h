// The shape of a heap, read off the field as a surveyor would: heights over squares of a metre, and slopes
// between their middles.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "shared/field/field.h"

namespace scree {

/// Heights of the topmost surface over a grid of squares of about a metre, in metres.
class HeapShape {
 public:
  /// Over a box of voxels, which reaches from solid ground into the air above the heap.
  HeapShape(const Field& field, const VoxelBox& box) : voxel_m_(field.source().voxel_size_m) {
    const Window codes = gather(field, box);
    columns_ = std::max(1, static_cast<int>(std::lround(1.0F / voxel_m_)));
    nx_ = box.size().x / columns_;
    nz_ = box.size().z / columns_;
    heights_m_.assign(static_cast<size_t>(nx_) * static_cast<size_t>(nz_), 0.0);
    for (int x = 0; x < nx_ * columns_; ++x)
      for (int z = 0; z < nz_ * columns_; ++z)
        add(x / columns_, z / columns_, height_m(codes, box.lo.x + x, box.lo.z + z) / (columns_ * columns_));
  }

  /// Angle of the steepest metre, degrees.
  double steepest_deg() const {
    double most = 0.0;
    for (int x = 1; x + 1 < nx_; ++x)
      for (int z = 1; z + 1 < nz_; ++z) most = std::max(most, slope_deg(x, z));
    return most;
  }
  /// Mean angle of the flanks: of what is no ground, no foot, to which falling stones roll, and no top.
  double flank_deg(double ground_m) const {
    const double top_m = *std::max_element(heights_m_.begin(), heights_m_.end()) - ground_m;
    double sum = 0.0;
    int count = 0;
    for (int x = 1; x + 1 < nx_; ++x)
      for (int z = 1; z + 1 < nz_; ++z) {
        const double part = (of(x, z) - ground_m) / top_m;
        if (part < 0.4 || part > 0.85) continue;
        sum += slope_deg(x, z);
        ++count;
      }
    return count == 0 ? 0.0 : sum / count;
  }
  /// Volume between the surface and the level 0, m³.
  double bulk_m3() const {
    const double side_m = columns_ * voxel_m_;
    double sum_m = 0.0;
    for (const double height_m : heights_m_) sum_m += height_m;
    return sum_m * side_m * side_m;
  }
  double top_m() const { return *std::max_element(heights_m_.begin(), heights_m_.end()); }

 private:
  double of(int x, int z) const { return heights_m_[static_cast<size_t>(x * nz_ + z)]; }
  void add(int x, int z, double more_m) { heights_m_[static_cast<size_t>(x * nz_ + z)] += more_m; }
  double height_m(const Window& codes, int x, int z) const {
    int y = codes.box.hi.y - 1;
    while (y > codes.box.lo.y && codes.at(x, y, z) >= 0) --y;
    if (y + 1 == codes.box.hi.y) return y * voxel_m_;
    const double below = codes.at(x, y, z), above = codes.at(x, y + 1, z);
    return (y + (below < 0 ? -below / (above - below) : 0.0)) * voxel_m_;
  }
  /// That of a plane through the eight squares around one.
  double slope_deg(int x, int z) const {
    double along_x = 0.0, along_z = 0.0;
    for (int i = -1; i <= 1; ++i) {
      along_x += of(x + 1, z + i) - of(x - 1, z + i);
      along_z += of(x + i, z + 1) - of(x + i, z - 1);
    }
    const double run_m = 6.0 * columns_ * voxel_m_;
    return std::atan(std::hypot(along_x, along_z) / run_m) * 180.0 / 3.14159265358979;
  }

  float voxel_m_;
  int columns_ = 1, nx_ = 0, nz_ = 0;
  std::vector<double> heights_m_;
};

}  // namespace scree
