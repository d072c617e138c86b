#include "tools/scenes/grounds.h"

#include "server/app/ground_giver.h"
#include "tools/import/bricks_import.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/heights_import.h"
#include "tools/import/mesh/mesh_solid.h"
#include "tools/scenes/house.h"
#include "tools/scenes/structures.h"

namespace scree {

namespace {

void no_progress(double) {}

/// The ground of that file, and a place to look at it from.
Result<SceneSetup> on_file(const std::string& path, glm::vec3 eye_m, glm::vec3 target_m) {
  SceneSetup setup;
  TRY(set_ground(path, setup.config));
  setup.eye_m = eye_m;
  setup.target_m = target_m;
  return setup;
}

/// North-western corners at street level; sizes in metres.
constexpr HousePlan block_of_houses[] = {
    {.x_m = -15.0F, .z_m = -11.0F, .width_m = 8.0F, .depth_m = 7.0F, .storeys = 3, .gable = false},
    {.x_m = -4.0F, .z_m = -11.0F, .width_m = 7.0F, .depth_m = 7.0F, .storeys = 2, .gable = true},
    {.x_m = 6.0F, .z_m = -11.0F, .width_m = 8.0F, .depth_m = 7.0F, .storeys = 4, .gable = false},
    {.x_m = -15.0F, .z_m = 2.0F, .width_m = 7.0F, .depth_m = 7.0F, .storeys = 2, .gable = true},
    {.x_m = -5.0F, .z_m = 2.0F, .width_m = 8.0F, .depth_m = 7.0F, .storeys = 3, .gable = false},
    {.x_m = 6.0F, .z_m = 2.0F, .width_m = 7.0F, .depth_m = 7.0F, .storeys = 2, .gable = true},
};

}  // namespace

Result<SceneSetup> city_scene(const std::string& folder) {
  const float voxel_m = TerrainSource{}.voxel_size_m;
  std::vector<std::unique_ptr<Solid>> houses;
  for (const HousePlan& plan : block_of_houses) {
    auto solid = TRY(solid_of_mesh(house(plan, voxel_m), {}, voxel_m));
    houses.push_back(std::move(solid));
  }
  const std::string path = folder + "/city.ground";
  const auto imported = import_bricks(houses, path, {.level_m = 0.0}, no_progress);
  if (!imported) return fail(path + ": " + imported.error().message);
  auto setup = on_file(path, {23.0F, 12.0F, 21.0F}, {0.0F, 3.0F, -2.0F});
  if (!setup) return setup;
  // A corner of each house that stands in front, and the wall of one.
  for (const glm::vec3 at_m : {glm::vec3(3.0F, 1.5F, 9.0F),
                               {13.0F, 1.5F, 9.0F},
                               {3.0F, 1.5F, 2.0F},
                               {-5.0F, 1.5F, 9.0F},
                               {10.0F, 4.5F, -4.0F}})
    setup->strikes.push_back(strike(sphere(at_m, 2.0F), at_m + glm::vec3(1.0F, 0.0F, 1.5F), 32, 5.0F));
  return setup;
}

Result<SceneSetup> maunga_whau_scene(const std::string& folder) {
  auto raster = TRY(open_raster(SCREE_DATA_DIR "/maunga_whau.asc"));
  const std::string path = folder + "/maunga-whau.ground";
  const auto imported = import_heights(*raster, path, {}, no_progress);
  if (!imported) return fail(path + ": " + imported.error().message);
  auto setup = on_file(path, {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F});
  if (!setup) return setup;
  const TerrainSource& terrain = setup->config.terrain;
  const auto on_ground_at = [&](float x_m, float z_m) {
    return glm::vec3(x_m, ground_height_m(terrain, x_m, z_m), z_m);
  };
  // From the eastern rim into the crater, with some sky over the western one.
  setup->target_m = on_ground_at(-130.0F, -34.0F) + glm::vec3(0.0F, 10.0F, 0.0F);
  setup->eye_m = on_ground_at(-62.0F, -16.0F) + glm::vec3(0.0F, 16.0F, 0.0F);
  for (const glm::vec2 at :
       {glm::vec2(-88.0F, -24.0F), {-84.0F, -16.0F}, {-92.0F, -30.0F}, {-82.0F, -28.0F}}) {
    const glm::vec3 impact_m = on_ground_at(at.x, at.y);
    setup->strikes.push_back(
        strike(crater(impact_m - glm::vec3(0.0F, 0.8F, 0.0F), 2.5F), impact_m, 64, 6.0F));
  }
  return setup;
}

}  // namespace scree
