#include "shared/field/material_window.h"

#include <algorithm>
#include <array>
#include <optional>

#include "shared/base/check.h"
#include "shared/field/eight_bytes.h"

namespace scree {

namespace {

/// The part of a brick that lies in a box, in world voxels.
VoxelBox within_box(BrickCoord brick, const VoxelBox& box) {
  const VoxelCoord first = first_voxel(brick);
  return common(box, {first, first + VoxelCoord{brick_size, brick_size, brick_size}});
}

/// Calls f(index in the brick, index in the box, count) for each row along z.
template <typename F>
void for_each_row_of(BrickCoord brick, const VoxelBox& box, F&& f) {
  const VoxelBox part = within_box(brick, box);
  const VoxelCoord size = box.size();
  const auto count = static_cast<size_t>(part.hi.z - part.lo.z);
  for (int x = part.lo.x; x < part.hi.x; ++x)
    for (int y = part.lo.y; y < part.hi.y; ++y) {
      const auto row = (static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(size.y) +
                        static_cast<size_t>(y - box.lo.y)) *
                           static_cast<size_t>(size.z) +
                       static_cast<size_t>(part.lo.z - box.lo.z);
      f(static_cast<size_t>(Brick::index(x & 7, y & 7, part.lo.z & 7)), row, count);
    }
}

constexpr int reach = 2;

/// Places within two voxels, the nearest first; equally far ones in order of x, y and z.
constexpr auto offsets_by_distance = [] {
  std::array<VoxelCoord, 32> offsets{};
  size_t count = 0;
  for (int squared = 1; squared <= reach * reach; ++squared)
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -reach; z <= reach; ++z)
          if (x * x + y * y + z * z == squared) offsets.at(count++) = {x, y, z};
  if (count != offsets.size()) throw "not as many offsets";  // ends the compilation
  return offsets;
}();

}  // namespace

MaterialMasses listed(const std::array<MassUnits, 256>& sums) {
  MaterialMasses masses;
  for (size_t row = 0; row < sums.size(); ++row)
    if (sums[row] != 0) masses.push_back({static_cast<Material>(row), sums[row]});
  return masses;
}

Material MaterialWindow::at(VoxelCoord voxel) const {
  if (each.empty()) return all;
  CHECK_DEBUG(box.holds(voxel));
  const VoxelCoord size = box.size(), off = voxel - box.lo;
  return each[(static_cast<size_t>(off.x) * static_cast<size_t>(size.y) + static_cast<size_t>(off.y)) *
                  static_cast<size_t>(size.z) +
              static_cast<size_t>(off.z)];
}

MassUnits sum_of(std::span<const MaterialMass> masses) {
  MassUnits sum = 0;
  for (const MaterialMass& one : masses) sum += one.mass;
  return sum;
}

MassUnits mass_of(std::span<const MaterialMass> masses, Material material) {
  for (const MaterialMass& one : masses)
    if (one.material == material) return one.mass;
  return 0;
}

void add(MaterialMasses& to, Material material, MassUnits mass) {
  const auto at = std::ranges::lower_bound(to, material, {}, &MaterialMass::material);
  if (at != to.end() && at->material == material)
    at->mass += mass;
  else
    to.insert(at, {material, mass});
}

void add(MaterialMasses& to, std::span<const MaterialMass> more) {
  for (const MaterialMass& one : more) add(to, one.material, one.mass);
}

std::optional<Material> MaterialReader::BrickOf::uniform() const {
  if (!said->is_uniform()) return std::nullopt;
  if (!said->is_ground()) return material_of(said->uniform());
  return ground->is_uniform() ? std::optional(material_of(ground->uniform())) : std::nullopt;
}

Material MaterialReader::BrickOf::at(int index) const {
  const VoxelMaterial value = said->at(index);
  return material_of(value != ground_own ? value : ground->at(index));
}

void MaterialReader::BrickOf::resolve(VoxelMaterials& to) const {
  if (said->is_ground()) return ground->unpack(to);
  said->unpack(to);
  if (!said->says_ground()) return;
  VoxelMaterials own;
  ground->unpack(own);
  // ground_own is 0: no branch, so that it runs in vectors.
  static_assert(ground_own == 0);
  for (size_t i = 0; i < to.size(); ++i) to[i] |= static_cast<uint8_t>(own[i] & (to[i] == 0 ? 0xFF : 0));
}

MaterialReader::MaterialReader(const Field& field, const VoxelBox& box)
    : box_(box),
      bulk_(said(field.source().rows.bulk)),
      lo_(brick_of(box.lo)),
      size_(brick_of(box.hi - VoxelCoord{1, 1, 1}) + BrickCoord{1, 1, 1} - lo_) {
  CHECK(!box.empty());
  static const BrickMaterials silent;
  bricks_.assign(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y) * static_cast<size_t>(size_.z),
                 {&silent, &bulk_});
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const VoxelCoord first = first_voxel(chunk);
    add_chunk(field, chunk, common(box, {first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}}));
  });
}

size_t MaterialReader::place_of(BrickCoord coord) const {
  const BrickCoord at = coord - lo_;
  CHECK_DEBUG(at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < size_.x && at.y < size_.y && at.z < size_.z);
  return (static_cast<size_t>(at.x) * static_cast<size_t>(size_.y) + static_cast<size_t>(at.y)) *
             static_cast<size_t>(size_.z) +
         static_cast<size_t>(at.z);
}

void MaterialReader::add_chunk(const Field& field, ChunkCoord chunk, const VoxelBox& part) {
  const std::optional<Field::ChunkRock> rock = field.chunk_rock(chunk);
  if (rock && rock->is_bulk()) return;
  for_each_brick(part, [&](BrickCoord coord) {
    BrickOf& of = bricks_[place_of(coord)];
    if (!rock) {
      of.said = &owned_.emplace_back(field.materials(coord));
      of.ground = &owned_.emplace_back(field.ground_materials(coord));
      return;
    }
    const int index = index_in_chunk(coord);
    if (rock->said != nullptr)
      if (const auto found = rock->said->find(index); found != rock->said->end()) of.said = &found->second;
    if (rock->ground != nullptr) of.ground = &rock->ground->at(index);
  });
}

std::optional<Material> MaterialReader::uniform() const {
  std::optional<Material> one;
  for (const BrickOf& of : bricks_) {
    const auto material = of.uniform();
    if (!material || (one && *one != *material)) return std::nullopt;
    one = material;
  }
  return one;
}

Material MaterialReader::at(VoxelCoord voxel) const {
  return brick(brick_of(voxel)).at(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7));
}

MaterialWindow MaterialReader::window() const {
  MaterialWindow window{box_, {}, {}};
  if (const auto one = uniform()) {
    window.all = *one;
    return window;
  }
  window.each.resize(Window::count(box_));
  VoxelMaterials voxels;
  for_each_brick(box_, [&](BrickCoord coord) {
    const BrickOf& of = brick(coord);
    if (const auto one = of.uniform()) {
      for_each_row_of(coord, box_, [&](size_t, size_t to, size_t count) {
        std::fill_n(window.each.begin() + static_cast<ptrdiff_t>(to), count, *one);
      });
      return;
    }
    of.resolve(voxels);
    for_each_row_of(coord, box_, [&](size_t from, size_t to, size_t count) {
      for (size_t i = 0; i < count; ++i) window.each[to + i] = static_cast<Material>(voxels[from + i] - 1);
    });
  });
  return window;
}

std::optional<Material> one_material_of(const Field& field, BrickCoord coord) {
  const VoxelCoord first = first_voxel(coord);
  return MaterialReader(field, {first, first + VoxelCoord{1, 1, 1}}).uniform();
}

BrickRock materials_of(const Field& field, BrickCoord coord) {
  const VoxelCoord first = first_voxel(coord);
  const MaterialReader reader(field, {first, first + VoxelCoord{brick_size, brick_size, brick_size}});
  BrickRock rock;
  for (int i = 0; i < brick_voxels; ++i)
    rock[static_cast<size_t>(i)] = reader.at(first + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7});
  return rock;
}

MaterialWindow gather_materials(const Field& field, const VoxelBox& box) {
  return MaterialReader(field, box).window();
}

MaterialWindow part_of(const MaterialWindow& window, const VoxelBox& box) {
  MaterialWindow part{box, window.all, {}};
  if (window.is_uniform() || box.empty()) return part;
  CHECK(window.box.covers(box));
  part.each.resize(Window::count(box));
  const auto count = static_cast<ptrdiff_t>(box.hi.z - box.lo.z);
  Material* to = part.each.data();
  const VoxelCoord size = window.box.size();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y, to += count) {
      const ptrdiff_t row =
          (static_cast<ptrdiff_t>(x - window.box.lo.x) * size.y + (y - window.box.lo.y)) * size.z +
          (box.lo.z - window.box.lo.z);
      std::copy_n(window.each.data() + row, count, to);
    }
  // Decoders make it so, too: what a piece's breaks share out goes by it.
  const Material first = part.each.front();
  if (std::ranges::all_of(part.each, [first](Material other) { return other == first; }))
    return {box, first, {}};
  return part;
}

MaterialMasses masses_of(const Window& codes, const MaterialWindow& materials) {
  if (materials.is_uniform()) return {{materials.all, mass_of(codes)}};
  CHECK_EQ(codes.codes.size(), materials.each.size());
  std::array<MassUnits, 256> sums{};
  for (size_t i = 0; i < codes.codes.size(); ++i)
    sums[row_number(materials.each[i])] += occupancy(codes.codes[i]);
  return listed(sums);
}

RockWindow rock_of(MaterialWindow materials, const RubbleRows& rows) {
  RockWindow rock;
  if (rows.any) {
    rock.fills.all = rows.fill[row_number(materials.all)];
    materials.all = rows.stones[row_number(materials.all)];
    const auto has_pores = [&](Material one) { return rows.fill[row_number(one)] != fill_solid; };
    if (std::ranges::any_of(materials.each, has_pores)) {
      rock.fills.each.resize(materials.each.size());
      for (size_t i = 0; i < materials.each.size(); ++i) {
        rock.fills.each[i] = rows.fill[row_number(materials.each[i])];
        materials.each[i] = rows.stones[row_number(materials.each[i])];
      }
      if (const Material first = materials.each.front();
          std::ranges::all_of(materials.each, [first](Material one) { return one == first; }))
        materials = {materials.box, first, {}};
    } else if (!materials.is_uniform()) {
      rock.fills.all = fill_solid;
    }
  }
  rock.stones = std::move(materials);
  return rock;
}

MaterialMasses masses_lost(const Window& before, const Window& after, const RockWindow& rock) {
  CHECK(before.box == after.box);
  std::array<MassUnits, 256> sums{};
  if (rock.stones.is_uniform()) {
    sums[row_number(rock.stones.all)] = mass_of(before, rock.fills) - mass_of(after, rock.fills);
  } else {
    CHECK_EQ(before.codes.size(), rock.stones.each.size());
    for_each_nonzero(mass_changes(before.codes, after.codes), [&](size_t i) {
      const int fill = rock.fills.at(i);
      sums[row_number(rock.stones.each[i])] +=
          mass_in_voxel(occupancy(before.codes[i]), fill) - mass_in_voxel(occupancy(after.codes[i]), fill);
    });
  }
  return listed(sums);
}

Material material_near(const Window& codes, const MaterialWindow& materials, VoxelCoord voxel) {
  if (materials.is_uniform()) return materials.all;
  const size_t own = codes.index(voxel.x, voxel.y, voxel.z);
  if (codes.codes[own] < 0) return materials.each[own];
  const VoxelCoord size = codes.box.size();
  const int along_x = size.y * size.z, along_y = size.z;
  const VoxelBox around{voxel - VoxelCoord{reach, reach, reach},
                        voxel + VoxelCoord{reach + 1, reach + 1, reach + 1}};
  const bool is_inside = codes.box.covers(around);
  for (const VoxelCoord off : offsets_by_distance) {
    if (!is_inside && !codes.box.holds(voxel + off)) continue;
    const size_t at = own + static_cast<size_t>(off.x * along_x + off.y * along_y + off.z);
    if (codes.codes[at] < 0) return materials.each[at];
  }
  return materials.each[own];
}

std::vector<BrickCoord> scatter(Field& field, const Window& window, std::span<const BrickSays> says) {
  CHECK_DEBUG(std::ranges::is_sorted(says, {}, &BrickSays::coord));
  return scatter(field, window, [&](BrickCoord coord) {
    const auto found = std::ranges::lower_bound(says, coord, {}, &BrickSays::coord);
    return found == says.end() || found->coord != coord ? nullptr : &found->materials;
  });
}

Material material_at(const Field& field, glm::vec3 p_m) {
  const glm::vec3 p = p_m / field.source().voxel_size_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
  const int index = Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7);
  const VoxelMaterial value = field.materials(brick_of(voxel)).at(index);
  return material_of(value != ground_own ? value : field.ground_materials(brick_of(voxel)).at(index));
}

}  // namespace scree
