#include "content/files/palette_file.h"

#include <filesystem>

#include "content/limits.h"
#include "content/palette_text.h"
#include "crypto/sha256.h"
#include "proto/palette_codec.h"
#include "shared/base/regular_file.h"

namespace scree {

Result<PaletteContent> read_palette_file(const std::string& path) {
  TRY(check_is_small_file(path, limits::palette_file_bytes_max));
  const Result<std::string> text = read_bytes_of(path, limits::palette_file_bytes_max);
  if (!text) return fail(path + ": " + text.error().message);
  ImageFolder images(std::filesystem::path(path).parent_path());
  Palette palette =
      TRY(read_palette(*text, path, [&](const std::string& image) { return images.read(image); }));
  return PaletteContent{std::move(palette), std::move(images).files()};
}

Digest palette_digest(const Palette& palette) {
  return sha256(encode_palette(palette));
}

}  // namespace scree
