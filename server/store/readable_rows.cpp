#include "server/store/readable_rows.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <system_error>

namespace scree {

namespace {

constexpr uint64_t key_max = (uint64_t{1} << 63U) - 1;  // SQLite's own

/// The key of the first row behind `after` that can be read: found by doubling a step, then by halving.
/// Nothing when there is none.
std::optional<uint64_t> next_readable(Database& database, const std::string& select_from, uint64_t after) {
  std::optional<uint64_t> seen;
  const auto can_be_read = [&](uint64_t from) {
    seen.reset();
    const auto in_order = [&](uint64_t key, auto, bool) -> Result<void> {
      if (key < from) return fail("keys are out of order");
      seen = key;
      return {};
    };
    return database.each(select_from + " LIMIT 1", from, in_order).has_value();
  };
  uint64_t fails = 0, step = 1;
  while (!can_be_read(after + step)) {
    fails = step;
    if (step > (key_max - after) / 2) return std::nullopt;
    step *= 2;
  }
  std::optional<uint64_t> found = seen;
  while (step - fails > 1) {
    const uint64_t middle = fails + (step - fails) / 2;
    const bool readable = can_be_read(after + middle);
    if (readable) found = seen;
    (readable ? step : fails) = middle;
  }
  return found;
}

uint64_t number_at(const std::array<unsigned char, 32>& start, size_t at, size_t bytes) {
  uint64_t number = 0;
  for (size_t i = 0; i < bytes; ++i) number = (number << 8U) | start[at + i];
  return number;
}

/// The file's length by its own header (SQLite file format, 1.3), if it is longer than the file.
void fill_to_its_length(const std::string& path) {
  std::array<unsigned char, 32> start{};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(start.data()), start.size());
  const uint64_t stored = number_at(start, 16, 2);
  const uint64_t page_bytes = stored == 1 ? 65536 : stored;
  if (page_bytes == 0) return;
  std::error_code ignored;
  const uint64_t bytes = std::filesystem::file_size(path, ignored);
  const uint64_t whole = (bytes + page_bytes - 1) / page_bytes * page_bytes;
  constexpr uint64_t filled_bytes_max = uint64_t{1} << 36U;  // a sparse file: it takes no room
  const uint64_t stated = number_at(start, 28, 4) * page_bytes;
  const uint64_t length = stated > whole && stated <= filled_bytes_max ? stated : whole;
  std::filesystem::resize_file(path, length, ignored);
}

}  // namespace

Result<void> each_readable(Database& database, const std::string& select_from,
                           const Database::RowVisitor& visit, const LoseRows& lose) {
  for (uint64_t from = 0;;) {
    std::optional<Error> refused;
    uint64_t next = from;
    const auto read =
        database.each(select_from, from, [&](uint64_t key, auto data, bool whole) -> Result<void> {
          if (key < next) return fail("keys are out of order");  // a damaged page may have any
          next = key + 1;
          auto taken = visit(key, data, whole);
          if (!taken) refused = taken.error();
          return taken;
        });
    if (read) return {};
    if (refused) return tl::unexpected(*refused);
    const auto found = next_readable(database, select_from, next);
    lose(next, found ? *found - 1 : key_max, read.error().message);
    if (!found) return {};
    from = *found;
  }
}

Result<void> copy_for_reading(const std::string& path, const std::string& to) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (const char* end : {"", "-wal"}) {
    if (!fs::exists(path + end, error) && end[0] != '\0') continue;
    if (!fs::copy_file(path + end, to + end, fs::copy_options::overwrite_existing, error))
      return fail(fmt::format("{}{} cannot be copied to {}{}: {}", path, end, to, end, error.message()));
  }
  fill_to_its_length(to);
  return {};
}

}  // namespace scree
