#include "ground/ground_writer.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <unistd.h>

#include "crypto/sha256.h"
#include "ground/whole_file.h"
#include "proto/byte_stream.h"
#include "proto/height_codec.h"
#include "proto/palette_codec.h"
#include "proto/stored_codec.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Format 1 has one material a brick, and the first rows of the built-in palette: rock, soil and ice.
bool is_of_format_1(const GeneratedChunk& chunk) {
  if (chunk.stored_materials == nullptr) return true;
  return std::ranges::all_of(chunk.stored_materials->distinct(), [](const BrickMaterials& brick) {
    return brick.is_uniform() && brick.uniform() <= said(material::ice);
  });
}

/// The greatest that a voxel says.
VoxelMaterial last_material(const GeneratedChunk& chunk) {
  VoxelMaterial last = ground_own;
  if (chunk.stored_materials != nullptr)
    for (const BrickMaterials& brick : chunk.stored_materials->distinct())
      last = std::max(last, brick.list().back());
  return last;
}

}  // namespace

GroundWriter::GroundWriter(std::string path, const HeightLayout& layout, float zero_m)
    : path_(std::move(path)),
      unfinished_(unfinished_name(path_)),
      levels_(static_cast<size_t>(layout.levels())),
      index_(layout.tiles()) {
  header_.ground.layout = layout;
  header_.ground.layout.lowest = std::numeric_limits<int32_t>::max();
  header_.ground.layout.highest = std::numeric_limits<int32_t>::min();
  header_.zero_m = zero_m;
}

Result<std::unique_ptr<GroundWriter>> GroundWriter::create(const std::string& path,
                                                           const HeightLayout& layout, float zero_m,
                                                           const Palette& palette) {
  std::unique_ptr<GroundWriter> writer(new GroundWriter(path, layout, zero_m));
  writer->file_.reset(std::fopen(writer->unfinished_.c_str(), "wbxe"));
  if (!writer->file_) return fail(path + ": " + std::strerror(errno));
  writer->write(std::vector<uint8_t>(header_bytes));
  writer->put_palette(palette);
  return writer;
}

GroundWriter::~GroundWriter() {
  if (file_) std::remove(unfinished_.c_str());
}

void GroundWriter::write(std::span<const uint8_t> bytes) {
  failed_ = failed_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size();
  written_ += bytes.size();
}

/// The built-in one is in every program.
void GroundWriter::put_palette(const Palette& palette) {
  palette_rows_ = palette.rows.size();
  if (palette == builtin_palette()) return;
  const std::vector<uint8_t> bytes = encode_palette(palette);
  header_.format = 2;
  header_.palette_bytes = static_cast<uint32_t>(bytes.size());
  header_.palette = sha256(bytes);
  write(bytes);
}

void GroundWriter::add_row(std::span<const int32_t> heights) {
  CHECK(!heights_done_);
  HeightLayout& layout = header_.ground.layout;
  CHECK(static_cast<int>(heights.size()) == layout.columns && levels_.front().count < layout.rows);
  const auto [least, most] = std::ranges::minmax(heights);
  layout.lowest = std::min(layout.lowest, least);
  layout.highest = std::max(layout.highest, most);
  add_row(0, Row(heights.begin(), heights.end()));
}

/// A row of the next level lies where each second one does, and reads the rows on both sides.
void GroundWriter::add_row(int level, Row row) {
  Level& here = levels_[static_cast<size_t>(level)];
  here.rows.push_back(row);
  if (here.rows.size() == tile_samples) write_tiles(level);
  const bool middle_was_last = here.count % 2 == 1;
  if (middle_was_last) add_smoothed(level + 1, here.count == 1 ? here.last : here.before, here.last, row);
  here.before = std::exchange(here.last, std::move(row));
  ++here.count;
}

/// By 1 2 1 in both directions, rounded; beyond the model's edge its edge is repeated.
void GroundWriter::add_smoothed(int level, const Row& above, const Row& middle, const Row& below) {
  if (level >= static_cast<int>(levels_.size())) return;
  const auto last = static_cast<int>(middle.size()) - 1;
  const auto down = [&](int i) {
    const auto at = static_cast<size_t>(std::clamp(i, 0, last));
    return int64_t{above[at]} + 2 * int64_t{middle[at]} + int64_t{below[at]};
  };
  Row row;
  for (int i = 0; i <= last; i += 2)
    row.push_back(static_cast<int32_t>((down(i - 1) + 2 * down(i) + down(i + 1) + 8) >> 4));
  add_row(level, std::move(row));
}

/// The row of tiles that ends with the last row; missing samples repeat the model's edge.
void GroundWriter::write_tiles(int level) {
  Level& here = levels_[static_cast<size_t>(level)];
  const HeightLayout& layout = header_.ground.layout;
  const int z = (here.count + (here.rows.size() == tile_samples ? 0 : -1)) / tile_samples;
  for (int x = 0; x < HeightLayout::tiles_on(level, layout.columns); ++x) {
    HeightTile tile;
    for (int j = 0; j < tile_samples; ++j) {
      const Row& row = here.rows[std::min(static_cast<size_t>(j), here.rows.size() - 1)];
      for (int i = 0; i < tile_samples; ++i)
        tile.heights[HeightTile::index(i, j)] =
            row[std::min(static_cast<size_t>(x * tile_samples + i), row.size() - 1)];
    }
    const TileKey key{level, x, z};
    std::vector<Digest> children;
    for (const TileKey child : layout.children(key)) {
      const auto found = orphans_.find(child);
      CHECK(found != orphans_.end());
      children.push_back(found->second);
      orphans_.erase(found);
    }
    const std::vector<uint8_t> bytes = pack_tile(children, tile);
    put_tile(key, bytes);
    orphans_[key] = sha256(bytes);
  }
  here.rows.clear();
}

void GroundWriter::put_tile(TileKey key, std::span<const uint8_t> bytes) {
  index_[index_of(header_.ground.layout, key)] = {written_, static_cast<uint32_t>(bytes.size())};
  write(bytes);
}

void GroundWriter::copy_heights(const GroundModel& ground) {
  CHECK(!heights_done_ && levels_.front().count == 0 && index_.size() == ground.layout().tiles());
  HeightLayout& layout = header_.ground.layout;
  layout = ground.layout();
  for (int level = 0; level < layout.levels(); ++level)
    for (int z = 0; z < HeightLayout::tiles_on(level, layout.rows); ++z)
      for (int x = 0; x < HeightLayout::tiles_on(level, layout.columns); ++x)
        put_tile({level, x, z}, ground.packed({level, x, z}));
  header_.ground.top = sha256(ground.packed(layout.top()));
  heights_done_ = true;
}

/// What is left of the levels once the last row is there.
void GroundWriter::end_heights() {
  if (heights_done_) return;
  CHECK(levels_.front().count == header_.ground.layout.rows);
  for (int level = 0; level < static_cast<int>(levels_.size()); ++level) {
    Level& here = levels_[static_cast<size_t>(level)];
    if (!here.rows.empty()) write_tiles(level);
    const bool middle_is_last = here.count % 2 == 1;
    if (middle_is_last)
      add_smoothed(level + 1, here.count == 1 ? here.last : here.before, here.last, here.last);
  }
  header_.ground.top = orphans_.at(header_.ground.layout.top());
  orphans_.clear();
  heights_done_ = true;
}

void GroundWriter::begin_chunks(const BrickLayout& layout) {
  end_heights();
  header_.ground.bricks = BrickGround{layout, {}};
}

void GroundWriter::add_chunk(TileKey key, const GeneratedChunk& chunk) {
  CHECK(last_material(chunk) <= palette_rows_);
  if (!is_of_format_1(chunk)) header_.format = 2;
  put_chunk(key, &chunk);
}

void GroundWriter::put_chunk(TileKey key, const GeneratedChunk* chunk) {
  CHECK(header_.ground.bricks.has_value());
  const BrickLayout& layout = header_.ground.bricks->layout;
  ChunkChildren children;
  if (key.level > 0) {
    const std::array<TileKey, 8> places = layout.children(key);
    for (size_t i = 0; i < places.size(); ++i)
      if (const auto found = orphans_.find(places[i]); found != orphans_.end()) {
        children[i] = found->second;
        orphans_.erase(found);
      }
  }
  const std::vector<uint8_t> bytes = pack_chunk(key, layout, children, chunk);
  CHECK(chunks_.emplace(key, Entry{written_, static_cast<uint32_t>(bytes.size())}).second);
  orphans_[key] = sha256(bytes);
  write(bytes);
}

void GroundWriter::write_chunk_index() {
  header_.chunk_index_begins = written_;
  if (!header_.ground.bricks) return;
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  writer.u32(static_cast<uint32_t>(chunks_.size()));
  for (const auto& [key, entry] : chunks_) {
    for (const int32_t number : {key.level, key.x, key.y, key.z}) writer.u32(static_cast<uint32_t>(number));
    writer.u64(entry.begins);
    writer.u32(entry.bytes);
  }
  write(bytes);
}

void GroundWriter::write_index() {
  header_.index_begins = written_;
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  for (const Entry& entry : index_) {
    writer.u64(entry.begins);
    writer.u32(entry.bytes);
  }
  write(bytes);
}

Result<GroundHeader> GroundWriter::finish() {
  end_heights();
  TRY(validate(header_.ground.layout));
  if (auto& bricks = header_.ground.bricks) {
    TRY(validate(bricks->layout));
    const TileKey root = bricks->layout.root();
    put_chunk(root, nullptr);
    bricks->root = orphans_.at(root);
    CHECK(orphans_.size() == 1);  // each chunk has a parent
  }
  write_index();
  write_chunk_index();
  failed_ = failed_ || std::fseek(file_.get(), 0, SEEK_SET) != 0;
  const uint64_t bytes = written_;
  write(encode(header_));
  written_ = bytes;
  failed_ = failed_ || std::fflush(file_.get()) != 0 || fsync(fileno(file_.get())) != 0;
  if (failed_ || std::rename(unfinished_.c_str(), path_.c_str()) != 0)
    return fail(path_ + ": it cannot be written: " + std::strerror(errno));
  file_.reset();
  return header_;
}

}  // namespace scree
