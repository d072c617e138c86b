#include "client/render/raymarch/march_targets.h"

#include <utility>

namespace scree {
namespace {

void set_filter(GLint filter) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

MarchTargets::MarchTargets() {
  resize({1, 1});
  glBindFramebuffer(GL_FRAMEBUFFER, tiles_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, start_.name(), 0);
  const auto attach = [&](const gl::Framebuffer& framebuffer, const gl::Texture& texture) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  };
  attach(marched_, hits_);
  for (const auto& [framebuffer, texture] : {std::pair(&pieces_, &hits_), {&pixels_, &colour_}}) {
    attach(*framebuffer, *texture);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void MarchTargets::resize(glm::ivec2 size) {
  if (size == size_) return;
  size_ = size;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, start_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, tiles().x, tiles().y, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  set_filter(GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, hits_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, size.x, size.y, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
  set_filter(GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, colour_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  set_filter(GL_LINEAR);
  glBindTexture(GL_TEXTURE_2D, depth_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size.x, size.y, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
               nullptr);
  set_filter(GL_NEAREST);
}

void MarchTargets::draw_tiles() const {
  glBindFramebuffer(GL_FRAMEBUFFER, tiles_.name());
  glViewport(0, 0, tiles().x, tiles().y);
}

void MarchTargets::draw_pieces() const {
  glBindFramebuffer(GL_FRAMEBUFFER, pieces_.name());
  glViewport(0, 0, size_.x, size_.y);
}

void MarchTargets::draw_hits() const {
  glBindFramebuffer(GL_FRAMEBUFFER, marched_.name());
  glViewport(0, 0, size_.x, size_.y);
}

void MarchTargets::draw_pixels() const {
  glBindFramebuffer(GL_FRAMEBUFFER, pixels_.name());
  glViewport(0, 0, size_.x, size_.y);
}

size_t MarchTargets::bytes() const {
  const auto area = [](glm::ivec2 s) { return static_cast<size_t>(s.x) * static_cast<size_t>(s.y); };
  return area(size_) * 24 + area(tiles()) * 4;
}

}  // namespace scree
