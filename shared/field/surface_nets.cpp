#include "shared/field/surface_nets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "shared/base/check.h"
#include "shared/field/surface_cells.h"

namespace scree {
namespace {

static_assert(std::endian::native == std::endian::little, "sign_bits reads eight codes as one word");

/// How far above the surface the openness is probed: well within the band of ±3 voxels.
constexpr float probe_voxels = 2.75F;

/// Bit i: codes[i] is rock. count <= 64.
uint64_t sign_bits(const Code* codes, int count) {
  uint64_t bits = 0;
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    uint64_t word;
    std::memcpy(&word, codes + i, sizeof(word));
    bits |= (((word & 0x8080808080808080ULL) * 0x0002040810204081ULL) >> 56U) << i;
  }
  for (; i < count; ++i) bits |= static_cast<uint64_t>(codes[i] < 0) << i;
  return bits;
}

int rounded(float value) {
  return static_cast<int>(value + (value < 0.0F ? -0.5F : 0.5F));
}

/// The four rows of voxels around a row of cells, as sign bits.
struct SignRows {
  uint64_t r00, r01, r10, r11;

  /// Cells that the surface crosses.
  uint64_t active() const {
    const uint64_t any = r00 | r01 | r10 | r11;
    const uint64_t all = r00 & r01 & r10 & r11;
    return (any | (any >> 1U)) & ~(all & (all >> 1U));
  }
  uint32_t signs(int i) const {
    const auto pair = [i](uint64_t row) { return static_cast<uint32_t>(row >> i) & 3U; };
    return pair(r00) | (pair(r01) << 2U) | (pair(r10) << 4U) | (pair(r11) << 6U);
  }
};

/// Trilinear weights and reads at a fraction of a cell.
struct CellReader {
  std::ptrdiff_t stride_x;
  std::ptrdiff_t stride_y;

  std::ptrdiff_t corner(int i) const { return (i >> 2) * stride_x + ((i >> 1) & 1) * stride_y + (i & 1); }

  static std::array<float, cell_corners> weights(glm::vec3 f) {
    const glm::vec3 g = 1.0F - f;
    return {g.x * g.y * g.z, g.x * g.y * f.z, g.x * f.y * g.z, g.x * f.y * f.z,
            f.x * g.y * g.z, f.x * g.y * f.z, f.x * f.y * g.z, f.x * f.y * f.z};
  }
  float value(const Code* cell, const std::array<float, cell_corners>& w) const {
    float sum = 0.0F;
    for (int i = 0; i < cell_corners; ++i)
      sum += w[static_cast<size_t>(i)] * static_cast<float>(cell[corner(i)]);
    return sum;
  }
  /// Central differences at the corners, interpolated: twice the step that a cell's own differences would
  /// have, so half the noise of the 8 bits.
  glm::vec3 gradient(const Code* cell, const std::array<float, cell_corners>& w) const {
    glm::vec3 sum(0.0F);
    for (int i = 0; i < cell_corners; ++i) {
      const Code* c = cell + corner(i);
      sum += w[static_cast<size_t>(i)] * glm::vec3(static_cast<float>(c[stride_x] - c[-stride_x]),
                                                   static_cast<float>(c[stride_y] - c[-stride_y]),
                                                   static_cast<float>(c[1] - c[-1]));
    }
    return sum;
  }
};

struct CellSlot {
  uint32_t first_vertex;
  const CellCase* sheets;
};

class Builder {
 public:
  Builder(const Window& window, const VoxelBox& owned, const Window* before)
      : window_(window), before_(before), tables_(cell_tables()) {
    const VoxelCoord size = window.box.size();
    reader_ = {static_cast<std::ptrdiff_t>(size.y) * size.z, size.z};
    cells_ = owned.size() + VoxelCoord{1, 1, 1};
    origin_ = owned.lo - VoxelCoord{1, 1, 1};
    mesh_.origin = origin_;
  }

  SurfaceMesh build() {
    for (int z = 0; z < cells_.z; z += segment_cells) build_segment(z, std::min(segment_cells, cells_.z - z));
    return std::move(mesh_);
  }

 private:
  /// Cells of a row that one word of signs covers: one voxel more than cells.
  static constexpr int segment_cells = 63;

  const Code* codes_at(int x, int y, int z) const {
    return window_.codes.data() + window_.index(origin_.x + x, origin_.y + y, origin_.z + z);
  }
  CellSlot& slot(int x, int y, int z) {
    return slots_[static_cast<size_t>((x * cells_.y + y) * cells_.z + z)];
  }

  /// The signs of every voxel row; whether both signs occur at all.
  bool read_signs(int z, int count) {
    const int rows_y = cells_.y + 1;
    rows_.resize(static_cast<size_t>((cells_.x + 1) * rows_y));
    uint64_t any = 0;
    uint64_t all = ~uint64_t{0};
    for (int x = 0; x <= cells_.x; ++x) {
      for (int y = 0; y < rows_y; ++y) {
        const uint64_t row = sign_bits(codes_at(x, y, z), count + 1);
        rows_[static_cast<size_t>(x * rows_y + y)] = row;
        any |= row;
        all &= row;
      }
    }
    const uint64_t full = count == segment_cells ? ~uint64_t{0} : (uint64_t{1} << (count + 1)) - 1;
    return any != 0 && all != full;
  }

  void build_segment(int z, int count) {
    if (!read_signs(z, count)) return;
    if (!slots_) {
      slots_ = std::make_unique_for_overwrite<CellSlot[]>(static_cast<size_t>(cells_.x) *
                                                          static_cast<size_t>(cells_.y * cells_.z));
    }
    const uint64_t mask = (uint64_t{1} << count) - 1;
    const auto rows_y = static_cast<size_t>(cells_.y + 1);
    for (int x = 0; x < cells_.x; ++x) {
      for (int y = 0; y < cells_.y; ++y) {
        const uint64_t* row = &rows_[static_cast<size_t>(x) * rows_y + static_cast<size_t>(y)];
        const SignRows signs{row[0], row[1], row[rows_y], row[rows_y + 1]};
        for (uint64_t left = signs.active() & mask; left != 0; left &= left - 1) {
          const int i = std::countr_zero(left);
          build_cell(x, y, z + i, signs.signs(i));
        }
      }
    }
  }

  void build_cell(int x, int y, int z, uint32_t signs) {
    const Code* cell = codes_at(x, y, z);
    CellSlot& mine = slot(x, y, z);
    mine.sheets = case_of(cell, signs);
    mine.first_vertex = static_cast<uint32_t>(mesh_.vertices.size());
    add_vertices(cell, {x, y, z}, *mine.sheets);
    if (x > 0 && y > 0 && z > 0) add_quads(x, y, z, signs);
  }

  const CellCase* case_of(const Code* cell, uint32_t signs) const {
    const CellCase& joined = tables_.joined[signs];
    if (joined.pinched_face == no_face) return &joined;
    const std::array<std::ptrdiff_t, 3> strides{reader_.stride_x, reader_.stride_y, 1};
    const std::ptrdiff_t stride = strides[joined.pinched_face / 2U];
    const bool upper = joined.pinched_face % 2U == 1;
    const Code* neighbour = cell + (upper ? stride : -stride);
    uint32_t across = 0;
    for (int i = 0; i < cell_corners; ++i)
      across |= static_cast<uint32_t>(neighbour[reader_.corner(i)] < 0) << i;
    const bool both = tables_.joined[across].pinched_face == (joined.pinched_face ^ 1U);
    return both ? &tables_.split[signs] : &joined;
  }

  void add_vertices(const Code* cell, VoxelCoord at, const CellCase& sheets) {
    std::array<glm::vec3, 4> sums{};
    std::array<float, 4> counts{};
    for (size_t e = 0; e < cell_edges; ++e) {
      const uint8_t sheet = sheets.sheet_of_edge[e];
      if (sheet == no_sheet) continue;
      const CellEdge edge = tables_.edges[e];
      const auto a = static_cast<float>(cell[reader_.corner(edge.from)]);
      const auto b = static_cast<float>(cell[reader_.corner(edge.to)]);
      glm::vec3 p(edge.from >> 2U, (edge.from >> 1U) & 1U, edge.from & 1U);
      p[static_cast<int>(e / 4)] = a / (a - b);
      sums[sheet] += p;
      counts[sheet] += 1.0F;
    }
    for (size_t s = 0; s < sheets.sheets; ++s) add_vertex(cell, at, sums[s] / counts[s]);
  }

  void add_vertex(const Code* cell, VoxelCoord at, glm::vec3 f) {
    const std::array<float, cell_corners> weights = CellReader::weights(f);
    glm::vec3 normal = reader_.gradient(cell, weights);
    const float length = std::sqrt(glm::dot(normal, normal));
    normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F);
    SurfaceVertex vertex;
    const auto step = [](int whole, float part) {
      // Strictly inside the cell, so that no two cells' vertices ever coincide and edges keep their ends.
      const int inner = std::clamp(static_cast<int>(part * surface_steps_per_voxel + 0.5F), 1, 255);
      return static_cast<uint16_t>(whole * static_cast<int>(surface_steps_per_voxel) + inner);
    };
    vertex.position = {step(at.x, f.x), step(at.y, f.y), step(at.z, f.z)};
    for (int i = 0; i < 3; ++i)
      vertex.normal[static_cast<size_t>(i)] = static_cast<int8_t>(rounded(normal[i] * 127.0F));
    vertex.openness = openness(cell, f + normal * probe_voxels);
    if (before_ != nullptr) {
      const Code* then = before_->codes.data() + (cell - window_.codes.data());
      vertex.before = static_cast<Code>(rounded(reader_.value(then, weights)));
    }
    mesh_.vertices.push_back(vertex);
  }

  /// Over open ground the distance grows as fast as one climbs; in a crevice it does not.
  uint8_t openness(const Code* cell, glm::vec3 f) const {
    // f > −4, so that truncation after a shift is floor.
    const glm::ivec3 base = glm::ivec3(f + 4.0F) - 4;
    const Code* there = cell + base.x * reader_.stride_x + base.y * reader_.stride_y + base.z;
    const float found = reader_.value(there, CellReader::weights(f - glm::vec3(base)));
    const float ratio = found / (probe_voxels * codes_per_voxel);
    return static_cast<uint8_t>(std::clamp(ratio, 0.0F, 1.0F) * 255.0F + 0.5F);
  }

  uint32_t vertex_of(const CellSlot& cell, size_t edge) const {
    return cell.first_vertex + cell.sheets->sheet_of_edge[edge];
  }

  /// Quads of the three edges that leave the cell's lowest voxel: this cell and three before it surround
  /// each.
  void add_quads(int x, int y, int z, uint32_t signs) {
    const bool rock = (signs & 1U) != 0;
    const CellSlot& c = slot(x, y, z);
    if (((signs >> 4U) & 1U) != static_cast<uint32_t>(rock))
      add_quad(vertex_of(slot(x, y - 1, z - 1), 3), vertex_of(slot(x, y, z - 1), 1), vertex_of(c, 0),
               vertex_of(slot(x, y - 1, z), 2), rock);
    if (((signs >> 2U) & 1U) != static_cast<uint32_t>(rock))
      add_quad(vertex_of(slot(x - 1, y, z - 1), 7), vertex_of(slot(x - 1, y, z), 6), vertex_of(c, 4),
               vertex_of(slot(x, y, z - 1), 5), rock);
    if (((signs >> 1U) & 1U) != static_cast<uint32_t>(rock))
      add_quad(vertex_of(slot(x - 1, y - 1, z), 11), vertex_of(slot(x, y - 1, z), 9), vertex_of(c, 8),
               vertex_of(slot(x - 1, y, z), 10), rock);
  }

  /// Counter-clockwise around the edge's direction when its start is rock. Split along the shorter diagonal.
  void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool forward) {
    if (!forward) std::swap(b, d);
    const bool ac = squared_length(a, c) <= squared_length(b, d);
    const std::array<uint32_t, 6> triangles =
        ac ? std::array<uint32_t, 6>{a, b, c, a, c, d} : std::array<uint32_t, 6>{a, b, d, b, c, d};
    mesh_.indices.insert(mesh_.indices.end(), triangles.begin(), triangles.end());
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
  const CellTables& tables_;
  CellReader reader_{};
  VoxelCoord cells_;   ///< cells a side: the owned voxels' and one before them
  VoxelCoord origin_;  ///< lowest voxel of cell (0, 0, 0)
  SurfaceMesh mesh_;
  std::vector<uint64_t> rows_;
  std::unique_ptr<CellSlot[]> slots_;  ///< only those of crossed cells are written, and read
};

}  // namespace

SurfaceMesh surface_nets(const Window& window, const VoxelBox& owned, const Window* before) {
  const VoxelBox needed = owned.grown(surface_nets_apron);
  const VoxelBox& box = window.box;
  CHECK(box.lo.x <= needed.lo.x && box.lo.y <= needed.lo.y && box.lo.z <= needed.lo.z);
  CHECK(box.hi.x >= needed.hi.x && box.hi.y >= needed.hi.y && box.hi.z >= needed.hi.z);
  const VoxelCoord size = owned.size();
  CHECK(!owned.empty() && std::max({size.x, size.y, size.z}) <= surface_side_max);
  CHECK(before == nullptr || before->codes.size() == window.codes.size());
  return Builder(window, owned, before).build();
}

SurfaceMesh surface_nets_closed(const Window& volume, const Window* before) {
  if (volume.box.empty()) return {};
  // One voxel of air on every side closes the surface.
  const VoxelBox owned = volume.box.grown(1);
  Window padded(owned.grown(surface_nets_apron));
  const VoxelCoord size = volume.box.size();
  const auto copy = [&](const Window& from, Window& to) {
    for (int x = volume.box.lo.x; x < volume.box.hi.x; ++x)
      for (int y = volume.box.lo.y; y < volume.box.hi.y; ++y)
        std::copy_n(&from.codes[from.index(x, y, volume.box.lo.z)], size.z, &to.at(x, y, volume.box.lo.z));
  };
  copy(volume, padded);
  if (before == nullptr) return surface_nets(padded, owned);
  Window padded_before(padded.box);
  copy(*before, padded_before);
  return surface_nets(padded, owned, &padded_before);
}

}  // namespace scree
