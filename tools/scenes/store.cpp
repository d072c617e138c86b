#include "tools/scenes/store.h"

#include <array>

#include "content/builtin_palette.h"
#include "shared/base/check.h"
#include "tools/scenes/structures.h"

namespace scree {

namespace {

constexpr float wall_top_m = 2.5F, dock_top_m = 1.0F;
/// What is put down begins so high above what it comes to lie on.
constexpr float gap_m = 0.01F;
constexpr glm::quat upright{1.0F, 0.0F, 0.0F, 0.0F};
constexpr glm::quat lying{0.70710678F, 0.70710678F, 0.0F, 0.0F};  ///< what stood along y lies along z

Material store_material(std::string_view name) {
  const auto row = builtin_palette().named(name);
  CHECK(row.has_value());
  return *row;
}

PropPart box_part(glm::vec3 half_m, glm::vec3 place_m = glm::vec3(0.0F)) {
  return {.kind = PropPartKind::box, .place_m = place_m, .half_m = half_m};
}
PropPart round_part(PropPartKind kind, float radius_m, float half_m) {
  return {.kind = kind, .half_m = {radius_m, half_m, radius_m}};
}

/// A boulder of eight corners and six.
PropPart boulder_part(float radius_m) {
  PropPart part{.kind = PropPartKind::hull};
  const float near_m = 0.62F * radius_m;
  for (const float x : {-near_m, near_m})
    for (const float y : {-near_m, near_m})
      for (const float z : {-near_m, near_m}) part.corners_m.push_back({x, y, z});
  for (const float side : {-radius_m, radius_m}) {
    part.corners_m.push_back({side, 0.1F * side, 0.0F});
    part.corners_m.push_back({0.0F, side, 0.15F * side});
    part.corners_m.push_back({-0.1F * side, 0.0F, side});
  }
  return part;
}

class Storeman {
 public:
  explicit Storeman(SceneSetup& setup) : setup_(setup) {}

  /// `place_m`: of the props' origin.
  void put(std::string_view material, std::vector<PropPart> parts, glm::vec3 place_m,
           glm::quat turn = upright) {
    AddPropRequest add;
    add.place_m = place_m + glm::vec3(0.0F, gap_m, 0.0F);
    add.turn = turn;
    add.prop.parts = std::move(parts);
    add.prop.material = store_material(material);
    add.prop.friction = builtin_palette().row(add.prop.material).friction;
    setup_.build.emplace_back(std::move(add));
  }
  void crate(float half_m, glm::vec3 foot_m) {
    put("timber", {box_part(glm::vec3(half_m))}, foot_m + glm::vec3(0.0F, half_m, 0.0F));
  }
  void barrel(std::string_view material, glm::vec3 foot_m) {
    constexpr float radius_m = 0.3F, half_m = 0.45F;
    put(material, {round_part(PropPartKind::cylinder, radius_m, half_m)},
        foot_m + glm::vec3(0.0F, half_m, 0.0F));
  }
  void ball(std::string_view material, float radius_m, glm::vec3 foot_m) {
    put(material, {round_part(PropPartKind::sphere, radius_m, radius_m)},
        foot_m + glm::vec3(0.0F, radius_m, 0.0F));
  }
  /// Its top is 0.8 m above its foot.
  void table(glm::vec3 foot_m) {
    constexpr float leg_m = 0.36F, wide_m = 0.9F, deep_m = 0.5F, thick_m = 0.04F;
    std::vector<PropPart> parts{box_part({wide_m, thick_m, deep_m}, {0.0F, leg_m + thick_m, 0.0F})};
    for (const float x : {-0.85F * wide_m, 0.85F * wide_m})
      for (const float z : {-0.8F * deep_m, 0.8F * deep_m})
        parts.push_back(box_part({0.05F, leg_m, 0.05F}, {x, 0.0F, z}));
    put("timber", std::move(parts), foot_m + glm::vec3(0.0F, leg_m, 0.0F));
  }

 private:
  SceneSetup& setup_;
};

/// Corners are multiples of a voxel; faces lie between voxels. What stands on the ground reaches into it.
void add_masonry(SceneSetup& setup) {
  constexpr float half_voxel_m = 0.125F;
  const auto put = [&](std::string_view material, glm::vec3 lo_m, glm::vec3 hi_m) {
    setup.build.emplace_back(
        FillRequest{box(0.5F * (lo_m + hi_m), 0.5F * (hi_m - lo_m)), store_material(material)});
  };
  const glm::vec3 low(-6.0F, -1.5F, -3.0F), high(6.0F, half_voxel_m, 2.5F);
  setup.build.emplace_back(
      PaintRequest{box(0.5F * (low + high), 0.5F * (high - low)), store_material("concrete")});
  put("concrete", {-5.0F, -0.5F, -1.5F}, {-1.0F, dock_top_m, 1.25F});
  put("brick", {-5.0F, -0.5F, -2.0F}, {5.0F, wall_top_m, -1.25F});
}

void add_stock(Storeman& store) {
  constexpr float crate_m = 0.35F, step_m = 0.72F;
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 3 - row; ++i)
      store.crate(crate_m, {-4.3F + step_m * (static_cast<float>(i) + 0.5F * static_cast<float>(row)),
                            dock_top_m + (2.0F * crate_m + gap_m) * static_cast<float>(row), 0.1F});
  store.barrel("steel", {-1.6F, dock_top_m, -0.6F});
  store.barrel("timber", {-1.5F, dock_top_m, 0.5F});

  const float wall_z_m = -1.625F;
  for (const float x : {-2.2F, 0.2F, 1.0F, 3.4F})
    store.barrel(x < 0.5F ? "steel" : "timber", {x, wall_top_m, wall_z_m});
  store.crate(0.3F, {2.2F, wall_top_m, wall_z_m});
  store.ball("ice", 0.3F, {-0.8F, wall_top_m, wall_z_m});
  store.ball("steel", 0.25F, {4.4F, wall_top_m, wall_z_m});

  store.table({1.3F, 0.0F, 0.9F});
  store.crate(0.15F, {0.8F, 0.8F, 0.8F});
  store.ball("glass", 0.12F, {1.6F, 0.8F, 1.0F});
  store.put("steel", {round_part(PropPartKind::capsule, 0.18F, 0.5F)}, {3.2F, 0.18F, 1.4F}, lying);
  store.put("rock", {boulder_part(0.45F)}, {4.0F, 0.29F, 0.2F});
  store.put("concrete", {round_part(PropPartKind::cylinder, 0.35F, 0.8F)}, {-0.1F, 0.35F, -0.2F}, lying);
  store.ball("brick", 0.3F, {2.7F, 0.0F, 0.2F});
}

}  // namespace

Result<SceneSetup> store_scene(const std::string&) {
  SceneSetup setup;
  setup.config.terrain = {TerrainKind::flat, 1, 0.25F};
  setup.eye_m = {5.5F, 3.4F, 8.0F};
  setup.target_m = {-0.3F, 1.2F, -0.6F};
  add_masonry(setup);
  Storeman store(setup);
  add_stock(store);
  for (const glm::vec3 impact_m : {glm::vec3(1.6F, 1.0F, -1.0F), {-1.8F, 1.9F, -1.0F}})
    setup.strikes.push_back(strike(crater(impact_m - glm::vec3(0.0F, 0.0F, 0.6F), 1.3F), impact_m, 40, 5.0F));
  return setup;
}

}  // namespace scree
