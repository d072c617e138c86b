#include "shared/surface/surface_nets.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include "shared/base/check.h"
#include "shared/surface/sign_rows.h"
#include "shared/surface/surface_cells.h"
#include "shared/surface/surface_vertices.h"

namespace scree {
namespace {

/// A cell of several sheets.
struct ManySheets {
  uint32_t first_vertex;
  const CellCase* sheets;
};

class NetsBuilder {
 public:
  NetsBuilder(const Window& window, const VoxelBox& owned, const Window* before, const CellMask* mask,
              const SheetPlace* place)
      : window_(window), before_(before), mask_(mask), place_(place), tables_(cell_tables()) {
    const VoxelCoord size = window.box.size();
    stride_x_ = static_cast<std::ptrdiff_t>(size.y) * size.z;
    stride_y_ = size.z;
    cells_ = owned.size() + VoxelCoord{1, 1, 1};
    origin_ = owned.lo - VoxelCoord{1, 1, 1};
    mesh_.origin = origin_;
  }

  SurfaceMesh build() {
    for (int z = 0; z < cells_.z; z += segment_cells) segments_.push_back(read_signs(z));
    for (const Segment& segment : segments_)
      if (segment.crossed) find_sheets(segment);
    if (sheets_.empty()) return std::move(mesh_);
    if (place_ == nullptr) {
      add_sheet_vertices(window_, before_, sheets_, mesh_);
    } else {
      add_placed_vertices(window_, before_, placed_sheets(window_, origin_, sheets_, *place_), mesh_);
    }
    CHECK_EQ(mesh_.vertices.size(), sheets_.size());
    mesh_.indices.resize(quads_ * 6);
    next_index_ = mesh_.indices.data();
    for (const Segment& segment : segments_)
      if (segment.crossed) add_quads(segment);
    CHECK(next_index_ <= mesh_.indices.data() + mesh_.indices.size());
    mesh_.indices.resize(static_cast<size_t>(next_index_ - mesh_.indices.data()));
    return std::move(mesh_);
  }

 private:
  /// Cells of a row that one word of signs covers: one voxel more than cells.
  static constexpr int segment_cells = 63;
  /// In a slot: the rest is an index into many_, not of a vertex.
  static constexpr uint32_t several = 0x80000000U;

  std::ptrdiff_t cell_index(int x, int y, int z) const {
    return static_cast<std::ptrdiff_t>(window_.index(origin_.x + x, origin_.y + y, origin_.z + z));
  }
  uint32_t* slots_of(int x, int y) {
    return &slots_[static_cast<size_t>(x * cells_.y + y) * static_cast<size_t>(cells_.z)];
  }

  /// A stretch along z of all rows.
  struct Segment {
    int z;
    int count;                         ///< cells
    std::unique_ptr<uint64_t[]> rows;  ///< signs of the voxel rows, y fastest
    bool crossed;                      ///< both signs occur

    uint64_t mask() const { return (uint64_t{1} << count) - 1; }
    /// Bits of the cells whose lowest voxels are owned.
    uint64_t owned_mask() const { return z == 0 ? mask() & ~uint64_t{1} : mask(); }
  };

  Segment read_signs(int z) const {
    const int count = std::min(segment_cells, cells_.z - z);
    const int rows_y = cells_.y + 1;
    const auto rows = static_cast<size_t>(cells_.x + 1) * static_cast<size_t>(rows_y);
    Segment segment{z, count, std::make_unique_for_overwrite<uint64_t[]>(rows), false};
    uint64_t any = 0;
    uint64_t all = ~uint64_t{0};
    // Short rows are read together with codes before them: sign_bits needs eight codes.
    const int early = std::max(0, 8 - (count + 1));
    uint64_t* to = segment.rows.get();
    for (int x = 0; x <= cells_.x; ++x) {
      const Code* codes = window_.codes.data() + cell_index(x, 0, z) - early;
      for (int y = 0; y < rows_y; ++y, codes += stride_y_) {
        const uint64_t row = sign_bits(codes, count + 1 + early) >> early;
        *to++ = row;
        any |= row;
        all &= row;
      }
    }
    const uint64_t full = count == segment_cells ? ~uint64_t{0} : (uint64_t{1} << (count + 1)) - 1;
    segment.crossed = any != 0 && all != full;
    return segment;
  }

  /// Which cells of the row count: bit i is cell (x, y, segment.z + i).
  uint64_t counted(int x, int y) const {
    if (mask_ == nullptr) return ~uint64_t{0};
    return mask_->row(origin_.x + x, origin_.y + y) >> (origin_.z - mask_->cells().lo.z);
  }

  SignRows signs_at(const Segment& segment, int x, int y) const {
    const auto rows_y = static_cast<size_t>(cells_.y + 1);
    const uint64_t* row = &segment.rows[static_cast<size_t>(x) * rows_y + static_cast<size_t>(y)];
    return {row[0], row[1], row[rows_y], row[rows_y + 1]};
  }

  void find_sheets(const Segment& segment) {
    if (!slots_) {
      slots_ = std::make_unique_for_overwrite<uint32_t[]>(static_cast<size_t>(cells_.x) *
                                                          static_cast<size_t>(cells_.y * cells_.z));
      sheets_.reserve(512);
    }
    for (int x = 0; x < cells_.x; ++x) {
      for (int y = 0; y < cells_.y; ++y) {
        const SignRows rows = signs_at(segment, x, y);
        uint64_t left = rows.active() & segment.mask() & counted(x, y);
        if (left == 0) continue;
        const std::ptrdiff_t row = cell_index(x, y, segment.z);
        uint32_t* slots = slots_of(x, y);
        for (; left != 0; left &= left - 1) {
          const int i = std::countr_zero(left);
          const uint32_t signs = rows.signs(i);
          const CrossedSheet sheet{
              static_cast<int32_t>(row + i),
              tables_.only_sheet[signs],
              {static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(segment.z + i)}};
          slots[segment.z + i] = static_cast<uint32_t>(sheets_.size());
          quads_ += tables_.first_edges[signs];
          if (sheet.edges != 0) {
            sheets_.push_back(sheet);
          } else {
            slots[segment.z + i] = add_sheets(sheet, signs);
          }
        }
      }
    }
  }

  /// Adds the sheets of a cell that has several, or shares a pinched face. Returns the value of its slot.
  uint32_t add_sheets(CrossedSheet sheet, uint32_t signs) {
    const CellCase& split = case_of(sheet, signs);
    CHECK_DEBUG(split.sheets > 0);
    const auto first = static_cast<uint32_t>(sheets_.size());
    for (size_t s = 0; s < split.sheets; ++s) {
      sheet.edges = split.edges_of_sheet[s];
      sheets_.push_back(sheet);
    }
    if (split.sheets == 1) return first;
    many_.push_back({first, &split});
    return several | static_cast<uint32_t>(many_.size() - 1);
  }

  const CellCase& case_of(const CrossedSheet& sheet, uint32_t signs) const {
    const CellCase& joined = tables_.joined[signs];
    if (joined.pinched_face == no_face) return joined;
    const size_t axis = joined.pinched_face / 2U;
    const int step = joined.pinched_face % 2U == 1 ? 1 : -1;
    if (mask_ != nullptr) {
      std::array<int, 3> across{sheet.at[0], sheet.at[1], sheet.at[2]};
      across[axis] += step;
      if (!mask_->holds(origin_ + VoxelCoord{across[0], across[1], across[2]})) return joined;
    }
    const std::array<std::ptrdiff_t, 3> strides{stride_x_, stride_y_, 1};
    const Code* neighbour = window_.codes.data() + sheet.cell + step * strides[axis];
    uint32_t across = 0;
    for (int i = 0; i < cell_corners; ++i) {
      const std::ptrdiff_t corner = (i >> 2) * stride_x_ + ((i >> 1) & 1) * stride_y_ + (i & 1);
      across |= static_cast<uint32_t>(neighbour[corner] < 0) << i;
    }
    const bool both = tables_.joined[across].pinched_face == (joined.pinched_face ^ 1U);
    return both ? tables_.split[signs] : joined;
  }

  /// A cell beside a crossed edge: its slot, and which of its edges that is.
  struct Corner {
    uint32_t slot;
    size_t edge;
  };

  uint32_t vertex_at(const Corner& corner) const {
    if ((corner.slot & several) == 0) return corner.slot;
    CHECK_DEBUG((corner.slot & ~several) < many_.size());
    const ManySheets& many = many_[corner.slot & ~several];
    return many.first_vertex + many.sheets->sheet_of_edge[corner.edge];
  }

  /// Calls quad(z, whether the voxel is rock) for each bit.
  template <typename Quad>
  static void each_end(uint64_t ends, uint64_t rock, Quad&& quad) {
    for (; ends != 0; ends &= ends - 1) {
      const int z = std::countr_zero(ends);
      quad(z, ((rock >> z) & 1U) != 0);
    }
  }

  /// A quad for each crossed edge that leaves an owned voxel along one of the axes: four cells surround it.
  void add_quads(const Segment& segment) {
    const uint64_t owned = segment.owned_mask();
    for (int x = 1; x < cells_.x; ++x) {
      for (int y = 1; y < cells_.y; ++y) {
        const SignRows rows = signs_at(segment, x, y);
        uint64_t along_x = (rows.r00 ^ rows.r10) & owned, along_y = (rows.r00 ^ rows.r01) & owned,
                 along_z = (rows.r00 ^ (rows.r00 >> 1U)) & owned;
        if ((along_x | along_y | along_z) == 0) continue;
        if (mask_ != nullptr) {
          const uint64_t c00 = counted(x - 1, y - 1), c01 = counted(x - 1, y);
          const uint64_t c10 = counted(x, y - 1), c11 = counted(x, y);
          // Bit 0 of a first segment is not owned; the cell before it, of a later one, is never masked.
          const auto and_before = [](uint64_t cells) { return cells & ((cells << 1U) | 1U); };
          along_x &= and_before(c10 & c11);
          along_y &= and_before(c01 & c11);
          along_z &= c00 & c01 & c10 & c11;
        }
        const uint32_t* s11 = slots_of(x, y) + segment.z;
        const uint32_t* s10 = s11 - cells_.z;
        const uint32_t* s01 = slots_of(x - 1, y) + segment.z;
        const uint32_t* s00 = s01 - cells_.z;
        each_end(along_x, rows.r00, [&](int z, bool rock) {
          add_quad({s10[z - 1], 3}, {s11[z - 1], 1}, {s11[z], 0}, {s10[z], 2}, rock);
        });
        each_end(along_y, rows.r00, [&](int z, bool rock) {
          add_quad({s01[z - 1], 7}, {s01[z], 6}, {s11[z], 4}, {s11[z - 1], 5}, rock);
        });
        each_end(along_z, rows.r00, [&](int z, bool rock) {
          add_quad({s00[z], 11}, {s10[z], 9}, {s11[z], 8}, {s01[z], 10}, rock);
        });
      }
    }
  }

  /// Counter-clockwise around the edge's direction when its start is rock. Split along the shorter diagonal.
  void add_quad(const Corner& a_at, const Corner& b_at, const Corner& c_at, const Corner& d_at,
                bool forward) {
    const uint32_t a = vertex_at(a_at), c = vertex_at(c_at);
    uint32_t b = vertex_at(b_at), d = vertex_at(d_at);
    if (!forward) std::swap(b, d);
    // Chosen without a branch: no predictor could guess which diagonal is shorter.
    const bool bd = squared_length(a, c) > squared_length(b, d);
    const uint32_t first = bd ? d : a, second = bd ? a : b, third = bd ? b : c, fourth = bd ? c : d;
    const std::array<uint32_t, 6> triangles{first, second, third, first, third, fourth};
    next_index_ = std::ranges::copy(triangles, next_index_).out;
  }

  int squared_length(uint32_t a, uint32_t b) const {
    int sum = 0;
    for (size_t i = 0; i < 3; ++i) {
      const int d = mesh_.vertices[a].position[i] - mesh_.vertices[b].position[i];
      sum += d * d;
    }
    return sum;
  }

  const Window& window_;
  const Window* before_;
  const CellMask* mask_;
  const SheetPlace* place_;  ///< or null: at the means of the crossings
  const CellTables& tables_;
  std::ptrdiff_t stride_x_;
  std::ptrdiff_t stride_y_;
  VoxelCoord cells_;   ///< cells a side: the owned voxels' and one before them
  VoxelCoord origin_;  ///< lowest voxel of cell (0, 0, 0)
  SurfaceMesh mesh_;
  std::vector<Segment> segments_;
  uint32_t* next_index_ = nullptr;
  size_t quads_ = 0;  ///< at most
  std::vector<CrossedSheet> sheets_;
  std::vector<ManySheets> many_;
  std::unique_ptr<uint32_t[]> slots_;  ///< only those of crossed cells are written, and read
};

/// Whether the mask knows the owned voxels' cells, those before them, and one more all around; of one
/// segment.
bool is_about(const CellMask& mask, const VoxelBox& owned) {
  const VoxelBox& cells = mask.cells();
  return cells.lo == owned.lo - VoxelCoord{2, 2, 2} && cells.hi == owned.hi + VoxelCoord{1, 1, 1};
}

SurfaceMesh build(const Window& window, const VoxelBox& owned, const Window* before, const CellMask* mask,
                  const SheetPlace* place) {
  const VoxelBox needed = owned.grown(surface_nets_apron);
  CHECK(window.box.covers(needed));
  const VoxelCoord size = owned.size();
  CHECK(!owned.empty() && std::max({size.x, size.y, size.z}) <= surface_side_max);
  CHECK(before == nullptr || before->box == window.box);
  CHECK(mask == nullptr || is_about(*mask, owned));
  return NetsBuilder(window, owned, before, mask, place).build();
}

}  // namespace

SurfaceMesh surface_nets(const Window& window, const VoxelBox& owned, const Window* before,
                         const CellMask* mask) {
  return build(window, owned, before, mask, nullptr);
}

SurfaceMesh surface_nets_placed(const Window& window, const VoxelBox& owned, const Window* before,
                                const CellMask* mask, const SheetPlace& place) {
  return build(window, owned, before, mask, &place);
}

VoxelBox closed_box(const Window& volume) {
  // One voxel of air on every side closes the surface.
  return volume.box.grown(1);
}

Window closed_window(const Window& volume) {
  Window padded(closed_box(volume).grown(surface_nets_apron));
  put(volume, padded);
  return padded;
}

SurfaceMesh surface_nets_closed(const Window& volume) {
  return volume.box.empty() ? SurfaceMesh{} : surface_nets(closed_window(volume), closed_box(volume));
}

}  // namespace scree
