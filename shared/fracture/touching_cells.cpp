#include "shared/fracture/touching_cells.h"

#include <array>
#include <bit>
#include <cstdint>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

/// A set of cells, a word of bits; a volume of more cells than bits has several such sets a cell.
constexpr size_t word_bits = 64;

/// Which cells touch which: a symmetric matrix of bits.
class TouchMatrix {
 public:
  explicit TouchMatrix(size_t cells)
      : cells_(cells), words_((cells + word_bits - 1) / word_bits), bits_(cells * words_) {}

  void set(CellLabel a, CellLabel b) {
    CHECK_DEBUG(a < cells_ && b < cells_);
    bits_[a * words_ + b / word_bits] |= uint64_t{1} << (b % word_bits);
  }
  /// Where a row is one word: adds a set of cells to it.
  void set_all(CellLabel a, uint64_t those) { bits_[a] |= those; }

  /// Pairs (low, high), sorted, of those set either way.
  std::vector<std::pair<CellLabel, CellLabel>> pairs() {
    for_each([&](size_t a, size_t b) { set(static_cast<CellLabel>(b), static_cast<CellLabel>(a)); });
    std::vector<std::pair<CellLabel, CellLabel>> out;
    for_each([&](size_t a, size_t b) {
      if (a < b) out.emplace_back(static_cast<CellLabel>(a), static_cast<CellLabel>(b));
    });
    return out;
  }

 private:
  template <typename F>
  void for_each(F&& f) const {
    for (size_t a = 0; a < cells_; ++a)
      for (size_t w = 0; w < words_; ++w)
        for (uint64_t left = bits_[a * words_ + w]; left != 0; left &= left - 1)
          f(a, w * word_bits + static_cast<size_t>(std::countr_zero(left)));
  }

  size_t cells_;
  size_t words_;
  std::vector<uint64_t> bits_;
};

/// Half of a voxel's 26 neighbours, as steps in a window: of two voxels that touch, one is ahead of the
/// other. Cells that meet only along an edge still bound each other.
std::array<ptrdiff_t, 13> steps_ahead(ptrdiff_t step_x, ptrdiff_t step_y) {
  constexpr int ahead[13][3] = {{0, 0, 1},  {0, 1, -1}, {0, 1, 0},  {0, 1, 1}, {1, -1, -1},
                                {1, -1, 0}, {1, -1, 1}, {1, 0, -1}, {1, 0, 0}, {1, 0, 1},
                                {1, 1, -1}, {1, 1, 0},  {1, 1, 1}};
  std::array<ptrdiff_t, 13> steps;
  for (size_t k = 0; k < steps.size(); ++k)
    steps[k] = ahead[k][0] * step_x + ahead[k][1] * step_y + ahead[k][2];
  return steps;
}

/// For many cells: neighbour by neighbour.
void touch_one_by_one(const Window& volume, const std::vector<CellLabel>& labels, TouchMatrix& touch) {
  const VoxelCoord size = volume.box.size();
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  const std::array<ptrdiff_t, 13> steps = steps_ahead(step_x, step_y);
  for (int x = 1; x + 1 < size.x; ++x)
    for (int y = 1; y + 1 < size.y; ++y)
      for (int z = 1; z + 1 < size.z; ++z) {
        const ptrdiff_t i = x * step_x + y * step_y + z;
        if (volume.codes[static_cast<size_t>(i)] == code_air) continue;
        const CellLabel here = labels[static_cast<size_t>(i)];
        for (const ptrdiff_t step : steps) {
          const auto j = static_cast<size_t>(i + step);
          const CellLabel there = labels[j];
          if (here == there || volume.codes[j] == code_air) continue;
          touch.set(here, there);
        }
      }
}

/// A plane of voxels: the bit of each one's cell, none in air; and those of it and both neighbours along z.
struct MarkedPlane {
  std::vector<uint64_t> own;
  std::vector<uint64_t> rows;

  explicit MarkedPlane(size_t count) : own(count), rows(count) {}
};

SCREE_VECTOR_CLONES void mark(const Code* __restrict codes, const CellLabel* __restrict labels, size_t count,
                              uint64_t* __restrict own, uint64_t* __restrict rows) {
  for (size_t i = 0; i < count; ++i)
    own[i] = static_cast<uint64_t>(codes[i] != code_air ? 1 : 0) << labels[i];
  for (size_t i = 1; i + 1 < count; ++i) rows[i] = own[i - 1] | own[i] | own[i + 1];
}

/// The cells ahead of each of `count` voxels: the next one along z, three along y, nine along x.
SCREE_VECTOR_CLONES void read_ahead(size_t count, ptrdiff_t step_y, const uint64_t* __restrict own,
                                    const uint64_t* __restrict rows, const uint64_t* __restrict rows_beyond,
                                    uint64_t* __restrict ahead) {
  for (size_t n = 0; n < count; ++n) {
    const auto i = static_cast<ptrdiff_t>(n);
    ahead[i] =
        own[i + 1] | rows[i + step_y] | rows_beyond[i - step_y] | rows_beyond[i] | rows_beyond[i + step_y];
  }
}

/// For at most as many cells as a word has bits: joins sets of cells without asking for their members.
/// Neighbours' cells differ as often as not, so branches would be mispredicted half the time.
void touch_by_words(const Window& volume, const std::vector<CellLabel>& labels, TouchMatrix& touch) {
  const VoxelCoord size = volume.box.size();
  if (std::min({size.x, size.y, size.z}) < 3) return;
  const auto step_y = static_cast<size_t>(size.z), plane = static_cast<size_t>(size.y) * step_y;
  MarkedPlane here(plane), beyond(plane);
  std::vector<uint64_t> ahead(plane);
  const auto mark_plane = [&](size_t x, MarkedPlane& to) {
    mark(&volume.codes[x * plane], &labels[x * plane], plane, to.own.data(), to.rows.data());
  };
  mark_plane(1, beyond);
  for (size_t x = 1; x + 1 < static_cast<size_t>(size.x); ++x) {
    std::swap(here, beyond);
    mark_plane(x + 1, beyond);
    read_ahead(plane - 2 * step_y, static_cast<ptrdiff_t>(step_y), &here.own[step_y], &here.rows[step_y],
               &beyond.rows[step_y], &ahead[step_y]);
    for (size_t row = step_y; row + step_y < plane; row += step_y)
      for (size_t i = row + 1; i + 1 < row + step_y; ++i)
        if (here.own[i] != 0) touch.set_all(labels[x * plane + i], ahead[i]);
  }
}

}  // namespace

std::vector<std::pair<CellLabel, CellLabel>> touching_cells(const Window& volume,
                                                            const std::vector<CellLabel>& labels,
                                                            size_t cells) {
  CHECK_EQ(labels.size(), volume.codes.size());
  if (cells == 1) return {};
  TouchMatrix touch(cells);
  if (cells <= word_bits)
    touch_by_words(volume, labels, touch);
  else
    touch_one_by_one(volume, labels, touch);
  return touch.pairs();
}

}  // namespace scree
