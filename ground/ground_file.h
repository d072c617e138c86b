// A ground file, read: a model whose tiles come from the file as they are needed.
//
// Invariant: every tile that it gives has the hash by which the tile above names it. All of them are looked
// at when the file is opened; should one be another later, the program ends, for a world without its ground
// would lie. Any thread may call.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "ground/ground_header.h"
#include "ground/limits.h"
#include "ground/tile_cache.h"
#include "shared/field/terrain.h"
#include "shared/material/palette.h"

namespace scree {

class GroundFile final : public GroundModel {
 public:
  /// Reads and checks all of the file. The error names it, and says what is wrong.
  static Result<std::shared_ptr<const GroundFile>> open(const std::string& path);
  ~GroundFile() override;

  const GroundHeader& header() const { return header_; }
  Digest name() const { return name_of(header_); }
  /// What its materials are rows of, and what its layers are of. Not null.
  std::shared_ptr<const Palette> palette() const { return palette_; }
  /// The ground as terrain of its own rows, with voxels of the size of its stored bricks, if there are any.
  static TerrainSource source_of(std::shared_ptr<const GroundFile> file);
  std::shared_ptr<const HeightTile> tile(TileKey key) const override;
  ChunkLookup chunk(TileKey key) const override;
  std::vector<uint8_t> packed(TileKey key) const override;
  bool has(TileKey key) const override { return layout().holds(key) || chunks_.contains(key); }
  /// The stored chunks, in order, without the root.
  std::vector<TileKey> chunks() const;

 private:
  struct Entry {
    uint64_t begins = 0;
    uint32_t bytes = 0;
    Digest digest{};
  };
  GroundFile(int file, const GroundHeader& header)
      : GroundModel(header.ground.layout,
                    header.ground.bricks ? std::optional(header.ground.bricks->layout) : std::nullopt),
        file_(file),
        header_(header) {}
  Result<void> read_palette(uint64_t file_bytes);
  Result<void> read_index(uint64_t file_bytes);
  Result<void> read_chunk_index(uint64_t file_bytes);
  Result<void> check();
  Result<void> check_chunks();
  const Entry& entry_of(TileKey key) const;
  Result<std::vector<uint8_t>> read(TileKey key) const;

  const int file_;
  const GroundHeader header_;
  std::shared_ptr<const Palette> palette_;
  std::vector<Entry> index_;
  std::map<TileKey, Entry> chunks_;  ///< with the root
  mutable std::mutex mutex_;         ///< guards the members below
  mutable TileCache<HeightTile> tile_cache_{limits::file_tiles_cached_max};
  mutable TileCache<GeneratedChunk> chunk_cache_{limits::file_chunks_cached_max};
};

}  // namespace scree
