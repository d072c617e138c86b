#include "server/store/world_copy.h"

#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace scree {

namespace {

/// Within a part of so many chunks nobody else has a turn: about limits::copy_part_bytes.
constexpr uint64_t chunks_a_part = 64;

Result<WorldStanding> check_rows_of(WorldFile& file, WorldCheck check, const std::function<bool()>& go_on) {
  const auto rows = TRY(file.read_moment());
  const WorldStanding standing{rows.header.world, rows.world.moment.tick};
  if (check == WorldCheck::moment) return standing;
  uint64_t chunks = 0;
  const auto visit = [&](const WorldChunk&) -> Result<void> {
    if (++chunks % chunks_a_part == 0 && go_on && !go_on())
      return fail(file.path() + ": the check was given up");
    return {};
  };
  TRY(file.each_chunk(visit));
  return standing;
}

/// With what SQLite keeps beside it.
void remove_with_logs(const std::string& path) {
  std::error_code ignored;
  for (const char* part : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(path + part, ignored);
}

}  // namespace

void sync_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  close(file);
}

Result<WorldStanding> check_world(const std::string& path, WorldCheck check,
                                  const std::function<bool()>& go_on) {
  const auto file = TRY(WorldFile::open(path));
  return check_rows_of(*file, check, go_on);
}

Result<WorldStanding> copy_checked(const std::string& from, const std::string& to, WorldCheck check,
                                   const std::function<bool()>& go_on) {
  std::error_code error;
  if (std::filesystem::exists(to, error)) return fail(to + " exists already");
  const std::string unfinished = to + "-new";
  remove_with_logs(unfinished);
  const auto copied = [&]() -> Result<WorldStanding> {
    const auto file = TRY(WorldFile::open(from));
    TRY(file->copy_to(unfinished, go_on));
    const auto checked = TRY(WorldFile::open(unfinished));
    return check_rows_of(*checked, check, go_on);
  }();
  if (copied) std::filesystem::rename(unfinished, to, error);
  remove_with_logs(unfinished);
  TRY(copied);
  if (error) return fail(fmt::format("{} cannot be made: {}", to, error.message()));
  sync_folder_of(to);
  return *copied;
}

}  // namespace scree
