// A WAV file of 16-bit samples that grows. It is whole after every append(), whatever ends the program then.
// Within one, the header tells of the samples before.
#pragma once

#include <fstream>
#include <span>
#include <string>

#include "shared/base/result.h"

namespace scree {

class WaveFile {
 public:
  /// Fails if the file cannot be written.
  static Result<WaveFile> create(const std::string& path, int rate_hz, int channels);

  /// Samples from −1 to 1, the channels in turn. Beyond limits::sound_file_bytes_max they are left out.
  void append(std::span<const float> samples);
  /// There are no more. Fails if anything could not be written.
  Result<void> finish();

 private:
  WaveFile(std::ofstream out, std::string path) : out_(std::move(out)), path_(std::move(path)) {}
  void write_lengths();

  std::ofstream out_;
  std::string path_;
  size_t bytes_ = 0;  ///< of samples
};

}  // namespace scree
