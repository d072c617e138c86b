// The tables of a recording: one SQLite file. proto/recording.proto specifies the blobs.
#pragma once

#include <cstdint>
#include <string>

#include "proto/recording_codec.h"
#include "server/store/file_kind.h"

namespace scree::schema {

/// PRAGMA application_id, "SCRE": distinguishes a recording from other SQLite files. PRAGMA user_version is
/// the format.
inline constexpr int64_t application_id = 0x53435245;

inline constexpr FileKind recording{.noun = "recording",
                                    .application_id = application_id,
                                    .format = recording_format,
                                    .way_out = "play it with the release that recorded it"};

inline std::string create_table(const std::string& table) {
  return "CREATE TABLE IF NOT EXISTS " + table +
         " (tick INTEGER PRIMARY KEY, data BLOB NOT NULL, checksum INTEGER NOT NULL);";
}

/// What recordings of earlier releases have not.
inline std::string create_later_tables() {
  return create_table("events") + create_table("machine") + create_table("short_keyframes");
}

/// frames: one row for every tick, without a gap. commands: one row for each tick with commands. keyframes:
/// what is published of the state after the tick. states: the world's whole value after the tick, from which
/// the simulation of the next one began: at the start of a recording, and where another process went on with
/// it. header: one row, tick 0. checksum: XXH3 of the data.
/// events: one row for each tick in which something happened that follows from the simulation; machine: one
/// row a second or so, of the ticks since the last: how long they took, and what else happened to the server.
/// short_keyframes: as keyframes, but of the bricks those that changed since the last keyframe, or since the
/// untouched terrain where there is none. Recordings of earlier releases have none of these three.
inline std::string create_tables() {
  std::string sql = "PRAGMA application_id = " + std::to_string(application_id) + ";" +
                    "PRAGMA user_version = " + std::to_string(recording_format) + ";";
  for (const char* table : {"header", "frames", "keyframes", "states", "commands"})
    sql += create_table(table);
  return sql + create_later_tables();
}

inline std::string insert_into(const std::string& table) {
  return "INSERT INTO " + table + " (tick, data, checksum) VALUES (?1, ?2, ?3)";
}
/// Where the row may be there already: a world may be started twice at one tick.
inline std::string put_into(const std::string& table) {
  return "REPLACE INTO " + table + " (tick, data, checksum) VALUES (?1, ?2, ?3)";
}
inline std::string select_from(const std::string& table) {
  return "SELECT data, checksum FROM " + table + " WHERE tick = ?1";
}

}  // namespace scree::schema
