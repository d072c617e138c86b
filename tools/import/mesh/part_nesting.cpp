#include "tools/import/mesh/part_nesting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>

#include "tools/import/mesh/box_tree.h"
#include "tools/import/mesh/winding.h"

namespace scree {

namespace {

class Nesting {
 public:
  Nesting(TriangleMesh& mesh, std::vector<MeshPart>& parts, PartFindings& found)
      : mesh_(mesh), parts_(parts), found_(found), trees_(parts.size()), turned_(parts.size(), false) {
    std::vector<Box3> boxes;
    for (const MeshPart& part : parts) {
      boxes.emplace_back();
      for (const uint32_t i : part.triangles)
        for (const uint32_t corner : mesh.triangles[i]) boxes.back().add(mesh.points[corner]);
    }
    boxes_ = std::make_unique<BoxTree>(std::move(boxes));
  }

  /// Larger parts first: what is around a part is right before it is its turn.
  void run() {
    std::vector<uint32_t> order(parts_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, [&](uint32_t one, uint32_t other) {
      return std::abs(parts_[one].volume_m3) > std::abs(parts_[other].volume_m3);
    });
    for (const uint32_t at : order) {
      const bool inverted = parts_[at].volume_m3 < 0.0;
      if (!inverted && found_.turned_parts == 0) continue;
      const auto [winding, parent, parent_turned] = around(at);
      const bool stays_within = winding > 0.5;
      const bool against = stays_within && inverted != parent_turned;
      parts_[at].is_cavity = against;
      parts_[at].within = parent;
      found_.cavities += against ? 1 : 0;
      if (inverted != against) turn(at);
    }
  }

 private:
  struct Around {
    double winding = 0.0;
    uint32_t parent = 0;  ///< the smallest part around
    bool parent_turned = false;
  };

  Around around(uint32_t at) {
    const glm::dvec3 p = place_on(parts_[at]);
    const double own = std::abs(parts_[at].volume_m3);
    Around found;
    double smallest = 1e300;
    boxes_->each_near(p, 0.0, [&](uint32_t other) {
      const double volume = std::abs(parts_[other].volume_m3);
      if (other == at || volume <= own) return;
      const double winding = tree_of(other).winding(p);
      if (std::abs(winding) < 0.5) return;
      found.winding += winding;
      if (volume >= smallest) return;
      smallest = volume;
      found.parent = other;
      found.parent_turned = turned_[other];
    });
    return found;
  }

  /// The middle of its largest triangle.
  glm::dvec3 place_on(const MeshPart& part) const {
    uint32_t best = part.triangles.front();
    double area = -1.0;
    for (const uint32_t i : part.triangles)
      if (const double own = glm::length(normal_of(mesh_, i)); own > area) {
        area = own;
        best = i;
      }
    const TriangleMesh::Triangle& t = mesh_.triangles[best];
    return (mesh_.points[t[0]] + mesh_.points[t[1]] + mesh_.points[t[2]]) / 3.0;
  }

  const WindingTree& tree_of(uint32_t part) {
    if (trees_[part] == nullptr)
      trees_[part] = std::make_unique<WindingTree>(part_mesh(mesh_, parts_[part].triangles));
    return *trees_[part];
  }

  void turn(uint32_t at) {
    MeshPart& part = parts_[at];
    for (const uint32_t i : part.triangles) std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
    for (EdgeUse& use : part.open) use.forward = !use.forward;
    part.volume_m3 = -part.volume_m3;
    part.facing_m2 = -part.facing_m2;
    turned_[at] = true;
    ++found_.turned_parts;
  }

  TriangleMesh& mesh_;
  std::vector<MeshPart>& parts_;
  PartFindings& found_;
  std::unique_ptr<BoxTree> boxes_;
  std::vector<std::unique_ptr<WindingTree>> trees_;
  std::vector<bool> turned_;
};

}  // namespace

void turn_insides_in(TriangleMesh& mesh, std::vector<MeshPart>& parts, PartFindings& found) {
  Nesting(mesh, parts, found).run();
}

}  // namespace scree
