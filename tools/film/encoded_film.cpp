#include "tools/film/encoded_film.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <unistd.h>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "tools/film/limits.h"
#include "tools/film/process/child_process.h"

namespace scree {
namespace {

/// Between the encoder's best and a small file: constant rate factor 15 to 40, 20 at a quality of 80.
std::vector<std::string> mp4_arguments(int quality) {
  return {"-vf",
          "scale=out_range=tv:out_color_matrix=bt709,format=yuv420p",
          "-c:v",
          "libx264",
          "-preset",
          "slow",
          "-crf",
          fmt::format("{:.2f}", 40.0 - 0.25 * quality),
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-movflags",
          "+faststart",
          "-f",
          "mp4"};
}

std::vector<std::string> webp_arguments(int quality) {
  return {"-c:v", "libwebp_anim", "-quality", std::to_string(quality), "-compression_level", "6", "-loop",
          "0",    "-f",           "webp"};
}

/// A palette for each frame: one for all would hold every frame in memory.
std::vector<std::string> gif_arguments(int /*quality*/) {
  return {"-filter_complex",
          "[0:v]split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=bayer",
          "-loop",
          "0",
          "-f",
          "gif"};
}

constexpr std::array encodings = {
    Encoding{".mp4", true, true, true, mp4_arguments},
    Encoding{".webp", true, false, false, webp_arguments},
    Encoding{".gif", false, false, false, gif_arguments},
};

/// Each film of the same frames has the same bytes: nothing in it says when or by what it was made.
std::vector<std::string> command_of(const Encoding& encoding, const FilmFormat& format,
                                    const std::string& partial) {
  std::vector<std::string> command = {"ffmpeg",
                                      "-hide_banner",
                                      "-loglevel",
                                      "error",
                                      "-y",
                                      "-f",
                                      "rawvideo",
                                      "-pixel_format",
                                      "rgb24",
                                      "-video_size",
                                      fmt::format("{}x{}", format.width, format.height),
                                      "-framerate",
                                      fmt::format("{}", format.frames_per_s),
                                      "-i",
                                      "pipe:0"};
  if (!format.sound.empty())
    command.insert(command.end(), {"-f", "wav", "-i", "file:" + format.sound, "-c:a", "aac", "-b:a", "192k",
                                   "-flags:a", "+bitexact"});
  command.insert(command.end(), {"-fflags", "+bitexact", "-flags:v", "+bitexact"});
  for (std::string& argument : encoding.arguments(format.quality)) command.push_back(std::move(argument));
  command.push_back("file:" + partial);
  return command;
}

class EncodedFilm final : public FrameSink {
 public:
  EncodedFilm(std::string file, std::string partial, std::unique_ptr<ChildProcess> encoder, Stopped stopped)
      : file_(std::move(file)),
        partial_(std::move(partial)),
        encoder_(std::move(encoder)),
        stopped_(std::move(stopped)) {}
  ~EncodedFilm() override {
    if (encoder_ == nullptr) return;
    encoder_.reset();
    std::error_code gone;
    std::filesystem::remove(partial_, gone);
  }

  Result<void> add(const Image& frame) override {
    std::span<const uint8_t> left(frame.rgb);
    while (!left.empty()) {
      if (stopped_()) return fail("stopped");
      const auto taken = TRY(encoder_->give(left, limits::encoder_pause_ms));
      left = left.subspan(taken);
    }
    return {};
  }

  Result<void> finish() override {
    encoder_->end_input();
    const double until_s = steady_now_s() + limits::encoder_finish_s_max;
    for (;;) {
      const auto ended = TRY(encoder_->wait(limits::encoder_pause_ms));
      if (ended) break;
      if (stopped_()) return fail("stopped");
      if (steady_now_s() > until_s) return fail("ffmpeg does not come to an end");
    }
    std::error_code error;
    std::filesystem::rename(partial_, file_, error);
    if (error) return fail(file_ + " cannot be written: " + error.message());
    encoder_.reset();
    return {};
  }

 private:
  std::string file_;
  std::string partial_;
  std::unique_ptr<ChildProcess> encoder_;  ///< null once the film stands
  Stopped stopped_;
};

}  // namespace

const Encoding* encoding_of(std::string_view file) {
  for (const Encoding& encoding : encodings)
    if (file.ends_with(encoding.ending)) return &encoding;
  return nullptr;
}

Result<std::unique_ptr<FrameSink>> open_encoded_film(const FilmFormat& format, Stopped stopped) {
  const Encoding* encoding = encoding_of(format.file);
  CHECK(encoding != nullptr);
  if (encoding->even && (format.width % 2 != 0 || format.height % 2 != 0))
    return fail(fmt::format("the width and height of a film in {} must be even: {}x{} is not",
                            encoding->ending, format.width, format.height));
  std::string partial = format.file + "." + std::to_string(::getpid()) + ".partial";
  auto encoder = TRY(ChildProcess::start(
      command_of(*encoding, format, partial),
      "which encodes films: install Debian's package of that name (./scree setup does), or write a folder of "
      "PNGs (-o FOLDER/)"));
  return std::make_unique<EncodedFilm>(format.file, std::move(partial), std::move(encoder),
                                       std::move(stopped));
}

}  // namespace scree
