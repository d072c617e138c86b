// The tables of a recording: one SQLite file. server/formats/recording.proto specifies the blobs.
#pragma once

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <string_view>

#include "server/formats/recording_codec.h"
#include "server/store/file_kind.h"

namespace scree::schema {

/// PRAGMA application_id, "SCRE": distinguishes a recording from other SQLite files. PRAGMA user_version is
/// the format.
inline constexpr int64_t application_id = 0x53435245;

inline constexpr std::string_view row_columns =
    " (tick INTEGER PRIMARY KEY, data BLOB NOT NULL, checksum INTEGER NOT NULL)";
inline constexpr std::string_view chunk_columns =
    " (id INTEGER PRIMARY KEY, tick INTEGER NOT NULL, chunk INTEGER NOT NULL, hash INTEGER NOT NULL,"
    " data BLOB NOT NULL, checksum INTEGER NOT NULL)";

inline constexpr FileKind recording{
    .noun = "recording",
    .application_id = application_id,
    .format = recording_format,
    .oldest = recording_format_oldest,
    .way_out = "play it with the release that recorded it",
    .columns = {row_columns, chunk_columns},
    .index = "CREATE INDEX keyframe_chunks_of ON keyframe_chunks (chunk, tick, hash)"};

/// Tables of rows by tick, or by id.
inline constexpr std::array row_tables = {"header",          "frames",          "commands",
                                          "events",          "machine",         "ended",
                                          "keyframe_states", "keyframe_pieces", "state_moments"};
inline constexpr const char* chunk_table = "keyframe_chunks";

/// The table frames has one row for every tick, without a gap. The table commands has one row for each tick
/// with commands, also for ticks before the first frame, back to the state from which these are simulated.
/// The table header has one row, of tick 0. Each checksum is the XXH3 of the data.
///
/// A keyframe, from which seeking starts, holds the changes since the one before it. A row of keyframe_states
/// has all but terrain and pieces' volumes. A row of keyframe_chunks has a chunk's edited bricks (as
/// wire.Frame.patches), for the keyframe in which it differed from its row before. Its key is chunk_key(),
/// its hash the sum of its bricks' hashes. The terrain of a keyframe is the latest row of each chunk up to
/// it. A row of keyframe_pieces has the volume of a piece, by its id, written once.
///
/// A row of state_moments has the world's value after the tick, without its terrain, which the keyframe of
/// that tick has. The simulation of the next tick began from it: at the start of a recording, where another
/// process went on with it, and where a part may begin when those before are dropped.
///
/// The table events has one row for each tick with events that follow from the simulation. The table machine
/// has about one row a second, with the durations of the ticks since the last row and the server's own
/// events. The table ended has one row, of the last tick, when the recorder came to an end.
///
/// This makes the tables that are not there. Builds before 0.2.0 left out tables without rows.
inline std::string create_tables() {
  std::string sql =
      fmt::format("PRAGMA application_id = {};PRAGMA user_version = {};", application_id, recording_format);
  for (const char* table : row_tables)
    sql += fmt::format("CREATE TABLE IF NOT EXISTS {}{};", table, row_columns);
  return sql + fmt::format("CREATE TABLE IF NOT EXISTS {}{};", chunk_table, chunk_columns) +
         "CREATE INDEX IF NOT EXISTS keyframe_chunks_of ON keyframe_chunks (chunk, tick, hash);";
}
/// Makes an empty table in memory, for a reader of a file that lacks it.
inline std::string create_empty(const std::string& table) {
  return fmt::format("CREATE TEMP TABLE {}{}", table, table == chunk_table ? chunk_columns : row_columns);
}

inline std::string insert_into(const std::string& table) {
  return "INSERT INTO " + table + " (tick, data, checksum) VALUES (?1, ?2, ?3)";
}
/// Where the row may be there already: a world may be started twice at one tick.
inline std::string put_into(const std::string& table) {
  return "REPLACE INTO " + table + " (tick, data, checksum) VALUES (?1, ?2, ?3)";
}
inline std::string insert_chunk() {
  return "INSERT INTO keyframe_chunks (tick, chunk, hash, data, checksum) VALUES (?1, ?2, ?3, ?4, ?5)";
}
inline std::string select_chunk() {
  return "SELECT data, checksum FROM keyframe_chunks WHERE id = ?1";
}
inline std::string select_from(const std::string& table) {
  return "SELECT data, checksum FROM " + table + " WHERE tick = ?1";
}

}  // namespace scree::schema
