#include "client/viewer/png.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <png.h>

namespace scree {

Result<void> write_png(const std::string& file, const Image& image) {
  const std::string partial = file + ".partial";
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  errno = 0;
  if (png_image_write_to_file(&header, partial.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
    const std::string reason = errno != 0 ? std::strerror(errno) : header.message;
    return fail("screenshot " + file + " cannot be written: " + reason);
  }
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (error) return fail("screenshot " + file + " cannot be written: " + error.message());
  return {};
}

}  // namespace scree
