// The sound of a film: what the recorded world's pieces do, at the camera's ears. The same recording and
// camera make the same samples.
#pragma once

#include "client/viewer/synthesis/synthesiser.h"
#include "client/viewer/synthesis/wave_file.h"
#include "tools/film/film_order.h"
#include "tools/film/frame_sink.h"
#include "tools/film/recorded_scene.h"

namespace scree {

/// A file that is gone when this is, unless it was moved.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Writes the sound of the whole film, of Synthesiser's rate. `scene` stands at the film's first moment or
/// before it. What happened earlier is not heard. Fails when it is stopped, or the file cannot be written.
Result<void> write_film_sound(const FilmPlan& plan, double frames_per_s, RecordedScene& scene, WaveFile file,
                              const Stopped& stopped);

}  // namespace scree
