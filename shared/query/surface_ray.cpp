#include "shared/query/surface_ray.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "shared/query/vectors.h"
#include "shared/surface/surface_cells.h"

namespace scree {

namespace {

/// Cells so near to a ray are looked at, voxels: far more than rounding amounts to.
constexpr double nearby = 1.0 / 4096.0;
/// A polygon so far behind the start of a ray that enters it counts, voxels: a start on a surface meets it.
constexpr double behind = 1.0 / 65536.0;
constexpr double steps_across = 1048576.0;

class RayWalk {
 public:
  RayWalk(CellSource& cells, const Line& line, double lo, double hi, uint32_t& steps)
      : cells_(cells), line_(line), lo_(lo), hi_(hi), steps_(steps) {
    const glm::dvec3 size = glm::abs(line.unit);
    major_ = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    right_ = across(line.unit);
    up_ = glm::cross(line.unit, right_);
  }

  std::optional<SurfaceHit> run() {
    const double from = line_.from[major_], speed = line_.unit[major_];
    const int step = speed > 0.0 ? 1 : -1;
    const double slack = nearby * step;
    first_ = floor_to_int(from + speed * lo_ - slack);
    last_ = floor_to_int(from + speed * hi_ + slack);
    const int last_slab = last_ >> 3;
    for (int slab = first_ >> 3;; slab += step) {
      if (walk_slab(slab, step) || slab == last_slab) return best_;
    }
  }

 private:
  struct Span {
    int lo[2];  ///< of the two axes that are not the major one
    int hi[2];
  };
  int minor(int i) const { return i == 0 ? (major_ == 0 ? 1 : 0) : (major_ == 2 ? 1 : 2); }

  /// When the line is between two planes across the major axis, within what counts of it.
  std::pair<double, double> times(int lo, int hi) const {
    const double from = line_.from[major_], speed = line_.unit[major_];
    double a = (static_cast<double>(lo) - from) / speed, b = (static_cast<double>(hi) - from) / speed;
    if (a > b) std::swap(a, b);
    return {std::clamp(a, lo_, hi_), std::clamp(b, lo_, hi_)};
  }
  Span span_of(std::pair<double, double> at) const {
    Span span;
    for (int i = 0; i < 2; ++i) {
      const double from = line_.from[minor(i)], speed = line_.unit[minor(i)];
      const double a = from + speed * at.first, b = from + speed * at.second;
      span.lo[i] = floor_to_int(std::min(a, b) - nearby);
      span.hi[i] = floor_to_int(std::max(a, b) + nearby);
    }
    return span;
  }
  template <typename C>
  C coord(int along, int u, int v) const {
    C c;
    int32_t* const parts[3] = {&c.x, &c.y, &c.z};
    *parts[major_] = along;
    *parts[minor(0)] = u;
    *parts[minor(1)] = v;
    return c;
  }

  /// Eight layers. Whether the walk is at its end.
  bool walk_slab(int slab, int step) {
    const Span whole = span_of(times(slab * brick_size, slab * brick_size + brick_size));
    const int u0 = whole.lo[0] >> 3, v0 = whole.lo[1] >> 3;
    const int nu = (whole.hi[0] >> 3) - u0 + 1, nv = (whole.hi[1] >> 3) - v0 + 1;
    CHECK_DEBUG(nu >= 1 && nu <= 3 && nv >= 1 && nv <= 3);
    std::array<const CellBlock*, 9> blocks{};
    bool any = false;
    for (int u = 0; u < nu; ++u)
      for (int v = 0; v < nv; ++v) {
        const CellBlock* block = cells_.block(coord<BrickCoord>(slab, u0 + u, v0 + v));
        blocks[static_cast<size_t>(u * 3 + v)] = block;
        any = any || block != nullptr;
        ++steps_;
      }
    if (!any) return false;
    const int first =
        step > 0 ? std::max(first_, slab * brick_size) : std::min(first_, slab * brick_size + brick_size - 1);
    const int end =
        step > 0 ? std::min(last_, slab * brick_size + brick_size - 1) : std::max(last_, slab * brick_size);
    for (int layer = first;; layer += step) {
      const auto at = times(layer, layer + 1);
      const Span span = span_of(at);
      for (int u = span.lo[0]; u <= span.hi[0]; ++u)
        for (int v = span.lo[1]; v <= span.hi[1]; ++v) {
          const int bu = std::clamp((u >> 3) - u0, 0, nu - 1), bv = std::clamp((v >> 3) - v0, 0, nv - 1);
          const CellBlock* block = blocks[static_cast<size_t>(bu * 3 + bv)];
          if (block == nullptr || (u >> 3) != u0 + bu || (v >> 3) != v0 + bv) continue;
          const VoxelCoord in = coord<VoxelCoord>(layer & 7, u & 7, v & 7);
          if (block->is_active(in)) test_cell(*block, in);
        }
      if (best_ && best_->along <= at.second - nearby) return true;
      if (layer == end) return false;
    }
  }

  void test_cell(const CellBlock& block, VoxelCoord cell) {
    const CellTables& tables = cell_tables();
    for (int e = 0; e < cell_edges; ++e) {
      const int from = tables.edges[static_cast<size_t>(e)].from;
      const VoxelCoord voxel = cell + VoxelCoord{from >> 2, (from >> 1) & 1, from & 1};
      if (!block.is_crossed(voxel, e / 4)) continue;
      for (const SurfaceTriangle& triangle : block.quad(voxel, e / 4)) test(triangle);
      ++steps_;
    }
  }

  void test(const SurfaceTriangle& triangle) {
    std::array<int64_t, 3> u, v;
    std::array<double, 3> along;
    std::array<glm::dvec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = in_voxels(triangle[i]);
      const glm::dvec3 off = corners[i] - line_.from;
      const auto whole = [](double x) {
        const double scaled = x * steps_across;
        return static_cast<int64_t>(scaled < 0.0 ? scaled - 0.5 : scaled + 0.5);
      };
      u[i] = whole(glm::dot(off, right_));
      v[i] = whole(glm::dot(off, up_));
      along[i] = glm::dot(off, line_.unit);
    }
    const int64_t a = u[1] * v[2] - v[1] * u[2], b = u[2] * v[0] - v[2] * u[0];
    const int64_t c = u[0] * v[1] - v[0] * u[1];
    const bool is_inside = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    if (!is_inside || a + b + c == 0) return;
    const double at = (static_cast<double>(a) * along[0] + static_cast<double>(b) * along[1] +
                       static_cast<double>(c) * along[2]) /
                      static_cast<double>(a + b + c);
    if (at > hi_ || (best_ && at >= best_->along)) return;
    const bool enters = a + b + c < 0;
    if (at < (enters ? lo_ - behind : lo_)) return;
    const double met = std::max(at, lo_);
    const glm::dvec3 out = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    // A triangle of no width may still be what closes the gap that rounding opened.
    const glm::dvec3 facing = enters ? -line_.unit : line_.unit;
    best_ = SurfaceHit{met, line_.at(met), glm::dot(out, out) > 0.0 ? unit_of(out) : facing};
  }

  CellSource& cells_;
  const Line& line_;
  double lo_, hi_;
  uint32_t& steps_;
  int major_;
  glm::dvec3 right_, up_;
  int first_ = 0, last_ = 0;  ///< layers
  std::optional<SurfaceHit> best_;
};

VoxelCoord cell_at(const glm::dvec3& place) {
  return {floor_to_int(place.x), floor_to_int(place.y), floor_to_int(place.z)};
}

bool is_crossed_cell(CellSource& cells, VoxelCoord cell) {
  const CellBlock* block = cells.block(brick_of(cell));
  return block != nullptr && block->is_active({cell.x & 7, cell.y & 7, cell.z & 7});
}

}  // namespace

std::optional<std::pair<double, double>> line_within(const VoxelBox* bounds, double distance,
                                                     const Line& line, double most) {
  double lo = 0.0, hi = most;
  if (bounds == nullptr) return std::pair{lo, hi};
  if (bounds->empty()) return std::nullopt;
  const glm::dvec3 least(bounds->lo.x - 2, bounds->lo.y - 2, bounds->lo.z - 2);
  const glm::dvec3 top(bounds->hi.x + 1, bounds->hi.y + 1, bounds->hi.z + 1);
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = line.unit[axis], from = line.from[axis];
    const double near = least[axis] - distance, far = top[axis] + distance;
    if (speed == 0.0) {
      if (from < near || from > far) return std::nullopt;
      continue;
    }
    const double a = (near - from) / speed, b = (far - from) / speed;
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  if (lo > hi) return std::nullopt;
  return std::pair{lo, hi};
}

std::optional<SurfaceHit> first_on_line(CellSource& cells, const Line& line, double most, uint32_t& steps) {
  const auto range = line_within(cells.bounds(), 0.0, line, most);
  if (!range) return std::nullopt;
  return RayWalk(cells, line, range->first, range->second, steps).run();
}

bool is_in_rock(CellSource& cells, glm::dvec3 place, uint32_t& steps) {
  // Askew: surfaces often lie along the axes, and a ray along a surface is the worst one.
  constexpr double piece = 4.0;
  constexpr int pieces = 64;
  const Line line{place, unit_of({0.0371, 1.0, 0.0487})};
  double along = 0.0;
  for (int i = 0; i < pieces; ++i, along += piece) {
    const VoxelCoord cell = cell_at(line.at(along));
    ++steps;
    if (!is_crossed_cell(cells, cell)) return cells.is_rock(cell);
    const auto hit = RayWalk(cells, line, along, along + piece, steps).run();
    if (hit) return glm::dot(hit->normal, line.unit) > 0.0;
  }
  return cells.is_rock(cell_at(place));
}

}  // namespace scree
