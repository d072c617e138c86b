#include "client/viewer/synthesis/wave_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "client/viewer/synthesis/limits.h"

namespace scree {
namespace {

constexpr uint32_t header_bytes = 44;

void put(std::string& bytes, uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
}

std::string length_of(size_t bytes) {
  std::string text;
  put(text, static_cast<uint32_t>(bytes), 4);
  return text;
}

}  // namespace

Result<WaveFile> WaveFile::create(const std::string& path, int rate_hz, int channels) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  const auto rate = static_cast<uint32_t>(rate_hz), sides = static_cast<uint32_t>(channels);
  std::string header = "RIFF" + length_of(header_bytes - 8) + "WAVEfmt " + length_of(16);
  put(header, 1, 2);  // plain samples
  put(header, sides, 2);
  put(header, rate, 4);
  put(header, rate * sides * 2, 4);
  put(header, sides * 2, 2);
  put(header, 16, 2);
  header += "data" + length_of(0);
  out << header;
  out << std::flush;
  if (!out) return fail(path + " cannot be written");
  return WaveFile(std::move(out), path);
}

void WaveFile::append(std::span<const float> samples) {
  const size_t room = (limits::sound_file_bytes_max - bytes_) / 2;
  std::string bytes;
  for (const float sample : samples.first(std::min(samples.size(), room))) {
    const auto step = static_cast<int16_t>(std::lround(std::clamp(sample, -1.0F, 1.0F) * 32767.0F));
    put(bytes, static_cast<uint16_t>(step), 2);
  }
  if (bytes.empty()) return;
  // The samples come first: a header never tells of more than there is.
  out_ << bytes << std::flush;
  bytes_ += bytes.size();
  write_lengths();
}

void WaveFile::write_lengths() {
  out_.seekp(4);
  out_ << length_of(header_bytes - 8 + bytes_);
  out_.seekp(header_bytes - 4);
  out_ << length_of(bytes_) << std::flush;
  out_.seekp(0, std::ios::end);
}

Result<void> WaveFile::finish() {
  out_.close();
  if (!out_) return fail(path_ + " cannot be written");
  return {};
}

}  // namespace scree
