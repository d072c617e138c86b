// A plane section of a beam: its area, and the tension at its edge when it is bent. Lengths in voxels.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace scree {

/// Area and moments about the centroid, made of cells: voxels, or parts of voxels at the surface.
class Section {
 public:
  /// `area`: of the cell, positive.
  void add(glm::dvec2 at, double area) { cells_.push_back({at, area}); }
  /// Call once, after all cells.
  void finish();

  double area() const { return area_; }
  glm::dvec2 centroid() const { return centroid_; }

  /// Greatest tension at the edge when a unit of load bends the section at that lever: by Navier's formula,
  /// with the full tensor of second moments. There must be a cell.
  double tension(glm::dvec2 lever) const;

 private:
  struct Cell {
    glm::dvec2 at;
    double area;
  };
  std::vector<Cell> cells_;
  double area_ = 0.0, uu_ = 0.0, uv_ = 0.0, vv_ = 0.0;
  glm::dvec2 centroid_{0.0};
};

}  // namespace scree
