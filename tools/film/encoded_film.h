// A film as one file, encoded by the program ffmpeg: it gets the frames through a socket, and writes a
// partial file, which is renamed when it is whole.
#pragma once

#include <string_view>
#include <vector>

#include "tools/film/frame_sink.h"

namespace scree {

/// A format that ffmpeg writes for us.
struct Encoding {
  std::string_view ending;  ///< of its files' names
  bool has_quality;         ///< FilmFormat::quality says something
  bool even;                ///< its sides are even: colours have half the resolution
  bool has_sound;
  /// ffmpeg's arguments between its input and its output.
  std::vector<std::string> (*arguments)(int quality);
};

/// Null when the name ends like no format's.
const Encoding* encoding_of(std::string_view file);

/// Starts ffmpeg, which is looked for in PATH. The error says how to get it.
Result<std::unique_ptr<FrameSink>> open_encoded_film(const FilmFormat& format, Stopped stopped);

}  // namespace scree
