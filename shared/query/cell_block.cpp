#include "shared/query/cell_block.h"

#include <algorithm>
#include <utility>

#include "shared/surface/surface_cells.h"

namespace scree {

namespace {

/// A cell beside a crossed edge, from the edge's voxel, and which of its edges that is: in a cycle that is
/// counter-clockwise around the edge's direction. As surface_nets has them.
struct AroundEdge {
  VoxelCoord cell;
  int edge;
};
constexpr std::array<std::array<AroundEdge, 4>, 3> around_edge = {{
    {{{{0, -1, -1}, 3}, {{0, 0, -1}, 1}, {{0, 0, 0}, 0}, {{0, -1, 0}, 2}}},
    {{{{-1, 0, -1}, 7}, {{-1, 0, 0}, 6}, {{0, 0, 0}, 4}, {{0, 0, -1}, 5}}},
    {{{{-1, -1, 0}, 11}, {{0, -1, 0}, 9}, {{0, 0, 0}, 8}, {{-1, 0, 0}, 10}}},
}};

int squared_length_between(const SurfacePoint& a, const SurfacePoint& b) {
  int sum = 0;
  for (size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// Strictly inside the cell, 1/256 voxel.
uint32_t step_into_cell(float part) {
  return static_cast<uint32_t>(std::clamp(static_cast<int>(part * surface_steps_per_voxel + 0.5F), 1, 255));
}

}  // namespace

CellBlock::CellBlock(BrickCoord coord, const Code* codes) : first_(first_voxel(coord)) {
  std::copy_n(codes, codes_.size(), codes_.data());
  constexpr int rows = brick_size + 1;
  // Bit z: the voxel is rock.
  std::array<std::array<uint32_t, rows>, rows> rock{};
  for (int x = 0; x < rows; ++x)
    for (int y = 0; y < rows; ++y) {
      const Code* row = codes_.data() + index({x, y, 0});
      uint32_t bits = 0;
      for (uint32_t z = 0; z < rows; ++z) bits |= static_cast<uint32_t>(row[z] < 0) << z;
      rock[static_cast<size_t>(x)][static_cast<size_t>(y)] = bits;
    }
  for (size_t x = 0; x < brick_size; ++x)
    for (size_t y = 0; y < brick_size; ++y) {
      const uint32_t any = rock[x][y] | rock[x][y + 1] | rock[x + 1][y] | rock[x + 1][y + 1];
      const uint32_t all = rock[x][y] & rock[x][y + 1] & rock[x + 1][y] & rock[x + 1][y + 1];
      const uint64_t cells = ((any | (any >> 1U)) & ~(all & (all >> 1U))) & 255U;
      active_[x] |= cells << (y * brick_size);
    }
}

bool CellBlock::any() const {
  return std::ranges::any_of(active_, [](uint64_t word) { return word != 0; });
}

uint32_t CellBlock::signs_at(int index) const {
  uint32_t signs = 0;
  for (int i = 0; i < cell_corners; ++i) {
    const int corner = index + (i >> 2) * side * side + ((i >> 1) & 1) * side + (i & 1);
    signs |= static_cast<uint32_t>(codes_[static_cast<size_t>(corner)] < 0) << i;
  }
  return signs;
}

/// The edges of the sheet that crosses one of them, in a cell that has several, or a pinched face.
uint16_t CellBlock::edges_of(VoxelCoord cell, uint32_t signs, int edge) const {
  const CellTables& tables = cell_tables();
  const CellCase* sheets = &tables.joined[signs];
  if (sheets->pinched_face != no_face) {
    const int axis = sheets->pinched_face / 2, step = sheets->pinched_face % 2 == 1 ? 1 : -1;
    const VoxelCoord across{cell.x + (axis == 0 ? step : 0), cell.y + (axis == 1 ? step : 0),
                            cell.z + (axis == 2 ? step : 0)};
    if (tables.joined[signs_at(index(across))].pinched_face == (sheets->pinched_face ^ 1U))
      sheets = &tables.split[signs];
  }
  const uint8_t sheet = sheets->sheet_of_edge[static_cast<size_t>(edge)];
  CHECK_DEBUG(sheet != no_sheet);
  return sheets->edges_of_sheet[sheet];
}

SurfacePoint CellBlock::vertex(VoxelCoord cell, int edge) const {
  const auto place = [&](uint32_t in) {
    return SurfacePoint{(first_.x + cell.x) * surface_steps + static_cast<int>(in & 255U),
                        (first_.y + cell.y) * surface_steps + static_cast<int>((in >> 8U) & 255U),
                        (first_.z + cell.z) * surface_steps + static_cast<int>(in >> 16U)};
  };
  uint32_t& known =
      known_[static_cast<size_t>(((cell.x + 1) * vertex_side + cell.y + 1) * vertex_side + cell.z + 1)];
  if (known != 0) return place(known);
  const CellTables& tables = cell_tables();
  const int lowest = index(cell);
  const uint32_t signs = signs_at(lowest);
  const uint16_t only = tables.only_sheet[signs];
  const uint16_t edges = only != 0 ? only : edges_of(cell, signs, edge);
  // The mean of the crossings, added in the order in which add_sheet_vertices does.
  std::array<float, 3> sums{};
  float count = 0.0F;
  for (size_t e = 0; e < cell_edges; ++e) {
    if (((edges >> e) & 1U) == 0) continue;
    const auto code = [&](uint8_t corner) {
      const int at = lowest + (corner >> 2) * side * side + ((corner >> 1) & 1) * side + (corner & 1);
      return static_cast<float>(codes_[static_cast<size_t>(at)]);
    };
    const CellEdge ends = tables.edges[e];
    const float from = code(ends.from), to = code(ends.to);
    for (size_t axis = 0; axis < 3; ++axis) {
      if (axis == e / 4)
        sums[axis] += from / (from - to);
      else
        sums[axis] += static_cast<float>((ends.from >> (2 - axis)) & 1);
    }
    count += 1.0F;
  }
  const uint32_t in = step_into_cell(sums[0] / count) | (step_into_cell(sums[1] / count) << 8U) |
                      (step_into_cell(sums[2] / count) << 16U);
  if (only != 0) known = in;
  return place(in);
}

SurfaceQuad CellBlock::quad(VoxelCoord from, int axis) const {
  CHECK_DEBUG(is_crossed(from, axis));
  std::array<SurfacePoint, 4> corners;
  const auto& cells = around_edge[static_cast<size_t>(axis)];
  for (size_t i = 0; i < 4; ++i) corners[i] = vertex(from + cells[i].cell, cells[i].edge);
  if (codes_[static_cast<size_t>(index(from))] >= 0) std::swap(corners[1], corners[3]);
  const auto& [a, b, c, d] = corners;
  if (squared_length_between(a, c) > squared_length_between(b, d)) return {{{d, a, b}, {d, b, c}}};
  return {{{a, b, c}, {a, c, d}}};
}

}  // namespace scree
