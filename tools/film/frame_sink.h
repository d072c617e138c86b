// Where the frames of a film go. One thread.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "client/render/renderer.h"

namespace scree {

/// Whether the film shall end now, unfinished.
using Stopped = std::function<bool()>;

class FrameSink {
 public:
  /// Before finish(): no half file stays.
  virtual ~FrameSink() = default;

  /// The next frame, of the film's size. An error ends the film, and so does being stopped.
  virtual Result<void> add(const Image& frame) = 0;
  /// After the last frame. When it returns, the film stands where it was ordered.
  virtual Result<void> finish() = 0;
};

/// What a film shall be.
struct FilmFormat {
  std::string file{};  ///< ends in .mp4, .webp or .gif; or a folder for PNGs: ends in /, or is there
  int width = 0;
  int height = 0;
  double frames_per_s = 0.0;
  int quality = 0;      ///< of the encoder, 1 to 100; of .mp4 and .webp
  std::string sound{};  ///< a WAV, which a folder takes; empty: none
};

/// Whether a film of that name can have sound.
bool can_sound(const std::string& file);
/// Refuses a name that says no format.
Result<void> check_film_name(const std::string& file);

/// Begins a film. `stopped` is asked while it waits for the encoder. The error says what is missing.
Result<std::unique_ptr<FrameSink>> open_sink(const FilmFormat& format, Stopped stopped);

}  // namespace scree
