#include "client/render/pieces/prop_views.h"

#include <array>
#include <bit>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "client/render/gl/lighting.h"
#include "client/render/gl/shader_sources.h"
#include "client/render/gl/surface_variants.h"
#include "client/render/scene/piece_tint.h"
#include "shared/prop/prop_solid.h"

namespace scree {
namespace {

struct PropVertex {
  glm::vec3 place_m;
  glm::vec3 normal;
};

/// The shape of a part, wherever in its prop it lies.
PropPart at_origin(const PropPart& part) {
  PropPart moved = part;
  moved.place_m = glm::vec3(0.0F);
  moved.turn = {1.0F, 0.0F, 0.0F, 0.0F};
  return moved;
}

Result<gl::Program> link_prop(Surfaces surfaces) {
  const std::array vertex{shader_source("rotation.glsl"), shader_source("prop.vert")};
  const std::array fragment{
      define_of(surfaces),          shader_source("rotation.glsl"), shader_source("atmosphere.glsl"),
      shader_source("noise.glsl"),  shader_source("clouds.glsl"),   shader_source("haze.glsl"),
      shader_source("stones.glsl"), shader_source("material.glsl"), shader_source("rock.glsl"),
      shader_source("shadow.glsl"), shader_source("prop.frag")};
  return gl::Program::link("prop", vertex, fragment);
}

Result<gl::Program> link_model() {
  const std::array vertex{shader_source("rotation.glsl"), shader_source("model.vert")};
  const std::array fragment{
      define_of(Surfaces::ground),  shader_source("rotation.glsl"), shader_source("atmosphere.glsl"),
      shader_source("noise.glsl"),  shader_source("clouds.glsl"),   shader_source("haze.glsl"),
      shader_source("stones.glsl"), shader_source("material.glsl"), shader_source("rock.glsl"),
      shader_source("shadow.glsl"), shader_source("model.frag")};
  return gl::Program::link("model", vertex, fragment);
}

/// Where a part lies in its material: another place for each, so that no two crates have the same boards, but
/// by whole steps of the pattern, so that edges cut all of them alike. Bricks repeat after six steps.
glm::vec3 pattern_place(PieceId id, size_t part, const MaterialLook& look) {
  constexpr uint32_t places = 16;
  uint32_t number = (id + static_cast<uint32_t>(part) * 131U + 1U) * 0x9E3779B1U;
  number ^= number >> 15U;
  const float step_m = look.albedo ? look.image_m : 6.0F * look.pattern_m;
  return step_m * glm::vec3(static_cast<float>(number % places), static_cast<float>((number >> 8U) % places),
                            static_cast<float>((number >> 16U) % places));
}

void describe_instance(GLuint at, size_t stride, size_t offset) {
  glEnableVertexAttribArray(at);
  glVertexAttribPointer(at, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(at, 1);
}

void describe_vertex(GLuint at, GLenum type, size_t stride, size_t offset) {
  glEnableVertexAttribArray(at);
  glVertexAttribPointer(at, 3, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
}

}  // namespace

size_t PropViews::PartHash::operator()(const PropPart& part) const {
  auto hash = static_cast<size_t>(part.kind);
  const auto add = [&](glm::vec3 v) {
    for (int i = 0; i < 3; ++i) hash = hash * 0x9E3779B1U + std::bit_cast<uint32_t>(v[i] + 0.0F);
  };
  add(part.half_m);
  for (const glm::vec3& corner_m : part.corners_m) add(corner_m);
  return hash ^ (hash >> 15U);
}

Result<PropViews::Programs> PropViews::link() {
  const std::array vertex{shader_source("rotation.glsl"), shader_source("prop.vert")};
  Result<gl::Program> shadow =
      gl::Program::link("prop_shadow", vertex, std::array{shader_source("surface_shadow.frag")});
  if (!shadow) return fail(shadow.error().message);
  Result<gl::Program> materials = link_prop(Surfaces::materials);
  if (!materials) return fail(materials.error().message);
  return Programs{std::move(*shadow), std::move(*materials), {}, false, {}, false};
}

std::shared_ptr<PropViews::Shape> PropViews::upload(const PropPart& part) {
  const PropMesh mesh = mesh_of(part);
  std::vector<PropVertex> vertices;
  vertices.reserve(mesh.corners_m.size());
  for (size_t i = 0; i < mesh.corners_m.size(); ++i) vertices.push_back({mesh.corners_m[i], mesh.normals[i]});
  auto shape = std::make_shared<Shape>();
  shape->corners = static_cast<GLsizei>(vertices.size());
  glBindVertexArray(shape->array.name());
  glBindBuffer(GL_ARRAY_BUFFER, shape->vertices.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(PropVertex)),
               vertices.data(), GL_STATIC_DRAW);
  describe_vertex(0, GL_FLOAT, sizeof(PropVertex), offsetof(PropVertex, place_m));
  describe_vertex(1, GL_FLOAT, sizeof(PropVertex), offsetof(PropVertex, normal));
  glBindBuffer(GL_ARRAY_BUFFER, shape->instance_buffer.name());
  describe_instance(2, sizeof(Instance), offsetof(Instance, place_m));
  describe_instance(3, sizeof(Instance), offsetof(Instance, rotation));
  describe_instance(4, sizeof(Instance), offsetof(Instance, pattern_m));
  glBindVertexArray(0);
  return shape;
}

std::shared_ptr<PropViews::Shape> PropViews::upload(const ModelMesh& mesh) {
  auto shape = std::make_shared<Shape>();
  shape->corners = static_cast<GLsizei>(mesh.corners.size());
  shape->reach_m = mesh.reach_m;
  glBindVertexArray(shape->array.name());
  glBindBuffer(GL_ARRAY_BUFFER, shape->vertices.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(ModelVertex)),
               mesh.vertices.data(), GL_STATIC_DRAW);
  describe_vertex(0, GL_FLOAT, sizeof(ModelVertex), offsetof(ModelVertex, place_m));
  describe_vertex(1, GL_BYTE, sizeof(ModelVertex), offsetof(ModelVertex, normal));
  describe_vertex(4, GL_UNSIGNED_BYTE, sizeof(ModelVertex), offsetof(ModelVertex, colour));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, shape->indices.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.corners.size() * sizeof(uint32_t)),
               mesh.corners.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ARRAY_BUFFER, shape->instance_buffer.name());
  describe_instance(2, sizeof(Instance), offsetof(Instance, place_m));
  describe_instance(3, sizeof(Instance), offsetof(Instance, rotation));
  glBindVertexArray(0);
  return shape;
}

/// Links what draws them when it is first asked for: few worlds have any.
bool PropViews::can_draw_models() {
  if (!programs_->models && !programs_->models_fail) {
    Result<gl::Program> linked = link_model();
    if (linked) programs_->models.emplace(std::move(*linked));
    programs_->models_fail = !linked;  // then parts show
  }
  return programs_->models.has_value();
}

std::shared_ptr<PropViews::Shape> PropViews::model_of(const Prop& prop) {
  if (!prop.model) return nullptr;
  const auto mesh = meshes_.find(*prop.model);
  if (mesh == meshes_.end() || !can_draw_models()) return nullptr;
  std::weak_ptr<Shape>& known = model_shapes_[*prop.model];
  std::shared_ptr<Shape> found = known.lock();
  if (found == nullptr) known = found = upload(*mesh->second);
  return found;
}

void PropViews::set_models(const ModelMeshes& models) {
  meshes_ = models;
  models_are_new_ = true;
}

std::shared_ptr<PropViews::Shape> PropViews::shape_of(const PropPart& part) {
  const PropPart shape = at_origin(part);
  std::weak_ptr<Shape>& known = shapes_[shape];
  std::shared_ptr<Shape> found = known.lock();
  if (found == nullptr) known = found = upload(shape);
  return found;
}

PropViews::View PropViews::view_of(const SceneProp& shown) {
  View view{shown.prop, shown.pose, 0.0F, {}, model_of(*shown.prop)};
  view.reach_m = view.model ? view.model->reach_m : reach_of(*shown.prop);
  if (!view.model)
    for (const PropPart& part : shown.prop->parts) view.shapes.push_back(shape_of(part));
  return view;
}

Result<void> PropViews::show(const SceneProps& props) {
  if (!programs_ && !props.empty()) programs_.emplace(TRY(link()));
  const bool may_change = std::exchange(models_are_new_, false);
  const size_t gone = std::erase_if(views_, [&](const auto& view) {
    const auto shown = props.find(view.first);
    return shown == props.end() || shown->second.prop != view.second.prop ||
           (may_change && view.second.prop->model);
  });
  for (const auto& [id, shown] : props) {
    const auto known = views_.find(id);
    if (known == views_.end()) {
      views_.emplace(id, view_of(shown));
    } else {
      known->second.pose = shown.pose;
    }
  }
  if (gone > 0) {
    std::erase_if(shapes_, [](const auto& shape) { return shape.second.expired(); });
    std::erase_if(model_shapes_, [](const auto& shape) { return shape.second.expired(); });
  }
  return {};
}

void PropViews::add_instances(PieceId id, const View& view, const Palette& palette) {
  const Prop& prop = *view.prop;
  if (view.model) {
    const glm::quat& turn = view.pose.rotation;
    view.model->instances.push_back({view.pose.position_m, 0.0F, {turn.x, turn.y, turn.z, turn.w}, {}, 0.0F});
    return;
  }
  const MaterialLook& look = palette.row_or_first(prop.material).look;
  const bool is_bulk = prop.material == palette.ground.bulk;
  for (size_t i = 0; i < prop.parts.size(); ++i) {
    const PropPart& part = prop.parts[i];
    const glm::quat turn = view.pose.rotation * part.turn;
    view.shapes[i]->instances.push_back({view.pose.position_m + view.pose.rotation * part.place_m,
                                         tint_of(id),
                                         {turn.x, turn.y, turn.z, turn.w},
                                         pattern_place(id, i, look),
                                         is_bulk ? 0.0F : static_cast<float>(row_number(prop.material) + 1)});
  }
}

const gl::Program& PropViews::surface_program(const DrawPass& pass) {
  if (pass.lighting.images != 0 && !programs_->images && !programs_->images_fail) {
    Result<gl::Program> linked = link_prop(Surfaces::images);
    if (linked) programs_->images.emplace(std::move(*linked));
    programs_->images_fail = !linked;  // then colours show
  }
  return pass.lighting.images != 0 && programs_->images ? *programs_->images : programs_->materials;
}

void PropViews::use(const gl::Program& program, const DrawPass& pass) {
  program.use();
  program.set("u_view_projection", pass.view_projection);
  if (pass.kind != DrawPass::Kind::shadow) set_lighting(program, pass, 0);
}

/// False: there is nothing to draw.
bool PropViews::begin_instances(Shape& shape) {
  if (shape.instances.empty()) return false;
  glBindVertexArray(shape.array.name());
  glBindBuffer(GL_ARRAY_BUFFER, shape.instance_buffer.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(shape.instances.size() * sizeof(Instance)),
               shape.instances.data(), GL_STREAM_DRAW);
  return true;
}

/// Their faces are seen from both sides: many a modeller makes thin things of one face.
void PropViews::draw_models(const DrawPass& pass) {
  if (model_shapes_.empty()) return;
  use(pass.kind == DrawPass::Kind::shadow ? programs_->shadow : *programs_->models, pass);
  glDisable(GL_CULL_FACE);
  for (const auto& [digest, known] : model_shapes_) {
    const std::shared_ptr<Shape> shape = known.lock();
    if (shape == nullptr || !begin_instances(*shape)) continue;
    glDrawElementsInstanced(GL_TRIANGLES, shape->corners, GL_UNSIGNED_INT, nullptr,
                            static_cast<GLsizei>(shape->instances.size()));
    shape->instances.clear();
  }
  glEnable(GL_CULL_FACE);
}

void PropViews::draw(const DrawPass& pass, const Palette& palette) {
  if (views_.empty()) return;
  const Frustum frustum(pass.view_projection);
  for (const auto& [id, view] : views_)
    if (frustum.touches(view.pose.position_m, view.reach_m)) add_instances(id, view, palette);
  use(pass.kind == DrawPass::Kind::shadow ? programs_->shadow : surface_program(pass), pass);
  for (const auto& [part, known] : shapes_) {
    const std::shared_ptr<Shape> shape = known.lock();
    if (shape == nullptr || !begin_instances(*shape)) continue;
    glDrawArraysInstanced(GL_TRIANGLES, 0, shape->corners, static_cast<GLsizei>(shape->instances.size()));
    shape->instances.clear();
  }
  draw_models(pass);
  glBindVertexArray(0);
}

}  // namespace scree
