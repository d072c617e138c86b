#include "client/viewer/pictures/png.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <png.h>

#include "client/render/scene/limits.h"

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
    return fail("picture " + file + " cannot be written: " + reason);
  }
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (error) return fail("picture " + file + " cannot be written: " + error.message());
  return {};
}

Result<void> write_frame(const std::string& folder, size_t frame, const Image& image) {
  char name[32];
  std::snprintf(name, sizeof name, "%06zu.png", frame);
  return write_png((std::filesystem::path(folder) / name).string(), image);
}

namespace {

/// The header's reading has begun, or failed to begin.
Result<Image> finish_reading(png_image& header, bool begun) {
  const auto wrong = [&](const std::string& why) {
    png_image_free(&header);
    return fail(why);
  };
  if (!begun) return wrong(header.message);
  if (std::max(header.width, header.height) > static_cast<png_uint_32>(limits::image_side_max))
    return wrong("it has over " + std::to_string(limits::image_side_max) +
                 " pixels a side (limits.image_side_max)");
  header.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  const png_color black{};
  if (png_image_finish_read(&header, &black, image.rgb.data(), 0, nullptr) == 0) return wrong(header.message);
  return image;
}

}  // namespace

Result<Image> read_png(const std::string& file) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  Result<Image> image = finish_reading(header, png_image_begin_read_from_file(&header, file.c_str()) != 0);
  if (!image) return fail("picture " + file + " cannot be read: " + image.error().message);
  return image;
}

Result<Image> decode_png(std::span<const uint8_t> bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  return finish_reading(header, png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) != 0);
}

}  // namespace scree
