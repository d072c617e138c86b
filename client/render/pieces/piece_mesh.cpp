#include "client/render/pieces/piece_mesh.h"

namespace scree {

PieceJob gather_piece(const Field& field, PieceId id, const ScenePiece& piece) {
  return {id, piece, paint_number(field, *piece.volume), gather_generated(field, piece.volume->window.box)};
}

PieceMesh mesh_piece(const PieceJob& job) {
  PieceMesh done{job.id, job.piece, surface_nets_closed(job.piece.volume->window, &job.before)};
  for (SurfaceVertex& vertex : done.mesh.vertices) vertex.paint = vertex_paint(job.paint);
  return done;
}

}  // namespace scree
