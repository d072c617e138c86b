#include "ground/ground_file.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "content/builtin_palette.h"
#include "crypto/sha256.h"
#include "ground/limits.h"
#include "proto/byte_stream.h"
#include "proto/height_codec.h"
#include "proto/limits.h"
#include "proto/palette_codec.h"
#include "proto/stored_codec.h"
#include "shared/base/check.h"
#include "shared/base/regular_file.h"

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

/// Each is a row of the palette.
Result<void> check_materials(const GeneratedChunk& chunk, const Palette& palette) {
  if (chunk.stored_materials == nullptr) return {};
  for (const BrickMaterials& brick : chunk.stored_materials->distinct())
    if (const VoxelMaterial last = brick.list().back(); last > palette.rows.size())
      return fail(fmt::format("a stored chunk has material {}, and its palette has {} (0 to {})", last - 1,
                              palette.rows.size(), palette.rows.size() - 1));
  return {};
}

}  // namespace

Result<std::shared_ptr<const GroundFile>> GroundFile::open(const std::string& path) {
  const auto wrong = [&](const std::string& why) { return fail(path + ": " + why); };
  TRY(check_no_device(path));
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
  if (auto read = ground->read_palette(size); !read) return wrong(read.error().message);
  if (auto index = ground->read_index(size); !index) return wrong(index.error().message);
  if (auto index = ground->read_chunk_index(size); !index) return wrong(index.error().message);
  if (auto checked = ground->check(); !checked) return wrong(checked.error().message);
  if (auto checked = ground->check_chunks(); !checked) return wrong(checked.error().message);
  return ground;
}

GroundFile::~GroundFile() {
  close(file_);
}

TerrainSource GroundFile::source_of(std::shared_ptr<const GroundFile> file) {
  TerrainSource source{.rows = file->palette()->ground};
  if (const auto& bricks = file->bricks()) source.voxel_size_m = bricks->voxel_size_m;
  source.heights = std::move(file);
  return source;
}

Result<void> GroundFile::read_palette(uint64_t file_bytes) {
  palette_ = shared_builtin_palette();
  if (header_.palette_bytes == 0) return {};
  if (file_bytes < header_bytes + header_.palette_bytes) return fail("it is cut short");
  const auto bytes = TRY(read_at(file_, header_bytes, header_.palette_bytes));
  if (sha256(bytes) != header_.palette) return fail("it is damaged: its palette does not have its hash");
  palette_ = std::make_shared<const Palette>(TRY(decode_palette(bytes)));
  return {};
}

Result<void> GroundFile::read_index(uint64_t file_bytes) {
  const size_t tiles = layout().tiles();
  const uint64_t bytes = uint64_t{tiles} * index_entry_bytes;
  if (header_.index_begins > file_bytes || file_bytes - header_.index_begins < bytes)
    return fail("it is cut short");
  if (header_.chunk_index_begins != header_.index_begins + bytes) return fail("its header is damaged");
  const auto read = TRY(read_at(file_, header_.index_begins, bytes));
  ByteReader reader(read, "the index");
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

Result<void> GroundFile::read_chunk_index(uint64_t file_bytes) {
  if (!bricks()) return {};
  const uint64_t begins = header_.chunk_index_begins;
  if (begins > file_bytes || file_bytes - begins < sizeof(uint32_t)) return fail("it is cut short");
  const auto count_bytes = TRY(read_at(file_, begins, sizeof(uint32_t)));
  const size_t count = ByteReader(count_bytes, "the index").u32("stored chunks");
  if (count > limits::file_chunks_max)
    return fail(fmt::format("it stores {} chunks, more than {} (limits.file_chunks_max)", count,
                            limits::file_chunks_max));
  if (file_bytes - begins - sizeof(uint32_t) < count * chunk_entry_bytes) return fail("it is cut short");
  const auto read = TRY(read_at(file_, begins + sizeof(uint32_t), count * chunk_entry_bytes));
  ByteReader reader(read, "the index");
  for (size_t i = 0; i < count; ++i) {
    const auto number = [&] { return std::bit_cast<int32_t>(reader.u32("key of a stored chunk")); };
    const int level = number(), x = number(), y = number(), z = number();
    const TileKey key = key_of(level, {x, y, z});
    const Entry entry{reader.u64("begin of a stored chunk"), reader.u32("bytes of a stored chunk"), {}};
    if (!bricks()->holds(key) || entry.bytes > limits::tile_bytes_max ||
        entry.begins > header_.index_begins || header_.index_begins - entry.begins < entry.bytes ||
        !chunks_.emplace(key, entry).second)
      return fail("the index of stored chunks is damaged");
  }
  return {};
}

/// As check(), of the stored chunks: those that are named are those that are there.
Result<void> GroundFile::check_chunks() {
  if (!bricks()) return {};
  const auto missing = [] { return fail("it is damaged: a stored chunk is missing"); };
  const auto root = chunks_.find(bricks()->root());
  if (root == chunks_.end()) return missing();
  root->second.digest = header_.ground.bricks->root;
  size_t named = 1;
  for (auto each = chunks_.rbegin(); each != chunks_.rend(); ++each) {  // keys have the level first
    const TileKey key = each->first;
    const auto bytes = TRY(read(key));
    const auto unpacked = TRY(unpack_chunk(bytes, key, *bricks()));
    TRY(check_materials(unpacked.chunk, *palette_));
    for (size_t i = 0; i < unpacked.children.size(); ++i) {
      if (!unpacked.children[i]) continue;
      const auto child = chunks_.find(bricks()->children(key)[i]);
      if (child == chunks_.end()) return missing();
      child->second.digest = *unpacked.children[i];
      ++named;
    }
  }
  return named == chunks_.size() ? Result<void>()
                                 : fail("it is damaged: its index does not name a stored chunk");
}

/// From the coarsest level down: each tile has the hashes of those below it.
Result<void> GroundFile::check() {
  index_[index_of(layout(), layout().top())].digest = header_.ground.top;
  for (int level = layout().levels() - 1; level >= 0; --level)
    for (int z = 0; z < HeightLayout::tiles_on(level, layout().rows); ++z)
      for (int x = 0; x < HeightLayout::tiles_on(level, layout().columns); ++x) {
        const TileKey key{level, x, z};
        const auto bytes = TRY(read(key));
        const auto tile = TRY(unpack_tile(bytes, key, layout()));
        const std::vector<TileKey> children = layout().children(key);
        for (size_t i = 0; i < children.size(); ++i)
          index_[index_of(layout(), children[i])].digest = tile.children[i];
      }
  return {};
}

const GroundFile::Entry& GroundFile::entry_of(TileKey key) const {
  return key.kind == TileKind::bricks ? chunks_.at(key) : index_[index_of(layout(), key)];
}

Result<std::vector<uint8_t>> GroundFile::read(TileKey key) const {
  const Entry& entry = entry_of(key);
  auto bytes = read_at(file_, entry.begins, entry.bytes);
  if (bytes && sha256(*bytes) != entry.digest)
    return fail(fmt::format("it is damaged: tile ({}, {}, {}{}) does not have its hash", key.level, key.x,
                            key.kind == TileKind::bricks ? fmt::format("{}, ", key.y) : "", key.z));
  return bytes;
}

std::vector<uint8_t> GroundFile::packed(TileKey key) const {
  CHECK(has(key));
  auto bytes = read(key);
  CHECK(bytes.has_value());
  return std::move(*bytes);
}

std::shared_ptr<const HeightTile> GroundFile::tile(TileKey key) const {
  const std::scoped_lock lock(mutex_);
  if (auto cached = tile_cache_.find(key)) return cached;
  auto unpacked = unpack_tile(packed(key), key, layout());
  CHECK(unpacked.has_value());
  return tile_cache_.insert(key, std::move(unpacked->tile));
}

ChunkLookup GroundFile::chunk(TileKey key) const {
  if (!chunks_.contains(key) || key == bricks()->root()) return {};
  const std::scoped_lock lock(mutex_);
  if (auto cached = chunk_cache_.find(key)) return {true, std::move(cached)};
  auto unpacked = unpack_chunk(packed(key), key, *bricks());
  CHECK(unpacked.has_value());
  return {true, chunk_cache_.insert(key, std::move(unpacked->chunk))};
}

std::vector<TileKey> GroundFile::chunks() const {
  std::vector<TileKey> keys;
  for (const auto& [key, entry] : chunks_)
    if (key != bricks()->root()) keys.push_back(key);
  return keys;
}

}  // namespace scree
