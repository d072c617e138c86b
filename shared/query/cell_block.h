// The surface in a block of 8³ cells, computed on demand: the polygons of surface_nets (shared/surface), bit
// for bit, without making a mesh. A cell is the cube between 8 voxels; its lowest voxel names it. A quad
// belongs to a grid edge that the surface crosses, and has its corners in the four cells around that edge; so
// all polygons with points in a cell are the quads of the cell's own edges. Units: voxels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/field/brick.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

/// A corner of a polygon: 1/256 voxel (surface_steps), from the origin of the voxels.
using SurfacePoint = std::array<int32_t, 3>;

inline glm::dvec3 in_voxels(const SurfacePoint& p) {
  return glm::dvec3(p[0], p[1], p[2]) / static_cast<double>(surface_steps);
}

/// Counter-clockwise seen from the air. Its corners may coincide.
using SurfaceTriangle = std::array<SurfacePoint, 3>;

/// Two triangles, split along the shorter diagonal as surface_nets does.
using SurfaceQuad = std::array<SurfaceTriangle, 2>;

/// Where the cells of a block, and the quads of their edges, find all codes that they depend on.
class CellBlock {
 public:
  /// Voxels that the codes reach below the block's first one, and a side of them.
  static constexpr int apron = 2;
  static constexpr int side = apron + brick_size + 3;
  /// The voxels whose codes a block needs.
  static VoxelBox box_of(BrickCoord coord) {
    const VoxelCoord first = first_voxel(coord);
    return {first - VoxelCoord{apron, apron, apron},
            first + VoxelCoord{side - apron, side - apron, side - apron}};
  }

  /// `codes`: those of box_of(coord), z fastest.
  CellBlock(BrickCoord coord, const Code* codes);

  /// Bit y·8 + z of word x: the surface crosses that cell.
  const std::array<uint64_t, brick_size>& active() const { return active_; }
  bool any() const;
  /// `at`: from the block's first voxel, here and below. 0..7.
  bool is_active(VoxelCoord at) const {
    return ((active_[static_cast<size_t>(at.x)] >> (at.y * brick_size + at.z)) & 1U) != 0;
  }
  /// Whether the surface crosses the edge from a voxel along an axis (0, 1, 2). −1..8.
  bool is_crossed(VoxelCoord from, int axis) const {
    const int near = index(from), along = axis == 0 ? side * side : (axis == 1 ? side : 1);
    return (codes_[static_cast<size_t>(near)] < 0) != (codes_[static_cast<size_t>(near + along)] < 0);
  }
  /// The quad of such an edge. 0..8.
  SurfaceQuad quad(VoxelCoord from, int axis) const;

 private:
  static constexpr int vertex_side = brick_size + 2;  ///< cells that quads reach: −1..8

  static int index(VoxelCoord at) { return ((at.x + apron) * side + at.y + apron) * side + at.z + apron; }
  uint32_t signs_at(int index) const;
  uint16_t edges_of(VoxelCoord cell, uint32_t signs, int edge) const;
  SurfacePoint vertex(VoxelCoord cell, int edge) const;

  VoxelCoord first_;
  std::array<uint64_t, brick_size> active_{};
  std::array<Code, size_t{side} * side * side> codes_;
  /// Places in their cells of vertices that were asked for, of cells with one sheet: 1..255 by bytes; 0: not
  /// yet.
  mutable std::array<uint32_t, size_t{vertex_side} * vertex_side * vertex_side> known_{};
};

/// Blocks of one surface: of a field, or of a piece's volume. Not thread-safe.
class CellSource {
 public:
  virtual ~CellSource() = default;
  /// Null: the surface crosses no cell of the block. Valid until the source is told to forget.
  virtual const CellBlock* block(BrickCoord coord) = 0;
  virtual bool is_rock(VoxelCoord voxel) = 0;
  /// Outside these voxels, all is air. Nothing: it has no bounds.
  virtual const VoxelBox* bounds() const = 0;
};

}  // namespace scree
