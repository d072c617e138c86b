#include "tools/import/vdb/vdb_sender.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <openvdb/io/File.h>

#include "tools/import/vdb/vdb_message.h"
#include "tools/import/vdb/vdb_names.h"

namespace scree {

namespace {

using openvdb::FloatGrid;

/// A grid of floats, and the name by which --grid chooses it.
struct Candidate {
  std::string name;
  FloatGrid::Ptr grid;
  bool is_level_set = false;
};

/// Floats, or doubles rounded to them.
FloatGrid::Ptr floats_of(const openvdb::GridBase::Ptr& grid) {
  if (auto floats = openvdb::gridPtrCast<FloatGrid>(grid)) return floats;
  const auto doubles = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid);
  if (doubles == nullptr) return nullptr;
  return std::make_shared<FloatGrid>(*doubles);  // copies transform and metadata, and converts the values
}

/// As the grid says, or else by its values: distances are negative somewhere.
bool is_level_set(const FloatGrid& grid) {
  if (grid.getGridClass() != openvdb::GRID_UNKNOWN) return grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  if (grid.background() <= 0.0F) return false;
  for (auto value = grid.cbeginValueAll(); value; ++value)
    if (*value < 0.0F) return true;
  return false;
}

/// Grids of one name are told apart by a number in brackets, as OpenVDB's own tools do.
std::vector<std::string> names_of(const openvdb::GridPtrVec& grids) {
  std::vector<std::string> names;
  for (size_t i = 0; i < grids.size(); ++i) {
    size_t before = 0, all = 0;
    for (size_t k = 0; k < grids.size(); ++k)
      if (grids[k]->getName() == grids[i]->getName()) {
        before += k < i ? 1 : 0;
        ++all;
      }
    names.push_back(grids[i]->getName() + (all > 1 ? fmt::format("[{}]", before) : ""));
  }
  return names;
}

std::string list_of(const openvdb::GridPtrVec& grids) {
  const std::vector<std::string> names = names_of(grids);
  std::string list;
  for (size_t i = 0; i < grids.size(); ++i)
    list += fmt::format("{}'{}' of {}", list.empty() ? "" : ", ", names[i], grids[i]->valueType());
  return list;
}

std::string list_of(const std::vector<Candidate>& candidates) {
  std::string list;
  for (const Candidate& one : candidates) list += fmt::format("{}'{}'", list.empty() ? "" : ", ", one.name);
  return list;
}

/// Without a name there must be no choice: one level set, or no level set and one other grid.
Result<Candidate> chosen(const openvdb::GridPtrVec& grids, const std::string& name) {
  if (grids.empty()) return fail("it holds no grid");
  const std::vector<std::string> names = names_of(grids);
  std::vector<Candidate> level_sets, others;
  for (size_t i = 0; i < grids.size(); ++i) {
    if (!name.empty() && names[i] != name) continue;
    auto floats = floats_of(grids[i]);
    if (floats == nullptr) {
      if (name.empty()) continue;
      return fail(
          fmt::format("its grid '{}' has values of type {}, not floats", name, grids[i]->valueType()));
    }
    if (name.empty() && floats->empty()) continue;
    const bool level_set = is_level_set(*floats);
    (level_set ? level_sets : others).push_back({names[i], std::move(floats), level_set});
  }
  auto& candidates = level_sets.empty() ? others : level_sets;
  if (candidates.size() == 1) return candidates.front();
  if (!candidates.empty())
    return fail(fmt::format("it holds {} {}, {}: --grid NAME says which becomes rock", candidates.size(),
                            level_sets.empty() ? "grids of floats" : "level sets", list_of(candidates)));
  return fail(name.empty() ? fmt::format("it has no grid of floats with values; it has {}", list_of(grids))
                           : fmt::format("it has no grid '{}'; it has {}", name, list_of(grids)));
}

Result<void> check_values(const FloatGrid& grid, VdbHead& head) {
  if (grid.empty()) return fail("the grid is empty");
  if (!std::isfinite(grid.background())) return fail("the grid's background is not a number");
  head.least = head.greatest = grid.background();
  for (auto value = grid.cbeginValueAll(); value; ++value) {
    if (!std::isfinite(*value)) {
      const openvdb::Coord at = value.getCoord();
      return fail(
          fmt::format("the grid has a value that is not a number, at ({}, {}, {})", at.x(), at.y(), at.z()));
    }
    head.least = std::min(head.least, *value);
    head.greatest = std::max(head.greatest, *value);
  }
  return {};
}

Result<std::array<double, 16>> matrix_of(const openvdb::GridBase& grid) {
  if (!grid.transform().isLinear())
    return fail(fmt::format("the transform of its grid '{}' is not linear: resample it to cubes first",
                            grid.getName()));
  const auto matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
  std::array<double, 16> rows{};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      rows[static_cast<size_t>(4 * row + column)] = matrix(row, column);
  const openvdb::Vec3d size = grid.voxelSize();
  for (int axis = 0; axis < 3; ++axis)
    if (!(size[axis] > 0.0) || !std::isfinite(size[axis])) return fail("the grid's voxels have no size");
  return rows;
}

template <typename T, typename To>
void tell(const FloatGrid& grid, const char* name, VdbTold what, To& to, VdbHead& head) {
  const auto meta = grid.getMetadata<openvdb::TypedMetadata<T>>(name);
  if (!meta) return;
  to = meta->value();
  head.told = static_cast<uint8_t>(head.told | static_cast<uint8_t>(what));
}

void read_metadata(const FloatGrid& grid, VdbHead& head) {
  tell<float>(grid, vdb_names::voxel_size_m, VdbTold::voxel_size, head.voxel_size_m, head);
  tell<float>(grid, vdb_names::soil_below_m, VdbTold::soil_below, head.soil_below_m, head);
  tell<float>(grid, vdb_names::ice_above_m, VdbTold::ice_above, head.ice_above_m, head);
  tell<double>(grid, vdb_names::level_m, VdbTold::level, head.level_m, head);
  const auto lo = grid.getMetadata<openvdb::Vec3IMetadata>(vdb_names::chunks_lo);
  const auto hi = grid.getMetadata<openvdb::Vec3IMetadata>(vdb_names::chunks_hi);
  if (!lo || !hi) return;
  head.chunks_lo = {lo->value().x(), lo->value().y(), lo->value().z()};
  head.chunks_hi = {hi->value().x(), hi->value().y(), hi->value().z()};
  head.told = static_cast<uint8_t>(head.told | static_cast<uint8_t>(VdbTold::chunks));
}

/// The bytes of a text in the metadata; none if there is none.
std::vector<uint8_t> bytes_of(const openvdb::Int32Grid& grid, const char* name) {
  const auto meta = grid.getMetadata<openvdb::StringMetadata>(name);
  if (!meta) return {};
  const std::string text = meta->value();
  return {text.begin(), text.end()};
}

/// Words of OpenVDB's exceptions need words around them.
Result<openvdb::GridPtrVecPtr> grids_in(const std::string& path) {
  try {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open(false);
    return file.getGrids();
  } catch (const openvdb::Exception& error) {
    return fail(std::string("not an OpenVDB file, or a damaged one: ") + error.what());
  }
}

}  // namespace

Result<void> send_vdb(ReaderChannel& channel, const std::string& path, const std::string& grid) {
  const auto grids = TRY(grids_in(path));
  const Candidate rock = TRY(chosen(*grids, grid));
  openvdb::Int32Grid::Ptr materials;
  for (const auto& other : *grids)
    if (other->getName() == vdb_names::material) materials = openvdb::gridPtrCast<openvdb::Int32Grid>(other);
  VdbHead head;
  TRY(check_values(*rock.grid, head));
  head.to_world = TRY(matrix_of(*rock.grid));
  if (materials != nullptr) head.materials_to_world = TRY(matrix_of(*materials));
  head.is_level_set = rock.is_level_set ? 1 : 0;
  head.has_materials = materials != nullptr ? 1 : 0;
  read_metadata(*rock.grid, head);
  TRY(channel.put(head));
  TRY(channel.put_text(rock.name));
  TRY(channel.put_text(grids->size() > 1 ? list_of(*grids) : std::string()));
  TRY(send_grid(channel, *rock.grid));
  if (materials == nullptr) return {};
  TRY(channel.put_list(bytes_of(*materials, vdb_names::material_names)));
  TRY(channel.put_list(bytes_of(*materials, vdb_names::palette)));
  TRY(send_grid(channel, *materials));
  return {};
}

}  // namespace scree
