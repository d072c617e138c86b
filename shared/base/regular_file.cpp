#include "shared/base/regular_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace scree {

namespace {

/// A large limit is not to cost the memory of a large file.
constexpr size_t read_at_first_bytes = size_t{64} << 10U;

const char* words_on(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory:
      return "it is a folder, not a file";
    case std::filesystem::file_type::fifo:
      return "it is a pipe, not a file";
    case std::filesystem::file_type::socket:
      return "it is a socket, not a file";
    case std::filesystem::file_type::not_found:
      return "there is no such file";
    default:
      return "it is a device, not a file";
  }
}

}  // namespace

Result<void> check_is_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error && status.type() == std::filesystem::file_type::none) return fail("it cannot be reached");
  if (status.type() == std::filesystem::file_type::regular) return {};
  return fail(words_on(status.type()));
}

Result<void> check_is_small_file(const std::string& path, size_t bytes_max) {
  if (const auto checked = check_is_file(path); !checked) return fail(path + ": " + checked.error().message);
  std::error_code error;
  if (const auto bytes = std::filesystem::file_size(path, error); !error && bytes > bytes_max)
    return fail(path + ": a file of " + std::to_string(bytes >> 10U) +
                " KiB is not what is wanted here, at most " + std::to_string(bytes_max >> 10U) + " KiB");
  return {};
}

Result<std::string> read_bytes_of(const std::string& path, size_t bytes_max) {
  TRY(check_is_file(path));
  std::ifstream in(path, std::ios::binary);
  if (!in) return fail("it cannot be read");
  std::string bytes;
  while (in && bytes.size() <= bytes_max) {
    const size_t had = bytes.size();
    bytes.resize(std::min(bytes_max + 1, std::max(2 * had, read_at_first_bytes)));
    in.read(bytes.data() + had, static_cast<std::streamsize>(bytes.size() - had));
    if (in.bad()) return fail("it cannot be read");
    bytes.resize(had + static_cast<size_t>(in.gcount()));
  }
  bytes.shrink_to_fit();
  return bytes;
}

Result<void> check_no_device(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error) || error) return {};
  if (const auto checked = check_is_file(path); !checked) return fail(path + ": " + checked.error().message);
  return {};
}

}  // namespace scree
