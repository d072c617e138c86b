#include "ground/ground_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crypto/sha256.h"
#include "ground/limits.h"
#include "proto/byte_stream.h"
#include "proto/height_codec.h"
#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

Result<std::vector<uint8_t>> read_at(int file, uint64_t begins, size_t count) {
  std::vector<uint8_t> bytes(count);
  size_t done = 0;
  while (done < count) {
    const ssize_t got = pread(file, bytes.data() + done, count - done, static_cast<off_t>(begins + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(std::strerror(errno));
    if (got == 0) return fail("it is cut short");
    done += static_cast<size_t>(got);
  }
  return bytes;
}

}  // namespace

Result<std::shared_ptr<const GroundFile>> GroundFile::open(const std::string& path) {
  const auto wrong = [&](const std::string& why) { return fail(path + ": " + why); };
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return wrong(std::strerror(errno));
  struct stat about {};
  const bool known = fstat(file, &about) == 0 && S_ISREG(about.st_mode);
  const auto size = static_cast<uint64_t>(known ? about.st_size : 0);
  auto begin = read_at(file, 0, std::min<uint64_t>(size, header_bytes));
  auto header = begin ? decode_header(*begin) : tl::unexpected(begin.error());
  if (!header) {
    close(file);
    return wrong(header.error().message);
  }
  const std::shared_ptr<GroundFile> ground(new GroundFile(file, *header));
  if (auto index = ground->read_index(size); !index) return wrong(index.error().message);
  if (auto checked = ground->check(); !checked) return wrong(checked.error().message);
  return ground;
}

GroundFile::~GroundFile() {
  close(file_);
}

Result<void> GroundFile::read_index(uint64_t file_bytes) {
  const size_t tiles = layout().tiles();
  const uint64_t bytes = uint64_t{tiles} * index_entry_bytes;
  if (header_.index_begins > file_bytes || file_bytes - header_.index_begins < bytes)
    return fail("it is cut short");
  const auto read = read_at(file_, header_.index_begins, bytes);
  if (!read) return tl::unexpected(read.error());
  ByteReader reader(*read, "the index");
  index_.resize(tiles);
  for (Entry& entry : index_) {
    entry.begins = reader.u64("begin of a tile");
    entry.bytes = reader.u32("bytes of a tile");
    if (entry.bytes > limits::tile_bytes_max || entry.begins > header_.index_begins ||
        header_.index_begins - entry.begins < entry.bytes)
      return fail("the index is damaged");
  }
  return {};
}

/// From the coarsest level down: each tile has the hashes of those below it.
Result<void> GroundFile::check() {
  index_[index_of(layout(), layout().top())].digest = header_.ground.top;
  for (int level = layout().levels() - 1; level >= 0; --level)
    for (int z = 0; z < HeightLayout::tiles_on(level, layout().rows); ++z)
      for (int x = 0; x < HeightLayout::tiles_on(level, layout().columns); ++x) {
        const TileKey key{level, x, z};
        const auto bytes = read(key);
        if (!bytes) return tl::unexpected(bytes.error());
        const auto tile = unpack_tile(*bytes, key, layout());
        if (!tile) return tl::unexpected(tile.error());
        const std::vector<TileKey> children = layout().children(key);
        for (size_t i = 0; i < children.size(); ++i)
          index_[index_of(layout(), children[i])].digest = tile->children[i];
      }
  return {};
}

Result<std::vector<uint8_t>> GroundFile::read(TileKey key) const {
  const Entry& entry = index_[index_of(layout(), key)];
  auto bytes = read_at(file_, entry.begins, entry.bytes);
  if (bytes && sha256(*bytes) != entry.digest)
    return fail("it is damaged: tile (" + std::to_string(key.level) + ", " + std::to_string(key.x) + ", " +
                std::to_string(key.z) + ") does not have its hash");
  return bytes;
}

std::vector<uint8_t> GroundFile::packed(TileKey key) const {
  CHECK(layout().holds(key));
  auto bytes = read(key);
  CHECK(bytes.has_value());
  return std::move(*bytes);
}

std::shared_ptr<const HeightTile> GroundFile::tile(TileKey key) const {
  const std::scoped_lock lock(mutex_);
  const auto found = kept_.find(key);
  if (found != kept_.end()) {
    uses_.splice(uses_.begin(), uses_, found->second.use);
    return found->second.tile;
  }
  const auto unpacked = unpack_tile(packed(key), key, layout());
  CHECK(unpacked.has_value());
  if (kept_.size() >= limits::file_tiles_kept_max) {
    kept_.erase(uses_.back());
    uses_.pop_back();
  }
  uses_.push_front(key);
  auto tile = std::make_shared<const HeightTile>(unpacked->tile);
  kept_.emplace(key, Kept{tile, uses_.begin()});
  return tile;
}

}  // namespace scree
