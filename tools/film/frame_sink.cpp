#include "tools/film/frame_sink.h"

#include <filesystem>

#include "tools/film/encoded_film.h"
#include "tools/film/picture_folder.h"

namespace scree {
namespace {

bool is_folder(const std::string& file) {
  return file.ends_with('/');
}

}  // namespace

bool can_sound(const std::string& file) {
  const Encoding* const encoding = encoding_of(file);
  return encoding == nullptr || encoding->has_sound;
}

Result<void> check_film_name(const std::string& file) {
  std::error_code unknown;
  if (!is_folder(file) && std::filesystem::is_directory(file, unknown))
    return fail("'" + file + "' is a folder: write " + file + "/ for a film of PNGs in it");
  if (is_folder(file) || encoding_of(file) != nullptr) return {};
  return fail("'" + file +
              "' is not a film: the name must end in .mp4, .webp or .gif, or in / for a folder of PNGs");
}

Result<std::unique_ptr<FrameSink>> open_sink(const FilmFormat& format, Stopped stopped) {
  if (is_folder(format.file)) return open_picture_folder(format.file, format.sound);
  return open_encoded_film(format, std::move(stopped));
}

}  // namespace scree
