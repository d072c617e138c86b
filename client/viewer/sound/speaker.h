// Plays a synthesiser by OpenAL, on a thread of its own, so that slow frames do not make gaps. Thread-safe.
#pragma once

#include <memory>
#include <span>

#include "client/viewer/synthesis/sound_event.h"
#include "shared/base/result.h"

namespace scree {

class Speaker {
 public:
  /// Before other threads begin, for it sets variables of the environment: where there is no card, ALSA says
  /// so in ten lines on the standard error, and OpenAL in one. A person's own choice stays.
  static void silence_library_log();
  /// Fails where there is no device, saying so.
  static Result<std::unique_ptr<Speaker>> open();
  ~Speaker();

  void play(std::span<const SoundEvent> events);

 private:
  struct Parts;
  explicit Speaker(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace scree
