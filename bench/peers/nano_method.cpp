#include "bench/peers/nano_method.h"

#include <epoxy/gl.h>
#include <fstream>
#include <sstream>
#include <string>

#include "bench/peers/screen_program.h"

namespace scree::peers {
namespace {

constexpr GLuint words_binding = 0;
/// Where Debian's libnanovdb-dev has it: the shader's source is the header itself.
constexpr const char* header_path = "/usr/include/nanovdb/PNanoVDB.h";

/// Before NanoVDB's header, and after it.
constexpr const char* head_text = R"GLSL(#version 430 core
layout(std430, binding = 0) readonly buffer Words { uint pnanovdb_buf_data[]; };
#define PNANOVDB_GLSL
)GLSL";

constexpr const char* main_text = R"GLSL(
uniform vec3 u_eye;
uniform vec3 u_sun;
uniform float u_reach_m;
uniform float u_voxel_m;
uniform mat4 u_view_projection;
in vec3 v_direction;
out vec4 o_colour;

float value_at(inout pnanovdb_readaccessor_t reader, ivec3 at) {
  pnanovdb_buf_t words;
  return pnanovdb_read_float(words, pnanovdb_readaccessor_get_value_address(PNANOVDB_GRID_TYPE_FLOAT, words, reader, at));
}

void main() {
  pnanovdb_buf_t words;
  pnanovdb_grid_handle_t grid;
  grid.address.byte_offset = 0u;
  pnanovdb_readaccessor_t reader;
  pnanovdb_readaccessor_init(reader, pnanovdb_tree_get_root(words, pnanovdb_grid_get_tree(words, grid)));
  vec3 direction = normalize(v_direction);
  float along = 0.0;
  float value = 0.0;
  bool found = pnanovdb_hdda_zero_crossing(PNANOVDB_GRID_TYPE_FLOAT, words, reader, u_eye / u_voxel_m, 0.0, direction,
                                           u_reach_m / u_voxel_m, along, value);
  if (!found) discard;
  vec3 world = u_eye + direction * (along * u_voxel_m);
  ivec3 at = ivec3(floor(world / u_voxel_m));
  vec3 normal = vec3(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    ivec3 step = ivec3(0);
    step[axis] = 1;
    normal[axis] = value_at(reader, at + step) - value_at(reader, at - step);
  }
  o_colour = vec4(vec3(0.2 + 0.8 * max(dot(normalize(normal), u_sun), 0.0)), 1.0);
  vec4 clip = u_view_projection * vec4(world, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
}
)GLSL";

class NanoMethod final : public DrawMethod {
 public:
  NanoMethod(std::unique_ptr<ScreenProgram> program, std::span<const uint32_t> words, float voxel_size_m,
             float reach_m)
      : program_(std::move(program)),
        bytes_(words.size_bytes()),
        voxel_size_m_(voxel_size_m),
        reach_m_(reach_m) {
    glGenBuffers(1, &words_);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, words_);
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes_), words.data(), GL_STATIC_DRAW);
  }
  ~NanoMethod() override { glDeleteBuffers(1, &words_); }
  NanoMethod(const NanoMethod&) = delete;
  NanoMethod& operator=(const NanoMethod&) = delete;

  void changed(const MirrorChanges&) override {}
  void update(const Scene&, const Camera&) override {}
  bool loaded() const override { return true; }
  bool complete() const override { return true; }
  float reach_m() const override { return reach_m_; }
  DrawStats stats() const override {
    DrawStats stats;
    stats.memory.push_back({.category = "grid", .gpu_bytes = bytes_});
    return stats;
  }
  void draw(const DrawPass& pass) override {
    if (pass.kind == DrawPass::Kind::shadow) return;
    program_->use(pass);
    glUniform1f(program_->uniform("u_voxel_m"), voxel_size_m_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, words_binding, words_);
    program_->draw();
  }

 private:
  std::unique_ptr<ScreenProgram> program_;
  GLuint words_ = 0;
  size_t bytes_;
  float voxel_size_m_;
  float reach_m_;
};

}  // namespace

Result<std::unique_ptr<DrawMethod>> make_nano_method(std::span<const uint32_t> words, float voxel_size_m,
                                                     float reach_m) {
  if (epoxy_gl_version() < 43 || !epoxy_is_desktop_gl()) return fail("PNanoVDB needs OpenGL 4.3");
  GLint64 bytes_max = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes_max);
  if (static_cast<GLint64>(words.size_bytes()) > bytes_max)
    return fail("the grid of " + std::to_string(words.size_bytes()) +
                " bytes is larger than this GPU's storage buffers may be: " + std::to_string(bytes_max));
  std::ostringstream header;
  header << std::ifstream(header_path).rdbuf();
  if (header.str().empty())
    return fail(std::string("cannot read ") + header_path + ": install libnanovdb-dev");
  Result<std::unique_ptr<ScreenProgram>> program =
      ScreenProgram::link("PNanoVDB", head_text + header.str() + main_text);
  if (!program) return fail(program.error().message);
  return std::make_unique<NanoMethod>(std::move(*program), words, voxel_size_m, reach_m);
}

}  // namespace scree::peers
