// An OpenGL context without a window or display: EGL's surfaceless platform, on Mesa's software driver if
// there is no GPU. Current on the thread that made it, until it is destroyed there.
#pragma once

#include <memory>

#include "shared/base/result.h"

namespace scree {

class EglContext {
 public:
  /// OpenGL 3.3 core, else OpenGL ES 3.0. `debug` asks for a context that reports errors.
  static Result<std::unique_ptr<EglContext>> create(bool debug);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

 private:
  EglContext(void* display, void* context) : display_(display), context_(context) {}
  void* display_;
  void* context_;
};

}  // namespace scree
