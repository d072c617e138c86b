#include "server/fracture/cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <tuple>
#include <voro++/voro++.hh>

namespace scree {

namespace {

/// voro++'s tolerances are absolute (1e-11), made for boxes of about this side. Duplicates and seeds outside
/// the container can drive it to exit(), so none is ever given.
constexpr double unit_side = 1.0;

/// Seeds that share a cube of this side, in units of the box, count as one.
constexpr double merge_side = 1e-5;

/// A block of voro++'s search grid works best with about five seeds.
constexpr double seeds_per_block = 5.0;

struct UnitBox {
  glm::dvec3 lo;
  double scale;
  glm::dvec3 size;

  UnitBox(glm::vec3 box_lo, glm::vec3 box_hi) : lo(box_lo) {
    const glm::dvec3 extent = glm::dvec3(box_hi) - lo;
    scale = unit_side / std::max({extent.x, extent.y, extent.z});
    size = extent * scale;
  }
  glm::dvec3 to_unit(glm::vec3 p) const { return (glm::dvec3(p) - lo) * scale; }
  glm::vec3 from_unit(glm::dvec3 p) const { return p / scale + lo; }
  bool holds(glm::dvec3 p) const {
    return p.x > merge_side && p.y > merge_side && p.z > merge_side && p.x < size.x - merge_side &&
           p.y < size.y - merge_side && p.z < size.z - merge_side;
  }
};

int blocks(double extent, double count, const glm::dvec3& size) {
  const double per_unit = std::cbrt(count / seeds_per_block / (size.x * size.y * size.z));
  return std::clamp(static_cast<int>(extent * per_unit + 0.5), 1, 32);
}

/// Puts every usable seed into the container, numbered by its index.
void put_seeds(const std::vector<glm::vec3>& seeds, const UnitBox& box, voro::container& container) {
  std::map<std::tuple<long, long, long>, int> taken;
  for (size_t i = 0; i < seeds.size(); ++i) {
    const glm::dvec3 p = box.to_unit(seeds[i]);
    if (!box.holds(p)) continue;
    const auto cube = [](double x) { return static_cast<long>(x / merge_side); };
    const int number = static_cast<int>(i);
    if (taken.try_emplace({cube(p.x), cube(p.y), cube(p.z)}, number).second)
      container.put(number, p.x, p.y, p.z);
  }
}

}  // namespace

std::vector<std::vector<glm::vec3>> cell_corners(const std::vector<glm::vec3>& seeds, glm::vec3 box_lo,
                                                 glm::vec3 box_hi) {
  std::vector<std::vector<glm::vec3>> corners(seeds.size());
  if (!(box_hi.x > box_lo.x && box_hi.y > box_lo.y && box_hi.z > box_lo.z)) return corners;
  const UnitBox box(box_lo, box_hi);
  const auto count = static_cast<double>(seeds.size());
  voro::container container(0.0, box.size.x, 0.0, box.size.y, 0.0, box.size.z,
                            blocks(box.size.x, count, box.size), blocks(box.size.y, count, box.size),
                            blocks(box.size.z, count, box.size), false, false, false, 8);
  put_seeds(seeds, box, container);
  voro::c_loop_all loop(container);
  voro::voronoicell cell;
  std::vector<double> flat;
  if (!loop.start()) return corners;
  do {
    if (!container.compute_cell(cell, loop)) continue;
    double x = 0.0, y = 0.0, z = 0.0;
    loop.pos(x, y, z);
    cell.vertices(x, y, z, flat);
    std::vector<glm::vec3>& out = corners[static_cast<size_t>(loop.pid())];
    for (size_t i = 0; i + 2 < flat.size(); i += 3)
      out.push_back(box.from_unit(glm::dvec3(flat[i], flat[i + 1], flat[i + 2])));
  } while (loop.inc());
  return corners;
}

}  // namespace scree
