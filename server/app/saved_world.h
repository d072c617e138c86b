// A world whose file keeps it: found again at the start, saved while it runs. Without a name the file is a
// temporary one, which has room for terrain that is out of memory, and goes with the server.
#pragma once

#include <memory>
#include <string>

#include "server/store/world_lock.h"
#include "server/store/world_saver.h"
#include "server/world/world.h"
#include "shared/base/log_limit.h"

namespace scree {

class SavedWorld {
 public:
  /// Takes the file for this process; where it exists, reads it, checks it, and makes the world that it
  /// holds. Start and stop are one way with a crash: nothing is read but what was saved. `threads`: of the
  /// world (World::create). `ground` gives the one that the file names. `bricks_max`: edited bricks that it
  /// takes into memory; 0: as memory-max says. `told`: limits of this machine (LiveConfig::machine_limits),
  /// which the caller gives the world in its first tick: the value in the file stays as it was recorded.
  /// `materials`: the palette that the world goes on with; null: its own. Refuses one that is not the same
  /// with other numbers or more rows.
  static Result<std::unique_ptr<SavedWorld>> open(const std::string& path, const WorldConfig& config,
                                                  size_t threads, const GroundGiver& ground,
                                                  size_t bricks_max = 0, const SettingValues& told = {},
                                                  std::shared_ptr<const Palette> materials = nullptr);
  /// A new world in a file that is removed at the end, and after a crash by the next one that is opened.
  static Result<std::unique_ptr<SavedWorld>> open_temporary(const WorldConfig& config, size_t threads);

  /// The world, once: the file's, or a new one of the configuration.
  std::unique_ptr<World> release_world() { return std::move(world_); }
  uint64_t number() const { return number_; }  ///< WelcomeMessage::world
  uint64_t first_session() const { return first_session_; }
  /// No file of it existed when it was opened.
  bool is_new() const { return is_new_; }

  /// Writes a new world's file, and begins to save; once. `world` is the one that was taken, and has not
  /// ticked yet.
  Result<void> start(World& world, SaverConfig config);
  /// After each tick of the world. `pressed`: memory is short until it is saved.
  void note(const TickDelta& delta, World& world, bool pressed = false);
  /// Saves the world as it stands, and ends. What fails is tried again for a while (WorldSaver::finish). A
  /// temporary one is removed.
  Result<void> finish(World& world);
  /// Ends with what was saved: the world does not stand between two ticks.
  void abandon();
  const std::string& path() const { return path_; }
  bool is_temporary() const { return temporary_; }
  ~SavedWorld();
  /// From any thread, after start(), also after the end.
  SaverStatus status() const { return saver_->status(); }
  Durations save_times() const { return saver_->times(); }

 private:
  /// What a server wants of a world that goes on: the arguments of open().
  struct Wanted {
    size_t bricks_max = 0;
    const SettingValues& told;
    std::shared_ptr<const Palette> materials;
  };
  SavedWorld(std::string path, WorldLock lock) : path_(std::move(path)), lock_(std::move(lock)) {}
  static Result<std::unique_ptr<World>> restored(WorldFile& file, size_t threads, const GroundGiver& ground,
                                                 const Wanted& wanted, SavedWorld& saved_world,
                                                 size_t& chunks);
  void complain(const SaverStatus& status);
  void tell_log_left() const;

  std::string path_;
  WorldLock lock_;
  std::unique_ptr<WorldFile> file_;  ///< until start(), of a world that is not new
  std::unique_ptr<World> world_;
  bool is_new_ = false;
  bool temporary_ = false;
  uint64_t number_ = 0;
  uint64_t first_session_ = 1;
  std::unique_ptr<WorldSaver> saver_;
  std::string complaint_;  ///< the last that was logged
  LogLimit log_;
};

}  // namespace scree
