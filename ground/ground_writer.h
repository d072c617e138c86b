// Writes a ground file from rows of heights, north to south. Of each level it keeps the rows of one tile and
// the hashes that wait for their parent, so that its memory is bounded by the model's width.
//
// The file is written under another name and renamed at the end: no half of one is left behind.
#pragma once

#include <cstdio>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "ground/ground_header.h"

namespace scree {

class GroundWriter {
 public:
  /// `layout`: a valid one, whose lowest and highest are of no account; they are those of the rows.
  static Result<std::unique_ptr<GroundWriter>> create(const std::string& path, const HeightLayout& layout,
                                                      float zero_m);
  /// Without finish(), nothing is left behind.
  ~GroundWriter();
  GroundWriter(const GroundWriter&) = delete;
  GroundWriter& operator=(const GroundWriter&) = delete;

  /// The next row, of as many heights as there are columns, in 1/256 m.
  void add_row(std::span<const int32_t> heights);
  /// After all rows. The error says why the file cannot be written, or what is wrong with the heights.
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
  void write_index();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  const std::string path_;
  const std::string unfinished_;
  std::unique_ptr<std::FILE, Close> file_;
  GroundHeader header_;
  std::vector<Level> levels_;
  std::vector<Entry> index_;
  std::map<TileKey, Digest> orphans_;  ///< tiles whose parent is not written yet
  uint64_t written_ = 0;
  bool failed_ = false;
};

}  // namespace scree
