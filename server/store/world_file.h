// A world as a file: its terrain's edits by chunk, its pieces, and the rest of its value
// (server/formats/world_value.h), all of one tick. Each save is one transaction, and on the disk when save()
// returns: whatever crashes, the file holds the last whole one. Every byte read is checked. Nobody but one
// process writes (world_lock.h); others may read meanwhile. One thread at a time.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/formats/world_codec.h"
#include "server/world/world.h"
#include "shared/base/result.h"

namespace scree {

/// What a look at all rows found.
struct WorldRows {
  WorldHeader header;
  WorldSnapshot world;
  std::vector<WorldChunk> chunks;  ///< without their bricks, which are the world's
  GroundMasses ground;             ///< of the chunks
  uint64_t stones_left_out = 0;    ///< rows of stones that are damaged or too many: no error
  std::string stone_left_out;      ///< the first of them, and why
  uint64_t bytes = 0;              ///< of all rows
};

/// Rows that were left out, and why.
struct LostRows {
  std::vector<std::string> reasons;
};

/// Whether a file could not be read for the system's reasons, as on a full disk, where SQLite lacks what it
/// keeps beside the file: the error says nothing of the file itself.
bool refused_by_system(const Error& error);
/// Whether an error says that another program holds the file; whether it may pass by itself, as that does,
/// and a full or failing disk (Database::may_pass).
bool is_held(const Error& error);
bool may_pass(const Error& error);

class WorldFile {
 public:
  /// Makes a file of a world, whose ground is there; an error if the file exists. It appears under its name
  /// when it is whole. Unless it is `durable`, nothing is synced to the disk, now and later: a crash of the
  /// machine may leave anything.
  static Result<std::unique_ptr<WorldFile>> create(const std::string& path, const WorldHeader& header,
                                                   const WorldSnapshot& world, bool durable = true);
  /// The same of a world whose terrain comes chunk by chunk: `each` puts every edited chunk once, its ground
  /// weighed.
  using PutChunk = std::function<Result<void>(const WorldChunk&)>;
  using EachChunk = std::function<Result<void>(const PutChunk& put)>;
  static Result<std::unique_ptr<WorldFile>> create(const std::string& path, const WorldHeader& header,
                                                   const WorldMoment& moment, const EachChunk& each,
                                                   bool durable = true);
  /// Refuses what is no world, and one of another release, by name.
  static Result<std::unique_ptr<WorldFile>> open(const std::string& path);
  ~WorldFile();

  /// All rows, as of one moment; a damaged one is an error that names it, or, when `lost` is given, is left
  /// out and told there: only the header must be whole. Without the moment no piece goes on. Whether they
  /// agree with each other World::restore() says.
  Result<WorldRows> read(LostRows* lost = nullptr);

  /// All that is read from now on is as of one moment, whatever is saved meanwhile, unless nobody has saved
  /// yet; the log beside the file grows until this object is gone. Not for who saves.
  Result<void> hold_moment();
  /// The format of the file: of the program that saved it last.
  Result<int64_t> format();
  /// As read(), but of the terrain nothing: the header, and the world's moment; the bytes are theirs.
  Result<WorldRows> read_moment(LostRows* lost = nullptr);
  /// Calls `visit` for each chunk, its bricks with it, in order of rows; ends at the first error, also one of
  /// `visit`, or a damaged row. Returns the bytes of the rows.
  /// Rows that are lost are told to `lost` instead, if it is not null.
  Result<uint64_t> each_chunk(const std::function<Result<void>(const WorldChunk&)>& visit,
                              LostRows* lost = nullptr);
  /// One chunk as it was saved last; nothing when it has no row. From any thread, if no other uses this file.
  Result<std::optional<WorldChunk>> read_chunk(ChunkCoord chunk);
  /// Its bricks; without a row it is an error.
  Result<std::vector<BrickPatch>> read_bricks(ChunkCoord chunk);

  /// Replaces the chunks and pieces that changed, and the moment, in one transaction, on the disk when this
  /// returns. After an error the file is as it was; where it was moved or removed, that is an error, too. A
  /// file of an older format becomes one of the present in that transaction, and a checked copy of it is kept
  /// before (world_upgrade.h).
  Result<void> save(const WorldMoment& moment, const std::vector<WorldChunk>& changed);
  /// Whether the file is not there any more under its name.
  bool has_moved() const;
  /// The same file opened anew, for another try after an error. Where it was moved or removed, it is put back
  /// under its name as it was saved last; an error if another file has the name meanwhile.
  Result<std::unique_ptr<WorldFile>> opened_anew();
  /// For who reads a file that another object saves: opens the one that was put back. Leaves `file` alone
  /// where there is none, or one of another world or of an earlier tick.
  static void follow(std::unique_ptr<WorldFile>& file);
  /// Merges SQLite's log into the file, which then has all rows by itself. An error, as on a full disk or
  /// while somebody reads as of one moment, leaves both as they are.
  Result<void> merge_log();
  uint64_t bytes_written() const;  ///< in rows, since it was opened

  /// Copies the file, as of one moment, into a new one, which is whole before this returns. `go_on` is
  /// called after every so many bytes (limits::copy_part_bytes), and may wait; false gives the copy up. Who
  /// saves by another object goes on meanwhile.
  Result<void> copy_to(const std::string& path, const std::function<bool()>& go_on = {});
  /// Gives room back that rows left behind.
  Result<void> compact();

  const std::string& path() const;

 private:
  struct State;
  explicit WorldFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
