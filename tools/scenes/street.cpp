#include "tools/scenes/street.h"

#include <vector>

#include "content/builtin_palette.h"
#include "tools/scenes/structures.h"

namespace scree {

namespace {

constexpr float voxel_m = 0.25F, level_m = 3.0F, floor_slab_m = 0.5F, thick_m = 0.5F;

/// A fill gives its material to what it adds, not to what is there: so a lintel is built before the
/// wall above it.
class Site {
 public:
  explicit Site(SceneSetup& setup) : setup_(setup) {}

  /// Corners are multiples of a voxel; faces lie between voxels. What stands on the ground reaches into it.
  void put(std::string_view material, glm::vec3 lo_m, glm::vec3 hi_m) {
    const auto row = builtin_palette().named(material);
    CHECK(row.has_value());
    if (lo_m.y == 0.0F) lo_m.y = -0.5F;
    const glm::vec3 middle = 0.5F * (lo_m + hi_m) + 0.5F * voxel_m;
    setup_.build.emplace_back(FillRequest{box(middle, 0.5F * (hi_m - lo_m)), *row});
  }
  /// Soil does not carry houses: what is below them becomes another material, down to the rock.
  void found(std::string_view material, glm::vec3 lo_m, glm::vec3 hi_m) {
    constexpr float deep_m = 1.5F;
    const glm::vec3 low(lo_m.x - 0.5F, -deep_m, lo_m.z - 0.5F), high(hi_m.x + 0.5F, 0.125F, hi_m.z + 0.5F);
    setup_.build.emplace_back(
        PaintRequest{box(0.5F * (low + high), 0.5F * (high - low)), *builtin_palette().named(material)});
  }
  void heap(std::string_view material, glm::vec3 at_m, float radius_m) {
    setup_.build.emplace_back(FillRequest{sphere(at_m, radius_m), *builtin_palette().named(material)});
  }

 private:
  SceneSetup& setup_;
};

struct Plan {
  glm::vec3 lo_m;  ///< of the ground floor
  glm::vec3 hi_m;  ///< of the top of the uppermost storey
};

/// A wall along x: up to its windows' tops, then lintels and panes, so that nothing hangs in the air
/// meanwhile.
void wall_along_x(Site& site, std::string_view material, const Plan& plan, float floor_m, float z_m) {
  const float far_m = z_m + thick_m;
  site.put(material, {plan.lo_m.x, floor_m, z_m}, {plan.hi_m.x, floor_m + 1.0F, far_m});
  std::vector<float> windows;
  for (float x = plan.lo_m.x + 1.5F; x + 1.5F < plan.hi_m.x; x += 2.75F) windows.push_back(x);
  float from_m = plan.lo_m.x;
  for (const float x : windows) {
    site.put(material, {from_m, floor_m + 1.0F, z_m}, {x, floor_m + 2.25F, far_m});
    from_m = x + 1.25F;
  }
  site.put(material, {from_m, floor_m + 1.0F, z_m}, {plan.hi_m.x, floor_m + 2.25F, far_m});
  for (const float x : windows) {
    site.put("concrete", {x - 0.5F, floor_m + 2.25F, z_m}, {x + 1.75F, floor_m + 2.75F, far_m});
    site.put("glass", {x, floor_m + 1.0F, z_m + 0.25F}, {x + 1.25F, floor_m + 2.25F, z_m + 0.5F});
  }
  site.put(material, {plan.lo_m.x, floor_m + 2.25F, z_m}, {plan.hi_m.x, floor_m + level_m, far_m});
}

void wall_along_z(Site& site, std::string_view material, const Plan& plan, float floor_m, float x_m) {
  site.put(material, {x_m, floor_m, plan.lo_m.z}, {x_m + thick_m, floor_m + level_m, plan.hi_m.z});
}

void one_storey(Site& site, std::string_view walls, const Plan& plan, float floor_m) {
  for (const float x : {plan.lo_m.x, plan.hi_m.x - thick_m}) wall_along_z(site, walls, plan, floor_m, x);
  for (const float z : {plan.lo_m.z, plan.hi_m.z - thick_m}) wall_along_x(site, walls, plan, floor_m, z);
  site.put("concrete", {plan.lo_m.x, floor_m + level_m - floor_slab_m, plan.lo_m.z},
           {plan.hi_m.x, floor_m + level_m, plan.hi_m.z});
}

/// Steps of a gable whose ridge runs along x; snow lies on it.
void timber_roof(Site& site, const Plan& plan) {
  const float depth_m = plan.hi_m.z - plan.lo_m.z;
  const int steps = static_cast<int>(depth_m / 2.0F);
  for (int i = 0; i < steps; ++i) {
    const float in_m = static_cast<float>(i), low_m = plan.hi_m.y + 0.5F * static_cast<float>(i);
    site.put("timber", {plan.lo_m.x, low_m, plan.lo_m.z + in_m},
             {plan.hi_m.x, low_m + 0.5F, plan.hi_m.z - in_m});
    for (const float z : {plan.lo_m.z + in_m, plan.hi_m.z - in_m - 1.0F})
      site.put("snow", {plan.lo_m.x, low_m + 0.5F, z}, {plan.hi_m.x, low_m + 0.75F, z + 1.0F});
  }
}

void brick_house(Site& site) {
  const Plan plan{{-24.0F, 0.0F, -9.0F}, {-13.0F, 2.0F * level_m, -1.0F}};
  site.found("concrete", plan.lo_m, plan.hi_m);
  for (const float floor_m : {0.0F, level_m}) one_storey(site, "brick", plan, floor_m);
  timber_roof(site, plan);
}

/// Columns of steel carry slabs of concrete; the front and the back are of glass.
void office(Site& site) {
  const Plan plan{{-5.0F, 0.0F, -10.0F}, {7.0F, 3.0F * level_m, -1.0F}};
  site.found("concrete", plan.lo_m, plan.hi_m);
  for (float floor_m = 0.0F; floor_m < plan.hi_m.y; floor_m += level_m) {
    const float top_m = floor_m + level_m;
    for (const float x : {plan.lo_m.x, plan.lo_m.x + 3.75F, plan.lo_m.x + 7.5F, plan.hi_m.x - 0.5F})
      for (const float z : {plan.lo_m.z, plan.lo_m.z + 4.25F, plan.hi_m.z - 0.5F})
        site.put("steel", {x, floor_m, z}, {x + 0.5F, top_m, z + 0.5F});
    site.put("concrete", {plan.lo_m.x, top_m - floor_slab_m, plan.lo_m.z}, {plan.hi_m.x, top_m, plan.hi_m.z});
    for (const float z : {plan.lo_m.z + 0.25F, plan.hi_m.z - 0.5F})
      site.put("glass", {plan.lo_m.x, floor_m, z}, {plan.hi_m.x, top_m, z + 0.25F});
  }
  for (const float x : {plan.lo_m.x, plan.hi_m.x - thick_m})
    site.put("brick", {x, 0.0F, plan.lo_m.z}, {x + thick_m, plan.hi_m.y, plan.hi_m.z});
  site.put("gravel", {plan.lo_m.x, plan.hi_m.y, plan.lo_m.z},
           {plan.hi_m.x, plan.hi_m.y + 0.25F, plan.hi_m.z});
}

void timber_hut(Site& site) {
  const Plan plan{{14.0F, 0.0F, -8.0F}, {22.0F, level_m, -2.0F}};
  site.found("rock", plan.lo_m, plan.hi_m);
  site.put("concrete", {plan.lo_m.x - 0.5F, -0.5F, plan.lo_m.z - 0.5F},
           {plan.hi_m.x + 0.5F, 0.5F, plan.hi_m.z + 0.5F});
  one_storey(site, "timber", plan, 0.5F);
  timber_roof(site, {plan.lo_m, plan.hi_m + glm::vec3(0.0F, 0.5F, 0.0F)});
}

/// In front of the houses: a road between kerbs, beds, a rink, and heaps. Nothing is of rock: where rock was
/// added, it is drawn as rubble.
void open_places(Site& site) {
  for (const float x : {-25.0F, -12.5F, 0.0F, 12.5F}) {
    for (const float z : {2.0F, 8.0F}) site.put("concrete", {x, -0.25F, z}, {x + 12.5F, 0.25F, z + 0.5F});
    site.put("gravel", {x, -0.5F, 2.5F}, {x + 12.5F, 0.25F, 8.0F});
  }
  site.put("clay", {-24.0F, -0.5F, 10.0F}, {-20.0F, 0.75F, 13.0F});
  site.put("soil", {-18.0F, -0.5F, 10.0F}, {-8.0F, 0.5F, 13.0F});
  site.put("ice", {-5.0F, -0.5F, 9.5F}, {4.0F, 0.5F, 13.5F});
  site.heap("sand", {9.0F, -0.5F, 11.5F}, 2.0F);
  site.heap("gravel", {14.0F, -0.5F, 11.5F}, 2.25F);
  site.heap("snow", {19.0F, -0.5F, 11.5F}, 1.75F);
  for (const float x : {-10.0F, 10.0F}) {  // lamps
    site.put("steel", {x, -0.5F, 9.0F}, {x + 0.5F, 4.5F, 9.5F});
    site.put("glass", {x - 0.25F, 4.5F, 8.75F}, {x + 0.75F, 5.25F, 9.75F});
  }
}

}  // namespace

Result<SceneSetup> street_scene(const std::string&) {
  SceneSetup setup;
  setup.config.terrain = {.kind = TerrainKind::flat, .random_seed = 1, .voxel_size_m = voxel_m};
  setup.eye_m = {20.0F, 9.0F, 24.0F};
  setup.target_m = {-3.0F, 3.0F, -2.0F};
  Site site(setup);
  brick_house(site);
  office(site);
  timber_hut(site);
  open_places(site);
  for (const glm::vec3 at_m : {glm::vec3(-13.5F, 1.5F, -1.5F),
                               {0.0F, 1.5F, -1.0F},
                               {6.5F, 2.0F, -1.5F},
                               {18.0F, 2.0F, -2.0F},
                               {0.0F, 0.25F, 11.5F}})
    setup.strikes.push_back(strike(sphere(at_m, 2.0F), at_m + glm::vec3(0.5F, 0.5F, 2.0F), 32, 5.0F));
  return setup;
}

}  // namespace scree
