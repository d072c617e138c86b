#include "client/render/pieces/piece_views.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "client/render/scene/piece_tint.h"
#include "shared/base/check.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// As client/shaders/surface.vert has it.
constexpr size_t pieces_a_row = 64;
/// An arena tells so many meshes apart.
constexpr size_t labels_max = size_t{UINT16_MAX} + 1;

glm::vec3 voxels_of(const SurfaceMesh& mesh, const SurfaceVertex& vertex) {
  return as_vector(mesh.origin) +
         glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel;
}

}  // namespace

/// Nothing where there are as many as labels: a mirror may hold so many, and stones lie beside them.
std::optional<size_t> PieceViews::free_row() {
  if (free_rows_.empty()) {
    const size_t first = texels_.size() / texels_each;
    if (first + pieces_a_row > labels_max) return std::nullopt;
    texels_.resize(texels_.size() + pieces_a_row * texels_each);
    for (size_t row = first + pieces_a_row; row > first; --row) free_rows_.push_back(row - 1);
  }
  const size_t row = free_rows_.back();
  free_rows_.pop_back();
  return row;
}

void PieceViews::show(const PieceMesh& piece, float voxel_m) {
  remove(piece.id);
  View& view = views_[piece.id];
  view.volume = piece.piece.volume;
  view.pose = piece.piece.pose;
  if (piece.mesh.empty()) return;
  const std::optional<size_t> row = free_row();
  if (!row) return;
  view.row = *row;
  view.slot = arena_.add(piece.mesh, piece.mesh.origin, static_cast<uint16_t>(view.row));
  const glm::vec3 centre = piece.piece.volume->centre_voxels;
  glm::vec3 lo = voxels_of(piece.mesh, piece.mesh.vertices.front()), hi = lo;
  for (const SurfaceVertex& vertex : piece.mesh.vertices) {
    const glm::vec3 at = voxels_of(piece.mesh, vertex);
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
    view.reach_m = std::max(view.reach_m, glm::distance(at, centre) * voxel_m);
  }
  const glm::vec3 size = hi - lo;
  const float half_width_m = 0.5F * std::max({size.x, size.y, size.z}) * voxel_m;
  glm::vec4* const texels = &texels_[view.row * texels_each];
  texels[2] = glm::vec4(as_vector(piece.mesh.origin), half_width_m);
  texels[3] = glm::vec4(centre * voxel_m, 0.0F);
  place(view, piece.id);
}

/// Sets those of its texels that change as the piece moves.
void PieceViews::place(const View& view, PieceId id) {
  glm::vec4* const texels = &texels_[view.row * texels_each];
  const glm::quat& turn = view.pose.rotation;
  texels[0] = glm::vec4(view.pose.position_m, tint_of(id));
  texels[1] = glm::vec4(turn.x, turn.y, turn.z, turn.w);
  are_new_ = true;
}

void PieceViews::remove(PieceId id) {
  const auto found = views_.find(id);
  if (found == views_.end()) return;
  if (found->second.slot.indices > 0) {
    arena_.remove(found->second.slot);
    free_rows_.push_back(found->second.row);
  }
  views_.erase(found);
}

void PieceViews::move(const ScenePieces& pieces) {
  for (auto& [id, view] : views_) {
    const auto piece = pieces.find(id);
    if (piece == pieces.end() || view.slot.indices == 0) continue;
    const Pose& pose = piece->second.pose;
    if (pose.position_m == view.pose.position_m && pose.rotation == view.pose.rotation) continue;
    view.pose = pose;
    place(view, id);
  }
}

void PieceViews::show_all(const Field& field, const ScenePieces& pieces) {
  std::vector<PieceId> gone;
  for (const auto& [id, view] : views_) {
    const auto piece = pieces.find(id);
    if (piece == pieces.end() || piece->second.volume != view.volume) gone.push_back(id);
  }
  for (const PieceId id : gone) remove(id);
  for (const auto& [id, piece] : pieces)
    if (!views_.contains(id)) show(mesh_piece(gather_piece(field, id, piece)), field.source().voxel_size_m);
  move(pieces);
}

void PieceViews::upload_places() {
  if (!std::exchange(are_new_, false)) return;
  const size_t width = pieces_a_row * texels_each;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, static_cast<GLsizei>(width),
               static_cast<GLsizei>(texels_.size() / width), 0, GL_RGBA, GL_FLOAT, texels_.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void PieceViews::draw(const SurfaceProgram& program, const DrawPass& pass, float voxel_m, DrawStats& stats) {
  const Frustum frustum(pass.view_projection);
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  visible_.clear();
  for (const auto& [id, view] : views_) {
    if (view.slot.indices == 0 || !frustum.touches(view.pose.position_m, view.reach_m)) continue;
    const glm::vec3 away = view.pose.position_m - pass.eye_m;
    const float square = glm::dot(away, away);
    // Less than a pixel wide.
    const float seen_m = 2.0F * view.reach_m / pass.pixel;
    if (!shadow && square > seen_m * seen_m) continue;
    visible_.emplace_back(square, &view);
  }
  if (visible_.empty()) return;
  std::ranges::sort(visible_);
  slots_.clear();
  for (const auto& [square, view] : visible_) {
    slots_.push_back(view->slot);
    stats.triangles += view->slot.triangles();
  }
  glActiveTexture(GL_TEXTURE0 + SurfaceProgram::pieces_unit);
  glBindTexture(GL_TEXTURE_2D, places_.name());
  upload_places();
  glActiveTexture(GL_TEXTURE0);
  glUniform1f(program.loose, 1.0F);
  glUniform1f(program.voxel_m, voxel_m);
  glUniform1f(program.step, 1.0F / surface_steps_per_voxel);
  stats.draws += arena_.draw(slots_);
}

}  // namespace scree
