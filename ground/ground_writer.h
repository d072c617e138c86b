// Writes a ground file from rows of heights, north to south, or from the tiles of another ground; then the
// chunks that it stores, fine ones first. It keeps, for each level, the rows of one tile and the hashes that
// wait for their parent, and the place of each stored chunk. So the model's width bounds its memory.
//
// The file is written under another name and renamed at the end: no half of one is left behind.
#pragma once

#include <cstdio>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "content/builtin_palette.h"
#include "ground/ground_header.h"

namespace scree {

class GroundWriter {
 public:
  /// `layout`: a valid one, whose lowest and highest are of no account; they are those of the rows.
  /// `palette`: what its materials are rows of.
  static Result<std::unique_ptr<GroundWriter>> create(const std::string& path, const HeightLayout& layout,
                                                      float zero_m,
                                                      const Palette& palette = builtin_palette());
  /// Without finish(), nothing is left behind.
  ~GroundWriter();
  GroundWriter(const GroundWriter&) = delete;
  GroundWriter& operator=(const GroundWriter&) = delete;

  /// The next row, of as many heights as there are columns, in 1/256 m.
  void add_row(std::span<const int32_t> heights);
  /// In place of rows: the elevation model of another ground, of the same layout.
  void copy_heights(const GroundModel& ground);
  /// After the heights, and before the first chunk.
  void begin_chunks(const BrickLayout& layout);
  /// Its materials are rows of the palette. Chunks of a level come after all of the level below; those below
  /// it are then the last ones added there.
  void add_chunk(TileKey key, const GeneratedChunk& chunk);
  /// After all heights and chunks. The error says why the file cannot be written, or what is wrong with the
  /// heights.
  Result<GroundHeader> finish();
  uint64_t bytes() const { return written_; }

 private:
  using Row = std::vector<int32_t>;
  struct Entry {
    uint64_t begins = 0;
    uint32_t bytes = 0;
  };
  struct Level {
    std::vector<Row> rows;  ///< of the row of tiles that is not written yet
    Row before;             ///< the last two rows
    Row last;
    int count = 0;  ///< rows so far
  };

  GroundWriter(std::string path, const HeightLayout& layout, float zero_m);
  void add_row(int level, Row row);
  void add_smoothed(int level, const Row& above, const Row& middle, const Row& below);
  void write_tiles(int level);
  void write(std::span<const uint8_t> bytes);
  void end_heights();
  void put_tile(TileKey key, std::span<const uint8_t> bytes);
  void put_palette(const Palette& palette);
  void put_chunk(TileKey key, const GeneratedChunk* chunk);
  void write_index();
  void write_chunk_index();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  const std::string path_;
  const std::string unfinished_;
  std::unique_ptr<std::FILE, Close> file_;
  GroundHeader header_;
  std::vector<Level> levels_;
  std::vector<Entry> index_;
  std::map<TileKey, Entry> chunks_;
  std::map<TileKey, Digest> orphans_;  ///< tiles whose parent is not written yet
  bool heights_done_ = false;
  uint64_t written_ = 0;
  size_t palette_rows_ = 0;
  bool failed_ = false;
};

}  // namespace scree
