#include "client/render/meshing/piece_mesh.h"

#include "client/render/levels/surface_looks.h"
#include "shared/surface/creases.h"
#include "shared/surface/surface_nets.h"

namespace scree {

PieceJob gather_piece(const Field& field, PieceId id, const ScenePiece& piece) {
  const Volume& volume = *piece.volume;
  return {id, piece, looks_of(field, volume), gather_generated(field, volume.window.box)};
}

PieceMesh mesh_piece(const PieceJob& job) {
  const Window& now = job.piece.volume->window;
  PieceMesh done{job.id, job.piece, {}};
  if (now.box.empty()) return done;
  const Window closed = closed_window(now), before = closed_window(job.before);
  done.mesh = surface_nets(closed, closed_box(now), &before);
  sharpen_creases(closed, done.mesh);
  set_looks(done.mesh, now, job.looks,
            [](const SurfaceVertex& vertex, glm::vec3) { return vertex.before < cut_begins; });
  for (SurfaceVertex& vertex : done.mesh.vertices) vertex.before = packed_worn(vertex.before);
  if (!job.looks.is_ground()) part_looks(done.mesh);
  return done;
}

}  // namespace scree
