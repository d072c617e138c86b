#include "content/files/palette_file.h"

#include <filesystem>
#include <fstream>

#include "content/limits.h"
#include "content/palette_text.h"
#include "crypto/sha256.h"
#include "proto/palette_codec.h"
#include "shared/base/regular_file.h"

namespace scree {

namespace {

Result<std::string> read_text(const std::string& path) {
  TRY(check_is_small_file(path, limits::palette_file_bytes_max));
  std::ifstream in(path, std::ios::binary);
  std::string text(limits::palette_file_bytes_max + 1, '\0');
  if (!in) return fail(path + ": it cannot be read");
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) return fail(path + ": it cannot be read");
  text.resize(static_cast<size_t>(in.gcount()));
  return text;
}

}  // namespace

Result<PaletteContent> read_palette_file(const std::string& path) {
  const std::string text = TRY(read_text(path));
  ImageFolder images(std::filesystem::path(path).parent_path());
  Palette palette =
      TRY(read_palette(text, path, [&](const std::string& image) { return images.read(image); }));
  return PaletteContent{std::move(palette), std::move(images).files()};
}

Digest palette_digest(const Palette& palette) {
  return sha256(encode_palette(palette));
}

}  // namespace scree
