// What the file of a world holds, for people and programs: `scree world info`.
#pragma once

#include <cstdint>
#include <string>

#include "server/store/world_file.h"

namespace scree {

/// Sums over the rows of chunks.
struct ChunkSums {
  uint64_t chunks = 0, bricks = 0, bytes = 0;
  int64_t format = 0;  ///< of the file
};

/// One JSON object: the palette without the numbers that settings change. `palette` null: the built-in one.
std::string palette_facts(const Palette* palette);

/// One JSON object: the materials by name, with their part of the ledger, but for those that have none.
std::string ledger_json(const MaterialLedger& ledger, const Palette& palette);

/// One JSON object. `rows`: all but the chunks.
std::string world_facts(const std::string& path, const WorldRows& rows, const ChunkSums& sums);

}  // namespace scree
