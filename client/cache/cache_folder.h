// Kept chunks as files, one for each world at each server's address. A file is written anew and renamed, so
// that neither a crash nor two clients at once leave half of one: who writes last is read next. It is only a
// cache: a file that cannot be written or read is as none. Used by one thread at a time.
//
// A file is little-endian. It begins with a number that says what it is (u64), the world (u64) and the voxel
// size in metres (f32). Then it has for each chunk the bytes of its bricks (u32), x, y and z (i32), its hash
// (u64), and the bricks as in Chunk.bricks (proto/scree.proto). The chunk used last is at the end.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/cache/chunk_cache.h"
#include "shared/base/result.h"

namespace scree {

/// What is kept of a world.
struct CachedWorld {
  uint64_t world = 0;
  float voxel_size_m = 0.0F;
  std::vector<CachedChunk> chunks{};
};

class CacheFolder {
 public:
  /// `path` is empty: nothing is read or written. `bytes_max`: of all files.
  CacheFolder(std::string path, size_t bytes_max) : path_(std::move(path)), bytes_max_(bytes_max) {}

  /// What the address' file of that world has, or, without a world, of the one written last. Stops at the
  /// first thing that is wrong; that the bricks have their hashes is not checked here.
  std::optional<CachedWorld> read(const std::string& address, std::optional<uint64_t> world) const;
  /// The error says why nothing can be kept there.
  Result<void> try_writing() const;
  /// Then calls bound().
  void write(const std::string& address, const CachedWorld& cached) const;
  /// Removes the files written longest ago, as far as all, tiles of grounds, palettes and images among
  /// them, are more than the bound.
  void bound() const;
  const std::string& path() const { return path_; }

 private:
  std::string file_of(const std::string& address, uint64_t world) const;

  std::string path_;
  size_t bytes_max_;
};

}  // namespace scree
