#include "content/files/image_folder.h"

#include <algorithm>

#include "content/files/png_pixels.h"
#include "content/limits.h"
#include "crypto/sha256.h"
#include "shared/base/regular_file.h"
#include "shared/base/text.h"
#include "shared/material/material_image.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

bool leads_out(const fs::path& path) {
  return path.has_root_path() || std::ranges::find(path, fs::path("..")) != path.end();
}

/// Whether a file lies in the folder when all links are followed.
bool is_within(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path home = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path place = fs::canonical(file, error);
  if (error) return false;
  return std::ranges::mismatch(home, place).in1 == home.end();
}

}  // namespace

Result<Digest> ImageFolder::read(const std::string& path) {
  if (path.empty() || path.size() > limits::image_path_bytes_max)
    return fail("the path of an image has 1 to " + std::to_string(limits::image_path_bytes_max) + " bytes");
  if (const auto fault = fault_of_text(path)) return fail("the path of an image " + std::string(*fault));
  if (leads_out(path)) return fail(path + ": images lie in the folder of the palette's file, or below it");
  const fs::path file = folder_ / path;
  const auto say = [&](const Error& error) { return fail(path + ": " + error.message); };
  if (const auto checked = check_is_file(file.string()); !checked) return say(checked.error());
  if (!is_within(folder_, file)) return fail(path + ": it is a link that leads out of the palette's folder");
  const Result<std::string> read = read_bytes_of(file.string(), limits::image_bytes_max);
  if (!read) return say(read.error());
  std::vector<uint8_t> bytes(read->begin(), read->end());
  if (const auto checked = check_image(bytes); !checked) return say(checked.error());
  const Digest digest = sha256(bytes);
  if (files_.contains(digest)) return digest;
  if (const auto checked = check_pixels(bytes); !checked) return say(checked.error());
  if (bytes_ + bytes.size() > limits::palette_images_bytes_max)
    return fail(path + ": with it, the palette's images are over the limit of " +
                std::to_string(limits::palette_images_bytes_max >> 20U) + " MiB in all");
  bytes_ += bytes.size();
  files_.emplace(digest, std::move(bytes));
  return digest;
}

}  // namespace scree
