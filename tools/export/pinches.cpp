#include "tools/export/pinches.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "shared/base/check.h"

namespace scree {

namespace {

/// A triangle's corner at a point, with the triangle's other two points.
struct Corner {
  uint32_t triangle = 0;
  uint32_t next = 0;
  uint32_t before = 0;
};

/// The triangles at each point, in order.
class TrianglesAt {
 public:
  explicit TrianglesAt(const WeldedSurface& surface) : first_(surface.points.size() + 1, 0) {
    for (const auto& triangle : surface.triangles)
      for (const uint32_t point : triangle) ++first_[point + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    triangles_.resize(first_.back());
    std::vector<uint32_t> at(first_.begin(), first_.end() - 1);
    for (size_t i = 0; i < surface.triangles.size(); ++i)
      for (const uint32_t point : surface.triangles[i]) triangles_[at[point]++] = static_cast<uint32_t>(i);
  }

  /// The corners at a point.
  void read(const WeldedSurface& surface, uint32_t point, std::vector<Corner>& corners) const {
    corners.clear();
    for (uint32_t i = first_[point]; i < first_[point + 1]; ++i) {
      const auto& t = surface.triangles[triangles_[i]];
      const auto k = static_cast<size_t>(std::ranges::find(t, point) - t.begin());
      corners.push_back({triangles_[i], t[(k + 1) % 3], t[(k + 2) % 3]});
    }
  }

 private:
  std::vector<uint32_t> first_;
  std::vector<uint32_t> triangles_;
};

/// Two triangles that belong together at an edge which has others, too: the first goes along it from `a`.
struct EdgePair {
  uint32_t first, second;
  uint32_t a, b;
};

/// For each corner the one that comes next around the point. Where an edge has several triangles on a side,
/// the first of the one side belongs to the first of the other, and so on: from both of its ends that is the
/// same. Calls crowded(i, j) for pairs that are not the first at their edge.
template <typename Crowded>
void link(const std::vector<Corner>& corners, std::vector<size_t>& following, const Crowded& crowded) {
  following.resize(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    size_t nth = 0;
    for (size_t k = 0; k < i; ++k) nth += corners[k].next == corners[i].next ? 1 : 0;
    const bool is_crowded = nth > 0;
    size_t j = 0;
    for (; j < corners.size(); ++j)
      if (corners[j].before == corners[i].next && nth-- == 0) break;
    CHECK(j < corners.size());
    following[i] = j;
    if (is_crowded) crowded(i, j);
  }
}

std::vector<EdgePair> crowded_edges(const WeldedSurface& surface) {
  const TrianglesAt at(surface);
  std::vector<EdgePair> pairs;
  std::vector<Corner> corners;
  std::vector<size_t> following;
  for (uint32_t point = 0; point < surface.points.size(); ++point) {
    at.read(surface, point, corners);
    link(corners, following, [&](size_t i, size_t j) {
      if (point < corners[i].next)  // the other end has the same pair
        pairs.push_back({corners[i].triangle, corners[j].triangle, point, corners[i].next});
    });
  }
  return pairs;
}

/// Divides the one of some triangles that has the edge, in that direction.
void divide(WeldedSurface& surface, std::vector<uint32_t>& among, uint32_t a, uint32_t b, uint32_t middle) {
  for (const uint32_t i : among) {
    auto& t = surface.triangles[i];
    for (size_t k = 0; k < 3; ++k) {
      if (t[k] != a || t[(k + 1) % 3] != b) continue;
      const uint32_t apex = t[(k + 2) % 3];
      t = {a, middle, apex};
      among.push_back(static_cast<uint32_t>(surface.triangles.size()));
      surface.triangles.push_back({middle, b, apex});
      return;
    }
  }
}

/// Every pair but the first of an edge gets a point of its own in the middle.
void split_edges(WeldedSurface& surface, const std::vector<EdgePair>& crowded) {
  std::map<uint32_t, std::vector<uint32_t>> parts;  // of triangles that were divided
  const auto parts_of = [&](uint32_t triangle) -> std::vector<uint32_t>& {
    return parts.try_emplace(triangle, 1, triangle).first->second;
  };
  for (const EdgePair& pair : crowded) {
    const WeldedSurface::Point &a = surface.points[pair.a], &b = surface.points[pair.b];
    const WeldedSurface::Point half{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    const auto middle = static_cast<uint32_t>(surface.points.size());
    const auto material = surface.materials[pair.a];
    surface.points.push_back(half);
    surface.materials.push_back(material);
    divide(surface, parts_of(pair.first), pair.a, pair.b, middle);
    divide(surface, parts_of(pair.second), pair.b, pair.a, middle);
  }
}

/// Gives each sheet at a point, which are the rings of corners around it, a point of its own. No edge is
/// crowded.
void split_points(WeldedSurface& surface) {
  struct Change {
    uint32_t triangle, from, to;
  };
  std::vector<Change> changes;
  const TrianglesAt at(surface);
  const auto before = static_cast<uint32_t>(surface.points.size());
  std::vector<Corner> corners;
  std::vector<size_t> following;
  std::vector<bool> seen;
  for (uint32_t point = 0; point < before; ++point) {
    at.read(surface, point, corners);
    link(corners, following, [](size_t, size_t) { CHECK(false); });
    seen.assign(corners.size(), false);
    for (size_t first = 0; first < corners.size(); ++first) {
      if (seen[first]) continue;
      const auto added = static_cast<uint32_t>(surface.points.size());
      for (size_t i = first; !seen[i]; i = following[i]) {
        seen[i] = true;
        if (first != 0) changes.push_back({corners[i].triangle, point, added});  // the first ring keeps it
      }
      if (first == 0) continue;
      surface.points.push_back(surface.points[point]);
      surface.materials.push_back(surface.materials[point]);
    }
  }
  for (const auto& [triangle, from, to] : changes)
    std::ranges::replace(surface.triangles[triangle], from, to);
}

}  // namespace

size_t split_pinches(WeldedSurface& surface) {
  const size_t before = surface.points.size();
  split_edges(surface, crowded_edges(surface));
  split_points(surface);
  return surface.points.size() - before;
}

}  // namespace scree
