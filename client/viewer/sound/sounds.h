// The sounds of a session: what its pieces do, to a device, to a file, to both or to none. Main thread only.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/viewer/sound/speaker.h"
#include "client/viewer/synthesis/hearing.h"
#include "client/viewer/synthesis/synthesiser.h"
#include "client/viewer/synthesis/wave_file.h"

namespace scree {

class Sounds {
 public:
  /// `aloud`: by the device, if there is one; `file`: a WAV, empty: none. Fails if that cannot be written.
  static Result<Sounds> begin(bool aloud, const std::string& file);

  /// By the device, if there is one, or not any more.
  void play_aloud(bool on);
  /// Plays the events, the greatest impulse first.
  void step(const std::vector<PieceEvent>& events, const Camera& camera, double now_s);
  /// Whether nobody hears anything: then step() costs nothing.
  bool silent() const { return !speaker_ && !file_; }
  /// The file gets no more.
  Result<void> finish();

 private:
  Sounds() = default;
  void write_until(double now_s);

  std::unique_ptr<Speaker> speaker_;
  std::optional<WaveFile> file_;
  std::unique_ptr<Synthesiser> of_file_;  ///< null: there is none
  std::optional<double> begun_s_;
  size_t written_ = 0;  ///< frames of the file
};

}  // namespace scree
