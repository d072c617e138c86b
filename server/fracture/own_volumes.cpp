#include "server/fracture/own_volumes.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "shared/base/limits.h"
#include "shared/falling/connected.h"
#include "shared/field/redistance.h"
#include "shared/operation/limits.h"

namespace scree {

namespace {

/// Voxels around a part to which its distances reach.
constexpr int own_margin = 3;

template <typename F>
void for_each_in(const VoxelBox& box, F&& f) {
  size_t at = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) f(VoxelCoord{x, y, z}, at++);
}

/// The part's solid voxels, with the distances around them. All others are not solid.
Window window_of(const Window& given, const ConnectedVoxels& found, size_t part) {
  const auto label = static_cast<uint32_t>(part + 1);
  Window window(found.all[part].box.grown(own_margin));
  std::vector<float> levels(window.codes.size(), band_voxels);
  std::vector<uint8_t> own(window.codes.size(), 0);
  for_each_in(window.box, [&](VoxelCoord v, size_t at) {
    if (!given.box.holds(v)) return;
    const size_t from = given.index(v.x, v.y, v.z);
    own[at] = found.labels[from] == label ? 1 : 0;
    if (own[at] != 0 || found.labels[from] == 0) levels[at] = decode(given.codes[from]);
  });
  distances_from_levels(levels, window);
  for (size_t at = 0; at < own.size(); ++at)
    if (own[at] != 0) window.codes[at] = std::min(window.codes[at], Code{-1});
  return window;
}

/// The materials of the window's voxels: of the rock as given, else of the nearest rock.
MaterialWindow materials_of(const Window& window, const Volume& given, const RubbleRows& rubble) {
  const auto stones = [&](Material material) { return rubble.stones[row_number(material)]; };
  MaterialWindow materials{window.box, stones(given.materials.all), {}};
  if (given.materials.is_uniform()) return materials;
  std::vector<Material>& each = materials.each;
  std::array<size_t, 256> counts{};
  each.resize(window.codes.size());
  for_each_in(window.box, [&](VoxelCoord v, size_t at) {
    if (window.codes[at] >= 0) return;
    each[at] = stones(given.materials.each[given.window.index(v.x, v.y, v.z)]);
    ++counts[row_number(each[at])];
  });
  const auto most = static_cast<Material>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  const bool is_one = std::count(counts.begin(), counts.end(), size_t{0}) + 1 == std::ssize(counts);
  if (is_one) return {window.box, most, {}};
  for (size_t at = 0; at < each.size(); ++at)
    if (window.codes[at] >= 0) each[at] = most;
  for_each_in(window.box, [&](VoxelCoord v, size_t at) {
    if (window.codes[at] >= 0 && occupancy(window.codes[at]) > 0)
      each[at] = material_near(window, materials, v);
  });
  return materials;
}

glm::vec3 centre_of(const Window& window) {
  int64_t sum = 0, sum_x = 0, sum_y = 0, sum_z = 0;
  const VoxelCoord lo = window.box.lo;
  for_each_in(window.box, [&](VoxelCoord v, size_t at) {
    const int units = occupancy(window.codes[at]);
    sum += units;
    sum_x += int64_t{units} * (v.x - lo.x);
    sum_y += int64_t{units} * (v.y - lo.y);
    sum_z += int64_t{units} * (v.z - lo.z);
  });
  CHECK(sum > 0);
  const auto mean = [&](int64_t total, int from) {
    return static_cast<float>(static_cast<double>(total) / static_cast<double>(sum) + from);
  };
  return {mean(sum_x, lo.x), mean(sum_y, lo.y), mean(sum_z, lo.z)};
}

Volume volume_of(Window window, const Volume& given, const RubbleRows& rubble) {
  Volume volume;
  volume.mass = mass_of(window);
  volume.centre_voxels = centre_of(window);
  volume.materials = materials_of(window, given, rubble);
  if (!volume.materials.is_uniform()) volume.masses = masses_of(window, volume.materials);
  CHECK(volume.masses.empty() || sum_of(volume.masses) == volume.mass);
  volume.window = std::move(window);
  return volume;
}

}  // namespace

Result<std::vector<Volume>> own_volumes(const Volume& given, const RubbleRows& rubble) {
  const ConnectedVoxels found = connected_in(given.window);
  const auto is_large = [](const Connected& one) { return one.voxels > 1; };
  const auto large = static_cast<size_t>(std::count_if(found.all.begin(), found.all.end(), is_large));
  if (large > limits::cut_rests_max)
    return fail("its voxels make " + std::to_string(large) + " parts that do not connect, more than " +
                std::to_string(limits::cut_rests_max) + " (limits.cut_rests_max)");
  std::vector<Volume> volumes;
  for (size_t part = 0; part < found.all.size(); ++part) {
    if (!is_large(found.all[part])) continue;
    Window window = window_of(given.window, found, part);
    if (mass_of(window) >= limits::piece_mass_min)
      volumes.push_back(volume_of(std::move(window), given, rubble));
  }
  if (volumes.empty()) return fail("it holds no rock, or no part of it that weighs as much as two voxels");
  return volumes;
}

}  // namespace scree
