#include "tools/import/mesh/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace scree {

std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = mesh.triangles[i][k], to = mesh.triangles[i][(k + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<uint32_t>(i), from < to});
    }
  std::ranges::sort(uses, [](const EdgeUse& one, const EdgeUse& other) {
    return std::tie(one.a, one.b, one.triangle) < std::tie(other.a, other.b, other.triangle);
  });
  return uses;
}

std::vector<EdgeUse> border_edges(const std::vector<EdgeUse>& uses) {
  std::vector<EdgeUse> border;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 1) border.push_back(edge.front());
  });
  return border;
}

int balance_of(std::span<const EdgeUse> uses) {
  int balance = 0;
  for (const EdgeUse& use : uses) balance += use.forward ? 1 : -1;
  return balance;
}

void retain_triangles(TriangleMesh& mesh, const std::vector<bool>& stays) {
  size_t left = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!stays[i]) continue;
    mesh.triangles[left] = mesh.triangles[i];
    if (!mesh.materials.empty()) mesh.materials[left] = mesh.materials[i];
    ++left;
  }
  mesh.triangles.resize(left);
  if (!mesh.materials.empty()) mesh.materials.resize(left);
}

}  // namespace scree
