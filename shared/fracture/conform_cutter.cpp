#include "shared/fracture/conform_cutter.h"

#include <algorithm>
#include <optional>

#include "shared/base/check.h"
#include "shared/fracture/triangle_grid.h"

namespace scree {

namespace {

/// A face of a cell as a polygon: corners in order, counter-clockwise seen from outside the cell.
struct Loop {
  std::vector<glm::dvec3> corners;
  std::vector<glm::dvec3> outwards;  ///< of the side from each corner to the next, in the face's plane

  size_t size() const { return corners.size(); }
  glm::dvec3 corner(size_t i) const { return corners[i % corners.size()]; }
};

/// The point where the line along which the surface crosses a face meets the face's outline.
struct End {
  double at = 0.0;  ///< side, and how far along it: 0 … sides
  glm::dvec3 point{0.0};
  int sign = 0;  ///< +1 where the outline goes on from the line, −1 where the line goes on from the outline
};

class Conforming {
 public:
  explicit Conforming(const PolygonMesh& mesh) : mesh_(mesh), grid_(mesh) {}

  PolygonMesh part(const PolygonMesh& cell) {
    if (cell.empty()) return {};
    const std::vector<uint32_t> near = grid_.near(bounds_of(cell));
    if (near.empty()) return grid_.holds(cell.vertices.front()) ? cell : PolygonMesh{};
    PolygonMesh out;
    for (const uint32_t i : near) clip_triangle(mesh_.faces[i], cell, out);
    for (const PolygonFace& face : cell.faces) cap(cell, face, near, out);
    return out;
  }

 private:
  /// The triangle's part in the cell, by its planes one after the other (Sutherland & Hodgman 1974).
  void clip_triangle(const PolygonFace& triangle, const PolygonMesh& cell, PolygonMesh& out) {
    polygon_.clear();
    for (uint32_t i = 0; i < triangle.edges; ++i)
      polygon_.push_back(mesh_.vertices[mesh_.edges[triangle.first_edge + i].from]);
    for (const PolygonFace& face : cell.faces) {
      clipped_.clear();
      for (size_t i = 0; i < polygon_.size(); ++i) {
        const glm::dvec3 &a = polygon_[i], &b = polygon_[(i + 1) % polygon_.size()];
        const double da = face.plane.distance(a), db = face.plane.distance(b);
        if (da <= 0.0) clipped_.push_back(a);
        if ((da <= 0.0) != (db <= 0.0)) clipped_.push_back(a + (b - a) * (da / (da - db)));
      }
      std::swap(polygon_, clipped_);
      if (polygon_.size() < 3) return;
    }
    const size_t first = out.edges.size();
    const auto base = static_cast<uint32_t>(out.vertices.size());
    const auto count = static_cast<uint32_t>(polygon_.size());
    out.vertices.insert(out.vertices.end(), polygon_.begin(), polygon_.end());
    for (uint32_t i = 0; i < count; ++i) out.edges.push_back({base + i, base + (i + 1) % count});
    out.end_face(triangle.plane, own_surface, first);
  }

  static Loop loop_of(const PolygonMesh& cell, const PolygonFace& face) {
    Loop loop;
    uint32_t at = cell.edges[face.first_edge].from;
    for (uint32_t i = 0; i < face.edges; ++i) {
      loop.corners.push_back(cell.vertices[at]);
      for (uint32_t k = face.first_edge; k < face.first_edge + face.edges; ++k)
        if (cell.edges[k].from == at) {
          at = cell.edges[k].to;
          break;
        }
    }
    for (size_t i = 0; i < loop.size(); ++i)
      loop.outwards.push_back(glm::cross(loop.corner(i + 1) - loop.corner(i), face.plane.normal));
    return loop;
  }

  /// The line along which the plane crosses a triangle, directed as an edge of the cap of the solid below the
  /// plane. Triangles that share an edge compute the same point on it.
  struct Segment {
    glm::dvec3 from, to;
  };
  std::optional<Segment> crossing(const PolygonFace& triangle, const Plane& plane) const {
    Segment segment;
    bool crosses = false;
    for (uint32_t i = 0; i < triangle.edges; ++i) {
      const PolygonEdge edge = mesh_.edges[triangle.first_edge + i];
      const double d_from = plane.distance(mesh_.vertices[edge.from]);
      const double d_to = plane.distance(mesh_.vertices[edge.to]);
      if ((d_from <= 0.0) == (d_to <= 0.0)) continue;
      crosses = true;
      const bool forward = edge.from < edge.to;
      const glm::dvec3 &low = mesh_.vertices[forward ? edge.from : edge.to],
                       &high = mesh_.vertices[forward ? edge.to : edge.from];
      const double d_low = forward ? d_from : d_to, d_high = forward ? d_to : d_from;
      const glm::dvec3 point = low + (high - low) * (d_low / (d_low - d_high));
      // The cap's edge begins where the triangle's outline enters the part below the plane.
      (d_from <= 0.0 ? segment.to : segment.from) = point;
    }
    return crosses ? std::optional(segment) : std::nullopt;
  }

  /// Appends the part of the segment inside the loop; where the loop's outline cuts it off, adds an end.
  void clip_segment(const Segment& segment, const Loop& loop, PolygonMesh& out) {
    double begin = 0.0, end = 1.0;
    std::optional<size_t> begin_side, end_side;
    for (size_t i = 0; i < loop.size(); ++i) {
      const double d_from = glm::dot(loop.outwards[i], segment.from - loop.corners[i]);
      const double d_to = glm::dot(loop.outwards[i], segment.to - loop.corners[i]);
      if (d_from > 0.0 && d_to > 0.0) return;
      if ((d_from > 0.0) == (d_to > 0.0)) continue;
      const double t = d_from / (d_from - d_to);
      if (d_from > 0.0 && (!begin_side || t > begin)) begin = t, begin_side = i;
      if (d_to > 0.0 && (!end_side || t < end)) end = t, end_side = i;
    }
    if (begin_side && end_side && begin > end) return;
    const glm::dvec3 way = segment.to - segment.from;
    const glm::dvec3 from = begin_side ? segment.from + way * begin : segment.from;
    const glm::dvec3 to = end_side ? segment.from + way * end : segment.to;
    append_edge(out, from, to);
    if (begin_side) ends_.push_back({along(loop, *begin_side, from), from, -1});
    if (end_side) ends_.push_back({along(loop, *end_side, to), to, 1});
  }

  static double along(const Loop& loop, size_t side, glm::dvec3 p) {
    const glm::dvec3 way = loop.corner(side + 1) - loop.corners[side];
    const double length2 = glm::dot(way, way);
    const double t = length2 > 0.0 ? glm::dot(p - loop.corners[side], way) / length2 : 0.0;
    return static_cast<double>(side) + std::clamp(t, 0.0, 1.0);
  }

  static void append_edge(PolygonMesh& out, glm::dvec3 from, glm::dvec3 to) {
    const auto base = static_cast<uint32_t>(out.vertices.size());
    out.vertices.push_back(from);
    out.vertices.push_back(to);
    out.edges.push_back({base, base + 1});
  }

  /// Appends the part of a cell's face that lies in the solid, bounded by the line along which the surface
  /// crosses the face and by the parts of its outline in the solid.
  void cap(const PolygonMesh& cell, const PolygonFace& face, const std::vector<uint32_t>& near,
           PolygonMesh& out) {
    const Loop loop = loop_of(cell, face);
    CHECK_DEBUG(loop.size() >= 3);
    const size_t first = out.edges.size();
    ends_.clear();
    for (const uint32_t i : near)
      if (const auto segment = crossing(mesh_.faces[i], face.plane)) clip_segment(*segment, loop, out);
    std::ranges::sort(ends_, [](const End& a, const End& b) { return a.at < b.at; });
    int inside = 0, lowest = 0;
    for (const End& end : ends_) lowest = std::min(lowest, inside += end.sign);
    inside = ends_.empty() ? (grid_.holds(loop.corners.front()) ? 1 : 0) : -lowest;
    size_t next = 0;
    for (size_t side = 0; side < loop.size(); ++side) {
      glm::dvec3 from = loop.corners[side];
      for (; next < ends_.size() && ends_[next].at <= static_cast<double>(side + 1); ++next) {
        for (int k = 0; k < inside; ++k) append_edge(out, from, ends_[next].point);
        from = ends_[next].point;
        inside += ends_[next].sign;
      }
      for (int k = 0; k < inside; ++k) append_edge(out, from, loop.corner(side + 1));
    }
    CHECK_DEBUG(next == ends_.size());
    out.end_face(face.plane, face.neighbour, first);
  }

  const PolygonMesh& mesh_;
  TriangleGrid grid_;
  std::vector<glm::dvec3> polygon_, clipped_;
  std::vector<End> ends_;
};

}  // namespace

std::vector<PolygonMesh> conform_cells(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells) {
  Conforming conforming(mesh);
  std::vector<PolygonMesh> parts;
  parts.reserve(cells.size());
  for (const PolygonMesh& cell : cells) parts.push_back(conforming.part(cell));
  return parts;
}

Cut cut_by_conforming(const Window& volume, std::vector<uint8_t> lost,
                      const std::vector<glm::vec3>& seeds_voxels) {
  return cut_as_polygons(conform_cutting, volume, std::move(lost), seeds_voxels);
}

}  // namespace scree
