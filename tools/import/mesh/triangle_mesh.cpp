#include "tools/import/mesh/triangle_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "tools/import/mesh/winding.h"

namespace scree {

namespace {

using Triangle = std::array<uint32_t, 3>;

double volume_of(const TriangleMesh& mesh, const std::vector<size_t>& triangles) {
  double sum = 0.0;
  const glm::dvec3 origin = mesh.points.front();  // near, or digits are lost
  for (const size_t i : triangles) {
    const Triangle& t = mesh.triangles[i];
    sum += glm::dot(mesh.points[t[0]] - origin,
                    glm::cross(mesh.points[t[1]] - origin, mesh.points[t[2]] - origin));
  }
  return sum / 6.0;
}

/// Triangles by the connected part that they belong to.
std::vector<std::vector<size_t>> parts_of(const TriangleMesh& mesh) {
  std::vector<uint32_t> root(mesh.points.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](uint32_t at) {
    while (root[at] != at) at = root[at] = root[root[at]];
    return at;
  };
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 1; k < 3; ++k) root[find(t[k])] = find(t[0]);
  std::map<uint32_t, std::vector<size_t>> parts;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) parts[find(mesh.triangles[i][0])].push_back(i);
  std::vector<std::vector<size_t>> list;
  for (auto& [at, part] : parts) list.push_back(std::move(part));
  return list;
}

/// For each edge, the triangles in one direction less those in the other.
size_t count_open_edges(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return static_cast<size_t>(std::ranges::count_if(edges, [](const auto& edge) { return edge.second != 0; }));
}

TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<size_t>& triangles, bool others) {
  TriangleMesh part;
  part.points = mesh.points;
  std::vector<bool> in(mesh.triangles.size(), others);
  for (const size_t i : triangles) in[i] = !others;
  for (size_t i = 0; i < in.size(); ++i)
    if (in[i]) part.triangles.push_back(mesh.triangles[i]);
  return part;
}

}  // namespace

void weld(TriangleMesh& mesh) {
  std::map<std::tuple<double, double, double>, uint32_t> places;
  std::vector<glm::dvec3> points;
  std::vector<uint32_t> place_of;
  for (const glm::dvec3& p : mesh.points) {
    const auto [found, is_new] = places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(points.size()));
    if (is_new) points.push_back(p);
    place_of.push_back(found->second);
  }
  std::set<Triangle> seen;
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    Triangle welded{place_of[t[0]], place_of[t[1]], place_of[t[2]]};
    if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
    std::rotate(welded.begin(), std::ranges::min_element(welded), welded.end());
    if (seen.insert(welded).second) triangles.push_back(welded);
  }
  mesh.points = std::move(points);
  mesh.triangles = std::move(triangles);
}

MeshRepair turn_inside_in(TriangleMesh& mesh) {
  MeshRepair repair;
  const auto parts = parts_of(mesh);
  repair.parts = parts.size();
  std::vector<size_t> turned;
  for (const auto& part : parts) {
    if (volume_of(mesh, part) >= 0.0) continue;
    if (parts.size() > 1) {
      const WindingTree others(part_of(mesh, part, true));
      if (std::abs(others.winding(mesh.points[mesh.triangles[part.front()][0]])) > 0.5) continue;  // a cavity
    }
    ++repair.turned_parts;
    turned.insert(turned.end(), part.begin(), part.end());
  }
  for (const size_t i : turned) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  repair.open_edges = count_open_edges(mesh);
  return repair;
}

double volume_m3(const TriangleMesh& mesh) {
  std::vector<size_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), size_t{0});
  return all.empty() ? 0.0 : volume_of(mesh, all);
}

}  // namespace scree
