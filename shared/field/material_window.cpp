#include "shared/field/material_window.h"

#include <algorithm>
#include <array>
#include <optional>

#include "shared/base/check.h"

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

/// What a brick's voxels are of, as one material or each its own.
struct BrickOf {
  BrickMaterials said;
  const BrickMaterials* ground;

  std::optional<Material> uniform() const {
    if (!said.is_uniform()) return std::nullopt;
    if (!said.is_ground()) return material_of(said.uniform());
    return ground->is_uniform() ? std::optional(material_of(ground->uniform())) : std::nullopt;
  }
  void resolve(VoxelMaterials& to) const {
    if (said.is_ground()) return ground->unpack(to);
    said.unpack(to);
    if (said.list().front() != ground_own) return;
    VoxelMaterials own;
    ground->unpack(own);
    for (size_t i = 0; i < to.size(); ++i)
      if (to[i] == ground_own) to[i] = own[i];
  }
};

BrickOf brick_of_field(const Field& field, BrickCoord coord) {
  BrickOf of{field.materials(coord), nullptr};
  of.ground = &field.ground_materials(coord);
  return of;
}

/// The one material of all bricks of the box, if there is one.
std::optional<Material> one_material(const Field& field, const VoxelBox& box) {
  std::optional<Material> one;
  bool mixed = false;
  for_each_brick(box, [&](BrickCoord coord) {
    if (mixed) return;
    const auto material = brick_of_field(field, coord).uniform();
    mixed = !material || (one && *one != *material);
    one = material;
  });
  return mixed ? std::nullopt : one;
}

}  // namespace

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

std::optional<Material> one_material_of(const Field& field, BrickCoord coord) {
  return brick_of_field(field, coord).uniform();
}

BrickRock materials_of(const Field& field, BrickCoord coord) {
  VoxelMaterials voxels;
  brick_of_field(field, coord).resolve(voxels);
  BrickRock rock;
  for (size_t i = 0; i < rock.size(); ++i) rock[i] = material_of(voxels[i]);
  return rock;
}

MaterialWindow gather_materials(const Field& field, const VoxelBox& box) {
  CHECK(!box.empty());
  MaterialWindow window{box, {}, {}};
  if (const auto one = one_material(field, box)) {
    window.all = *one;
    return window;
  }
  window.each.resize(Window::count(box));
  VoxelMaterials voxels;
  for_each_brick(box, [&](BrickCoord coord) {
    brick_of_field(field, coord).resolve(voxels);
    for_each_row_of(coord, box, [&](size_t from, size_t to, size_t count) {
      for (size_t i = 0; i < count; ++i) window.each[to + i] = material_of(voxels[from + i]);
    });
  });
  const bool uniform = std::ranges::all_of(window.each, [&](Material m) { return m == window.each.front(); });
  if (!uniform) return window;
  window.all = window.each.front();
  window.each.clear();
  return window;
}

MaterialWindow part_of(const MaterialWindow& window, const VoxelBox& box) {
  MaterialWindow part{box, window.all, {}};
  if (window.is_uniform() || box.empty()) return part;
  CHECK(window.box.covers(box));
  part.each.reserve(Window::count(box));
  const auto count = static_cast<ptrdiff_t>(box.hi.z - box.lo.z);
  const VoxelCoord size = window.box.size();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y) {
      const ptrdiff_t row =
          (static_cast<ptrdiff_t>(x - window.box.lo.x) * size.y + (y - window.box.lo.y)) * size.z +
          (box.lo.z - window.box.lo.z);
      part.each.insert(part.each.end(), window.each.begin() + row, window.each.begin() + row + count);
    }
  return part;
}

MaterialMasses masses_of(const Window& codes, const MaterialWindow& materials) {
  if (materials.is_uniform()) return {{materials.all, mass_of(codes)}};
  CHECK_EQ(codes.codes.size(), materials.each.size());
  std::array<MassUnits, 256> sums{};
  for (size_t i = 0; i < codes.codes.size(); ++i)
    sums[row_number(materials.each[i])] += occupancy(codes.codes[i]);
  MaterialMasses masses;
  for (size_t row = 0; row < sums.size(); ++row)
    if (sums[row] != 0) masses.push_back({static_cast<Material>(row), sums[row]});
  return masses;
}

void spread(MaterialWindow& materials, const Window& codes) {
  if (materials.is_uniform()) return;
  CHECK_EQ(codes.codes.size(), materials.each.size());
  const VoxelCoord size = codes.box.size();
  const std::array<size_t, 3> steps{static_cast<size_t>(size.y) * static_cast<size_t>(size.z),
                                    static_cast<size_t>(size.z), 1};
  const std::array<size_t, 3> sides{static_cast<size_t>(size.x), static_cast<size_t>(size.y),
                                    static_cast<size_t>(size.z)};
  std::vector<uint32_t> ahead;
  std::vector<uint8_t> known(codes.codes.size());
  bool one = true;
  for (size_t i = 0; i < known.size(); ++i) {
    if (codes.codes[i] >= 0) continue;
    known[i] = 1;
    ahead.push_back(static_cast<uint32_t>(i));
    one = one && materials.each[i] == materials.each[ahead.front()];
  }
  if (one) {
    materials.all = materials.each[ahead.empty() ? known.size() / 2 : ahead.front()];
    materials.each.clear();
    return;
  }
  for (size_t next = 0; next < ahead.size(); ++next) {
    const size_t at = ahead[next];
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t place = at / steps[axis] % sides[axis];
      const auto reach = [&](size_t to) {
        if (known[to] != 0) return;
        known[to] = 1;
        materials.each[to] = materials.each[at];
        ahead.push_back(static_cast<uint32_t>(to));
      };
      if (place > 0) reach(at - steps[axis]);
      if (place + 1 < sides[axis]) reach(at + steps[axis]);
    }
  }
}

std::vector<BrickCoord> set_materials(Field& field, const VoxelBox& box, std::span<const uint8_t> marks,
                                      const MaterialWindow& materials) {
  CHECK_EQ(marks.size(), Window::count(box));
  std::vector<BrickCoord> changed;
  for_each_brick(box, [&](BrickCoord coord) {
    bool any = false;
    for_each_row_of(coord, box, [&](size_t, size_t from, size_t count) {
      for (size_t i = 0; i < count; ++i) any = any || marks[from + i] != 0;
    });
    if (!any) return;
    const BrickMaterials before = field.materials(coord);
    VoxelMaterials voxels = before.unpacked(), own;
    field.ground_materials(coord).unpack(own);
    for_each_row_of(coord, box, [&](size_t to, size_t from, size_t count) {
      for (size_t i = 0; i < count; ++i) {
        if (marks[from + i] == 0) continue;
        const VoxelMaterial value = said(materials.at(from + i));
        voxels[to + i] = value == own[to + i] ? ground_own : value;
      }
    });
    const BrickMaterials now(voxels);
    if (now == before) return;
    field.set_materials(coord, now);
    changed.push_back(coord);
  });
  return changed;
}

Material material_at(const Field& field, glm::vec3 p_m) {
  const glm::vec3 p = p_m / field.source().voxel_size_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
  const int index = Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7);
  const VoxelMaterial value = field.materials(brick_of(voxel)).at(index);
  return material_of(value != ground_own ? value : field.ground_materials(brick_of(voxel)).at(index));
}

}  // namespace scree
