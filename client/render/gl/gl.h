// Owners of OpenGL objects, and programs. Only for client/render: includes epoxy. Everything here needs the
// context current on the calling thread, destructors too.
//
// Within the common subset of OpenGL 3.3 core and OpenGL ES 3.0, but for geometry shaders.
#pragma once

#include <epoxy/gl.h>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "shared/base/result.h"

namespace scree::gl {

/// The context's version and driver, for people.
std::string describe_context();
/// Fails without OpenGL 3.3 or OpenGL ES 3.0; the error names what was found.
Result<void> check_context();

/// Owns one name; Traits say how it is made and freed.
template <typename Traits>
class Object {
 public:
  Object() { Traits::make(&name_); }
  ~Object() {
    if (name_ != 0) Traits::free(&name_);
  }
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct BufferTraits {
  static void make(GLuint* name) { glGenBuffers(1, name); }
  static void free(GLuint* name) { glDeleteBuffers(1, name); }
};
struct VertexArrayTraits {
  static void make(GLuint* name) { glGenVertexArrays(1, name); }
  static void free(GLuint* name) { glDeleteVertexArrays(1, name); }
};
struct TextureTraits {
  static void make(GLuint* name) { glGenTextures(1, name); }
  static void free(GLuint* name) { glDeleteTextures(1, name); }
};
struct FramebufferTraits {
  static void make(GLuint* name) { glGenFramebuffers(1, name); }
  static void free(GLuint* name) { glDeleteFramebuffers(1, name); }
};
struct QueryTraits {
  static void make(GLuint* name) { glGenQueries(1, name); }
  static void free(GLuint* name) { glDeleteQueries(1, name); }
};
struct RenderbufferTraits {
  static void make(GLuint* name) { glGenRenderbuffers(1, name); }
  static void free(GLuint* name) { glDeleteRenderbuffers(1, name); }
};

using Buffer = Object<BufferTraits>;
using VertexArray = Object<VertexArrayTraits>;
using Texture = Object<TextureTraits>;
using Framebuffer = Object<FramebufferTraits>;
using Query = Object<QueryTraits>;
using Renderbuffer = Object<RenderbufferTraits>;

/// A linked program of a vertex and a fragment shader. Setting a uniform that the compiler removed does
/// nothing.
class Program {
 public:
  /// `parts` are concatenated, behind the version line that the context needs; without any for a geometry
  /// shader there is none. The message of a failure is the compiler's.
  static Result<Program> link(std::string_view name, std::span<const std::string_view> vertex_parts,
                              std::span<const std::string_view> fragment_parts,
                              std::span<const std::string_view> geometry_parts = {});
  ~Program() { glDeleteProgram(name_); }
  Program(Program&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Program& operator=(Program&&) = delete;

  void use() const { glUseProgram(name_); }
  GLint uniform(const char* name) const { return glGetUniformLocation(name_, name); }
  void set(const char* name, float value) const { glUniform1f(uniform(name), value); }
  void set(const char* name, int value) const { glUniform1i(uniform(name), value); }
  void set(const char* name, glm::vec3 value) const { glUniform3f(uniform(name), value.x, value.y, value.z); }
  void set(const char* name, glm::vec4 value) const {
    glUniform4f(uniform(name), value.x, value.y, value.z, value.w);
  }
  void set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(uniform(name), 1, GL_FALSE, &value[0][0]);
  }

 private:
  explicit Program(GLuint name) : name_(name) {}
  /// Nothing of it is kept if it does not compile.
  Result<void> attach(GLenum stage, std::string_view name, std::span<const std::string_view> parts) const;
  GLuint name_;
};

}  // namespace scree::gl
