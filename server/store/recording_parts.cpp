#include "server/store/recording_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>

#include "server/store/limits.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// SQLite's files of a database.
constexpr std::array<std::string_view, 4> ends{"", "-wal", "-shm", "-journal"};

/// The number of the part whose file, or a file beside it, has this name; 0: it is no part.
uint32_t part_of(const fs::path& path, std::string name) {
  for (const std::string_view end : ends)
    if (!end.empty() && name.ends_with(end)) name.resize(name.size() - end.size());
  if (name == path.filename().string()) return 1;
  const std::string before = path.stem().string() + "-", after = path.extension().string();
  if (!name.starts_with(before) || !name.ends_with(after) || name.size() <= before.size() + after.size())
    return 0;
  const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
  uint32_t part = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), part);
  const bool is_number =
      error == std::errc() && end == digits.data() + digits.size() && digits.front() != '0';
  return is_number && part >= 2 && part <= limits::recording_parts_max ? part : 0;
}

std::vector<uint32_t> numbers_of_parts(const fs::path& path) {
  std::vector<uint32_t> parts;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
    if (const uint32_t part = part_of(path, file->path().filename().string()); part != 0)
      parts.push_back(part);
  std::ranges::sort(parts);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

}  // namespace

std::string recording_part(const std::string& path, uint32_t part) {
  if (part == 1) return path;
  const fs::path whole(path);
  return (whole.parent_path() /
          fmt::format("{}-{}{}", whole.stem().string(), part, whole.extension().string()))
      .string();
}

std::vector<std::string> recording_parts(const std::string& path) {
  std::vector<std::string> parts;
  for (const uint32_t part : numbers_of_parts(path)) parts.push_back(recording_part(path, part));
  return parts;
}

Result<std::string> next_recording_part(const std::string& path) {
  const std::vector<uint32_t> parts = numbers_of_parts(path);
  const uint32_t next = parts.empty() ? 1 : parts.back() + 1;
  if (next > limits::recording_parts_max)
    return fail(
        fmt::format("{}: there are {} parts (limits.recording_parts_max): move some away", path, next - 1));
  return recording_part(path, next);
}

void remove_recording(const std::string& path) {
  std::error_code ignored;
  for (const std::string_view end : ends) fs::remove(path + std::string(end), ignored);
}

}  // namespace scree
