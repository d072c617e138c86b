#include "client/render/gl/canvas.h"

#include <algorithm>
#include <string>

namespace scree {

Canvas::Canvas(int width, int height, int samples) {
  glBindRenderbuffer(GL_RENDERBUFFER, colour.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width, height);
  glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
}

bool Canvas::complete() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

Result<void> Canvases::prepare(int width, int height, int samples) {
  if (one_ && width_ == width && height_ == height && samples_ == samples) return {};
  many_.reset();
  one_.reset();
  GLint largest = 0, samples_most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  glGetIntegerv(GL_MAX_SAMPLES, &samples_most);
  if (std::max(width, height) > largest)
    return fail("an image of " + std::to_string(width) + "x" + std::to_string(height) +
                " pixels is over this driver's " + std::to_string(largest) + " a side: use a smaller --size");
  width_ = width;
  height_ = height;
  samples_ = samples;
  if (samples > 0) many_.emplace(width, height, std::min(samples, samples_most));
  one_.emplace(width, height, 0);
  if ((!many_ || many_->complete()) && one_->complete()) return {};
  many_.reset();
  one_.reset();
  return fail("the driver refuses a framebuffer of " + std::to_string(width) + "x" + std::to_string(height) +
              " pixels: use a smaller --size");
}

void Canvases::average() const {
  if (many_) copy_picture(drawn(), width_, height_, one(), width_, height_);
}

void copy_picture(unsigned from, int from_width, int from_height, unsigned to, int width, int height) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  const bool same = from_width == width && from_height == height;
  glBlitFramebuffer(0, 0, from_width, from_height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                    same ? GL_NEAREST : GL_LINEAR);
}

}  // namespace scree
