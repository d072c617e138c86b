#include "shared/falling/section.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

void Section::finish() {
  CHECK(area_ == 0.0);
  for (const Cell& cell : cells_) {
    area_ += cell.area;
    centroid_ += cell.at * cell.area;
  }
  if (area_ > 0.0) centroid_ /= area_;
  for (const Cell& cell : cells_) {
    const glm::dvec2 r = cell.at - centroid_;
    uu_ += cell.area * (r.x * r.x + 1.0 / 12.0);
    uv_ += cell.area * r.x * r.y;
    vv_ += cell.area * (r.y * r.y + 1.0 / 12.0);
  }
}

double Section::tension(glm::dvec2 lever) const {
  const double determinant = uu_ * vv_ - uv_ * uv_;
  CHECK(determinant > 0.0);
  const glm::dvec2 slope((lever.x * vv_ - lever.y * uv_) / determinant,
                         (-lever.x * uv_ + lever.y * uu_) / determinant);
  double most = 0.0;
  for (const Cell& cell : cells_) {
    const glm::dvec2 r = cell.at - centroid_;
    // A cell that is full reaches half a voxel beyond its middle; one that is half full ends there.
    const double edge = (cell.area - 0.5) * (std::abs(slope.x) + std::abs(slope.y));
    most = std::max(most, slope.x * r.x + slope.y * r.y + edge);
  }
  return most;
}

}  // namespace scree
