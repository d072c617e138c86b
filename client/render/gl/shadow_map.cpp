#include "client/render/gl/shadow_map.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace scree {
namespace {

/// Half the side of the square, metres: debris needs texels of some centimetres.
constexpr float reach_max_m = 48.0F;
/// Towards the sun and away from it: cliffs outside of the square cast shadows into it.
constexpr float depth_m = 120.0F;

}  // namespace

ShadowMap::ShadowMap(int side) : side_(side) {
  glBindTexture(GL_TEXTURE_2D, depth_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, side, side, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  const GLenum none = GL_NONE;
  glDrawBuffers(1, &none);
  glReadBuffer(GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

glm::mat4 ShadowMap::begin(const Camera& camera, glm::vec3 sun, float view_radius_m) {
  const float reach_m = std::min(reach_max_m, view_radius_m);
  const glm::vec3 focus = camera.eye_m + camera.forward() * (reach_m * 0.7F);
  const glm::mat4 turn = glm::lookAt(glm::vec3(0.0F), -sun, glm::vec3(0.0F, 0.0F, 1.0F));
  // Whole texels only: otherwise edges crawl as the camera moves.
  const float texel_m = 2.0F * reach_m / static_cast<float>(side_);
  glm::vec3 centre = glm::vec3(turn * glm::vec4(focus, 1.0F));
  centre = glm::floor(centre / texel_m) * texel_m;
  const glm::mat4 box = glm::ortho(centre.x - reach_m, centre.x + reach_m, centre.y - reach_m,
                                   centre.y + reach_m, -centre.z - depth_m, -centre.z + depth_m);
  const glm::mat4 view_projection = box * turn;
  matrix_ = glm::translate(glm::mat4(1.0F), glm::vec3(0.5F)) * glm::scale(glm::mat4(1.0F), glm::vec3(0.5F)) *
            view_projection;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, side_, side_);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5F, 2.0F);
  return view_projection;
}

void ShadowMap::end() const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace scree
