// Whether a mesh is closed: every edge is shared by exactly two triangles, once in each direction.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace scree {

/// The number of uses of each edge, by keys of its corners.
template <typename Corner>
using EdgeUses = std::map<std::pair<Corner, Corner>, int>;

/// `corner_of(index)`: the key of a corner, equal for equal corners of all meshes counted together.
template <typename Corner, typename CornerOf>
void count_edges(std::span<const uint32_t> indices, const CornerOf& corner_of, EdgeUses<Corner>& uses) {
  for (size_t t = 0; t < indices.size(); t += 3)
    for (size_t i = 0; i < 3; ++i) ++uses[{corner_of(indices[t + i]), corner_of(indices[t + (i + 1) % 3])}];
}

template <typename Corner>
int open_edges(const EdgeUses<Corner>& uses) {
  int open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end() || back->second != 1) ++open;
  }
  return open;
}

}  // namespace scree
