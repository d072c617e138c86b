// In place of libepoxy in the web build: WebGL 2 is OpenGL ES 3.0, whose functions emscripten links. What is
// asked for of others is declared, so that its callers compile, and never called: there is no desktop OpenGL,
// no later version and no extension here.
#pragma once

#include <GLES3/gl3.h>

#define APIENTRY GL_APIENTRY

inline bool epoxy_is_desktop_gl() {
  return false;
}
inline int epoxy_gl_version() {
  return 30;
}
inline bool epoxy_has_gl_extension(const char*) {
  return false;
}

// Timestamps, as of GL_EXT_disjoint_timer_query.
#define GL_TIMESTAMP 0x8E28
#define GL_TIMESTAMP_EXT GL_TIMESTAMP
#define GL_QUERY_RESULT_EXT GL_QUERY_RESULT
inline void glQueryCounter(GLuint, GLenum) {}
inline void glQueryCounterEXT(GLuint, GLenum) {}
inline void glGetQueryObjectui64v(GLuint, GLenum, GLuint64*) {}
inline void glGetQueryObjectui64vEXT(GLuint, GLenum, GLuint64*) {}

// Debug output, as of OpenGL ES 3.2.
#define GL_DEBUG_OUTPUT 0x92E0
#define GL_DEBUG_OUTPUT_SYNCHRONOUS 0x8242
#define GL_DEBUG_TYPE_ERROR 0x824C
#define GL_DEBUG_SEVERITY_HIGH 0x9146
using GLDEBUGPROC = void (*)(GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar*, const void*);
inline void glDebugMessageCallback(GLDEBUGPROC, const void*) {}

// Geometry shaders, as of OpenGL ES 3.2.
#define GL_GEOMETRY_SHADER 0x8DD9
#define GL_LINES_ADJACENCY 0x000A
#define GL_PRIMITIVES_GENERATED 0x8C87

// Many draws at once, as of desktop OpenGL.
inline void glMultiDrawElements(GLenum, const GLsizei*, GLenum, const void* const*, GLsizei) {}
