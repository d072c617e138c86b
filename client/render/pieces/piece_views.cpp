#include "client/render/pieces/piece_views.h"

#include <glm/geometric.hpp>

#include "client/render/scene/piece_tint.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {}  // namespace

void PieceViews::show(const PieceMesh& piece, float voxel_m) {
  remove(piece.id);
  View& view = views_[piece.id];
  if (!piece.mesh.empty()) {
    view.mesh.emplace(piece.mesh);
    gpu_bytes_ += view.mesh->bytes();
  }
  view.pose = piece.piece.pose;
  view.centre_m = piece.piece.volume->centre_voxels * voxel_m;
  view.radius_m = glm::length(as_vector(piece.piece.volume->window.box.size())) * voxel_m;
}

void PieceViews::remove(PieceId id) {
  const auto found = views_.find(id);
  if (found == views_.end()) return;
  if (found->second.mesh) gpu_bytes_ -= found->second.mesh->bytes();
  views_.erase(found);
}

void PieceViews::move(const ScenePieces& pieces) {
  for (auto& [id, view] : views_) {
    const auto piece = pieces.find(id);
    if (piece != pieces.end()) view.pose = piece->second.pose;
  }
}

void PieceViews::erase_all_but(const ScenePieces& pieces) {
  std::vector<PieceId> gone;
  for (const auto& [id, view] : views_)
    if (!pieces.contains(id)) gone.push_back(id);
  for (const PieceId id : gone) remove(id);
}

void PieceViews::draw(const SurfaceProgram& program, const Frustum& frustum, float voxel_m,
                      DrawStats& pass) const {
  glUniform1f(program.loose, 1.0F);
  glUniform1f(program.voxel_m, voxel_m);
  for (const auto& [id, view] : views_) {
    if (!view.mesh || !frustum.touches(view.pose.position_m, view.radius_m)) continue;
    const glm::vec3 place_m = view.pose.position_m;
    const glm::quat& turn = view.pose.rotation;
    program.set_place(place_of(view.mesh->origin(), 0));
    glUniform3f(program.centre_m, view.centre_m.x, view.centre_m.y, view.centre_m.z);
    glUniform3f(program.place_m, place_m.x, place_m.y, place_m.z);
    glUniform4f(program.rotation, turn.x, turn.y, turn.z, turn.w);
    glUniform1f(program.tint, tint_of(id));
    view.mesh->draw();
    ++pass.draws;
    pass.triangles += view.mesh->triangles();
  }
}

}  // namespace scree
