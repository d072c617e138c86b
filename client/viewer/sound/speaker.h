// Plays a synthesiser by OpenAL, on a thread of its own, so that slow frames do not make gaps. Thread-safe.
#pragma once

#include <memory>
#include <vector>

#include "client/viewer/sound/synthesiser.h"
#include "shared/base/result.h"

namespace scree {

class Speaker {
 public:
  /// Fails where there is no device, saying so.
  static Result<std::unique_ptr<Speaker>> open();
  ~Speaker();

  void play(const std::vector<PieceEvent>& events, const Ears& ears);

 private:
  struct Parts;
  explicit Speaker(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace scree
