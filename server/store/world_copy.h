// Copies of a world's file that appear under their name when they are whole, on the disk and checked.
#pragma once

#include <functional>
#include <string>

#include "server/store/world_file.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

/// Which world a file holds, as of which tick.
struct WorldStanding {
  uint64_t world = 0;
  Tick tick = 0;

  bool operator==(const WorldStanding&) const = default;
};

/// How far a file is read: its pages, and the rows of all but the terrain; or every row, with its checksum.
enum class WorldCheck : uint8_t { moment, all_rows };
Result<WorldStanding> check_world(const std::string& path, WorldCheck check,
                                  const std::function<bool()>& go_on = {});

/// Copies the world into the file `to`, which must not exist, by the unfinished name `to`-new. `go_on`: as of
/// WorldFile::copy_to(), also while the copy is checked. After an error nothing is left of it.
Result<WorldStanding> copy_checked(const std::string& from, const std::string& to, WorldCheck check,
                                   const std::function<bool()>& go_on = {});

/// A rename is on the disk when its folder is.
void sync_folder_of(const std::string& path);

}  // namespace scree
