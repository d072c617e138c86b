#include "shared/fracture/polygon_codes.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr double band = static_cast<double>(band_voxels);

int floor_to_int(double x) {
  const int i = static_cast<int>(x);
  return x < static_cast<double>(i) ? i - 1 : i;
}
int ceil_to_int(double x) {
  return -floor_to_int(-x);
}

double clamped(double x, double lo, double hi) {
  return x < lo ? lo : (x > hi ? hi : x);
}

/// The place where an edge crosses a line of constant y: the same for an edge and its reverse, so that the
/// crossings of two faces that share an edge cancel to the last bit.
struct RowCrossing {
  double x = 0.0;
  int sign = 0;  ///< +1 when the edge climbs
};

/// A crossing of a column of voxels by the surface.
struct ColumnCrossing {
  size_t column = 0;
  double z = 0.0;
  int winding = 0;
};

class ColumnCrossings {
 public:
  ColumnCrossings(const PolygonMesh& mesh, const VoxelBox& box) : mesh_(mesh), box_(box) {
    for (const PolygonFace& face : mesh.faces) add(face);
    std::ranges::sort(crossings_, [](const ColumnCrossing& a, const ColumnCrossing& b) {
      return a.column != b.column ? a.column < b.column : a.z < b.z;
    });
  }

  const std::vector<ColumnCrossing>& sorted() const { return crossings_; }

 private:
  void add(const PolygonFace& face) {
    PolygonBounds bounds;
    for (uint32_t i = 0; i < face.edges; ++i)
      bounds.add(mesh_.vertices[mesh_.edges[face.first_edge + i].from]);
    const int y_lo = std::max(ceil_to_int(bounds.lo.y), box_.lo.y);
    const int y_hi = std::min(floor_to_int(bounds.hi.y) + 1, box_.hi.y);
    for (int y = y_lo; y < y_hi; ++y) add_row(face, bounds, y);
  }

  void add_row(const PolygonFace& face, const PolygonBounds& bounds, int row) {
    row_.clear();
    const double y = row;
    for (uint32_t i = 0; i < face.edges; ++i) {
      const PolygonEdge edge = mesh_.edges[face.first_edge + i];
      const glm::dvec3 &from = mesh_.vertices[edge.from], &to = mesh_.vertices[edge.to];
      if ((from.y <= y) == (to.y <= y)) continue;
      const bool climbs = to.y > from.y;
      const glm::dvec3 &low = climbs ? from : to, &high = climbs ? to : from;
      row_.push_back({low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y)), climbs ? 1 : -1});
    }
    if (row_.empty()) return;
    const int x_lo = std::max(floor_to_int(bounds.lo.x), box_.lo.x);
    const int x_hi = std::min(floor_to_int(bounds.hi.x) + 1, box_.hi.x);
    for (int x = x_lo; x < x_hi; ++x) {
      int winding = 0;
      for (const RowCrossing& crossing : row_)
        if (crossing.x > static_cast<double>(x)) winding += crossing.sign;
      if (winding == 0) continue;
      const size_t column = static_cast<size_t>(x - box_.lo.x) * static_cast<size_t>(box_.size().y) +
                            static_cast<size_t>(row - box_.lo.y);
      crossings_.push_back({column, height(face.plane, bounds, x, y), winding});
    }
  }

  /// Height of the face over (x, y). For an upright face any of its heights will do, since the column runs
  /// along it.
  static double height(const Plane& plane, const PolygonBounds& bounds, double x, double y) {
    constexpr double upright = 1e-12;
    const double slope = plane.normal.z;
    if (slope < upright && slope > -upright) return bounds.lo.z;
    return clamped((plane.offset - plane.normal.x * x - plane.normal.y * y) / slope, bounds.lo.z,
                   bounds.hi.z);
  }

  const PolygonMesh& mesh_;
  const VoxelBox& box_;
  std::vector<RowCrossing> row_;
  std::vector<ColumnCrossing> crossings_;
};

}  // namespace

PolygonDistances::PolygonDistances(const VoxelBox& box)
    : box_(box), squared_(Window::count(box), band * band) {}

PolygonDistances::Span PolygonDistances::span(double lo, double hi, int box_lo, int box_hi) {
  return {std::max(ceil_to_int(lo - band), box_lo), std::min(floor_to_int(hi + band) + 1, box_hi)};
}

/// Squared distance of p, which lies `above` the plane, to the polygon of sides_; u and v are the axes that
/// show the plane least foreshortened.
double PolygonDistances::squared_distance(glm::dvec3 p, const Plane& plane, double above, int u,
                                          int v) const {
  const glm::dvec3 foot = p - plane.normal * above;
  const double foot_u = foot[u], foot_v = foot[v];
  int winding = 0;
  double nearest = band * band;
  for (const Side& side : sides_) {
    if ((side.from_v <= foot_v) != (side.to_v <= foot_v)) {
      const double t = (foot_v - side.from_v) / (side.to_v - side.from_v);
      if (side.from_u + (side.to_u - side.from_u) * t > foot_u) winding += side.to_v > side.from_v ? 1 : -1;
    }
    const glm::dvec3 off = p - side.from;
    const double t = clamped(glm::dot(off, side.along) * side.inverse2, 0.0, 1.0);
    const glm::dvec3 away = off - side.along * t;
    nearest = std::min(nearest, glm::dot(away, away));
  }
  return winding != 0 ? above * above : nearest;
}

void PolygonDistances::add(const PolygonMesh& mesh, const PolygonFace& face) {
  CHECK_DEBUG(face.edges > 0);
  const glm::dvec3 steep(face.plane.normal * face.plane.normal);
  const int dropped = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
  const int u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  sides_.clear();
  PolygonBounds bounds;
  for (uint32_t i = 0; i < face.edges; ++i) {
    const PolygonEdge edge = mesh.edges[face.first_edge + i];
    const glm::dvec3 from = mesh.vertices[edge.from], to = mesh.vertices[edge.to];
    const double length2 = glm::dot(to - from, to - from);
    sides_.push_back({from, to - from, length2 > 0.0 ? 1.0 / length2 : 0.0, from[u], from[v], to[u], to[v]});
    bounds.add(from);
  }
  const Span xs = span(bounds.lo.x, bounds.hi.x, box_.lo.x, box_.hi.x);
  const Span ys = span(bounds.lo.y, bounds.hi.y, box_.lo.y, box_.hi.y);
  const Span zs = span(bounds.lo.z, bounds.hi.z, box_.lo.z, box_.hi.z);
  const VoxelCoord size = box_.size();
  for (int x = xs.lo; x < xs.hi; ++x)
    for (int y = ys.lo; y < ys.hi; ++y) {
      double* row = squared_.data() + (static_cast<size_t>(x - box_.lo.x) * static_cast<size_t>(size.y) +
                                       static_cast<size_t>(y - box_.lo.y)) *
                                          static_cast<size_t>(size.z);
      for (int z = zs.lo; z < zs.hi; ++z) {
        const glm::dvec3 p(x, y, z);
        const double above = face.plane.distance(p);
        double& nearest = row[z - box_.lo.z];
        if (above * above >= nearest) continue;
        nearest = std::min(nearest, squared_distance(p, face.plane, above, u, v));
      }
    }
}

Window PolygonDistances::codes(const std::vector<uint8_t>& inside) const {
  CHECK_EQ(inside.size(), squared_.size());
  Window window(box_);
  for (size_t i = 0; i < squared_.size(); ++i) {
    const double distance = std::sqrt(squared_[i]);
    window.codes[i] = encode(static_cast<float>(inside[i] != 0 ? -distance : distance));
  }
  return window;
}

void mark_inside(const PolygonMesh& mesh, const VoxelBox& box, std::vector<uint8_t>& inside) {
  CHECK_EQ(inside.size(), Window::count(box));
  const ColumnCrossings crossings(mesh, box);
  const auto nz = static_cast<size_t>(box.size().z);
  const std::vector<ColumnCrossing>& all = crossings.sorted();
  // From below; inside once more surfaces that face down were passed than surfaces that face up.
  for (size_t i = 0; i < all.size();) {
    const size_t column = all[i].column;
    uint8_t* bytes = inside.data() + column * nz;
    int winding = 0;
    for (int z = box.lo.z; z < box.hi.z; ++z) {
      for (; i < all.size() && all[i].column == column && all[i].z <= static_cast<double>(z); ++i)
        winding -= all[i].winding;
      if (winding > 0) bytes[z - box.lo.z] = 1;
    }
    while (i < all.size() && all[i].column == column) ++i;
  }
}

VoxelBox voxels_around(const PolygonBounds& bounds, int margin, const VoxelBox& within) {
  const auto low = [&](double x, int most) { return std::max(floor_to_int(x) - margin, most); };
  const auto high = [&](double x, int most) { return std::min(ceil_to_int(x) + 1 + margin, most); };
  return {{low(bounds.lo.x, within.lo.x), low(bounds.lo.y, within.lo.y), low(bounds.lo.z, within.lo.z)},
          {high(bounds.hi.x, within.hi.x), high(bounds.hi.y, within.hi.y), high(bounds.hi.z, within.hi.z)}};
}

}  // namespace scree
