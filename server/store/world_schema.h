// The tables of a world file: one SQLite file in WAL mode. server/formats/world.proto specifies the blobs.
#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>

#include "server/formats/world_codec.h"
#include "server/store/file_kind.h"
#include "server/store/limits.h"
#include "shared/field/coord.h"

namespace scree::world_schema {

/// "SCRW" distinguishes a world from other SQLite files.
inline constexpr FileKind world{
    .noun = "world",
    .application_id = 0x53435257,
    .format = world_format,
    .oldest = world_format_oldest,
    .way_out = "open it with the release that made it",
    .columns = {" (key INTEGER PRIMARY KEY, data BLOB NOT NULL, checksum INTEGER NOT NULL)"},
    .index = {}};

/// header and moment: one row each, key 0. chunks: the edited ones, by chunk_key(). pieces: those alive, by
/// id. stones: where pieces merged, by the piece's id; files of older releases lack the table, and who saves
/// adds it. checksum: XXH3 of the data. All rows are of one tick, the moment's.
inline std::string create_tables() {
  std::string sql = "PRAGMA application_id = " + std::to_string(world.application_id) + ";" +
                    "PRAGMA user_version = " + std::to_string(world.format) + ";";
  for (const char* table : {"header", "moment", "chunks", "pieces", "stones"})
    sql += fmt::format("CREATE TABLE {}{};", table, world.columns.front());
  return sql;
}

inline std::string add_stones() {
  return fmt::format("CREATE TABLE IF NOT EXISTS stones{};", world.columns.front());
}

inline std::string bound_page_cache() {
  return "PRAGMA cache_size = -" + std::to_string(limits::page_cache_kib);
}

inline std::string put_into(const std::string& table) {
  return "REPLACE INTO " + table + " (key, data, checksum) VALUES (?1, ?2, ?3)";
}
inline std::string delete_from(const std::string& table) {
  return "DELETE FROM " + table + " WHERE key = ?1";
}
inline std::string all_of(const std::string& table) {
  return "SELECT key, data, checksum FROM " + table + " ORDER BY key";
}

/// From the key ?1 on.
inline std::string all_from(const std::string& table) {
  return "SELECT key, data, checksum FROM " + table + " WHERE key >= ?1 ORDER BY key";
}

inline std::string one_of(const std::string& table) {
  return "SELECT data, checksum FROM " + table + " WHERE key = ?1";
}

/// 21 bits a coordinate: worlds reach a few thousand chunks.
inline uint64_t chunk_key(ChunkCoord chunk) {
  constexpr int32_t half = 1 << 20;
  constexpr uint64_t mask = (uint64_t{1} << 21U) - 1;
  const auto part = [](int32_t c) { return static_cast<uint64_t>(static_cast<int64_t>(c) + half) & mask; };
  return (part(chunk.x) << 42U) | (part(chunk.y) << 21U) | part(chunk.z);
}
inline ChunkCoord chunk_of_key(uint64_t key) {
  constexpr int64_t half = 1 << 20;
  constexpr uint64_t mask = (uint64_t{1} << 21U) - 1;
  const auto part = [&](unsigned shift) {
    return static_cast<int32_t>(static_cast<int64_t>((key >> shift) & mask) - half);
  };
  return {part(42), part(21), part(0)};
}

}  // namespace scree::world_schema
