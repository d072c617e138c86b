#include "client/render/details/detail_drawer.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "client/render/details/detail_meshes.h"
#include "client/render/gl/lighting.h"
#include "client/render/gl/shader_sources.h"
#include "client/render/gl/surface_variants.h"

namespace scree {
namespace {

/// `casts`: for the shadow map.
Result<gl::Program> link_detail(bool stones, bool casts, std::span<const std::string_view> fragment) {
  std::vector<std::string_view> vertex{stones ? "#define STONES 1\n" : "#define STONES 0\n",
                                       casts ? "#define CASTS 1\n" : "#define CASTS 0\n",
                                       "#define AT_CORNERS\n"};
  for (const std::string_view part :
       {"rotation.glsl", "atmosphere.glsl", "noise.glsl", "clouds.glsl", "haze.glsl"})
    vertex.push_back(shader_source(part));
  if (!casts) vertex.push_back(shader_source("shadow.glsl"));
  vertex.push_back(shader_source("detail.vert"));
  return gl::Program::link("detail", vertex, fragment);
}

Result<gl::Program> link_detail_shadow(bool stones) {
  return link_detail(stones, true, std::array{shader_source("surface_shadow.frag")});
}

Result<gl::Program> link_detail_colour(bool stones) {
  if (!stones)
    return link_detail(stones, false,
                       std::array{shader_source("atmosphere.glsl"), shader_source("detail.frag")});
  return link_detail(
      stones, false,
      std::array{define_of(Surfaces::ground), shader_source("rotation.glsl"),
                 shader_source("atmosphere.glsl"), shader_source("noise.glsl"), shader_source("clouds.glsl"),
                 shader_source("haze.glsl"), shader_source("stones.glsl"), shader_source("material.glsl"),
                 shader_source("rock.glsl"), shader_source("detail_stone.frag")});
}

void describe_detail(GLuint index, GLint size, GLenum type, size_t stride, size_t offset, GLuint divisor) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE,
                        static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(index, divisor);
}

template <typename T>
void upload_buffer(GLenum target, const gl::Buffer& buffer, const std::vector<T>& all, GLenum usage) {
  glBindBuffer(target, buffer.name());
  glBufferData(target, static_cast<GLsizeiptr>(all.size() * sizeof(T)), all.data(), usage);
}

}  // namespace

Result<DetailDrawer> DetailDrawer::create() {
  return DetailDrawer({TRY(link_detail_colour(false)), TRY(link_detail_colour(true))},
                      {TRY(link_detail_shadow(false)), TRY(link_detail_shadow(true))});
}

DetailDrawer::DetailDrawer(Programs&& colour, Programs&& shadow)
    : colour_(std::move(colour)), shadow_(std::move(shadow)) {
  for (size_t kind = 0; kind < detail_kinds; ++kind) {
    Shape& shape = shapes_.at(kind);
    const DetailMesh mesh = detail_mesh(static_cast<DetailKind>(kind));
    shape.corner_count = static_cast<GLsizei>(mesh.corners.size());
    glBindVertexArray(shape.array.name());
    upload_buffer(GL_ARRAY_BUFFER, shape.vertices, mesh.vertices, GL_STATIC_DRAW);
    describe_detail(0, 3, GL_FLOAT, sizeof(DetailVertex), offsetof(DetailVertex, place), 0);
    describe_detail(1, 4, GL_BYTE, sizeof(DetailVertex), offsetof(DetailVertex, normal), 0);
    upload_buffer(GL_ELEMENT_ARRAY_BUFFER, shape.corners, mesh.corners, GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, shape.instances.name());
    describe_detail(2, 4, GL_FLOAT, sizeof(Detail), offsetof(Detail, place_m), 1);
    describe_detail(3, 4, GL_UNSIGNED_BYTE, sizeof(Detail), offsetof(Detail, colour), 1);
    describe_detail(4, 4, GL_BYTE, sizeof(Detail), offsetof(Detail, turn), 1);
    glBindVertexArray(0);
  }
}

void DetailDrawer::draw(const DetailLists& lists, float range_m, const DrawPass& pass) const {
  for (size_t kind = 0; kind < detail_kinds; ++kind) {
    const std::vector<Detail>& all = lists.at(kind);
    if (all.empty()) continue;
    const bool is_stone = static_cast<DetailKind>(kind) == DetailKind::stone;
    const bool is_shadow = pass.kind == DrawPass::Kind::shadow;
    const gl::Program& program = (is_shadow ? shadow_ : colour_)[is_stone ? 1 : 0];
    program.use();
    program.set("u_view_projection", pass.view_projection);
    program.set("u_range_m", range_m);
    program.set("u_eye", pass.eye_m);
    program.set("u_wind_s", pass.wind_s);
    program.set("u_pixel", static_cast<DetailKind>(kind) == DetailKind::grass ? pass.pixel : 0.0F);
    if (!is_shadow) set_lighting(program, pass, 0);
    const Shape& shape = shapes_.at(kind);
    glBindVertexArray(shape.array.name());
    upload_buffer(GL_ARRAY_BUFFER, shape.instances, all, GL_STREAM_DRAW);
    // A blade and a leaf are seen from both sides.
    if (!is_stone) glDisable(GL_CULL_FACE);
    glDrawElementsInstanced(GL_TRIANGLES, shape.corner_count, GL_UNSIGNED_SHORT, nullptr,
                            static_cast<GLsizei>(all.size()));
    if (!is_stone) glEnable(GL_CULL_FACE);
  }
  glBindVertexArray(0);
}

}  // namespace scree
