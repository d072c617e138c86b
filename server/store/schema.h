// The tables of a recording: one SQLite file. server/formats/recording.proto specifies the blobs.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "server/formats/recording_codec.h"
#include "server/store/file_kind.h"

namespace scree::schema {

/// PRAGMA application_id, "SCRE": distinguishes a recording from other SQLite files. PRAGMA user_version is
/// the format.
inline constexpr int64_t application_id = 0x53435245;

inline constexpr FileKind recording{.noun = "recording",
                                    .application_id = application_id,
                                    .format = recording_format,
                                    .way_out = "play it with the release that recorded it"};

/// Tables of rows by tick, or by id.
inline constexpr std::array row_tables = {"header",          "frames",          "commands",
                                          "events",          "machine",         "ended",
                                          "keyframe_states", "keyframe_pieces", "state_moments"};
inline constexpr const char* chunk_table = "keyframe_chunks";
inline constexpr const char* chunk_columns =
    " (id INTEGER PRIMARY KEY, tick INTEGER NOT NULL, chunk INTEGER NOT NULL, hash INTEGER NOT NULL,"
    " data BLOB NOT NULL, checksum INTEGER NOT NULL);";
inline constexpr const char* row_columns =
    " (tick INTEGER PRIMARY KEY, data BLOB NOT NULL, checksum INTEGER NOT NULL);";

/// frames: one row for every tick, without a gap. commands: one row for each tick with commands, also of
/// ticks before the first frame, back to the state from which these are simulated. header: one row, tick 0.
/// checksum: XXH3 of the data.
///
/// A keyframe, from which seeking starts, is what changed since the one before it. keyframe_states: all but
/// terrain and pieces' volumes. keyframe_chunks: a chunk's edited bricks (as wire.Frame.patches), of the
/// keyframe in which it differed from its row before; chunk: chunk_key(); hash: Σ of its bricks' hashes. The
/// terrain is, of each chunk, the latest row up to the keyframe. keyframe_pieces: the volume of a piece, by
/// its id, written once.
///
/// state_moments: the world's value after the tick, without its terrain, which is the keyframe's of that
/// tick: the simulation of the next tick began from it, at the start of a recording, where another process
/// went on with it, and where a part may begin when those before are dropped.
///
/// events: one row for each tick in which something happened that follows from the simulation; machine: one
/// row a second or so, of the ticks since the last: how long they took, and what else happened to the server.
/// ended: one row, of the last tick, when who recorded came to an end.
///
/// Makes those that are not there. Builds before 0.2.0 left out tables without rows.
inline std::string create_tables() {
  std::string sql = "PRAGMA application_id = " + std::to_string(application_id) + ";" +
                    "PRAGMA user_version = " + std::to_string(recording_format) + ";";
  for (const char* table : row_tables)
    sql += std::string("CREATE TABLE IF NOT EXISTS ") + table + row_columns;
  return sql + "CREATE TABLE IF NOT EXISTS " + chunk_table + chunk_columns +
         "CREATE INDEX IF NOT EXISTS keyframe_chunks_of ON keyframe_chunks (chunk, tick, hash);";
}
/// For a reader of one that lacks the table.
inline std::string create_empty(const std::string& table) {
  return "CREATE TEMP TABLE " + table + (table == chunk_table ? chunk_columns : row_columns);
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
