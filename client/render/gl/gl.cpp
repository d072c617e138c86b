#include "client/render/gl/gl.h"

#include <string>

namespace scree::gl {
namespace {

/// Desktop GL and ES differ in the version line and in ES's precisions.
std::string preamble() {
  if (epoxy_is_desktop_gl()) return "#version 330 core\n";
  return "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2DShadow;\n"
         "precision highp sampler3D;\nprecision highp usampler3D;\nprecision highp usampler2D;\n";
}

Result<GLuint> compile(GLenum stage, std::string_view name, std::span<const std::string_view> parts) {
  std::string source = preamble();
  for (const std::string_view part : parts) source += part;
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<size_t>(length));
  glDeleteShader(shader);
  return fail("shader " + std::string(name) + " does not compile: " + log);
}

}  // namespace

std::string describe_context() {
  const auto text = [](GLenum what) {
    const auto* found = reinterpret_cast<const char*>(glGetString(what));
    return std::string(found == nullptr ? "unknown" : found);
  };
  return (epoxy_is_desktop_gl() ? "OpenGL " : "") + text(GL_VERSION) + " (" + text(GL_RENDERER) + ")";
}

Result<void> check_context() {
  const int version = epoxy_gl_version();
  const bool desktop = epoxy_is_desktop_gl();
  if (version >= (desktop ? 33 : 30)) return {};
  return fail("found " + describe_context() +
              "; OpenGL 3.3 or OpenGL ES 3.0 is needed: install a newer driver, " +
              "or Mesa's software one (libgl1-mesa-dri) and set LIBGL_ALWAYS_SOFTWARE=1");
}

Result<void> Program::attach(GLenum stage, std::string_view name,
                             std::span<const std::string_view> parts) const {
  const Result<GLuint> shader = compile(stage, name, parts);
  if (!shader) return fail(shader.error().message);
  glAttachShader(name_, *shader);
  glDeleteShader(*shader);
  return {};
}

Result<Program> Program::link(std::string_view name, std::span<const std::string_view> vertex_parts,
                              std::span<const std::string_view> fragment_parts,
                              std::span<const std::string_view> geometry_parts) {
  Program program(glCreateProgram());
  Result<void> attached = program.attach(GL_VERTEX_SHADER, name, vertex_parts);
  if (attached && !geometry_parts.empty())
    attached = program.attach(GL_GEOMETRY_SHADER, name, geometry_parts);
  if (attached) attached = program.attach(GL_FRAGMENT_SHADER, name, fragment_parts);
  if (!attached) return fail(attached.error().message);
  glLinkProgram(program.name_);
  GLint done = GL_FALSE;
  glGetProgramiv(program.name_, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program.name_, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<size_t>(length));
  return fail("shader " + std::string(name) + " does not link: " + log);
}

}  // namespace scree::gl
