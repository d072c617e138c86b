#include "tools/import/vdb/vdb_file.h"

#include <cmath>
#include <fmt/format.h>

#include "content/builtin_palette.h"
#include "proto/palette_codec.h"
#include "shared/base/limits.h"
#include "shared/base/regular_file.h"
#include "tools/import/limits.h"
#include "tools/import/vdb/grid_solid.h"
#include "tools/import/vdb/vdb_materials.h"
#include "tools/import/vdb/vdb_message.h"
#include "tools/import/vdb/vdb_sender.h"

namespace scree {

namespace {

using openvdb::FloatGrid;

void apply_metadata(const VdbHead& head, const VdbImport& how, VdbSolid& solid) {
  if (!has(head, VdbTold::voxel_size) || head.voxel_size_m != how.voxel_size_m || !how.place.is_identity())
    return;
  if (has(head, VdbTold::level) && std::isfinite(head.level_m)) solid.level_m = head.level_m;
  if (has(head, VdbTold::soil_below) && has(head, VdbTold::ice_above) && std::isfinite(head.soil_below_m) &&
      std::isfinite(head.ice_above_m))
    solid.layers = MaterialHeights{head.soil_below_m, head.ice_above_m};
  if (!has(head, VdbTold::chunks)) return;
  const auto& lo = head.chunks_lo;
  const auto& hi = head.chunks_hi;
  const BrickLayout box{how.voxel_size_m, {lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
  if (validate(box)) solid.exact = BricksImport::Exact{box.lo, box.hi};
}

Result<openvdb::math::Transform::Ptr> transform_of(const std::array<double, 16>& rows) {
  for (const double number : rows)
    if (!std::isfinite(number)) return fail("the grid's transform is none");
  const openvdb::Mat4d matrix(rows.data());
  if (matrix.det() == 0.0) return fail("the grid's transform is none");
  return openvdb::math::Transform::createLinearTransform(matrix);
}

/// Where the values are on one side alone: the reason that there is no rock.
Result<void> check_sides(const VdbHead& head, double density) {
  if (head.is_level_set != 0 && !(head.least < 0.0F))
    return fail("no value of the level set is negative: it has no inside");
  if (head.is_level_set == 0 && !(static_cast<double>(head.greatest) > density))
    return fail(fmt::format(
        "the densest value of the fog volume is {:.4g}, not above {:.4g}: --density says from which "
        "density on it is rock",
        head.greatest, density));
  return {};
}

Result<VdbSolid> solid_in(const std::string& path, const VdbImport& how) {
  TRY(check_is_file(path));
  const auto reader = TRY(ReaderProcess::start(
      "OpenVDB", how.reader, [&](ReaderChannel& channel) { return send_vdb(channel, path, how.grid); },
      {.files = {path}}));
  const auto head = TRY(reader->get<VdbHead>());
  VdbSolid solid;
  solid.grid = TRY(reader->get_text());
  solid.all_grids = TRY(reader->get_text());
  solid.is_level_set = head.is_level_set != 0;
  TRY(check_sides(head, how.density));
  openvdb::initialize();
  const auto grid = TRY(receive_grid<FloatGrid>(*reader, limits::import_leaves_max,
                                                [](float value) { return std::isfinite(value); }));
  grid->setTransform(TRY(transform_of(head.to_world)));
  if (solid.is_level_set) grid->setGridClass(openvdb::GRID_LEVEL_SET);
  MaterialGrid materials;
  if (head.has_materials != 0) {
    ImportPalette builtin(shared_builtin_palette());
    const auto names = TRY(reader->get_list<uint8_t>(palette_bytes_max));
    const auto packed = TRY(reader->get_list<uint8_t>(2 * palette_bytes_max));
    materials.grid = TRY(
        receive_grid<openvdb::Int32Grid>(*reader, limits::import_leaves_max, [](int32_t) { return true; }));
    std::set<int32_t> occurring;
    for (auto value = materials.grid->cbeginValueOn(); value; ++value)
      if (*value >= 0 && static_cast<size_t>(*value) < materials_max) occurring.insert(*value);
    materials.rows = TRY(rows_of_numbers(names, packed, occurring, how.map,
                                         how.palette != nullptr ? *how.palette : builtin, solid.map_used));
    materials.grid->setTransform(TRY(transform_of(head.materials_to_world)));
  }
  const GridSide side =
      solid.is_level_set ? GridSide{0.0F, 1.0F} : GridSide{static_cast<float>(how.density), -1.0F};
  if (side.sign * (grid->background() - side.iso) < 0.0F)
    return fail("the grid's background is inside the rock: it must be outside");
  solid.own_volume_m3 = rock_volume_m3(*grid, side, how.place);
  solid.solid = TRY(solid_of_grid(grid, materials, side, how.place, how.voxel_size_m));
  apply_metadata(head, how, solid);
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
