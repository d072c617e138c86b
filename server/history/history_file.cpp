#include "server/history/history_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <random>

#include "proto/operation_codec.h"
#include "server/history/owner_file.h"
#include "server/log/log.h"
#include "server/store/database.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// "SCRH" distinguishes a history from other SQLite files.
constexpr int64_t history_application_id = 0x53435248;
constexpr int64_t history_format = 1;
constexpr size_t address_key_bytes = 16;

/// Rows of `facts`.
enum Fact : uint8_t { world_fact = 0, address_fact = 1, known_since_fact = 2 };

/// As SQLite keeps them: a file that has others is none of ours, and its SQL would run.
constexpr std::array<std::string_view, 6> history_tables{
    "CREATE TABLE facts (key INTEGER PRIMARY KEY, data BLOB NOT NULL, checksum INTEGER NOT NULL)",
    "CREATE TABLE authors (key INTEGER PRIMARY KEY, party INTEGER, token INTEGER, address INTEGER, since "
    "INTEGER, "
    "data BLOB NOT NULL, checksum INTEGER NOT NULL)",
    "CREATE TABLE edits (key INTEGER PRIMARY KEY, tick INTEGER, author INTEGER, kind INTEGER, lo INTEGER, hi "
    "INTEGER, bricks INTEGER, pieces INTEGER)",
    "CREATE TABLE images (key INTEGER PRIMARY KEY, brick INTEGER, first INTEGER, last INTEGER, author "
    "INTEGER, "
    "after INTEGER, data BLOB NOT NULL, checksum INTEGER NOT NULL)",
    "CREATE TABLE pieces (key INTEGER PRIMARY KEY, author INTEGER, made INTEGER)",
    "CREATE INDEX images_by_brick ON images (brick, key)",
};

/// 21 bits a coordinate, as chunks of worlds have (world_schema.h).
constexpr int64_t key_half = int64_t{1} << 20;
int64_t key_of(BrickCoord brick) {
  const auto part = [](int32_t c) {
    CHECK(c >= -key_half && c < key_half);
    return static_cast<int64_t>(c) + key_half;
  };
  return (part(brick.x) << 42U) | (part(brick.y) << 21U) | part(brick.z);
}
BrickCoord brick_of_key(int64_t key) {
  constexpr int64_t mask = (int64_t{1} << 21U) - 1;
  const auto part = [&](unsigned shift) { return static_cast<int32_t>(((key >> shift) & mask) - key_half); };
  return {part(42), part(21), part(0)};
}

int64_t sql(uint64_t number) {
  return static_cast<int64_t>(number);
}
uint64_t from_sql(int64_t number) {
  return static_cast<uint64_t>(number);
}

ImageRow image_of(std::span<const int64_t> columns) {
  return {.key = columns[0],
          .brick = brick_of_key(columns[1]),
          .first = from_sql(columns[2]),
          .last = from_sql(columns[3]),
          .author = from_sql(columns[4]),
          .after = from_sql(columns[5])};
}
constexpr const char* image_columns = "key, brick, first, last, author, after";

std::vector<uint8_t> bytes_of_number(uint64_t number) {
  std::vector<uint8_t> bytes;
  for (unsigned i = 0; i < 8; ++i) bytes.push_back(static_cast<uint8_t>(number >> (8U * i)));
  return bytes;
}
uint64_t number_of_bytes(std::span<const uint8_t> bytes) {
  uint64_t number = 0;
  for (size_t i = 0; i < bytes.size() && i < 8; ++i) number |= uint64_t{bytes[i]} << (8U * i);
  return number;
}

/// A world that was under this name before has left its history: that gets another name.
Result<void> put_aside(const std::string& path) {
  const std::string old = path + ".old";
  std::error_code error;
  for (const char* log : {"-wal", "-shm"}) std::filesystem::remove(path + log, error);
  std::filesystem::rename(path, old, error);
  if (error)
    return fail(path + " is the history of another world, and cannot be moved away: " + error.message());
  log_of(LogPart::store).warn("{} was the history of another world: it is {} now", path, old);
  return {};
}

std::vector<uint8_t> random_key() {
  std::random_device random;
  std::vector<uint8_t> key;
  while (key.size() < address_key_bytes) key.push_back(static_cast<uint8_t>(random()));
  return key;
}

}  // namespace

struct HistoryFile::State {
  explicit State(Database opened) : database(std::move(opened)) {}

  Result<void> make(uint64_t world);
  Result<void> check(uint64_t world);
  Result<void> prepare(Tick tick);
  Result<std::optional<std::vector<uint8_t>>> fact(Fact which);
  Result<void> set_fact(Fact which, std::span<const uint8_t> data);

  Database database;
  Statement get_fact, put_fact, put_author, put_edit, put_image, extend_image, put_piece, drop_piece,
      extend_edit, get_image;
  std::optional<std::pair<int64_t, EditRow>> last_undo;  ///< its line, which grows, and the line's key
  std::vector<uint8_t> address_key;
  int64_t next_image = 1;
  bool is_of_world = true;
};

HistoryFile::HistoryFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
HistoryFile::~HistoryFile() = default;

Result<std::optional<std::vector<uint8_t>>> HistoryFile::State::fact(Fact which) {
  return database.get(get_fact, which);
}
Result<void> HistoryFile::State::set_fact(Fact which, std::span<const uint8_t> data) {
  return database.put(put_fact, which, data);
}

Result<void> HistoryFile::State::make(uint64_t world) {
  std::string all = fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; BEGIN;",
                                history_application_id, history_format);
  for (const std::string_view table : history_tables) all += fmt::format("{};", table);
  TRY(database.execute(all));
  put_fact = TRY(database.prepare("REPLACE INTO facts VALUES (?1, ?2, ?3)"));
  TRY(set_fact(world_fact, bytes_of_number(world)));
  TRY(set_fact(address_fact, random_key()));
  return database.execute("COMMIT");
}

Result<void> HistoryFile::State::check(uint64_t world) {
  const std::string way_out = ": move it away, and a new history begins";
  if (TRY(database.number("PRAGMA application_id")).value_or(0) != history_application_id)
    return fail(database.path() + " is no history of a world" + way_out);
  if (TRY(database.number("PRAGMA user_version")).value_or(0) != history_format)
    return fail(database.path() + " is a history of another release" + way_out);
  std::vector<std::string> found;
  TRY(database.each_text("SELECT sql FROM sqlite_master WHERE sql IS NOT NULL",
                         [&](std::span<const std::string> columns) -> Result<void> {
                           found.push_back(columns[0]);
                           return {};
                         }));
  std::vector<std::string> wanted(history_tables.begin(), history_tables.end());
  std::ranges::sort(found);
  std::ranges::sort(wanted);
  if (found != wanted) return fail(database.path() + " holds other tables than a history" + way_out);
  get_fact = TRY(database.prepare("SELECT data, checksum FROM facts WHERE key = ?1"));
  is_of_world = false;
  if (const auto of = TRY(fact(world_fact))) is_of_world = number_of_bytes(*of) == world;
  return {};
}

Result<void> HistoryFile::State::prepare(Tick tick) {
  TRY(database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA cache_size = -4096"));
  get_fact = TRY(database.prepare("SELECT data, checksum FROM facts WHERE key = ?1"));
  put_fact = TRY(database.prepare("REPLACE INTO facts VALUES (?1, ?2, ?3)"));
  put_author = TRY(database.prepare("REPLACE INTO authors VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)"));
  put_edit = TRY(database.prepare("INSERT INTO edits VALUES (NULL, ?1, ?2, ?3, ?4, ?5, ?6, ?7)"));
  extend_edit =
      TRY(database.prepare("UPDATE edits SET lo = ?2, hi = ?3, bricks = ?4, pieces = ?5 WHERE key = ?1"));
  put_image = TRY(database.prepare("INSERT INTO images VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)"));
  extend_image = TRY(database.prepare("UPDATE images SET last = ?2, after = ?3 WHERE key = ?1"));
  put_piece = TRY(database.prepare("REPLACE INTO pieces VALUES (?1, ?2, ?3)"));
  drop_piece = TRY(database.prepare("DELETE FROM pieces WHERE key = ?1"));
  get_image = TRY(database.prepare("SELECT data, checksum FROM images WHERE key = ?1"));
  const int64_t at = sql(tick);
  TRY(database.execute(
      fmt::format("BEGIN; DELETE FROM edits WHERE tick > {0}; DELETE FROM images WHERE first > "
                  "{0}; UPDATE images SET last = {0}, after = 0 WHERE last > {0}; DELETE FROM "
                  "pieces WHERE made > {0}; COMMIT",
                  at)));
  const auto key = TRY(fact(address_fact));
  if (!key || key->size() != address_key_bytes)
    return fail(database.path() + " is damaged: it lacks its key");
  address_key = *key;
  next_image = TRY(database.number("SELECT max(key) FROM images")).value_or(0) + 1;
  return {};
}

Result<std::unique_ptr<HistoryFile>> HistoryFile::open(const std::string& path, uint64_t world, Tick tick) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    static_cast<void>(let_owner_alone_read(path));  // of an older release; it may be another user's
    auto state = std::make_unique<State>(TRY(Database::open(path)));
    TRY(state->check(world));
    if (state->is_of_world) {
      TRY(state->prepare(tick));
      return std::unique_ptr<HistoryFile>(new HistoryFile(std::move(state)));
    }
    state.reset();
    TRY(put_aside(path));
  }
  auto state = std::make_unique<State>(TRY(Database::create(path)));
  TRY(let_owner_alone_read(path));
  TRY(state->make(world));
  TRY(state->prepare(tick));
  return std::unique_ptr<HistoryFile>(new HistoryFile(std::move(state)));
}

const std::vector<uint8_t>& HistoryFile::address_key() const {
  return state_->address_key;
}

Result<void> HistoryFile::begin() {
  return state_->database.execute("BEGIN");
}
Result<void> HistoryFile::commit() {
  return state_->database.execute("COMMIT");
}
void HistoryFile::roll_back() {
  state_->last_undo.reset();  // its line may be gone
  static_cast<void>(state_->database.execute("ROLLBACK"));
}

Result<void> HistoryFile::put(const Author& author) {
  const std::array<int64_t, 5> columns{sql(author.id), sql(author.party), sql(author.token_id),
                                       sql(author.address), sql(author.since)};
  const auto* const name = reinterpret_cast<const uint8_t*>(author.name.data());
  return state_->database.put(state_->put_author, columns, {name, author.name.size()});
}

Result<void> HistoryFile::put(const EditRow& edit) {
  auto& last = state_->last_undo;
  if (is_undo(edit.author) && last && last->second.author == edit.author) {
    const EditRow all = together(last->second, edit);
    const std::array<int64_t, 5> columns{last->first, key_of(all.lo), key_of(all.hi), all.bricks, all.pieces};
    TRY(state_->database.run(state_->extend_edit, columns));
    last->second = all;
    return {};
  }
  const std::array<int64_t, 7> columns{sql(edit.tick),  sql(edit.author), edit.kind,  key_of(edit.lo),
                                       key_of(edit.hi), edit.bricks,      edit.pieces};
  TRY(state_->database.run(state_->put_edit, columns));
  if (!is_undo(edit.author)) return {};
  if (const auto key = TRY(state_->database.number("SELECT last_insert_rowid()"))) last = {*key, edit};
  return {};
}

Result<int64_t> HistoryFile::put(const ImageRow& image, const BrickPatch& was) {
  const int64_t key = state_->next_image++;
  const std::array<int64_t, 6> columns{
      key, key_of(image.brick), sql(image.first), sql(image.last), sql(image.author), sql(image.after)};
  TRY(state_->database.put(state_->put_image, columns, encode_bricks(std::span(&was, 1))));
  return key;
}

Result<void> HistoryFile::extend(const ImageRow& image) {
  const std::array<int64_t, 3> columns{image.key, sql(image.last), sql(image.after)};
  return state_->database.run(state_->extend_image, columns);
}

Result<void> HistoryFile::put_piece(PieceId piece, AuthorId author, Tick made) {
  const std::array<int64_t, 3> columns{piece, sql(author), sql(made)};
  return state_->database.run(state_->put_piece, columns);
}

Result<void> HistoryFile::remove_piece(PieceId piece) {
  return state_->database.run(state_->drop_piece, uint64_t{piece});
}

Result<std::vector<Author>> HistoryFile::authors() {
  std::vector<Author> found;
  TRY(state_->database.each_number(
      "SELECT key, party, token, address, since FROM authors ORDER BY key",
      [&](std::span<const int64_t> c) -> Result<void> {
        found.push_back({from_sql(c[0]), from_sql(c[1]), from_sql(c[2]), from_sql(c[3]), from_sql(c[4]), {}});
        return {};
      }));
  size_t next = 0;
  TRY(state_->database.each("SELECT key, data, checksum FROM authors ORDER BY key",
                            [&](uint64_t, std::span<const uint8_t> data, bool whole) -> Result<void> {
                              if (whole && next < found.size())
                                found[next].name.assign(data.begin(), data.end());
                              ++next;
                              return {};
                            }));
  return found;
}

Result<std::vector<HistoryFile::PieceMaker>> HistoryFile::pieces() {
  std::vector<PieceMaker> found;
  TRY(state_->database.each_number(
      "SELECT key, author, made FROM pieces ORDER BY key", [&](std::span<const int64_t> c) -> Result<void> {
        found.push_back({static_cast<PieceId>(c[0]), from_sql(c[1]), from_sql(c[2])});
        return {};
      }));
  return found;
}

Result<std::optional<ImageRow>> HistoryFile::last_of(BrickCoord brick) {
  std::optional<ImageRow> found;
  TRY(state_->database.each_number(
      fmt::format("SELECT {} FROM images WHERE brick = {} ORDER BY key DESC LIMIT 1", image_columns,
                  key_of(brick)),
      [&](std::span<const int64_t> columns) -> Result<void> {
        found = image_of(columns);
        return {};
      }));
  return found;
}

Result<std::vector<ImageRow>> HistoryFile::runs_of(BrickCoord brick, Tick since) {
  std::vector<ImageRow> found;
  TRY(state_->database.each_number(
      fmt::format("SELECT {} FROM images WHERE brick = {} AND last >= {} ORDER BY key", image_columns,
                  key_of(brick), sql(since)),
      [&](std::span<const int64_t> columns) -> Result<void> {
        found.push_back(image_of(columns));
        return {};
      }));
  return found;
}

Result<std::vector<BrickCoord>> HistoryFile::bricks_of(const std::vector<AuthorId>& authors, Tick since) {
  std::vector<int64_t> ids;
  for (const AuthorId author : authors) ids.push_back(sql(author));
  const std::string by =
      ids.empty() ? std::string() : fmt::format(" AND author IN ({})", fmt::join(ids, ","));
  std::vector<BrickCoord> found;
  TRY(state_->database.each_number(
      fmt::format("SELECT DISTINCT brick FROM images WHERE last >= {}{}", sql(since), by),
      [&](std::span<const int64_t> columns) -> Result<void> {
        found.push_back(brick_of_key(columns[0]));
        return {};
      }));
  return found;
}

Result<BrickPatch> HistoryFile::before(const ImageRow& image) {
  const auto data = TRY(state_->database.get(state_->get_image, from_sql(image.key)));
  if (!data) return fail("the history has forgotten a brick meanwhile");
  auto bricks = TRY(decode_bricks(*data, 1));
  if (bricks.size() != 1 || bricks.front().coord != image.brick)
    return fail(state_->database.path() + " is damaged: a brick is not the one that it says");
  return std::move(bricks.front());
}

Result<std::vector<EditRow>> HistoryFile::edits(const std::function<bool(const EditRow&)>& wanted,
                                                size_t most) {
  std::vector<EditRow> found;
  const Error enough{"enough"};
  const auto done = state_->database.each_number(
      "SELECT tick, author, kind, lo, hi, bricks, pieces FROM edits ORDER BY key DESC",
      [&](std::span<const int64_t> c) -> Result<void> {
        const EditRow edit{.tick = from_sql(c[0]),
                           .author = from_sql(c[1]),
                           .kind = static_cast<uint8_t>(c[2]),
                           .lo = brick_of_key(c[3]),
                           .hi = brick_of_key(c[4]),
                           .bricks = static_cast<uint32_t>(c[5]),
                           .pieces = static_cast<uint32_t>(c[6])};
        if (wanted(edit)) found.push_back(edit);
        if (found.size() == most) return tl::unexpected(enough);
        return {};
      });
  if (!done && found.size() != most) return tl::unexpected(done.error());
  return found;
}

Result<Tick> HistoryFile::known_since() {
  const auto since = TRY(state_->fact(known_since_fact));
  return since ? number_of_bytes(*since) : Tick{0};
}

Result<uint64_t> HistoryFile::bytes() {
  const int64_t pages = TRY(state_->database.number("PRAGMA page_count")).value_or(0);
  const int64_t unused = TRY(state_->database.number("PRAGMA freelist_count")).value_or(0);
  const int64_t size = TRY(state_->database.number("PRAGMA page_size")).value_or(0);
  return from_sql((pages - unused) * size);
}

Result<void> HistoryFile::forget_oldest() {
  const int64_t first = TRY(state_->database.number("SELECT min(key) FROM images")).value_or(0);
  const int64_t last = TRY(state_->database.number("SELECT max(key) FROM images")).value_or(0);
  const int64_t until = first + (last - first) / 10;
  const auto tick =
      TRY(state_->database.number(fmt::format("SELECT max(last) FROM images WHERE key <= {}", until)));
  TRY(state_->database.execute(fmt::format(
      "DELETE FROM images WHERE key <= {}; DELETE FROM edits WHERE tick <= {}", until, tick.value_or(0))));
  return state_->set_fact(known_since_fact, bytes_of_number(from_sql(tick.value_or(0)) + 1));
}

}  // namespace scree
