#include "tools/import/vdb/grid_solid.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <openvdb/tools/Interpolation.h>
#include <set>

#include "tools/import/limits.h"

namespace scree {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb::Vec3d;

/// Voxels of the world around the surface that the narrow band reaches.
constexpr int band_around = 4;

/// Tiles up to this side are taken to be surface as a whole, larger ones at their faces. Voxels of the grid.
constexpr int whole_tile_max = 128;

Vec3d turned(const Vec3d& p, bool z_up) {
  return z_up ? Vec3d(p.x(), p.z(), -p.y()) : p;
}
Vec3d turned_back(const Vec3d& p, bool z_up) {
  return z_up ? Vec3d(p.x(), -p.z(), p.y()) : p;
}

Vec3d corner(const CoordBBox& box, int i) {
  return {static_cast<double>((i & 4) != 0 ? box.max().x() : box.min().x()),
          static_cast<double>((i & 2) != 0 ? box.max().y() : box.min().y()),
          static_cast<double>((i & 1) != 0 ? box.max().z() : box.min().z())};
}

class GridSolid final : public Solid {
 public:
  GridSolid(FloatGrid::Ptr grid, MaterialGrid materials, const GridSide& side, const Placement& place,
            float voxel_size_m)
      : grid_(std::move(grid)),
        materials_(std::move(materials)),
        side_(side),
        place_(place),
        voxel_m_(voxel_size_m) {}

  /// Before all else.
  Result<void> survey() {
    find_box();
    if (box_.empty()) return fail("it has no rock at all");
    TRY(layout_around(box_, static_cast<float>(voxel_m_)));
    find_surface();
    if (touched_ > limits::solid_surface_max)
      return fail(
          fmt::format("it is too large for voxels of {:.6g} m (limits.solid_surface_max); larger ones "
                      "(--voxel-size) or a smaller --scale fit",
                      voxel_m_));
    return {};
  }

  std::vector<ChunkCoord> surface_chunks() const override { return {surface_.begin(), surface_.end()}; }
  VoxelBox box() const override { return box_; }
  double lowest_m() const override { return lowest_m_; }

  void read_levels(const VoxelBox& box, std::span<float> levels) const override {
    FloatGrid::ConstAccessor accessor = grid_->getConstAccessor();
    const bool aligned = is_aligned();
    const float unit = side_.sign / (grid_->getGridClass() == openvdb::GRID_LEVEL_SET
                                         ? static_cast<float>(voxel_m_ / place_.scale)
                                         : 1.0F);
    size_t i = 0;
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z, ++i) {
          const Vec3d at = index_of({x, y, z});
          const float value = aligned ? accessor.getValue(Coord::round(at))
                                      : openvdb::tools::BoxSampler::sample(accessor, at);
          levels[i] = (value - side_.iso) * unit;
        }
  }

  bool is_inside(VoxelCoord voxel) const override {
    return is_rock(grid_->getConstAccessor().getValue(Coord::round(index_of(voxel))));
  }

  /// Each voxel's is that of the grid's voxel nearest to it.
  BrickMaterials materials(BrickCoord brick) const override {
    if (materials_.grid == nullptr) return {};
    openvdb::Int32Grid::ConstAccessor accessor = materials_.grid->getConstAccessor();
    const VoxelCoord first = first_voxel(brick);
    VoxelMaterials voxels;
    for (int i = 0; i < brick_voxels; ++i) {
      const VoxelCoord voxel = first + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7};
      int32_t number = 0;
      const bool is_said =
          accessor.probeValue(Coord::round(materials_.grid->worldToIndex(world_of(voxel))), number);
      const bool is_row = is_said && number >= 0 && static_cast<size_t>(number) < materials_.rows.size();
      voxels[static_cast<size_t>(i)] = is_row ? materials_.rows[static_cast<size_t>(number)] : ground_own;
    }
    return BrickMaterials(voxels);
  }

 private:
  bool is_rock(float value) const { return side_.sign * (value - side_.iso) < 0.0F; }

  /// In the file's own metres.
  Vec3d world_of(VoxelCoord voxel) const {
    const Vec3d here(voxel.x * voxel_m_ - place_.at_m[0], voxel.y * voxel_m_ - place_.at_m[1],
                     voxel.z * voxel_m_ - place_.at_m[2]);
    return turned_back(here / place_.scale, place_.z_up);
  }
  Vec3d index_of(VoxelCoord voxel) const { return grid_->worldToIndex(world_of(voxel)); }

  /// Where a place of the grid lies, in voxels of the world.
  Vec3d voxel_of(const Vec3d& index) const {
    const Vec3d p = turned(grid_->indexToWorld(index), place_.z_up) * place_.scale;
    return Vec3d(p.x() + place_.at_m[0], p.y() + place_.at_m[1], p.z() + place_.at_m[2]) / voxel_m_;
  }

  /// Whether the world's voxels lie on the grid's.
  bool is_aligned() const {
    const auto whole = [](const Vec3d& at) {
      for (int axis = 0; axis < 3; ++axis)
        if (std::abs(at[axis] - std::round(at[axis])) > 1e-4) return false;
      return true;
    };
    return whole(index_of({0, 0, 0})) && whole(index_of({1, 0, 0})) && whole(index_of({0, 1, 0})) &&
           whole(index_of({0, 0, 1})) && whole(index_of({1000, 1000, 1000}));
  }

  /// The world's voxels around a box of the grid's.
  VoxelBox voxels_around(const CoordBBox& grid_box, int around) const {
    constexpr double far = 1.0e8;
    Vec3d lo(far), hi(-far);
    for (int i = 0; i < 8; ++i) {
      const Vec3d at = voxel_of(corner(grid_box, i));
      lo = openvdb::math::minComponent(lo, at);
      hi = openvdb::math::maxComponent(hi, at);
    }
    const auto whole = [&](double value) {
      return static_cast<int>(std::floor(std::isfinite(value) ? std::clamp(value, -far, far) : far));
    };
    return VoxelBox{{whole(lo.x()), whole(lo.y()), whole(lo.z())},
                    {whole(hi.x()) + 2, whole(hi.y()) + 2, whole(hi.z()) + 2}}
        .grown(around);
  }

  void add_surface(const CoordBBox& grid_box) {
    const VoxelBox box = voxels_around(grid_box, band_around);
    touched_ = std::max(touched_, surface_.size() + count_chunks(box));
    if (touched_ > limits::solid_surface_max) return;
    for_each_chunk(box, [this](ChunkCoord chunk) { surface_.insert(chunk); });
  }

  void add_faces(const CoordBBox& box) {
    if (box.dim().x() <= whole_tile_max) return add_surface(box);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool low : {true, false}) {
        CoordBBox face = box;
        if (low)
          face.max()[axis] = face.min()[axis];
        else
          face.min()[axis] = face.max()[axis];
        add_surface(face);
      }
  }

  /// Whether rock and air meet in the leaf, or beside it.
  bool is_surface(const FloatGrid::TreeType::LeafNodeType& leaf, FloatGrid::ConstAccessor& accessor) const {
    bool rock = false, air = false;
    for (openvdb::Index i = 0; i < leaf.SIZE; ++i) (is_rock(leaf.getValue(i)) ? rock : air) = true;
    if (rock && air) return true;
    CoordBBox around = leaf.getNodeBoundingBox();
    around.expand(1);
    for (auto at = around.begin(); at; ++at)
      if (is_rock(accessor.getValue(*at)) != rock) return true;
    return false;
  }

  /// Calls f(box) for each tile of rock larger than a voxel.
  template <typename F>
  void for_each_rock_tile(F&& f) const {
    auto tile = grid_->tree().cbeginValueAll();
    tile.setMaxDepth(FloatGrid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
      if (!is_rock(*tile)) continue;
      CoordBBox box;
      tile.getBoundingBox(box);
      f(box);
    }
  }

  void find_box() {
    CoordBBox rock;
    for (auto leaf = grid_->tree().cbeginLeaf(); leaf; ++leaf)
      for (auto value = leaf->cbeginValueAll(); value; ++value)
        if (is_rock(*value)) rock.expand(value.getCoord());
    for_each_rock_tile([&](const CoordBBox& box) { rock.expand(box); });
    if (rock.empty()) return;
    lowest_m_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) lowest_m_ = std::min(lowest_m_, voxel_of(corner(rock, i)).y() * voxel_m_);
    // Its surface lies up to a voxel of the grid beyond its outermost rock.
    rock.expand(1);
    box_ = voxels_around(rock, 0);
  }

  void find_surface() {
    FloatGrid::ConstAccessor accessor = grid_->getConstAccessor();
    for (auto leaf = grid_->tree().cbeginLeaf(); leaf; ++leaf)
      if (is_surface(*leaf, accessor)) add_surface(leaf->getNodeBoundingBox());
    for_each_rock_tile([&](const CoordBBox& box) { add_faces(box); });
  }

  const FloatGrid::Ptr grid_;
  const MaterialGrid materials_;
  const GridSide side_;
  const Placement place_;
  const double voxel_m_;
  std::set<ChunkCoord> surface_;
  size_t touched_ = 0;  ///< the most chunks that there may have been
  VoxelBox box_{};
  double lowest_m_ = 0.0;
};

}  // namespace

Result<std::unique_ptr<Solid>> solid_of_grid(openvdb::FloatGrid::Ptr grid, MaterialGrid materials,
                                             const GridSide& side, const Placement& place,
                                             float voxel_size_m) {
  auto solid = std::make_unique<GridSolid>(std::move(grid), std::move(materials), side, place, voxel_size_m);
  TRY(solid->survey());
  return solid;
}

double rock_volume_m3(const FloatGrid& grid, const GridSide& side, const Placement& place) {
  const double voxel_m3 = grid.transform().voxelVolume();
  const bool is_level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  const double voxel_m = std::cbrt(voxel_m3);
  double voxels = 0.0;
  for (auto value = grid.cbeginValueAll(); value; ++value) {
    const double outside = static_cast<double>(side.sign * (*value - side.iso));
    if (value.isVoxelValue())
      voxels += is_level_set ? std::clamp(0.5 - outside / voxel_m, 0.0, 1.0) : (outside < 0.0 ? 1.0 : 0.0);
    else if (outside < 0.0)
      voxels += static_cast<double>(value.getVoxelCount());
  }
  return voxels * voxel_m3 * place.scale * place.scale * place.scale;
}

}  // namespace scree
