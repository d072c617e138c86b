#include "tools/import/mesh/border_pairs.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/import/mesh/box_tree.h"

namespace scree {

namespace {

/// Places along an edge at which another border has to be near: none where edges are often divided.
constexpr std::array places = {0.07, 0.29, 0.47, 0.71, 0.93};

/// Cosine of the angle up to which two borders count as parallel.
constexpr double parallel_cosine = 0.95;

struct Segment {
  glm::dvec3 from;
  glm::dvec3 to;
};

Segment segment_of(const TriangleMesh& mesh, const EdgeUse& use) {
  const glm::dvec3 &a = mesh.points[use.a], &b = mesh.points[use.b];
  return use.forward ? Segment{a, b} : Segment{b, a};
}

/// Whether the segment passes p, and does not only end near it.
bool passes(const Segment& segment, const glm::dvec3& p, double tolerance_m) {
  const glm::dvec3 along = segment.to - segment.from;
  const double squared = glm::dot(along, along);
  if (!(squared > 0.0)) return false;
  const double at = glm::dot(p - segment.from, along) / squared;
  return at >= 0.0 && at <= 1.0 && glm::length(segment.from + at * along - p) <= tolerance_m;
}

double cosine(const Segment& one, const Segment& other) {
  const glm::dvec3 a = one.to - one.from, b = other.to - other.from;
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0.0 ? glm::dot(a, b) / lengths : 0.0;
}

}  // namespace

BorderMatch match_borders(const TriangleMesh& mesh, const std::vector<EdgeUse>& border, double tolerance_m) {
  BorderMatch match;
  match.joined.assign(border.size(), false);
  std::vector<Segment> segments;
  std::vector<Box3> boxes;
  for (const EdgeUse& use : border) {
    segments.push_back(segment_of(mesh, use));
    boxes.emplace_back();
    boxes.back().add(segments.back().from);
    boxes.back().add(segments.back().to);
  }
  const BoxTree tree(std::move(boxes));
  for (size_t i = 0; i < border.size(); ++i) {
    bool all = true;
    for (const double at : places) {
      const glm::dvec3 p = glm::mix(segments[i].from, segments[i].to, at);
      bool any = false;
      tree.each_near(p, tolerance_m, [&](uint32_t other) {
        if (other == i || border[other].triangle == border[i].triangle) return;
        const double angle = cosine(segments[i], segments[other]);
        if (std::abs(angle) < parallel_cosine || !passes(segments[other], p, tolerance_m)) return;
        any = true;
        if (match.pairs.empty() || match.pairs.back().one != border[i].triangle ||
            match.pairs.back().other != border[other].triangle)
          match.pairs.push_back({border[i].triangle, border[other].triangle, angle < 0.0});
      });
      all = all && any;
    }
    match.joined[i] = all;
  }
  return match;
}

}  // namespace scree
