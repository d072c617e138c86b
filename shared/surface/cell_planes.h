// The planes of flat faces about a cell, for the vertex that surface nets put there (creases.h). The map is
// not thread-safe. Units: voxels. Places count from the cell's lowest corner, so that all windows that hold a
// cell give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "shared/surface/face_plane.h"
#include "shared/surface/surface_cells.h"

namespace scree {

/// The plane of a point, which lies so far from it: normal · (x − point) + distance = 0.
struct PointFace {
  glm::vec3 normal{0.0F};
  float distance = 0.0F;
};

/// Along each axis of a window; and from a cell's lowest corner to its corners, and to the points one voxel
/// beyond these.
struct WindowSteps {
  std::array<std::ptrdiff_t, 3> along;
  struct Step {
    std::ptrdiff_t by;
    glm::vec3 off;  ///< from the cell's lowest corner
  };
  std::array<Step, cell_corners> corners;
  std::array<Step, size_t{3} * cell_corners> beyond;  ///< corner · 3 + axis

  explicit WindowSteps(const Window& window);
};

/// The planes of a window's points, by their index in it, each computed by the first call for it.
class FaceMap {
 public:
  /// The window must outlive it.
  explicit FaceMap(const Window& window) : window_(window), steps_(window), slots_(window.codes.size()) {}

  /// Null where no flat face is near. Valid until the next call.
  const PointFace* at(size_t index) {
    uint16_t& slot = slots_[index];
    if (slot == 0) slot = look(index);
    return slot == none ? nullptr : &faces_[slot - 1U];
  }
  const Window& window() const { return window_; }
  const WindowSteps& steps() const { return steps_; }

 private:
  static constexpr uint16_t none = 65535;

  uint16_t look(size_t index);

  const Window& window_;
  WindowSteps steps_;
  std::vector<uint16_t> slots_;  ///< index in faces_ + 1; 0: not computed yet
  std::vector<PointFace> faces_;
};

/// A cell's vertex before it moves.
struct CellVertex {
  VoxelCoord cell;
  size_t index;  ///< of the cell's lowest corner in the window
  glm::vec3 at;  ///< the vertex, from that corner

  CellVertex(VoxelCoord home, size_t first, glm::vec3 place) : cell(home), index(first), at(place) {}
  /// The field's direction over the cell and the points beyond it, unit; nothing where it has none. Computed
  /// by the first call.
  glm::vec3 out(const FaceMap& faces) {
    if (!out_) out_ = direction_about(faces, index);
    return *out_;
  }

 private:
  static glm::vec3 direction_about(const FaceMap& faces, size_t cell_index);

  std::optional<glm::vec3> out_;
};

/// Known planes about a cell that are near its vertex.
class CellPlanes {
 public:
  size_t count() const { return count_; }
  /// Adds those of its corners.
  void look_at_corners(FaceMap& faces, CellVertex& home) {
    for (const WindowSteps::Step& step : faces.steps().corners) add(faces, home, step);
  }
  /// Also those of the 24 points one voxel beyond the corners: an edge may cut off a part of the cell that
  /// holds none of them. Points whose distance the corners' face says lie on that face. Needs a plane.
  void look_beyond(FaceMap& faces, CellVertex& home);
  /// Those of faces straight across all of the cell's crossed edges instead, half-way between their ends: so
  /// people build, with steps of a voxel whose planes no point knows. None if a crossing lies elsewhere.
  void look_across(const FaceMap& faces, const CellVertex& home);
  /// Leaves the first ones.
  void keep_first(size_t count) { count_ = count; }
  /// Leaves those that are no farther from the vertex.
  void keep_near(float voxels);

  /// Whether they belong to more than one face.
  bool is_edge() const {
    if (count_ < 2) return false;
    const float cosine = glm::dot(normal_[0], normal_[farthest()]);
    return cosine < face_edge_cosine && cosine > other_side_cosine;
  }
  /// Whether all are across this direction.
  bool is_straight(glm::vec3 out) const;
  /// The direction of the edge in which two faces meet; none where three do.
  std::optional<glm::vec3> along_edge() const;
  /// From the vertex to where they meet, if they are of an edge.
  std::optional<glm::vec3> way_to_edge() const;
  glm::vec3 mean_normal() const;

 private:
  /// Cosine of the angle between two faces beyond which they are the sides of one wall: 160 degrees.
  static constexpr float other_side_cosine = -0.94F;
  /// Planes that lie farther from the mean of the crossings belong to another wall.
  static constexpr float same_wall_voxels = 1.2F;
  /// As many as a cell has corners and points beyond them; its edges are fewer.
  static constexpr size_t planes_max = 32;

  void add(FaceMap& faces, CellVertex& home, const WindowSteps::Step& step) {
    const PointFace* face = faces.at(home.index + static_cast<size_t>(step.by));
    if (face == nullptr) return;
    const float away = face->distance + glm::dot(face->normal, home.at - step.off);
    // Faces that turn away are the other side of a thin wall.
    if (std::abs(away) > same_wall_voxels || glm::dot(face->normal, home.out(faces)) < other_side_cosine)
      return;
    normal_[count_] = face->normal;
    distance_[count_++] = away;
  }
  size_t farthest() const;
  glm::vec3 way_to_meeting() const;
  bool meet_at(glm::vec3 way) const;

  std::array<glm::vec3, planes_max> normal_;
  std::array<float, planes_max> distance_;  ///< of the vertex from each
  size_t count_ = 0;
};

}  // namespace scree
