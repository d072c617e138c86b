#include "tools/import/vdb/vdb_file.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <openvdb/io/File.h>

#include "shared/base/limits.h"
#include "tools/import/vdb/grid_solid.h"
#include "tools/import/vdb/vdb_names.h"

namespace scree {

namespace {

using openvdb::FloatGrid;

std::string list_of(const openvdb::GridPtrVec& grids) {
  std::string list;
  for (const auto& grid : grids)
    list += fmt::format("{}'{}' of {}", list.empty() ? "" : ", ", grid->getName(), grid->valueType());
  return list;
}

/// Floats, or doubles rounded to them.
FloatGrid::Ptr floats_of(const openvdb::GridBase::Ptr& grid) {
  if (auto floats = openvdb::gridPtrCast<FloatGrid>(grid)) return floats;
  const auto doubles = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid);
  if (doubles == nullptr) return nullptr;
  auto made =
      std::make_shared<FloatGrid>(*doubles);  // copies transform and metadata, and converts the values
  return made;
}

Result<FloatGrid::Ptr> grid_of(const openvdb::GridPtrVec& grids, const std::string& name) {
  for (const auto& grid : grids) {
    if (!name.empty() && grid->getName() != name) continue;
    if (auto floats = floats_of(grid)) return floats;
    if (!name.empty())
      return fail(fmt::format("its grid '{}' has values of type {}, not floats", name, grid->valueType()));
  }
  if (grids.empty()) return fail("it holds no grid");
  return fail(name.empty() ? fmt::format("it has no grid of floats; it has {}", list_of(grids))
                           : fmt::format("it has no grid '{}'; it has {}", name, list_of(grids)));
}

Result<void> check_values(const FloatGrid& grid) {
  if (grid.empty()) return fail("the grid is empty");
  if (!std::isfinite(grid.background())) return fail("the grid's background is not a number");
  for (auto value = grid.cbeginValueAll(); value; ++value)
    if (!std::isfinite(*value)) {
      const openvdb::Coord at = value.getCoord();
      return fail(
          fmt::format("the grid has a value that is not a number, at ({}, {}, {})", at.x(), at.y(), at.z()));
    }
  const openvdb::Vec3d size = grid.voxelSize();
  for (int axis = 0; axis < 3; ++axis)
    if (!(size[axis] > 0.0) || !std::isfinite(size[axis])) return fail("the grid's voxels have no size");
  return {};
}

/// As the grid says, or else by its values: distances are negative somewhere.
bool is_level_set(const FloatGrid& grid) {
  if (grid.getGridClass() != openvdb::GRID_UNKNOWN) return grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  if (grid.background() <= 0.0F) return false;
  for (auto value = grid.cbeginValueAll(); value; ++value)
    if (*value < 0.0F) return true;
  return false;
}

template <typename T>
std::optional<T> told(const FloatGrid& grid, const char* name) {
  const auto meta = grid.getMetadata<openvdb::TypedMetadata<T>>(name);
  return meta ? std::optional(meta->value()) : std::nullopt;
}

void apply_metadata(const FloatGrid& grid, const VdbImport& how, VdbSolid& solid) {
  const auto voxel_m = told<float>(grid, vdb_names::voxel_size_m);
  if (!voxel_m || *voxel_m != how.voxel_size_m || !how.place.is_identity()) return;
  solid.level_m = told<double>(grid, vdb_names::level_m);
  const auto soil = told<float>(grid, vdb_names::soil_below_m),
             ice = told<float>(grid, vdb_names::ice_above_m);
  if (soil && ice && std::isfinite(*soil) && std::isfinite(*ice)) solid.layers = MaterialHeights{*soil, *ice};
  const auto lo = told<openvdb::Vec3i>(grid, vdb_names::chunks_lo),
             hi = told<openvdb::Vec3i>(grid, vdb_names::chunks_hi);
  if (!lo || !hi) return;
  const BrickLayout box{how.voxel_size_m, {lo->x(), lo->y(), lo->z()}, {hi->x(), hi->y(), hi->z()}};
  if (validate(box)) solid.exact = BricksImport::Exact{box.lo, box.hi};
}

Result<openvdb::GridPtrVec> grids_in(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return fail("there is no such file");
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open(false);
  return *file.getGrids();
}

Result<VdbSolid> solid_in(const std::string& path, const VdbImport& how) {
  const auto grids = TRY(grids_in(path));
  const auto grid = grid_of(grids, how.grid);
  TRY(grid);
  TRY(check_values(**grid));
  openvdb::Int32Grid::Ptr materials;
  for (const auto& other : grids)
    if (other->getName() == vdb_names::material) materials = openvdb::gridPtrCast<openvdb::Int32Grid>(other);
  VdbSolid solid;
  solid.grid = (*grid)->getName();
  solid.is_level_set = is_level_set(**grid);
  if (solid.is_level_set) (*grid)->setGridClass(openvdb::GRID_LEVEL_SET);
  const GridSide side =
      solid.is_level_set ? GridSide{0.0F, 1.0F} : GridSide{static_cast<float>(how.density), -1.0F};
  if (side.sign * ((*grid)->background() - side.iso) < 0.0F)
    return fail("the grid's background is inside the rock: it must be outside");
  auto made = TRY(solid_of_grid(*grid, materials, side, how.place, how.voxel_size_m));
  solid.solid = std::move(made);
  apply_metadata(**grid, how, solid);
  return solid;
}

}  // namespace

Result<VdbSolid> read_vdb(const std::string& path, const VdbImport& how) {
  try {
    auto solid = solid_in(path, how);
    if (!solid) return fail(path + ": " + solid.error().message);
    return solid;
  } catch (const std::bad_alloc&) {
    return fail(path + ": it does not fit into memory (--memory-max)");
  } catch (const std::exception& error) {
    return fail(path + ": not an OpenVDB file, or a damaged one: " + error.what());
  }
}

}  // namespace scree
