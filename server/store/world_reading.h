// Reads the rows of a world's file, table by table. Internal to WorldFile. One thread at a time.
#pragma once

#include <functional>

#include "server/store/database.h"
#include "server/store/world_file.h"

namespace scree {

/// The chunk of a row; refuses another one's.
Result<WorldChunk> chunk_of_row(uint64_t key, std::span<const uint8_t> data);

class WorldReading {
 public:
  /// Rows that are not whole are told to `lost`, and left out; where it is null they are errors.
  WorldReading(Database& database, LostRows* lost) : database_(database), lost_(lost) {}

  /// All rows; of chunks only with_chunks.
  Result<WorldRows> run(bool with_chunks);
  /// Calls `visit` for each chunk.
  using ChunkVisitor = std::function<Result<void>(WorldChunk)>;
  Result<void> chunks(const ChunkVisitor& visit);
  uint64_t bytes() const { return rows_.bytes; }  ///< of the rows that were read

 private:
  using Bytes = std::span<const uint8_t>;
  using BytesVisitor = std::function<Result<void>(uint64_t key, Bytes data)>;

  /// The only row of a table.
  Result<void> one(const std::string& table, const BytesVisitor& visit);
  /// All rows of a table.
  Result<void> every(const std::string& table, const BytesVisitor& visit);
  Result<void> piece(uint64_t key, Bytes data);
  Result<void> stones();
  Result<void> stone(uint64_t key, Bytes data);
  Result<void> lose(const std::string& what);
  tl::unexpected<Error> damaged(const std::string& what) const;
  void begin_anew();

  Database& database_;
  LostRows* lost_;
  WorldRows rows_;
  size_t voxels_ = 0;
  size_t stone_voxels_ = 0;
  bool has_moment_ = true;
};

}  // namespace scree
