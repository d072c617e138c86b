// Paints signs into pictures that are drawn without a window: screenshots and films. Threads: one at a time.
#pragma once

#include <memory>

#include "client/render/image.h"
#include "client/viewer/signs/sign_drawing.h"

namespace scree {

class SignPainter {
 public:
  SignPainter();
  ~SignPainter();
  SignPainter(SignPainter&&) noexcept;
  SignPainter& operator=(SignPainter&&) noexcept;

  /// Over the picture, with letters whose height follows from its own. Where there is no sign, no byte of it
  /// changes.
  void paint(Image& image, const std::vector<Sign>& signs, const SignMoment& moment, const Camera& camera);

 private:
  struct Letters;
  const Letters& letters_of(int height_px);

  std::unique_ptr<Letters> letters_;  ///< null: none were needed yet
};

}  // namespace scree
