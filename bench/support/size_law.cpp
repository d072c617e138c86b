#include "bench/support/size_law.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Least squares of y = intercept + slope · x.
struct Line {
  double slope = 0.0, intercept = 0.0;
};

Line line_through(const std::vector<glm::dvec2>& points) {
  glm::dvec2 mean(0.0);
  for (const glm::dvec2& p : points) mean += p / static_cast<double>(points.size());
  double xx = 0.0, xy = 0.0;
  for (const glm::dvec2& p : points) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  CHECK(xx > 0.0);
  return {xy / xx, mean.y - xy / xx * mean.x};
}

}  // namespace

SizeLaw size_law_of(std::vector<double> masses, double dust) {
  CHECK(masses.size() >= 3);
  std::ranges::sort(masses);
  const double all = std::accumulate(masses.begin(), masses.end(), dust);
  std::vector<glm::dvec2> points;
  double below = dust, d10 = 0.0, d90 = 0.0;
  for (const double mass : masses) {
    const double d = std::cbrt(mass);
    points.emplace_back(std::log(d), std::log(-std::log(1.0 - (below + 0.5 * mass) / all)));
    below += mass;
    if (d10 == 0.0 && below >= 0.1 * all) d10 = d;
    if (d90 == 0.0 && below >= 0.9 * all) d90 = d;
  }
  const Line line = line_through(points);
  const double at_smallest = line.intercept + line.slope * points.front().x;
  return {line.slope, d90 / d10, dust / all, 1.0 - std::exp(-std::exp(at_smallest))};
}

double near_over_far(const std::vector<const Volume*>& pieces, glm::vec3 place_voxels) {
  CHECK(pieces.size() >= 3);
  std::vector<std::pair<float, double>> by_distance;
  for (const Volume* piece : pieces)
    by_distance.emplace_back(glm::distance(piece->centre_voxels, place_voxels),
                             static_cast<double>(piece->mass));
  std::ranges::sort(by_distance);
  double near = 0.0, far = 0.0;
  for (size_t i = 0; i < by_distance.size() / 3; ++i) {
    near += by_distance[i].second;
    far += by_distance[by_distance.size() - 1 - i].second;
  }
  return near / far;
}

}  // namespace scree
