#include "server/store/world_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

#include "server/formats/world_stones.h"
#include "server/store/ground_mass.h"
#include "server/store/limits.h"
#include "server/store/store_fault.h"
#include "server/store/world_copy.h"
#include "server/store/world_reading.h"
#include "server/store/world_schema.h"
#include "server/store/world_upgrade.h"
#include "shared/base/check.h"

namespace scree {

namespace {

using Rows = std::vector<std::vector<uint8_t>>;

/// Refuses what is there already, and the logs of a world that was there: SQLite would write their pages into
/// the new one.
Result<void> check_free(const std::string& path) {
  std::error_code error;
  for (const char* part : {"", "-wal", "-journal"})
    if (std::filesystem::exists(path + part, error))
      return fail(fmt::format("{}{} exists already: choose another name, or move it away", path, part));
  return {};
}

std::string synchronous(bool durable) {
  return durable ? "FULL" : "OFF";
}

std::vector<WorldChunk> chunks_of(const WorldSnapshot& world) {
  std::map<ChunkCoord, WorldChunk> chunks;
  for (const BrickPatch& patch : world.bricks) {
    WorldChunk& chunk = chunks[chunk_of(patch.coord)];
    chunk.chunk = chunk_of(patch.coord);
    chunk.version = world.moment.tick;
    chunk.hash += brick_hash(patch.coord, patch.brick, patch.materials);
    chunk.bricks.push_back(patch);
  }
  std::vector<WorldChunk> list;
  const GroundMasses ground = measured_ground(world.moment.config.terrain, world.bricks);
  for (auto& [coord, chunk] : chunks) {
    chunk.ground_mass = ground.at(coord);
    list.push_back(std::move(chunk));
  }
  return list;
}

}  // namespace

struct WorldFile::State {
  explicit State(Database d) : database(std::move(d)) {}
  Result<void> prepare();
  Result<void> begin_to_save();
  Result<void> bring_up_to_date();              ///< within the transaction of a save
  Result<void> write(const WorldChunk& chunk);  ///< the rows alone, within a transaction
  Result<void> write(const WorldMoment& moment);
  Result<void> write(const std::vector<SettledStone>& all);  ///< what changed of them
  Result<void> put(const Statement& statement, uint64_t key, const std::vector<uint8_t>& data);
  Result<void> put_back();
  Result<WorldStanding> standing();

  Database database;
  Statement put_header, put_moment, put_chunk, put_piece, delete_piece, put_stone, delete_stone, get_chunk;
  std::map<PieceId, bool> pieces;  ///< that have rows, and whether these say that they are kept
  std::set<PieceId> stones;        ///< that have rows
  int64_t format_found = 0;        ///< of the file before the first save
  uint64_t bytes_written = 0;
  bool durable = true;  ///< saves are synced
};

Result<void> WorldFile::State::prepare() {
  const auto prepare = [this](Statement& statement, const std::string& sql) -> Result<void> {
    auto prepared = TRY(database.prepare(sql));
    statement = std::move(prepared);
    return {};
  };
  TRY(prepare(put_header, world_schema::put_into("header")));
  TRY(prepare(put_moment, world_schema::put_into("moment")));
  TRY(prepare(put_chunk, world_schema::put_into("chunks")));
  TRY(prepare(put_piece, world_schema::put_into("pieces")));
  TRY(prepare(put_stone, world_schema::put_into("stones")));
  TRY(prepare(delete_stone, world_schema::delete_from("stones")));
  return prepare(delete_piece, world_schema::delete_from("pieces"));
}

Result<void> WorldFile::State::put(const Statement& statement, uint64_t key,
                                   const std::vector<uint8_t>& data) {
  if (data.size() > limits::row_bytes_max)
    return fail(fmt::format("{}: a row of {} bytes is over the limit of {} (limits.row_bytes_max)",
                            database.path(), data.size(), limits::row_bytes_max));
  bytes_written += data.size();
  return database.put(statement, key, data);
}

Result<void> WorldFile::State::write(const WorldChunk& chunk) {
  return put(put_chunk, world_schema::chunk_key(chunk.chunk), encode(chunk));
}

Result<void> WorldFile::State::write(const std::vector<SettledStone>& all) {
  std::set<PieceId> ended = stones;
  for (const SettledStone& stone : all)
    if (ended.erase(stone.id) == 0) TRY(put(put_stone, stone.id, encode(stone)));
  for (const PieceId id : ended) TRY(database.run(delete_stone, id));
  return {};
}

/// With the pieces and the stones.
Result<void> WorldFile::State::write(const WorldMoment& moment) {
  std::set<PieceId> alive;
  for (const PieceRecord& piece : moment.pieces) {
    alive.insert(piece.id);
    const auto known = pieces.find(piece.id);
    if (known != pieces.end() && known->second == piece.traits.kept) continue;
    TRY(put(put_piece, piece.id, encode(piece)));
  }
  for (const auto& [id, kept] : pieces)
    if (!alive.contains(id)) TRY(database.run(delete_piece, id));
  TRY(write(moment.stones));
  return put(put_moment, 0, encode(moment));
}

bool refused_by_system(const Error& error) {
  return Database::is_refusal(error);
}
bool is_held(const Error& error) {
  return Database::is_held(error);
}
bool may_pass(const Error& error) {
  return Database::may_pass(error);
}

WorldFile::WorldFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
WorldFile::~WorldFile() = default;

Result<std::unique_ptr<WorldFile>> WorldFile::create(const std::string& path, const WorldHeader& header,
                                                     const WorldSnapshot& world, bool durable) {
  const auto each = [&](const PutChunk& put) -> Result<void> {
    for (const WorldChunk& chunk : chunks_of(world)) TRY(put(chunk));
    return {};
  };
  return create(path, header, world.moment, each, durable);
}

Result<std::unique_ptr<WorldFile>> WorldFile::create(const std::string& path, const WorldHeader& header,
                                                     const WorldMoment& moment, const EachChunk& each,
                                                     bool durable) {
  TRY(check_free(path));
  std::error_code error;
  const std::string unfinished = path + "-new";
  std::filesystem::remove(unfinished, error);
  const auto made = [&]() -> Result<void> {
    auto database = TRY(Database::create(unfinished));
    State state(std::move(database));
    Database& file = state.database;
    if (auto done = file.execute(fmt::format("PRAGMA page_size = 4096; PRAGMA synchronous = {}; BEGIN;{}",
                                             synchronous(durable), world_schema::create_tables()));
        !done)
      return done;
    TRY(state.prepare());
    TRY(state.put(state.put_header, 0, encode(header)));
    if (auto done = each([&](const WorldChunk& chunk) { return state.write(chunk); }); !done) return done;
    TRY(state.write(moment));
    return file.execute("COMMIT");
  }();
  if (!made) {
    std::filesystem::remove(unfinished, error);
    return tl::unexpected(made.error());
  }
  std::filesystem::rename(unfinished, path, error);
  if (error) return fail(fmt::format("{} cannot be made: {}", path, error.message()));
  if (durable) sync_folder_of(path);
  auto file = open(path);
  if (file) (*file)->state_->durable = durable;
  return file;
}

Result<std::unique_ptr<WorldFile>> WorldFile::open(const std::string& path) {
  TRY(check_file(path, world_schema::world));
  auto database = TRY(Database::open(path));
  auto state = std::make_unique<State>(std::move(database));
  auto usable = check_format(state->database, world_schema::world);
  if (usable) usable = state->database.execute(world_schema::bound_page_cache(), "cannot be read");
  TRY(usable);
  return std::unique_ptr<WorldFile>(new WorldFile(std::move(state)));
}

Result<WorldRows> WorldFile::read(LostRows* lost) {
  Database& file = state_->database;
  if (lost != nullptr) {
    if (auto whole = check_pages(file); !whole) lost->reasons.push_back(whole.error().message);
    return WorldReading(file, lost).run(true);
  }
  TRY(check_pages(file));
  TRY(file.execute("BEGIN", "cannot be read"));
  auto rows = WorldReading(file, nullptr).run(true);
  TRY(file.execute("COMMIT", "cannot be read"));
  return rows;
}

/// Without SQLite's log a reader would keep the first save out.
Result<void> WorldFile::hold_moment() {
  const auto mode = state_->database.text("PRAGMA journal_mode");
  return mode && *mode == "wal" ? state_->database.execute("BEGIN", "cannot be read") : Result<void>();
}

Result<int64_t> WorldFile::format() {
  const auto format = TRY(state_->database.number("PRAGMA user_version"));
  return format.value_or(0);
}

Result<WorldRows> WorldFile::read_moment(LostRows* lost) {
  Database& file = state_->database;
  if (auto whole = check_pages(file); !whole) {
    if (lost == nullptr) return tl::unexpected(whole.error());
    lost->reasons.push_back(whole.error().message);
  }
  return WorldReading(file, lost).run(false);
}

Result<uint64_t> WorldFile::each_chunk(const std::function<Result<void>(const WorldChunk&)>& visit,
                                       LostRows* lost) {
  WorldReading reading(state_->database, lost);
  TRY(reading.chunks(visit));
  return reading.bytes();
}

Result<std::optional<WorldChunk>> WorldFile::read_chunk(ChunkCoord chunk) {
  State& s = *state_;
  if (s.get_chunk == nullptr) {
    auto prepared = TRY(s.database.prepare(world_schema::one_of("chunks")));
    s.get_chunk = std::move(prepared);
  }
  const uint64_t key = world_schema::chunk_key(chunk);
  const auto row = s.database.get(s.get_chunk, key);
  TRY(row);
  if (!row->has_value()) return std::optional<WorldChunk>();
  auto decoded = chunk_of_row(key, **row);
  if (!decoded)
    return fail(fmt::format("{}: damaged: row {} of its chunks: {}", path(), key, decoded.error().message));
  return std::optional(std::move(*decoded));
}

Result<std::vector<BrickPatch>> WorldFile::read_bricks(ChunkCoord chunk) {
  auto row = TRY(read_chunk(chunk));
  if (!row.has_value()) return fail(path() + " does not have a chunk any more");
  return std::move(row->bricks);
}

/// The copy of an older file, the log, and which pieces the file has, once.
Result<void> WorldFile::State::begin_to_save() {
  if (put_moment != nullptr) return {};
  format_found = TRY(database.number("PRAGMA user_version")).value_or(0);
  if (format_found < world_schema::world.format) TRY(keep_older_world(database.path()));
  const std::string settings =
      fmt::format("PRAGMA journal_mode = WAL; PRAGMA synchronous = {}; PRAGMA wal_autocheckpoint = {};",
                  synchronous(durable), limits::wal_pages_max);
  TRY(database.execute(settings));
  const auto has_row = [this](PieceId id, std::span<const uint8_t> data, bool) -> Result<void> {
    const auto piece = decode_piece_record(data);
    pieces[id] = piece && piece->traits.kept;
    return {};
  };
  TRY(database.each(world_schema::all_of("pieces"), has_row));
  if (!TRY(database.has_table("stones"))) return {};
  const auto has_stone = [this](PieceId id, std::span<const uint8_t>, bool) -> Result<void> {
    stones.insert(id);
    return {};
  };
  return database.each(world_schema::all_of("stones"), has_stone);
}

/// What is written is of the present format. With the rows in one transaction: a crash leaves the old file or
/// the new one.
Result<void> WorldFile::State::bring_up_to_date() {
  if (put_moment != nullptr) return {};
  TRY(database.execute(world_schema::add_stones()));
  if (format_found < world_schema::world.format)
    TRY(database.execute(fmt::format("PRAGMA user_version = {}", world_schema::world.format)));
  return prepare();
}

Result<void> WorldFile::save(const WorldMoment& moment, const std::vector<WorldChunk>& changed) {
  Database& file = state_->database;
  auto saved = state_->begin_to_save();
  if (saved) saved = file.execute("BEGIN IMMEDIATE");
  if (saved) saved = state_->bring_up_to_date();
  for (const WorldChunk& chunk : changed)
    if (saved) saved = state_->write(chunk);
  if (saved) saved = state_->write(moment);
  if (saved) saved = file.execute("COMMIT");
  if (!saved) {
    static_cast<void>(file.execute("ROLLBACK"));  // there may be none, or none any more
    state_->put_moment.reset();                   // begins anew: what was brought up to date is not
    return saved;
  }
  if (file.has_moved())
    return fail(
        fmt::format("{}: {} while the server kept its world there", path(), name_of(StoreFault::moved)));
  state_->pieces.clear();
  for (const PieceRecord& piece : moment.pieces) state_->pieces[piece.id] = piece.traits.kept;
  state_->stones.clear();
  for (const SettledStone& stone : moment.stones) state_->stones.insert(stone.id);
  return {};
}

bool WorldFile::has_moved() const {
  return state_->database.has_moved();
}

/// Its log and what SQLite shares in memory belong to the file that is gone.
Result<void> WorldFile::State::put_back() {
  const std::string& path = database.path();
  std::error_code error;
  if (std::filesystem::exists(path, error))
    return fail(path + " is another file than the one in which the server kept its world: move it away");
  const std::string unfinished = path + "-new";
  std::filesystem::remove(unfinished, error);
  TRY(database.copy_to(unfinished));
  for (const char* end : {"-wal", "-shm"}) std::filesystem::remove(path + end, error);
  std::filesystem::rename(unfinished, path, error);
  if (error) return fail(fmt::format("{} cannot be made: {}", path, error.message()));
  if (durable) sync_folder_of(path);
  return {};
}

Result<std::unique_ptr<WorldFile>> WorldFile::opened_anew() {
  if (state_->database.has_moved()) TRY(state_->put_back());
  auto file = TRY(open(path()));
  file->state_->durable = state_->durable;
  file->state_->bytes_written = bytes_written();
  return file;
}

Result<WorldStanding> WorldFile::State::standing() {
  const auto row_of = [this](const char* table) -> Result<std::vector<uint8_t>> {
    const auto statement = TRY(database.prepare(world_schema::one_of(table)));
    auto row = database.get(statement, 0);
    TRY(row);
    if (!row->has_value()) return fail(fmt::format("{} has no {}", database.path(), table));
    return std::move(**row);
  };
  const auto header_row = TRY(row_of("header"));
  const auto moment_row = TRY(row_of("moment"));
  const auto header = TRY(decode_world_header(header_row));
  const auto moment = TRY(decode_world_moment(moment_row));
  return WorldStanding{header.world, moment.tick};
}

/// A backup that somebody put there has older rows, or another world's.
void WorldFile::follow(std::unique_ptr<WorldFile>& file) {
  if (!file->state_->database.has_moved()) return;
  auto found = open(file->path());
  if (!found) return;
  const auto is = (*found)->state_->standing(), was = file->state_->standing();
  if (!is || (was && (is->world != was->world || is->tick < was->tick))) return;
  file = std::move(*found);
}

Result<void> WorldFile::merge_log() {
  const auto is_held = TRY(state_->database.number("PRAGMA wal_checkpoint(TRUNCATE)"));
  if (is_held.value_or(0) == 0) return {};
  return fail(fmt::format("{}: its log cannot be merged: {}", path(), name_of(StoreFault::held)));
}

uint64_t WorldFile::bytes_written() const {
  return state_->bytes_written;
}
const std::string& WorldFile::path() const {
  return state_->database.path();
}

/// A held moment reads nothing yet; with the first look at the file the moment is fixed.
Result<void> WorldFile::copy_to(const std::string& path, const std::function<bool()>& go_on) {
  Database& file = state_->database;
  if (!go_on) return file.copy_to(path);
  const auto page_bytes = TRY(file.number("PRAGMA page_size"));
  const auto pages = static_cast<int64_t>(limits::copy_part_bytes) / page_bytes.value_or(4096);
  TRY(hold_moment());
  TRY(file.number("SELECT count(*) FROM moment"));
  auto copied = file.copy_to(path, {static_cast<int>(std::max<int64_t>(1, pages)), go_on});
  static_cast<void>(file.execute("COMMIT"));  // there is no transaction where there is no log
  return copied;
}

Result<void> WorldFile::compact() {
  return state_->database.execute("PRAGMA synchronous = FULL; VACUUM");
}

}  // namespace scree
