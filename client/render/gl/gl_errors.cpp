#include "client/render/gl/gl_errors.h"

#include "client/render/gl/gl.h"

namespace scree::gl {
namespace {

void APIENTRY receive(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                      const void* log) {
  if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
  auto* errors = const_cast<ErrorLog*>(static_cast<const ErrorLog*>(log));
  errors->add(std::string(text, static_cast<size_t>(length < 0 ? 0 : length)));
}

/// On desktop GL 4.3, or by the extension; on ES 3.2 only (the extension's names there have a suffix).
bool has_debug_output() {
  const int version = epoxy_gl_version();
  if (!epoxy_is_desktop_gl()) return version >= 32;
  return version >= 43 || epoxy_has_gl_extension("GL_KHR_debug");
}

}  // namespace

void ErrorLog::attach() {
  if (!has_debug_output()) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(receive, this);
  attached_ = true;
}

void ErrorLog::detach() {
  if (attached_) glDebugMessageCallback(nullptr, nullptr);
  attached_ = false;
}

void ErrorLog::poll() {
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
    if (!attached_) add("GL error " + std::to_string(error));
}

void ErrorLog::add(std::string message) {
  if (count_++ == 0) first_ = std::move(message);
}

}  // namespace scree::gl
