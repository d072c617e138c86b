// The sounds of a session: what its pieces do, to a device, to a file, to both or to none. Main thread only.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/render/scene/camera.h"
#include "client/viewer/sound/speaker.h"
#include "client/viewer/sound/synthesiser.h"
#include "client/viewer/sound/wave_file.h"

namespace scree {

class Sounds {
 public:
  /// `aloud`: by the device, if there is one; `file`: a WAV, empty: none. Fails if that cannot be written.
  static Result<Sounds> begin(bool aloud, const std::string& file);

  /// Plays the events, the greatest impulse first; the first limits::sounds_per_step_max are heard.
  void step(std::vector<PieceEvent> events, const Camera& camera, double now_s);
  /// Whether nobody hears anything: then step() costs nothing.
  bool silent() const { return !speaker_ && !file_; }
  /// The file is whole.
  Result<void> finish();

 private:
  Sounds() = default;

  std::unique_ptr<Speaker> speaker_;
  std::optional<WaveFile> file_;
  Synthesiser of_file_;
  std::optional<double> begun_s_;
  size_t written_ = 0;  ///< frames of the file
};

}  // namespace scree
