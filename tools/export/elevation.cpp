#include "tools/export/elevation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "shared/field/terrain.h"

namespace scree {

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr size_t side = chunk_size;

/// The columns of one column of chunks, read from the top.
struct Columns {
  std::array<Code, side * side> above;     ///< the code above the next voxel
  std::array<float, side * side> surface;  ///< in voxels; NaN: none so far
  size_t open = side * side;               ///< without a surface so far

  Columns() {
    above.fill(code_air);
    surface.fill(none);
  }
};

/// The highest crossing of a brick's columns, where nothing above has one.
void read_brick(const Brick& brick, VoxelCoord first, VoxelCoord chunk, Columns& columns) {
  for (int x = 0; x < brick_size; ++x)
    for (int z = 0; z < brick_size; ++z) {
      const size_t at =
          static_cast<size_t>(first.x + x - chunk.x) * side + static_cast<size_t>(first.z + z - chunk.z);
      if (!std::isnan(columns.surface[at])) continue;
      for (int y = brick_size - 1; y >= 0; --y) {
        const Code code = brick.codes[static_cast<size_t>(Brick::index(x, y, z))];
        if (code < 0) {
          const float inside = -static_cast<float>(code), outside = static_cast<float>(columns.above[at]);
          columns.surface[at] = static_cast<float>(first.y + y) + inside / (inside + outside);
          --columns.open;
          break;
        }
        columns.above[at] = code;
      }
    }
}

/// The columns of ground as its elevation model has them, where nobody edited it and it stores no bricks:
/// nothing is generated for them. Nothing where the surface comes near the box's top or bottom.
std::optional<Columns> unedited_columns(const Field& field, const ChunkBox& box, int chunk_x, int chunk_z) {
  const TerrainSource& source = field.source();
  if (source.heights == nullptr) return std::nullopt;
  for (int y = box.lo.y; y < box.hi.y; ++y) {
    const ChunkCoord chunk{chunk_x, y, chunk_z};
    const ChunkLookup stored = stored_chunk(source, chunk);
    if (!stored.known || stored.chunk != nullptr || field.has_edits(chunk)) return std::nullopt;
  }
  const HeightPatch patch = heights_at(*source.heights, chunk_x * chunk_size, chunk_z * chunk_size,
                                       chunk_size, source.voxel_size_m);
  const auto voxel_m = static_cast<double>(source.voxel_size_m);
  const double bottom_m = (box.lo.y * chunk_size + 1) * voxel_m,
               top_m = (box.hi.y * chunk_size - 2) * voxel_m;
  if (!patch.exact || patch.lowest_m < bottom_m || patch.highest_m > top_m) return std::nullopt;
  Columns columns;
  for (size_t x = 0; x < side; ++x)
    for (size_t z = 0; z < side; ++z)
      columns.surface[x * side + z] = static_cast<float>(patch.heights_m[z * side + x] / voxel_m);
  return columns;
}

Columns read_columns(Field& field, const ChunkBox& box, int chunk_x, int chunk_z) {
  Columns columns;
  for (int y = box.hi.y - 1; y >= box.lo.y && columns.open > 0; --y) {
    const ChunkCoord chunk{chunk_x, y, chunk_z};
    const BrickCoord lowest = brick_of(first_voxel(chunk));
    for (int by = chunk_bricks - 1; by >= 0; --by)
      for (int bx = 0; bx < chunk_bricks; ++bx)
        for (int bz = 0; bz < chunk_bricks; ++bz) {
          const BrickCoord coord = lowest + BrickCoord{bx, by, bz};
          read_brick(field.brick(coord), first_voxel(coord), first_voxel(chunk), columns);
        }
  }
  return columns;
}

/// Gathers rows of voxels into rows of cells.
class CellRows {
 public:
  CellRows(const ElevationGrid& grid, double voxel_m,
           const std::function<Result<void>(std::span<const float>)>& write_row)
      : grid_(grid), voxel_m_(voxel_m), write_row_(write_row), row_(static_cast<size_t>(grid.columns), none) {
    sums_.lowest_m = std::numeric_limits<double>::infinity();
    sums_.highest_m = -sums_.lowest_m;
  }

  /// `z`: of the voxels, from the box's first. In voxels.
  Result<void> add(int z, std::span<const float> surface) {
    const int cell = cell_of(z);
    if (cell != cell_) TRY(end_row());
    cell_ = cell;
    for (size_t x = 0; x < surface.size(); ++x) {
      float& height_m = row_[static_cast<size_t>(cell_of(static_cast<int>(x)))];
      height_m = std::fmax(height_m, static_cast<float>(surface[x] * voxel_m_));
    }
    return {};
  }
  Result<void> end_row() {
    for (const float height_m : row_) {
      if (std::isnan(height_m)) {
        ++sums_.empty_cells;
        continue;
      }
      sums_.lowest_m = std::min(sums_.lowest_m, static_cast<double>(height_m));
      sums_.highest_m = std::max(sums_.highest_m, static_cast<double>(height_m));
      sums_.volume_m3 += static_cast<double>(height_m) * grid_.cell_m * grid_.cell_m;
    }
    const auto taken = write_row_(row_);
    std::ranges::fill(row_, none);
    return taken;
  }
  const ElevationSums& sums() const { return sums_; }

 private:
  int cell_of(int voxel) const {
    return static_cast<int>((static_cast<double>(voxel) + 0.5) * voxel_m_ / grid_.cell_m);
  }

  const ElevationGrid& grid_;
  const double voxel_m_;
  const std::function<Result<void>(std::span<const float>)>& write_row_;
  int cell_ = 0;
  std::vector<float> row_;
  ElevationSums sums_;
};

}  // namespace

Result<ElevationGrid> elevation_grid(const ChunkBox& box, float voxel_size_m, std::optional<double> cell_m) {
  const auto voxel_m = static_cast<double>(voxel_size_m);
  if (cell_m && !(*cell_m >= voxel_m))
    return fail(fmt::format("cells of {} m are smaller than voxels, {} m", *cell_m, voxel_m));
  const VoxelBox voxels = box.voxels();
  const double cell = cell_m.value_or(voxel_m);
  const auto count = [&](int length) { return static_cast<int>(std::ceil(length * voxel_m / cell)); };
  return ElevationGrid{count(voxels.hi.x - voxels.lo.x), count(voxels.hi.z - voxels.lo.z), cell,
                       (voxels.lo.x - 0.5) * voxel_m, (voxels.lo.z - 0.5) * voxel_m};
}

Result<ElevationSums> each_elevation_row(Field& field, const ChunkBox& box, const ElevationGrid& grid,
                                         const std::function<Result<void>(std::span<const float>)>& write_row,
                                         const std::function<void(double)>& progress) {
  CellRows rows(grid, static_cast<double>(field.source().voxel_size_m), write_row);
  const auto width = static_cast<size_t>(box.hi.x - box.lo.x) * side;
  std::vector<float> surface(side * width);
  for (int z = box.lo.z; z < box.hi.z; ++z) {
    for (int x = box.lo.x; x < box.hi.x; ++x) {
      progress((static_cast<double>(z - box.lo.z) +
                static_cast<double>(x - box.lo.x) / static_cast<double>(box.hi.x - box.lo.x)) /
               static_cast<double>(box.hi.z - box.lo.z));
      const auto unedited = unedited_columns(field, box, x, z);
      const Columns columns = unedited ? *unedited : read_columns(field, box, x, z);
      const size_t first = static_cast<size_t>(x - box.lo.x) * side;
      for (size_t dx = 0; dx < side; ++dx)
        for (size_t dz = 0; dz < side; ++dz)
          surface[dz * width + first + dx] = columns.surface[dx * side + dz];
    }
    for (size_t dz = 0; dz < side; ++dz)
      if (auto added = rows.add((z - box.lo.z) * chunk_size + static_cast<int>(dz),
                                std::span(surface).subspan(dz * width, width));
          !added)
        return tl::unexpected(added.error());
  }
  progress(1.0);
  TRY(rows.end_row());
  if (rows.sums().lowest_m > rows.sums().highest_m) return fail("there is no rock in the box");
  return rows.sums();
}

}  // namespace scree
