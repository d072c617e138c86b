#include "shared/surface/surface_vertices.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

constexpr int batch = 8;
using Lanes = float __attribute__((vector_size(4 * batch)));
using Ints = int32_t __attribute__((vector_size(4 * batch)));

/// How far above the surface the openness is probed: well within the band of ±3 voxels.
constexpr float probe_voxels = 2.75F;

struct Vector3 {
  Lanes x, y, z;
};

/// Byte k of each lane as a code.
SCREE_INLINE void code_of(const Ints& packed, int k, Lanes& code) {
  code = __builtin_convertvector((packed << (24 - 8 * k)) >> 24, Lanes);
}

/// Nearest integer, halves away from zero.
SCREE_INLINE void round_to(const Lanes& value, Ints& whole) {
  whole = __builtin_convertvector(value + (value < 0.0F ? Lanes{} - 0.5F : Lanes{} + 0.5F), Ints);
}

/// Codes of four along z, from one below the cell, for the rows that the gradient at its corners needs.
struct Rows {
  Ints inner[2][2];     ///< [x][y]: the cell's own
  Ints beyond_x[2][2];  ///< [side][y]
  Ints beyond_y[2][2];  ///< [side][x]
};

struct RowLoader {
  std::ptrdiff_t stride_x;
  std::ptrdiff_t stride_y;

  static SCREE_INLINE int32_t four(const Code* codes) {
    int32_t packed;
    std::memcpy(&packed, codes, sizeof(packed));
    return packed;
  }
  static SCREE_INLINE int32_t two(const Code* codes) {
    uint16_t packed;
    std::memcpy(&packed, codes, sizeof(packed));
    return packed;
  }

  SCREE_INLINE void load(const Code* cell, int lane, Rows& rows) const {
    const Code* below = cell - 1;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        rows.inner[i][j][lane] = four(below + i * stride_x + j * stride_y);
        rows.beyond_x[i][j][lane] = four(below + (i == 0 ? -stride_x : 2 * stride_x) + j * stride_y);
        rows.beyond_y[i][j][lane] = four(below + (i == 0 ? -stride_y : 2 * stride_y) + j * stride_x);
      }
    }
  }
  /// The corners of a cell, four to a word.
  SCREE_INLINE void load_corners(const Code* cell, int lane, Ints& low, Ints& high) const {
    low[lane] = two(cell) | (two(cell + stride_y) << 16);
    high[lane] = two(cell + stride_x) | (two(cell + stride_x + stride_y) << 16);
  }
};

SCREE_INLINE void trilinear(const Ints& low, const Ints& high, const Vector3& f, Lanes& value) {
  Lanes c[8];
  for (int k = 0; k < 4; ++k) {
    code_of(low, k, c[k]);
    code_of(high, k, c[k + 4]);
  }
  for (int k = 0; k < 4; ++k) c[k] += f.x * (c[k + 4] - c[k]);
  for (int k = 0; k < 2; ++k) c[k] += f.y * (c[k + 2] - c[k]);
  value = c[0] + f.z * (c[1] - c[0]);
}

/// What is summed up of the crossings.
struct Crossings {
  Lanes c[cell_corners];  ///< codes
  Lanes sums[3];
  Lanes count;
};

/// The crossing of edge e. A template, because which corners and sums it is about is known to the compiler
/// then, and these stay in registers.
template <int e>
SCREE_INLINE void add_crossing(const Ints& edges, Crossings& all) {
  constexpr int axis = e / 4;
  constexpr int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  constexpr int from = ((e & 2) != 0 ? 4 >> u : 0) | ((e & 1) != 0 ? 4 >> v : 0);
  constexpr int to = from | (4 >> axis);
  const Ints bit = (edges >> e) & 1;
  const Lanes one = __builtin_convertvector(bit, Lanes);
  const Lanes t = all.c[from] / (all.c[from] - all.c[to]);
  all.sums[axis] += bit != 0 ? t : Lanes{};
  if constexpr ((e & 2) != 0) all.sums[u] += one;
  if constexpr ((e & 1) != 0) all.sums[v] += one;
  all.count += one;
}

template <int... e>
SCREE_INLINE void add_crossings(std::integer_sequence<int, e...>, const Ints& edges, Crossings& all) {
  (add_crossing<e>(edges, all), ...);
}

/// The mean of the crossings.
SCREE_INLINE void mean_crossing(const Rows& rows, const Ints& edges, Vector3& f) {
  Crossings all{};
  for (int i = 0; i < cell_corners; ++i) code_of(rows.inner[i >> 2][(i >> 1) & 1], 1 + (i & 1), all.c[i]);
  add_crossings(std::make_integer_sequence<int, cell_edges>(), edges, all);
  f = {all.sums[0] / all.count, all.sums[1] / all.count, all.sums[2] / all.count};
}

/// Central differences at the corners, interpolated: twice the step that a cell's own differences would have,
/// so half the noise of the 8 bits. A normal of unit length; straight up where the codes are all the same.
/// `length`: of the differences, codes.
SCREE_INLINE void normal_at(const Rows& rows, const Vector3& f, Vector3& normal, Lanes& length) {
  const Lanes gx = 1.0F - f.x, gy = 1.0F - f.y, gz = 1.0F - f.z;
  Lanes across[2][2], slope[2][2], x_sum[2][2], y_sum[2][2];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      Lanes c[4], a, b;
      for (int k = 0; k < 4; ++k) code_of(rows.inner[i][j], k, c[k]);
      across[i][j] = gz * c[1] + f.z * c[2];
      slope[i][j] = gz * (c[2] - c[0]) + f.z * (c[3] - c[1]);
      code_of(rows.beyond_x[i][j], 1, a);
      code_of(rows.beyond_x[i][j], 2, b);
      x_sum[i][j] = gz * a + f.z * b;
      code_of(rows.beyond_y[i][j], 1, a);
      code_of(rows.beyond_y[i][j], 2, b);
      y_sum[i][j] = gz * a + f.z * b;
    }
  }
  const Lanes x0 = gx * (across[1][0] - x_sum[0][0]) + f.x * (x_sum[1][0] - across[0][0]);
  const Lanes x1 = gx * (across[1][1] - x_sum[0][1]) + f.x * (x_sum[1][1] - across[0][1]);
  const Lanes y0 = gy * (across[0][1] - y_sum[0][0]) + f.y * (y_sum[1][0] - across[0][0]);
  const Lanes y1 = gy * (across[1][1] - y_sum[0][1]) + f.y * (y_sum[1][1] - across[1][0]);
  const Lanes x = gy * x0 + f.y * x1;
  const Lanes y = gx * y0 + f.x * y1;
  const Lanes z = gx * (gy * slope[0][0] + f.y * slope[0][1]) + f.x * (gy * slope[1][0] + f.y * slope[1][1]);
  length = x * x + y * y + z * z;
  for (int i = 0; i < batch; ++i) length[i] = __builtin_sqrtf(length[i]);
  const Ints flat = length == 0.0F;
  const Lanes scale = 1.0F / (flat ? Lanes{} + 1.0F : length);
  normal = {x * scale, flat ? Lanes{} + 1.0F : y * scale, z * scale};
}

struct Source {
  const Code* now;
  const Code* before;  ///< or null
  RowLoader rows;
};

/// Eight vertices on their way.
struct Batch {
  int32_t cells[batch];
  Ints edges;
  Ints x, y, z;  ///< cell, then position
  Rows rows;
  Vector3 f;
  Vector3 normal;
  Lanes difference;  ///< length of the central differences, codes
  Vector3 probe;     ///< fraction of the cell that the openness is probed in
  Ints probed;       ///< that cell's offset
  Ints above_low, above_high;
  Ints before_low, before_high;
};

/// Where to probe the openness.
SCREE_INLINE void aim(const Source& source, Batch& b) {
  normal_at(b.rows, b.f, b.normal, b.difference);
  b.probe = {b.f.x + b.normal.x * probe_voxels, b.f.y + b.normal.y * probe_voxels,
             b.f.z + b.normal.z * probe_voxels};
  // The probe is > −4, so that truncation after a shift is floor.
  const Ints x = __builtin_convertvector(b.probe.x + 4.0F, Ints) - 4;
  const Ints y = __builtin_convertvector(b.probe.y + 4.0F, Ints) - 4;
  const Ints z = __builtin_convertvector(b.probe.z + 4.0F, Ints) - 4;
  b.probe.x -= __builtin_convertvector(x, Lanes);
  b.probe.y -= __builtin_convertvector(y, Lanes);
  b.probe.z -= __builtin_convertvector(z, Lanes);
  b.probed =
      x * static_cast<int32_t>(source.rows.stride_x) + y * static_cast<int32_t>(source.rows.stride_y) + z;
}

SCREE_INLINE void load_above_and_before(const Source& source, Batch& b) {
  for (int i = 0; i < batch; ++i)
    source.rows.load_corners(source.now + b.cells[i] + b.probed[i], i, b.above_low, b.above_high);
  if (source.before == nullptr) return;
  for (int i = 0; i < batch; ++i)
    source.rows.load_corners(source.before + b.cells[i], i, b.before_low, b.before_high);
}

/// Over open ground the distance grows as fast as one climbs; in a crevice it does not. 0..255.
SCREE_INLINE void openness_of(const Batch& b, Ints& openness) {
  Lanes found;
  trilinear(b.above_low, b.above_high, b.probe, found);
  const Lanes open = found * (255.0F / (probe_voxels * codes_per_voxel)) + 0.5F;
  const Ints whole = __builtin_convertvector(open < 0.0F ? Lanes{} : open, Ints);
  openness = whole > 255 ? Ints{} + 255 : whole;
}

/// Packed as SurfaceVertex has it.
SCREE_INLINE void store(const Source& source, const Batch& b, SurfaceVertex* vertices, float* slopes) {
  Ints openness, nx, ny, nz, before{};
  openness_of(b, openness);
  round_to(b.normal.x * 127.0F, nx);
  round_to(b.normal.y * 127.0F, ny);
  round_to(b.normal.z * 127.0F, nz);
  if (source.before != nullptr) {
    Lanes then;
    trilinear(b.before_low, b.before_high, b.f, then);
    round_to(then, before);
  }
  const Ints words[3] = {b.x | (b.y << 16), b.z | (openness << 16) | (before << 24),
                         (nx & 255) | ((ny & 255) << 8) | ((nz & 255) << 16)};
  for (int i = 0; i < batch; ++i) {
    const int32_t packed[3] = {words[0][i], words[1][i], words[2][i]};
    std::memcpy(static_cast<void*>(vertices + i), packed, sizeof(packed));
  }
  const Lanes slope = b.difference * (0.5F / codes_per_voxel);
  std::memcpy(slopes, &slope, sizeof(slope));
}

SCREE_INLINE void load(const Source& source, const CrossedSheet* sheets, Batch& b) {
  for (int i = 0; i < batch; ++i) {
    CHECK_DEBUG(sheets[i].edges != 0);
    b.cells[i] = sheets[i].cell;
    b.edges[i] = sheets[i].edges;
    b.x[i] = sheets[i].at[0];
    b.y[i] = sheets[i].at[1];
    b.z[i] = sheets[i].at[2];
    source.rows.load(source.now + b.cells[i], i, b.rows);
  }
}

SCREE_INLINE void load(const Source& source, const PlacedVertex* placed, Batch& b) {
  for (int i = 0; i < batch; ++i) {
    b.cells[i] = placed[i].cell;
    b.x[i] = placed[i].position[0];
    b.y[i] = placed[i].position[1];
    b.z[i] = placed[i].position[2];
    b.f.x[i] = placed[i].fraction.x;
    b.f.y[i] = placed[i].fraction.y;
    b.f.z[i] = placed[i].fraction.z;
    source.rows.load(source.now + b.cells[i], i, b.rows);
  }
}

/// Strictly inside the cell, so that no two cells' vertices ever coincide and edges keep their ends.
SCREE_INLINE void step_into(const Lanes& part, Ints& whole) {
  const Ints inner = __builtin_convertvector(part * surface_steps_per_voxel + 0.5F, Ints);
  const Ints above = inner < 1 ? Ints{} + 1 : inner;
  whole = whole * surface_steps + (above > 255 ? Ints{} + 255 : above);
}

/// Batches computed together: values that one stage stores lane by lane have reached the cache when the next
/// stage loads them as vectors.
constexpr size_t together = 4;
constexpr size_t group = together * batch;

SCREE_VECTOR_CLONES void place_sheets(const Source& source, const CrossedSheet* sheets,
                                      SurfaceVertex* vertices, float* slopes) {
  Batch batches[together];
  for (size_t i = 0; i < together; ++i) load(source, sheets + i * batch, batches[i]);
  for (Batch& b : batches) {
    mean_crossing(b.rows, b.edges, b.f);
    step_into(b.f.x, b.x);
    step_into(b.f.y, b.y);
    step_into(b.f.z, b.z);
    aim(source, b);
  }
  for (Batch& b : batches) load_above_and_before(source, b);
  for (size_t i = 0; i < together; ++i) store(source, batches[i], vertices + i * batch, slopes + i * batch);
}

SCREE_VECTOR_CLONES void shade_placed(const Source& source, const PlacedVertex* placed,
                                      SurfaceVertex* vertices, float* slopes) {
  Batch batches[together];
  for (size_t i = 0; i < together; ++i) load(source, placed + i * batch, batches[i]);
  for (Batch& b : batches) aim(source, b);
  for (Batch& b : batches) load_above_and_before(source, b);
  for (size_t i = 0; i < together; ++i) store(source, batches[i], vertices + i * batch, slopes + i * batch);
}

/// Runs the kernel on whole groups in place, and on the rest in a padded copy.
template <typename Item, typename Kernel>
void in_groups(const Window& window, const Window* before, std::span<const Item> items, SurfaceMesh& mesh,
               Kernel&& kernel) {
  CHECK(before == nullptr || before->box == window.box);
  const VoxelCoord size = window.box.size();
  const Source source{window.codes.data(),
                      before == nullptr ? nullptr : before->codes.data(),
                      {static_cast<std::ptrdiff_t>(size.y) * size.z, size.z}};
  const size_t first = mesh.vertices.size();
  CHECK_EQ(mesh.slopes.size(), first);
  mesh.vertices.resize(first + items.size());
  mesh.slopes.resize(first + items.size());
  SurfaceVertex* to = mesh.vertices.data() + first;
  float* slopes_to = mesh.slopes.data() + first;
  size_t i = 0;
  for (; i + group <= items.size(); i += group) kernel(source, items.data() + i, to + i, slopes_to + i);
  if (i == items.size()) return;
  std::array<Item, group> padded;
  std::array<SurfaceVertex, group> done;
  std::array<float, group> slopes_done;
  padded.fill(items[i]);
  std::ranges::copy(items.subspan(i), padded.begin());
  kernel(source, padded.data(), done.data(), slopes_done.data());
  std::copy_n(done.begin(), items.size() - i, to + i);
  std::copy_n(slopes_done.begin(), items.size() - i, slopes_to + i);
}

}  // namespace

void add_sheet_vertices(const Window& window, const Window* before, std::span<const CrossedSheet> sheets,
                        SurfaceMesh& mesh) {
  in_groups(window, before, sheets, mesh, place_sheets);
}

void add_placed_vertices(const Window& window, const Window* before, std::span<const PlacedVertex> placed,
                         SurfaceMesh& mesh) {
  in_groups(window, before, placed, mesh, shade_placed);
}

}  // namespace scree
