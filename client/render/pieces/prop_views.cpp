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

void describe_vertex(GLuint at, size_t offset) {
  glEnableVertexAttribArray(at);
  glVertexAttribPointer(at, 3, GL_FLOAT, GL_FALSE, sizeof(PropVertex), reinterpret_cast<const void*>(offset));
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
  return Programs{std::move(*shadow), std::move(*materials), std::nullopt, false};
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
  describe_vertex(0, offsetof(PropVertex, place_m));
  describe_vertex(1, offsetof(PropVertex, normal));
  glBindBuffer(GL_ARRAY_BUFFER, shape->instance_buffer.name());
  describe_instance(2, sizeof(Instance), offsetof(Instance, place_m));
  describe_instance(3, sizeof(Instance), offsetof(Instance, rotation));
  describe_instance(4, sizeof(Instance), offsetof(Instance, pattern_m));
  glBindVertexArray(0);
  return shape;
}

std::shared_ptr<PropViews::Shape> PropViews::shape_of(const PropPart& part) {
  const PropPart shape = at_origin(part);
  std::weak_ptr<Shape>& known = shapes_[shape];
  std::shared_ptr<Shape> found = known.lock();
  if (found == nullptr) known = found = upload(shape);
  return found;
}

PropViews::View PropViews::view_of(const SceneProp& shown) {
  View view{shown.prop, shown.pose, reach_of(*shown.prop), {}};
  for (const PropPart& part : shown.prop->parts) view.shapes.push_back(shape_of(part));
  return view;
}

Result<void> PropViews::show(const SceneProps& props) {
  if (!programs_ && !props.empty()) programs_.emplace(TRY(link()));
  const size_t gone = std::erase_if(views_, [&](const auto& view) {
    const auto shown = props.find(view.first);
    return shown == props.end() || shown->second.prop != view.second.prop;
  });
  for (const auto& [id, shown] : props) {
    const auto known = views_.find(id);
    if (known == views_.end()) {
      views_.emplace(id, view_of(shown));
    } else {
      known->second.pose = shown.pose;
    }
  }
  if (gone > 0) std::erase_if(shapes_, [](const auto& shape) { return shape.second.expired(); });
  return {};
}

void PropViews::add_instances(PieceId id, const View& view, const Palette& palette) {
  const Prop& prop = *view.prop;
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

const gl::Program& PropViews::use(const DrawPass& pass) {
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  if (!shadow && pass.lighting.images != 0 && !programs_->images && !programs_->images_fail) {
    Result<gl::Program> linked = link_prop(Surfaces::images);
    if (linked) programs_->images.emplace(std::move(*linked));
    programs_->images_fail = !linked;  // then colours show
  }
  const bool has_images = pass.lighting.images != 0 && programs_->images;
  const gl::Program& program =
      shadow ? programs_->shadow : (has_images ? *programs_->images : programs_->materials);
  program.use();
  program.set("u_view_projection", pass.view_projection);
  if (!shadow) set_lighting(program, pass, 0);
  return program;
}

void PropViews::draw(const DrawPass& pass, const Palette& palette) {
  if (views_.empty()) return;
  use(pass);
  const Frustum frustum(pass.view_projection);
  for (const auto& [id, view] : views_)
    if (frustum.touches(view.pose.position_m, view.reach_m)) add_instances(id, view, palette);
  for (const auto& [part, known] : shapes_) {
    const std::shared_ptr<Shape> shape = known.lock();
    if (shape == nullptr || shape->instances.empty()) continue;
    glBindVertexArray(shape->array.name());
    glBindBuffer(GL_ARRAY_BUFFER, shape->instance_buffer.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(shape->instances.size() * sizeof(Instance)),
                 shape->instances.data(), GL_STREAM_DRAW);
    glDrawArraysInstanced(GL_TRIANGLES, 0, shape->corners, static_cast<GLsizei>(shape->instances.size()));
    shape->instances.clear();
  }
  glBindVertexArray(0);
}

}  // namespace scree
