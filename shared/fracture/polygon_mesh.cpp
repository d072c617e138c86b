#include "shared/fracture/polygon_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "shared/base/check.h"
#include "shared/surface/surface_nets.h"

namespace scree {

namespace {

constexpr uint32_t none = UINT32_MAX;

/// The plane of a triangle; one without area gets some plane through it, which changes no result.
Plane plane_through(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 across = glm::cross(b - a, c - a);
  const double length = std::sqrt(glm::dot(across, across));
  const glm::dvec3 normal = length > 0.0 ? across / length : glm::dvec3(0.0, 0.0, 1.0);
  return {normal, glm::dot(normal, a)};
}

}  // namespace

void PolygonMesh::end_face(const Plane& plane, uint32_t neighbour, size_t first_edge) {
  CHECK_DEBUG(first_edge <= edges.size());
  if (first_edge == edges.size()) return;
  faces.push_back({plane, neighbour, static_cast<uint32_t>(first_edge),
                   static_cast<uint32_t>(edges.size() - first_edge)});
}

void PolygonMesh::clear() {
  vertices.clear();
  edges.clear();
  faces.clear();
}

void PolygonBounds::add(glm::dvec3 p) {
  lo = glm::min(lo, p);
  hi = glm::max(hi, p);
}

void PolygonBounds::add(const PolygonBounds& other) {
  lo = glm::min(lo, other.lo);
  hi = glm::max(hi, other.hi);
}

PolygonBounds bounds_of(const PolygonMesh& mesh) {
  PolygonBounds bounds;
  for (const glm::dvec3& p : mesh.vertices) bounds.add(p);
  return bounds;
}

bool is_closed(const PolygonMesh& mesh) {
  std::vector<std::pair<uint32_t, uint32_t>> edges, reverses;
  for (const PolygonEdge& edge : mesh.edges) {
    edges.emplace_back(edge.from, edge.to);
    reverses.emplace_back(edge.to, edge.from);
  }
  std::ranges::sort(edges);
  std::ranges::sort(reverses);
  return edges == reverses;
}

PolygonMesh polygonise(const Window& volume) {
  const SurfaceMesh surface = surface_nets_closed(volume);
  const glm::dvec3 origin(surface.origin.x, surface.origin.y, surface.origin.z);
  PolygonMesh mesh;
  mesh.vertices.reserve(surface.vertices.size());
  for (const SurfaceVertex& v : surface.vertices)
    mesh.vertices.push_back(origin + glm::dvec3(v.position[0], v.position[1], v.position[2]) /
                                         static_cast<double>(surface_steps_per_voxel));
  mesh.edges.reserve(surface.indices.size());
  mesh.faces.reserve(surface.indices.size() / 3);
  for (size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const uint32_t a = surface.indices[i], b = surface.indices[i + 1], c = surface.indices[i + 2];
    mesh.edges.insert(mesh.edges.end(), {{a, b}, {b, c}, {c, a}});
    mesh.end_face(plane_through(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]), own_surface, i);
  }
  CHECK_DEBUG(is_closed(mesh));
  return mesh;
}

PolygonMesh box_mesh(const PolygonBounds& bounds) {
  CHECK(bounds.lo.x < bounds.hi.x && bounds.lo.y < bounds.hi.y && bounds.lo.z < bounds.hi.z);
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 4) != 0 ? bounds.hi.x : bounds.lo.x,
                               (i & 2) != 0 ? bounds.hi.y : bounds.lo.y,
                               (i & 1) != 0 ? bounds.hi.z : bounds.lo.z);
  constexpr std::array<std::array<uint32_t, 4>, 6> loops = {
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  for (const auto& loop : loops) {
    const size_t first = mesh.edges.size();
    for (size_t i = 0; i < 4; ++i) mesh.edges.push_back({loop[i], loop[(i + 1) % 4]});
    mesh.end_face(plane_through(mesh.vertices[loop[0]], mesh.vertices[loop[1]], mesh.vertices[loop[2]]),
                  own_surface, first);
  }
  CHECK_DEBUG(is_closed(mesh));
  return mesh;
}

PolygonMoments moments_of(const PolygonMesh& mesh) {
  PolygonMoments moments;
  if (mesh.empty()) return moments;
  // About a point nearby: less is lost to rounding.
  const glm::dvec3 origin = mesh.vertices[mesh.edges.front().from];
  for (const PolygonFace& face : mesh.faces) {
    const glm::dvec3 tip = mesh.vertices[mesh.edges[face.first_edge].from] - origin;
    for (uint32_t i = face.first_edge; i < face.first_edge + face.edges; ++i) {
      const glm::dvec3 a = mesh.vertices[mesh.edges[i].from] - origin;
      const glm::dvec3 b = mesh.vertices[mesh.edges[i].to] - origin;
      const double volume = glm::dot(tip, glm::cross(a, b)) / 6.0;
      moments.volume += volume;
      moments.first += (tip + a + b) * (volume / 4.0);
    }
  }
  moments.first += origin * moments.volume;
  return moments;
}

/// Computes the vertices' distances from the plane. Returns whether any vertex lies beyond it.
bool Slicer::classify(const PolygonMesh& mesh, const Plane& plane) {
  distances_.resize(mesh.vertices.size());
  bool beyond = false;
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    distances_[i] = plane.distance(mesh.vertices[i]);
    beyond = beyond || distances_[i] > 0.0;
  }
  return beyond;
}

uint32_t Slicer::copied(const PolygonMesh& mesh, uint32_t vertex) {
  if (copied_[vertex] == none) {
    copied_[vertex] = static_cast<uint32_t>(out_.vertices.size());
    out_.vertices.push_back(mesh.vertices[vertex]);
  }
  return copied_[vertex];
}

uint32_t Slicer::crossing(const PolygonMesh& mesh, PolygonEdge edge) {
  const auto [low, high] = std::minmax(edge.from, edge.to);
  for (uint32_t i = first_cut_[low]; i != none; i = cuts_[i].next)
    if (cuts_[i].other == high) return cuts_[i].vertex;
  CHECK_DEBUG((distances_[low] <= 0.0) != (distances_[high] <= 0.0));
  const double t = distances_[low] / (distances_[low] - distances_[high]);
  const auto vertex = static_cast<uint32_t>(out_.vertices.size());
  out_.vertices.push_back(mesh.vertices[low] + (mesh.vertices[high] - mesh.vertices[low]) * t);
  cuts_.push_back({high, vertex, first_cut_[low]});
  first_cut_[low] = static_cast<uint32_t>(cuts_.size() - 1);
  return vertex;
}

void Slicer::close(uint32_t from, uint32_t to) {
  if (from == to) return;
  out_.edges.push_back({from, to});
  cap_.push_back({to, from});
}

/// Joins the points where the face's loops leave the kept side to those where they enter, along the cut. With
/// more than one of each the winding number along the line decides, so that no edge bridges a gap.
void Slicer::close_face(glm::dvec3 along) {
  if (crossings_.size() == 2) {
    const size_t leaves = crossings_[0].sign < 0 ? 0 : 1;
    close(crossings_[leaves].vertex, crossings_[1 - leaves].vertex);
    return;
  }
  for (Crossing& crossing : crossings_) crossing.along = glm::dot(along, out_.vertices[crossing.vertex]);
  std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
    return a.along != b.along ? a.along < b.along : a.vertex < b.vertex;
  });
  int winding = 0;
  CHECK_DEBUG(crossings_.size() % 2 == 0);  // closed loops leave as often as they enter
  for (size_t i = 0; i + 1 < crossings_.size(); ++i) {
    winding -= crossings_[i].sign;
    const uint32_t here = crossings_[i].vertex, next = crossings_[i + 1].vertex;
    for (int k = 0; k < winding; ++k) close(here, next);
    for (int k = 0; k > winding; --k) close(next, here);
  }
}

void Slicer::clip_face(const PolygonMesh& mesh, const PolygonFace& face, const Plane& plane) {
  const size_t first = out_.edges.size();
  crossings_.clear();
  for (uint32_t i = face.first_edge; i < face.first_edge + face.edges; ++i) {
    const PolygonEdge edge = mesh.edges[i];
    const bool from_kept = distances_[edge.from] <= 0.0, to_kept = distances_[edge.to] <= 0.0;
    if (from_kept && to_kept) {
      const uint32_t from = copied(mesh, edge.from);
      out_.edges.push_back({from, copied(mesh, edge.to)});
    } else if (from_kept) {
      const uint32_t leaves = crossing(mesh, edge);
      out_.edges.push_back({copied(mesh, edge.from), leaves});
      crossings_.push_back({leaves, -1, 0.0});
    } else if (to_kept) {
      const uint32_t enters = crossing(mesh, edge);
      out_.edges.push_back({enters, copied(mesh, edge.to)});
      crossings_.push_back({enters, 1, 0.0});
    }
  }
  if (!crossings_.empty()) close_face(glm::cross(face.plane.normal, plane.normal));
  out_.end_face(face.plane, face.neighbour, first);
}

void Slicer::slice(PolygonMesh& mesh, const Plane& plane, uint32_t neighbour) {
  if (!classify(mesh, plane)) return;
  copied_.assign(mesh.vertices.size(), none);
  first_cut_.assign(mesh.vertices.size(), none);
  cuts_.clear();
  cap_.clear();
  out_.clear();
  for (const PolygonFace& face : mesh.faces) clip_face(mesh, face, plane);
  const size_t first = out_.edges.size();
  out_.edges.insert(out_.edges.end(), cap_.begin(), cap_.end());
  out_.end_face(plane, neighbour, first);
  CHECK_DEBUG(is_closed(out_));
  std::swap(mesh, out_);
}

}  // namespace scree
