// A ground file, read: a model whose tiles come from the file as they are needed.
//
// Invariant: every tile that it gives has the hash by which the tile above names it. All of them are looked
// at when the file is opened; should one be another later, the program ends, for a world without its ground
// would lie. Any thread may call.
#pragma once

#include <list>
#include <map>
#include <mutex>
#include <string>

#include "ground/ground_header.h"

namespace scree {

class GroundFile final : public HeightModel {
 public:
  /// Reads and checks all of the file. The error names it, and says what is wrong.
  static Result<std::shared_ptr<const GroundFile>> open(const std::string& path);
  ~GroundFile() override;

  const GroundHeader& header() const { return header_; }
  Digest name() const { return name_of(header_); }
  std::shared_ptr<const HeightTile> tile(TileKey key) const override;
  std::vector<uint8_t> packed(TileKey key) const override;

 private:
  struct Entry {
    uint64_t begins = 0;
    uint32_t bytes = 0;
    Digest digest{};
  };
  struct Kept {
    std::shared_ptr<const HeightTile> tile;
    std::list<TileKey>::iterator use;
  };

  GroundFile(int file, const GroundHeader& header)
      : HeightModel(header.ground.layout), file_(file), header_(header) {}
  Result<void> read_index(uint64_t file_bytes);
  Result<void> check();
  Result<std::vector<uint8_t>> read(TileKey key) const;

  const int file_;
  const GroundHeader header_;
  std::vector<Entry> index_;
  mutable std::mutex mutex_;  ///< guards the members below
  mutable std::map<TileKey, Kept> kept_;
  mutable std::list<TileKey> uses_;  ///< of kept_, the last one in front
};

}  // namespace scree
