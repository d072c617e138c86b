// Backups that a server makes of its world by itself (--backup-every): whole, checked files in a folder,
// named by the time, of which the newest so many are kept. A thread of low priority copies the world's file
// in parts, as of one moment, and gives way between them, so that neither ticks nor saves wait for it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/store/retry_pause.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

struct BackupPlan {
  double every_s = 0.0;  ///< 0: none are made
  uint32_t keep = 24;
  std::string folder;  ///< empty: default_backup_folder()
};

/// "hill.world.backups", beside the world.
std::string default_backup_folder(const std::string& world_path);

/// The backups of a world in a folder, by the time in their names, "hill-20261130T110000Z.world"; others'
/// files are left alone.
class BackupFolder {
 public:
  BackupFolder(const std::string& world_path, std::string folder);

  struct Backup {
    std::string path;
    uint64_t unix_s = 0;
  };
  /// The oldest first.
  std::vector<Backup> list() const;
  std::string path_at(uint64_t unix_s) const;
  /// Removes all but the newest `keep`. Those that are of later than `now_unix_s` were made before the clock
  /// was set back: they count as the oldest.
  Result<void> keep_newest(size_t keep, uint64_t now_unix_s) const;
  /// What a crash left of one that was being made.
  void remove_unfinished() const;
  const std::string& folder() const { return folder_; }

 private:
  std::string stem_, suffix_, folder_;
};

struct BackupStatus {
  uint64_t made = 0;  ///< since the start
  Tick last_tick = 0;
  uint64_t last_unix_ms = 0;  ///< of the newest that is there, also of an earlier start; 0: none
  StoreHealth health;         ///< why the last try failed
};

class Backups {
 public:
  /// Makes the folder. The first backup is due at once, unless the newest that is there is younger than
  /// plan.every_s.
  static Result<std::unique_ptr<Backups>> start(const std::string& world_path, BackupPlan plan);
  /// Gives up one that is being made.
  ~Backups();
  Backups(const Backups&) = delete;
  Backups& operator=(const Backups&) = delete;

  /// From any thread.
  BackupStatus status() const;

 private:
  struct State;
  explicit Backups(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
