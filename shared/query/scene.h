// What questions about space are asked of: a field, and the solids in it. A view of a moment.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "shared/field/piece.h"
#include "shared/query/convex.h"
#include "shared/query/field_cells.h"
#include "shared/query/solid_tree.h"
#include "shared/query/volume_cells.h"

namespace scree {

/// A piece, or a body of the game. Either has a volume, or parts.
struct QuerySolid {
  PieceId id = 0;
  Pose pose;                       ///< the rotation has a length, 1 as a rule
  const Volume* volume = nullptr;  ///< of a piece
  std::span<const Convex> parts;   ///< of a body, in its own frame, metres; each validate()d
  uint32_t groups = 1;             ///< of a body: bits that masks ask for; of none, nothing hits it
};

/// From the world's metres to a solid's own frame and unit: voxels of a piece, metres of a body.
struct SolidFrame {
  glm::dmat3 rotation{1.0};
  glm::dvec3 position_m{0.0};
  glm::dvec3 centre{0.0};  ///< of the frame, in its unit: at position_m
  double unit_m = 1.0;

  glm::dvec3 turned_in(const glm::dvec3& v) const { return v * rotation; }  // by the transpose
  glm::dvec3 turned_out(const glm::dvec3& v) const { return rotation * v; }
  glm::dvec3 in(const glm::dvec3& place_m) const { return turned_in(place_m - position_m) / unit_m + centre; }
  glm::dvec3 out(const glm::dvec3& place) const { return turned_out(place - centre) * unit_m + position_m; }
};

/// Keeps what was read of the field and of volumes from one question to the next: make one scene for many
/// questions, and a new one after the field changed, ground arrived or solids moved. Field, solids, volumes
/// and parts outlive it. Making it costs some 0.2 µs a solid. As a field, it is for one thread at a time; a
/// const function reads ground.
class QueryScene {
 public:
  /// Solids are ordered by id, each once.
  QueryScene(const Field& field, std::span<const QuerySolid> solids);
  /// With the cells of that field, kept since scenes before; told to forget what has changed.
  QueryScene(const Field& field, std::span<const QuerySolid> solids, FieldCells& terrain);

  const Field& field() const { return field_; }
  double voxel_m() const { return voxel_m_; }
  std::span<const QuerySolid> solids() const { return solids_; }
  /// Boxes around the solids and their positions, by their places in the span, metres.
  const SolidTree& tree() const { return tree_; }
  const SolidFrame& frame(size_t index) const { return frames_[index]; }
  FieldCells& terrain() const { return terrain_; }
  /// A piece has them.
  VolumeCells& cells(size_t index) const;

 private:
  QueryScene(const Field& field, std::span<const QuerySolid> solids, FieldCells* kept);

  const Field& field_;
  double voxel_m_;
  std::span<const QuerySolid> solids_;
  std::vector<SolidFrame> frames_;
  SolidTree tree_;
  std::unique_ptr<FieldCells> own_;
  FieldCells& terrain_;
  mutable std::vector<std::unique_ptr<VolumeCells>> cells_;  ///< of pieces that questions came to
};

}  // namespace scree
