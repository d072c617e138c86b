#include "bench/peers/csg_list.h"

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "bench/peers/screen_program.h"
#include "shared/base/random.h"

namespace scree::peers {
namespace {

constexpr int noise_side = 64;
constexpr float reach = 96.0F;  ///< metres

constexpr const char* fragment_text = R"GLSL(#version 330 core
uniform vec3 u_eye;
uniform vec3 u_sun;
uniform float u_reach_m;
uniform mat4 u_view_projection;
uniform sampler3D u_noise;
uniform int u_count;
uniform vec4 u_balls[128];
in vec3 v_direction;
out vec4 o_colour;

float octave(vec3 p) {
  vec3 i = floor(p);
  vec3 f = p - i;
  return textureLod(u_noise, (i + f * f * (3.0 - 2.0 * f) + 0.5) / 64.0, 0.0).r * 2.0 - 1.0;
}

float density(vec3 p) {
  float d = p.y + 8.0 * octave(p / 16.0) + 7.0 * octave(p / 7.0 + 17.0) + 1.5 * octave(p / 3.0 + 31.0);
  // The noise is steep: a third of the density is a distance at most.
  d *= 0.33;
  for (int i = 0; i < u_count; ++i) d = max(d, u_balls[i].w - length(p - u_balls[i].xyz));
  return d;
}

void main() {
  vec3 direction = normalize(v_direction);
  float along = 0.0;
  float d = 1.0;
  for (int i = 0; i < 256 && along < u_reach_m; ++i) {
    d = density(u_eye + direction * along);
    if (d < 0.002 * along + 0.002) break;
    along += d;
  }
  if (along >= u_reach_m) discard;
  vec3 p = u_eye + direction * along;
  vec2 h = vec2(0.1, 0.0);
  vec3 normal = normalize(vec3(density(p + h.xyy) - density(p - h.xyy), density(p + h.yxy) - density(p - h.yxy),
                               density(p + h.yyx) - density(p - h.yyx)));
  o_colour = vec4(vec3(0.2 + 0.8 * max(dot(normal, u_sun), 0.0)), 1.0);
  vec4 clip = u_view_projection * vec4(p, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
}
)GLSL";

tl::unexpected<Error> list_is_full() {
  return fail("the CSG list holds " + std::to_string(csg_list_max) + " carves");
}

class CsgList final : public CsgListMethod {
 public:
  CsgList(std::unique_ptr<ScreenProgram> program, const std::vector<glm::vec4>& balls)
      : program_(std::move(program)), balls_(balls) {
    glGenTextures(1, &noise_);
    std::vector<uint8_t> values(size_t{noise_side} * noise_side * noise_side);
    Random random(1);
    for (uint8_t& value : values) value = static_cast<uint8_t>(random.next() >> 24U);
    glBindTexture(GL_TEXTURE_3D, noise_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, noise_side, noise_side, noise_side, 0, GL_RED, GL_UNSIGNED_BYTE,
                 values.data());
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  }
  ~CsgList() override { glDeleteTextures(1, &noise_); }
  CsgList(const CsgList&) = delete;
  CsgList& operator=(const CsgList&) = delete;

  void changed(const MirrorChanges&) override {}
  void update(const Scene&, const Camera&) override {}
  bool loaded() const override { return true; }
  bool complete() const override { return true; }
  float reach_m() const override { return reach; }
  DrawStats stats() const override { return {}; }
  void draw(const DrawPass& pass) override;
  Result<void> carve(const glm::vec4& ball) override {
    if (balls_.size() == csg_list_max) return list_is_full();
    balls_.push_back(ball);
    return {};
  }

 private:
  std::unique_ptr<ScreenProgram> program_;
  std::vector<glm::vec4> balls_;
  GLuint noise_ = 0;
};

void CsgList::draw(const DrawPass& pass) {
  if (pass.kind == DrawPass::Kind::shadow) return;
  program_->use(pass);
  glUniform1i(program_->uniform("u_count"), static_cast<GLint>(balls_.size()));
  if (!balls_.empty())
    glUniform4fv(program_->uniform("u_balls"), static_cast<GLsizei>(balls_.size()),
                 glm::value_ptr(balls_.front()));
  glUniform1i(program_->uniform("u_noise"), 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_3D, noise_);
  program_->draw();
}

}  // namespace

Result<std::unique_ptr<CsgListMethod>> make_csg_list_method(const std::vector<glm::vec4>& balls) {
  if (balls.size() > csg_list_max) return list_is_full();
  Result<std::unique_ptr<ScreenProgram>> program = ScreenProgram::link("the CSG list", fragment_text);
  if (!program) return fail(program.error().message);
  return std::make_unique<CsgList>(std::move(*program), balls);
}

}  // namespace scree::peers
