// The surface that a slide moves, as columns of voxels: their heights under open air, how deep loose rubble
// lies in each, and how high it lies once what is steeper than its angle of repose has run down. Integers
// alone.
//
// Slopes are those of cells of several columns, about half a metre wide: stones stick out of a heap, and
// stand steeper for their own length. All columns of a cell sink or rise alike, so that the stones keep their
// looks. A step between two columns that is higher than a stone slides by itself first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shared/field/material_window.h"
#include "shared/field/window.h"

namespace scree {

/// Heights are in 256ths of a voxel, from the window's lowest voxel up.
inline constexpr int slide_steps = 256;

/// Layers at the bottom and at the top of a window in which no surface moves.
inline constexpr int slide_margin = 4;

/// A column of voxels.
struct SlideColumn {
  int height = 0;     ///< of its topmost surface
  int floor = 0;      ///< of what lies below the rubble on top of it; its height where none does
  int top = 0;        ///< its topmost solid voxel, from the window's lowest
  int last = 0;       ///< the lowest voxel of the rubble; top + 1 where there is none
  int now = 0;        ///< height after steps slid
  bool open = false;  ///< its surface lies in the window, away from bottom and top
  int shift = 0;      ///< by which the surface moves
};

/// What slides, and how: see SlideOperation.
struct SlideTerms {
  VoxelBox box;
  Material material{};
  int tangent = 48;  ///< of the angle of repose, in 64ths
  int cell = 1;      ///< columns of a cell, along each side
};

/// The columns of a window. A row of numbers per voxel of x, as in the window.
class SlideColumns {
 public:
  /// Both have the same box, which holds that of the terms with a margin.
  SlideColumns(const MaterialReader& materials, const Window& codes, const SlideTerms& terms);

  /// The greatest slope, in 64ths, from a cell that has rubble to give down to one that can take it; 0: none.
  int steepest() const;
  /// Lets rubble run down, and sets the columns' shifts. False when none moves.
  bool run();
  /// Lowers columns by as much in sum as this raises others: by `more` (256ths, over all columns) more.
  bool share_out(int64_t more);

  int size_x() const { return size_.x; }
  int size_z() const { return size_.z; }
  const SlideColumn& at(int x, int z) const { return columns_[index(x, z)]; }
  /// Whether run() wants the column to move, by whatever share_out() leaves of that.
  bool wants_to_move(int x, int z) const { return wanted_[index(x, z)] != 0; }

 private:
  struct Cell {
    int height = 0, before = 0;
    int available = 0;  ///< height that it can give
    int sill = 0;       ///< what flows in must lie higher
    bool open = false, rim = false;
  };
  struct Pair {
    int dx, dz;
    int distance;  ///< in 128ths of a cell
  };
  static constexpr Pair pairs[4] = {{1, 0, 128}, {0, 1, 128}, {1, 1, 181}, {1, -1, 181}};

  size_t index(int x, int z) const { return static_cast<size_t>(x) * static_cast<size_t>(size_.z) + z; }
  void read_column(const MaterialReader& materials, const Window& codes, int x, int z);
  bool flow_columns(SlideColumn& a, SlideColumn& b, int distance);
  bool sweep_columns(bool backward);
  int highest_step() const;
  template <typename F>
  void for_each_step(bool backward, F&& f) const;
  void make_cells();
  bool flow(Cell& a, Cell& b, const Pair& pair);
  bool sweep(bool backward);
  int shift_at(int x, int z) const;
  Cell& cell(int x, int z) { return cells_[static_cast<size_t>(x * cells_z_ + z)]; }
  const Cell& cell(int x, int z) const { return cells_[static_cast<size_t>(x * cells_z_ + z)]; }
  int threshold(const Pair& pair) const;
  /// What a step between two columns at that distance, in 128ths, may have.
  int step_threshold(int distance) const;

  VoxelBox window_;
  VoxelCoord size_;
  SlideTerms terms_;
  std::vector<SlideColumn> columns_;
  std::vector<Cell> cells_;
  std::vector<int> wanted_;  ///< shifts of the columns, before they are shared out
  int cells_x_ = 0, cells_z_ = 0;
};

}  // namespace scree
