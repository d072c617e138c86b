// scree-scene: names the scenes, and makes worlds of them that scree-server hosts (--world).
// Exit status: 0 success, 1 failure, 2 wrong usage.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "client/render/scene/look_at.h"
#include "client/viewer/base/camera_text.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"
#include "tools/scenes/build.h"

namespace scree {
namespace {

constexpr int failed = 1;
constexpr int usage_error = 2;

int complain(const std::string& message) {
  std::fprintf(stderr, "scree-scene: error: %s\n", message.c_str());
  return failed;
}

int list() {
  for (const SceneRow& scene : all_scenes())
    std::printf("%-12.*s %.*s\n", static_cast<int>(scene.name.size()), scene.name.data(),
                static_cast<int>(scene.summary.size()), scene.summary.data());
  return 0;
}

uint64_t drawn_number() {
  std::random_device device;
  return std::max<uint64_t>(1, (uint64_t{device()} << 32U) | device());
}

/// Where the strikes lie, so that a bot finds what they are about.
glm::vec3 middle_of(const std::vector<CarveRequest>& strikes) {
  glm::vec3 sum(0.0F);
  for (const CarveRequest& strike : strikes) sum += strike.impact_m;
  return strikes.empty() ? sum : sum / static_cast<float>(strikes.size());
}

int make(const std::string& name, const std::string& path) {
  const SceneRow* scene = scene_named(name);
  if (scene == nullptr) {
    std::fprintf(stderr, "there is no scene '%s'; the scenes are %s\n", name.c_str(), scene_names().c_str());
    return usage_error;
  }
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  const Result<SceneSetup> setup = scene->set_up(folder);
  if (!setup) return complain(setup.error().message);
  if (const auto made = make_scene_file(*setup, path, drawn_number()); !made)
    return complain(made.error().message);
  const glm::vec3 middle_m = middle_of(setup->strikes);
  const nlohmann::ordered_json line{{"world", path},
                                    {"scene", name},
                                    {"camera", camera_text(look_at(setup->eye_m, setup->target_m))},
                                    {"centre", {middle_m.x, middle_m.z}}};
  // A name of a file may be any bytes.
  std::printf("%s\n", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app("Makes worlds from the scenes of tests, benches and pictures.", "scree-scene");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  const CLI::App* list_command = app.add_subcommand("list", "lists the scenes");
  CLI::App* make_command =
      app.add_subcommand("make", "makes the file of a world, and the file of its ground in the same folder");
  std::string name, path;
  make_command->add_option("SCENE", name, "name of a scene (see list)")->required();
  make_command->add_option("FILE", path, "the new file, for scree-server --world FILE")->required();
  refuse_empty(*make_command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  const int code = list_command->parsed() ? list() : make(name, path);
  const auto printed = flush_output();
  return code == 0 && !printed ? complain(printed.error().message) : code;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  return scree::run(argc, argv);
}
