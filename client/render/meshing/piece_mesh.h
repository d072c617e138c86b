// The mesh of one piece. A job owns all its data: it may run on any thread.
#pragma once

#include "client/render/levels/block_windows.h"
#include "client/render/scene/draw_method.h"

namespace scree {

struct PieceMesh {
  PieceId id = 0;
  ScenePiece piece;  ///< as it was when the mesh was begun
  SurfaceMesh mesh;
};

struct PieceJob {
  PieceId id = 0;
  ScenePiece piece;
  LookWindow looks;
  /// The generated terrain in the voxel frame of the rock from which the piece was cut: it tells which of the
  /// piece's faces are fresh.
  Window before;
};

PieceJob gather_piece(const Field& field, PieceId id, const ScenePiece& piece);
PieceMesh mesh_piece(const PieceJob& job);

}  // namespace scree
