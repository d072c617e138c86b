#include "tools/import/mesh/mesh_bodies.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "tools/import/limits.h"

namespace scree {

namespace {

/// Rounding of the files' numbers, which most readers make 32-bit floats, relative to the largest.
constexpr double rounding = 4.0e-7;

/// Borders count as joined up to this part of a voxel: a slit of that width is not seen.
constexpr double slit_voxels = 0.05;

/// Sheets with less of a file's area than this are left out, and said, where no rule was chosen.
constexpr double stray_share = 0.001;

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const glm::dvec3& p : mesh.points)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

void append(TriangleMesh& to, const TriangleMesh& more) {
  const auto first = static_cast<uint32_t>(to.points.size());
  to.points.insert(to.points.end(), more.points.begin(), more.points.end());
  for (size_t i = 0; i < more.triangles.size(); ++i) {
    const TriangleMesh::Triangle& t = more.triangles[i];
    to.add({t[0] + first, t[1] + first, t[2] + first}, more.material_of(i));
  }
}

class Sorting {
 public:
  Sorting(TriangleMesh mesh, const BodiesRule& rule) : mesh_(std::move(mesh)), rule_(rule) {
    bodies_.triangles = mesh_.triangles.size();
    bodies_.closed.name = mesh_.name;
    bodies_.welded = weld(mesh_, rounding * largest_coordinate(mesh_));
    parts_ = parts_of(mesh_, slit_voxels * rule.voxel_m, bodies_.turned);
    for (const MeshPart& part : parts_) {
      if (!part.is_cavity) continue;
      hollows_[part.within].volume_m3 += part.volume_m3;
      hollows_[part.within].area_m2 += part.area_m2;
    }
    double all_m2 = 0.0, sheets_m2 = 0.0;
    for (const MeshPart& part : parts_) {
      sheets_.push_back(is_sheet(mesh_, part, rule.voxel_m));
      all_m2 += part.area_m2;
      sheets_m2 += sheets_.back() ? part.area_m2 : 0.0;
    }
    if (rule.sheet == SheetRule::refuse && sheets_m2 <= stray_share * all_m2) rule_.sheet = SheetRule::drop;
  }

  Result<MeshBodies> run() {
    if (rule_.sheet == SheetRule::refuse && std::ranges::find(sheets_, true) != sheets_.end())
      return refusal();
    bodies_.bottom_m = bottom_m();
    std::vector<uint32_t> closed;
    for (size_t i = 0; i < parts_.size(); ++i)
      if (parts_[i].open.empty() && !is_within_open(i)) {
        closed.insert(closed.end(), parts_[i].triangles.begin(), parts_[i].triangles.end());
        count(bodies_.whole, parts_[i], parts_[i].volume_m3);
      }
    bodies_.closed = part_mesh(mesh_, closed);
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].open.empty()) continue;
      if (!is_closed_by_windings(i))
        TRY(settle_sheet(parts_[i]));
      else
        TRY(add_open(parts_[i]));
    }
    if (holed_m2_ > 0.0) bodies_.missing = caps_m2_ / (holed_m2_ + caps_m2_);
    return std::move(bodies_);
  }

 private:
  tl::unexpected<Error> refusal() const {
    PartCount sheets;
    const MeshPart* largest = nullptr;
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (!sheets_[i]) continue;
      ++sheets.parts;
      sheets.area_m2 += parts_[i].area_m2;
      if (largest == nullptr || parts_[i].area_m2 > largest->area_m2) largest = &parts_[i];
    }
    const glm::dvec3& at = mesh_.points[mesh_.triangles[largest->triangles.front()][0]];
    return fail(fmt::format(
        "{} of its {} parts are open sheets, as terrain meshes and scans are: {:.6g} m², the largest near "
        "({:.1f}, {:.1f}, {:.1f}); they have no other side. --sheet down fills the rock below them, --sheet "
        "close "
        "closes them by winding numbers, --sheet drop leaves them out",
        sheets.parts, parts_.size(), sheets.area_m2, at.x, at.y, at.z));
  }

  double bottom_m() const {
    double bottom = rule_.level_m.value_or(1e300);
    for (size_t i = 0; i < parts_.size(); ++i)
      if (sheets_[i]) bottom = std::min(bottom, lowest_m(mesh_, parts_[i]));
    return bottom;
  }

  /// Whether parts with holes stay open bodies. Sheets are filled down or left out,
  /// unless they are to be closed.
  bool is_closed_by_windings(size_t at) const { return !sheets_[at] || rule_.sheet == SheetRule::close; }

  /// A cavity in a part with holes belongs to that part's winding numbers.
  bool is_within_open(size_t at) {
    if (!parts_[at].is_cavity) return false;
    const uint32_t around = parts_[at].within;
    if (parts_[around].open.empty() || !is_closed_by_windings(around)) return false;
    auto& cavities = cavities_[around];
    cavities.insert(cavities.end(), parts_[at].triangles.begin(), parts_[at].triangles.end());
    count(bodies_.holed, parts_[at], parts_[at].volume_m3);
    return true;
  }

  void count(PartCount& kind, const MeshPart& part, double volume_m3) {
    ++kind.parts;
    kind.volume_m3 += volume_m3;
    kind.area_m2 += part.area_m2;
    if (part.is_cavity) return;
    const auto number = static_cast<size_t>(&part - parts_.data());
    const auto [hollow_m3, hollow_m2] = hollows_.contains(number) ? hollows_.at(number) : Hollow{};
    const double rock_m3 = std::abs(volume_m3) - std::abs(hollow_m3);
    const double area_m2 = part.area_m2 + hollow_m2;
    const double thickness_m = area_m2 > 0.0 ? 2.0 * std::abs(rock_m3) / area_m2 : 0.0;
    if (thickness_m >= 2.0 * rule_.voxel_m) return;
    const bool is_first = bodies_.thin.parts + bodies_.slim.parts == 0;
    if (is_first || thickness_m < bodies_.thinnest_m) bodies_.thinnest_m = thickness_m;
    PartCount& few = thickness_m < rule_.voxel_m ? bodies_.thin : bodies_.slim;
    ++few.parts;
    few.volume_m3 += rock_m3;
    few.area_m2 += area_m2;
  }

  Result<void> settle_sheet(const MeshPart& part) {
    if (rule_.sheet == SheetRule::drop) {
      ++bodies_.dropped.parts;
      bodies_.dropped.area_m2 += part.area_m2;
      return {};
    }
    if (bodies_.filled.parts == limits::import_open_parts_max)
      return fail(
          fmt::format("more than {} of its parts are open sheets (limits.import_open_parts_max), too "
                      "many to fill the rock below each: --sheet drop leaves them out",
                      limits::import_open_parts_max));
    const TriangleMesh filled = filled_down(mesh_, part, bodies_.bottom_m);
    ++bodies_.filled.parts;
    bodies_.filled.volume_m3 += scree::volume_m3(filled);
    bodies_.filled.area_m2 += part.area_m2;
    append(bodies_.closed, filled);
    return {};
  }

  Result<void> add_open(const MeshPart& part) {
    if (bodies_.open.size() == limits::import_open_parts_max)
      return fail(fmt::format("more than {} of its parts have holes (limits.import_open_parts_max)",
                              limits::import_open_parts_max));
    OpenBody body;
    std::vector<uint32_t> triangles = part.triangles;
    const auto cavities = cavities_.find(static_cast<size_t>(&part - parts_.data()));
    if (cavities != cavities_.end())
      triangles.insert(triangles.end(), cavities->second.begin(), cavities->second.end());
    body.mesh = part_mesh(mesh_, triangles);
    for (const EdgeUse& use : part.open) body.edges.push_back({mesh_.points[use.a], mesh_.points[use.b]});
    bodies_.open.push_back(std::move(body));
    bodies_.open_edges += part.open.size();
    holed_m2_ += part.area_m2;
    caps_m2_ += part.caps_m2;
    count(bodies_.holed, part, part.volume_m3);
    return {};
  }

  /// The cavities of a part together: what is left of it around them are walls.
  struct Hollow {
    double volume_m3 = 0.0;
    double area_m2 = 0.0;
  };

  TriangleMesh mesh_;
  BodiesRule rule_;
  MeshBodies bodies_;
  std::vector<MeshPart> parts_;
  std::vector<bool> sheets_;
  std::map<size_t, std::vector<uint32_t>> cavities_;  ///< triangles, by the part with holes around them
  std::map<size_t, Hollow> hollows_;                  ///< by the part around them
  double holed_m2_ = 0.0;
  double caps_m2_ = 0.0;
};

}  // namespace

Result<MeshBodies> bodies_of(TriangleMesh mesh, const BodiesRule& rule) {
  return Sorting(std::move(mesh), rule).run();
}

}  // namespace scree
