// Islands: the search against labelling by brute force, and what lifting one leaves behind.
#include "shared/falling/island.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <set>

#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/falling/island_search.h"
#include "shared/field/edit.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

/// What the random fields are made of: within four chunks, two of them below ground.
constexpr VoxelBox edited{{8, -16, 8}, {48, 16, 24}};
/// Reaches into unedited chunks on all sides.
constexpr VoxelBox labelled{{-2, -34, -2}, {66, 20, 34}};

/// Noise in odd rounds, balls of rock and air in even ones: specks and caves, shells and bridges.
Window random_window(Field& field, Random& random, bool noise) {
  Window window = gather(field, edited);
  if (noise) {
    const float share = 0.1F + 0.4F * random.unit();
    for (Code& code : window.codes) code = random.unit() < share ? Code{-50} : Code{50};
    return window;
  }
  for (int i = 0; i < 40; ++i) {
    const VoxelCoord size = edited.size();
    const glm::vec3 at(random.unit() * static_cast<float>(size.x), random.unit() * static_cast<float>(size.y),
                       random.unit() * static_cast<float>(size.z));
    const glm::vec3 origin(edited.lo.x, edited.lo.y, edited.lo.z);
    const Window ball = codes_of(sphere(origin + at, 1.0F + 5.0F * random.unit()), edited);
    if (random.unit() < 0.5F) {
      carve(window, ball);
    } else {
      fill(window, ball);
    }
  }
  return window;
}

std::array<VoxelCoord, 6> neighbours(VoxelCoord v) {
  return {{{v.x - 1, v.y, v.z},
           {v.x + 1, v.y, v.z},
           {v.x, v.y - 1, v.z},
           {v.x, v.y + 1, v.z},
           {v.x, v.y, v.z - 1},
           {v.x, v.y, v.z + 1}}};
}

/// The component of a solid voxel, marked as seen; whether it touches one of the bricks, and the ground.
struct Component {
  std::vector<VoxelCoord> voxels;
  bool touched = false;
  bool grounded = false;
};

Component label(const Field& field, const Window& window, const std::set<BrickCoord>& changed,
                VoxelCoord from, std::vector<uint8_t>& seen) {
  Component found;
  found.voxels.push_back(from);
  seen[window.index(from.x, from.y, from.z)] = 1;
  for (size_t i = 0; i < found.voxels.size(); ++i) {
    const VoxelCoord v = found.voxels[i];
    found.touched = found.touched || changed.contains(brick_of(v));
    found.grounded = found.grounded || (chunk_of(v).y < 0 && !field.has_edits(chunk_of(v)));
    for (const VoxelCoord n : neighbours(v)) {
      found.touched = found.touched || changed.contains(brick_of(n));
      if (!window.box.holds(n)) continue;
      const size_t at = window.index(n.x, n.y, n.z);
      if (window.codes[at] >= 0 || seen[at] != 0) continue;
      seen[at] = 1;
      found.voxels.push_back(n);
    }
  }
  return found;
}

std::vector<Island> islands_by_brute_force(Field& field, const std::vector<BrickCoord>& changed) {
  const std::set<BrickCoord> bricks(changed.begin(), changed.end());
  const Window window = gather(field, labelled);
  std::vector<uint8_t> seen(window.codes.size(), 0);
  std::vector<Island> islands;
  for (int x = labelled.lo.x; x < labelled.hi.x; ++x)
    for (int y = labelled.lo.y; y < labelled.hi.y; ++y)
      for (int z = labelled.lo.z; z < labelled.hi.z; ++z) {
        const size_t at = window.index(x, y, z);
        if (window.codes[at] >= 0 || seen[at] != 0) continue;
        const Component component = label(field, window, bricks, {x, y, z}, seen);
        if (component.grounded || !component.touched) continue;
        Island island{{labelled.hi, labelled.lo}, {}, static_cast<int64_t>(component.voxels.size())};
        for (const VoxelCoord v : component.voxels) {
          VoxelBox& b = island.box;
          b.lo = {std::min(b.lo.x, v.x), std::min(b.lo.y, v.y), std::min(b.lo.z, v.z)};
          b.hi = {std::max(b.hi.x, v.x + 1), std::max(b.hi.y, v.y + 1), std::max(b.hi.z, v.z + 1)};
        }
        island.start = *std::ranges::min_element(component.voxels, {},
                                                 [](VoxelCoord v) { return std::pair(brick_of(v), v); });
        islands.push_back(island);
      }
  std::ranges::sort(islands, {}, &Island::start);
  return islands;
}

/// `changed` as a whole, so many bricks at a time.
std::vector<Island> search(Field& field, const std::vector<BrickCoord>& changed, size_t bricks_at_once) {
  IslandSearch search(field, changed);
  for (size_t bricks = bricks_at_once; !search.advance(bricks); bricks = bricks_at_once) {
  }
  return search.islands();
}

void print(std::ostream& out, const std::vector<Island>& islands) {
  for (const Island& island : islands)
    out << "  " << island.voxels << " voxels from " << island.start.x << ' ' << island.start.y << ' '
        << island.start.z << '\n';
}

TEST(island, the_search_finds_what_brute_force_finds_in_random_fields) {
  size_t found = 0;
  MapField field(flat_terrain);
  constexpr uint64_t fields = rounds(400, 50);
  for (uint64_t round = 0; round < fields; ++round) {
    Random random(round);
    for (const ChunkCoord chunk : field.edited_chunks()) field.forget_chunk(chunk);
    scatter(field, random_window(field, random, round % 2 == 1));
    std::vector<BrickCoord> bricks;
    for_each_brick(edited, [&](BrickCoord brick) {
      if (random.unit() < 0.2F) bricks.push_back(brick);
    });
    const std::vector<Island> want = islands_by_brute_force(field, bricks);
    const std::vector<Island> got = search(field, bricks, 1 + round % 50);
    found += got.size();
    if (got == want) continue;
    print(std::cerr << "found:\n", got);
    print(std::cerr << "wanted:\n", want);
    FAIL() << "round " << round;
  }
  EXPECT_GT(found, 10 * fields);
}

/// A slab of rock over flat ground on a post, in voxels.
Window slab_on_a_post(Field& field, bool post) {
  Window window = gather(field, {{-20, -8, -20}, {20, 40, 20}});
  fill(window, codes_of(box({0.0F, 20.0F, 0.0F}, {12.0F, 4.0F, 12.0F}), window.box));
  if (post) fill(window, codes_of(box({0.0F, 8.0F, 0.0F}, {2.5F, 10.0F, 2.5F}), window.box));
  return window;
}

TEST(island, what_stands_on_a_post_is_ground_and_without_it_an_island) {
  for (const bool post : {true, false}) {
    MapField field(flat_terrain);
    const std::vector<BrickCoord> changed = scatter(field, slab_on_a_post(field, post));
    EXPECT_EQ(search(field, changed, 1000).size(), post ? 0U : 1U);
  }
}

TEST(island, a_search_goes_down_to_the_ground_before_it_climbs) {
  constexpr int height = 40, changed = 4;
  MapField field(flat_terrain);
  for (int y = 0; y < height; ++y) field.set_brick({0, y, 0}, solid_brick());
  IslandSearch search(field, std::vector<BrickCoord>{{0, changed, 0}});
  size_t bricks = 1000;
  ASSERT_TRUE(search.advance(bricks));
  EXPECT_TRUE(search.islands().empty());
  EXPECT_LE(1000 - bricks, brick_faces.size() * (changed + 2U))
      << "what stands above the change need not be looked at";
}

TEST(island, of_what_stands_a_search_reads_one_column_and_what_lies_around_the_change) {
  constexpr int half = 5, height = 12;
  MapField field(flat_terrain);
  for (int x = -half; x <= half; ++x)
    for (int y = 0; y < height; ++y)
      for (int z = -half; z <= half; ++z) field.set_brick({x, y, z}, solid_brick());
  const BrickCoord changed{0, height - 1, 0};
  Brick half_full = solid_brick();
  std::fill_n(half_full.codes.begin(), half_full.codes.size() / 2, code_air);
  field.set_brick(changed, half_full);
  IslandSearch search(field, {&changed, 1});
  size_t bricks = 1000;
  ASSERT_TRUE(search.advance(bricks));
  EXPECT_TRUE(search.islands().empty());
  // Each neighbour that the change bared begins a flood of its own; those beside each other meet at once.
  EXPECT_LE(search.read(), 1 + brick_faces.size() * height / 2);
}

/// What a search around one brick at that height counts as, in steps of so many bricks.
size_t counted(Field& field, BrickCoord changed, size_t bricks_per_chunk, size_t at_once) {
  IslandSearch search(field, {&changed, 1}, {.bricks_per_chunk = bricks_per_chunk});
  size_t told = search.read();
  for (size_t left = at_once; !search.advance(left); left = at_once) {
    EXPECT_LT(left, at_once);
    EXPECT_LE(search.read() - told, at_once + 5 + 3 * bricks_per_chunk) << "it goes on where it stopped";
    told = search.read();
  }
  return search.read();
}

TEST(island, a_chunk_whose_terrain_may_have_to_be_generated_counts_each_time_as_so_many_bricks) {
  const TerrainSource source{TerrainKind::noise, 3, 0.25F};
  MapField field(source);
  const float height_m = ground_height_m(source, 1.0F, 1.0F);
  const BrickCoord changed{0, floor_to_int(height_m / (brick_size * source.voxel_size_m)), 0};
  field.set_brick(changed, air_brick());
  const size_t bricks = counted(field, changed, 0, 1000);
  const size_t with_chunks = counted(field, changed, 100, 1000);
  EXPECT_GT(with_chunks, bricks);
  EXPECT_EQ((with_chunks - bricks) % 100, 0U);
  EXPECT_EQ(counted(field, changed, 100, 1000), with_chunks) << "though it has been generated by now";
  EXPECT_EQ(counted(field, changed, 100, 1), with_chunks);
  const ChunkCoord chunk = chunk_of(changed);
  for (int x = -1; x <= 1; ++x)
    for (int y = -4; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const BrickCoord brick = brick_in_chunk(chunk + ChunkCoord{x, y, z}, 0);
        field.set_brick(brick, Brick(field.brick(brick)));
      }
  EXPECT_EQ(counted(field, changed, 100, 1000) / 100, 0U) << "edited chunks are there";
}

/// A bar of bricks in the air.
std::vector<BrickCoord> bar_of(Field& field, int length) {
  std::vector<BrickCoord> bar;
  for (int x = 0; x < length; ++x) {
    bar.push_back({x, 5, 0});
    field.set_brick(bar.back(), solid_brick());
  }
  return bar;
}

TEST(island, what_is_longer_than_a_piece_may_be_comes_in_blocks) {
  for (const int length : {limits::island_side_max_bricks, limits::island_side_max_bricks + 1, 100}) {
    MapField field(flat_terrain);
    const std::vector<BrickCoord> bar = bar_of(field, length);
    const std::vector<Island> blocks = search(field, {bar.front()}, 1000);
    int64_t voxels = 0;
    for (const Island& block : blocks) {
      EXPECT_LE(block.box.size().x, limits::island_side_max_bricks * brick_size);
      EXPECT_EQ(block.voxels, int64_t{block.box.size().x} * brick_size * brick_size);
      voxels += block.voxels;
    }
    EXPECT_EQ(voxels, int64_t{length} * brick_size * brick_size * brick_size);
    EXPECT_EQ(blocks.size(), length == 100 ? 8U : length > limits::island_side_max_bricks ? 2U : 1U);
  }
}

TEST(island, a_component_of_too_many_parts_counts_as_ground_and_is_counted) {
  MapField field(flat_terrain);
  const std::vector<BrickCoord> bar = bar_of(field, 20);
  for (const size_t parts_max : {size_t{19}, size_t{20}}) {
    // From both ends: two floods that meet are one component.
    IslandSearch search(field, std::vector<BrickCoord>{bar.front(), bar.back()}, {.parts_max = parts_max});
    size_t bricks = 1000;
    ASSERT_TRUE(search.advance(bricks));
    EXPECT_EQ(search.too_large(), parts_max == 19 ? 1U : 0U);
    EXPECT_EQ(search.islands().empty(), parts_max == 19);
  }
}

/// What connects within each block of so many bricks a side, by brute force: voxels and box of each.
std::vector<Island> split_by_brute_force(Field& field, const Island& whole,
                                         const std::vector<Island>& blocks) {
  std::vector<Island> found;
  const Window window = gather(field, whole.box);
  std::vector<uint8_t> seen(window.codes.size(), 0);
  for (const Island& block : blocks) {
    Island own{block.box, block.start, 0};
    std::vector<VoxelCoord> ahead{block.start};
    seen[window.index(block.start.x, block.start.y, block.start.z)] = 1;
    while (!ahead.empty()) {
      const VoxelCoord v = ahead.back();
      ahead.pop_back();
      ++own.voxels;
      for (const VoxelCoord n : neighbours(v)) {
        if (!block.box.holds(n) || window.at(n.x, n.y, n.z) >= 0) continue;
        uint8_t& mark = seen[window.index(n.x, n.y, n.z)];
        if (mark != 0) continue;
        mark = 1;
        ahead.push_back(n);
      }
    }
    found.push_back(own);
  }
  return found;
}

TEST(island, blocks_of_random_islands_are_connected_and_hold_every_voxel_once) {
  size_t split = 0;
  for (uint64_t round = 0; round < 40; ++round) {
    MapField field(flat_terrain);
    Random random(round);
    scatter(field, random_window(field, random, round % 2 == 1));
    std::vector<BrickCoord> bricks;
    for_each_brick(edited, [&](BrickCoord brick) { bricks.push_back(brick); });
    IslandSearch search(field, bricks);
    size_t budget = 1'000'000;
    ASSERT_TRUE(search.advance(budget));
    const std::vector<Island> whole = search.islands(), blocks = search.islands({2, 4});
    int64_t want = 0, got = 0;
    for (const Island& island : whole) want += island.voxels;
    for (const Island& block : blocks) {
      got += block.voxels;
      const VoxelCoord size = block.box.size();
      EXPECT_LE(std::max({size.x, size.y, size.z}), 2 * brick_size);
    }
    EXPECT_EQ(got, want) << round;
    // Each block's flood within its box, as the operation does it, takes what the search counted.
    EXPECT_EQ(split_by_brute_force(field, {labelled, {}, 0}, blocks), blocks) << round;
    split += blocks.size() - whole.size();
  }
  EXPECT_GT(split, 40U);
}

TEST(island, a_block_that_is_cut_off_leaves_a_flat_face_and_takes_exactly_its_mass) {
  MapField field(flat_terrain);
  const Shape bar = box({36.0F, 44.0F, 4.0F}, {30.5F, 3.3F, 3.3F});
  const VoxelBox all{{-8, 32, -8}, {80, 56, 16}};
  Window window = gather(field, all);
  fill(window, codes_of(bar, all));
  scatter(field, window);
  const MassUnits whole = mass_of(window);
  // Its left half.
  const VoxelBox half{{6, 41, 1}, {36, 48, 8}};
  Window left = gather(field, lift_box(half));
  const MassUnits before = mass_of(left);
  const Volume volume = lift(left, half, {20, 44, 4});
  EXPECT_EQ(volume.mass, before - mass_of(left));
  EXPECT_NEAR(static_cast<double>(volume.mass), static_cast<double>(whole) * 30.0 / 61.0,
              0.002 * static_cast<double>(whole));
  EXPECT_NEAR(static_cast<double>(mass_of(volume.window)), static_cast<double>(volume.mass),
              0.001 * static_cast<double>(whole));
  scatter(field, left);
  // What a bar that ends there would look like.
  Window want = gather(field, all);
  for (Code& code : want.codes) code = code_air;
  fill(want, codes_of(box({51.0F, 44.0F, 4.0F}, {15.5F, 3.3F, 3.3F}), all));
  const Window got = gather(field, all);
  for (int x = 33; x < 40; ++x) EXPECT_NEAR(got.at(x, 44, 4), want.at(x, 44, 4), 9) << "codes, at " << x;
}

TEST(island, lifting_takes_all_mass_of_the_island_and_leaves_the_field_as_if_it_had_never_been) {
  MapField field(flat_terrain);
  Window with = slab_on_a_post(field, false);
  // Near the ground: their bands overlap.
  fill(with, codes_of(sphere({14.0F, 4.0F, 14.0F}, 2.3F), with.box));
  Window without = gather(field, with.box);
  fill(without, codes_of(box({0.0F, 20.0F, 0.0F}, {12.0F, 4.0F, 12.0F}), with.box));
  const std::vector<BrickCoord> changed = scatter(field, with);
  const std::vector<Island> islands = search(field, changed, 1000);
  ASSERT_EQ(islands.size(), 2U);
  const Island& ball = *std::ranges::min_element(islands, {}, &Island::voxels);
  Window window = gather(field, lift_box(ball.box));
  const MassUnits before = mass_of(window);
  const Volume volume = lift(window, ball.box, ball.start);
  EXPECT_EQ(volume.mass, before - mass_of(window));
  EXPECT_EQ(volume.mass, mass_of(volume.window));
  scatter(field, window);
  const Window after = gather(field, with.box);
  int worst = 0;
  for (size_t i = 0; i < after.codes.size(); ++i)
    worst = std::max(worst, std::abs(after.codes[i] - without.codes[i]));
  EXPECT_LE(worst, 2) << "codes";
  EXPECT_NEAR(volume.centre_voxels.x, 14.0F, 0.05F);
  EXPECT_NEAR(volume.centre_voxels.y, 4.0F, 0.05F);
}

TEST(island, lifting_from_a_seed_in_air_changes_nothing) {
  MapField field(flat_terrain);
  const VoxelBox box{{0, 20, 0}, {4, 24, 4}};
  Window window = gather(field, lift_box(box));
  const Window before = window;
  EXPECT_EQ(lift(window, box, {1, 21, 1}).mass, 0);
  EXPECT_EQ(window.codes, before.codes);
}

}  // namespace
}  // namespace scree
