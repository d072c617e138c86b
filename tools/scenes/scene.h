// Scenes, written once for tests, benches, pictures and the demo: a ground, what is built on it, where to
// stand and where to strike. Each is the same world wherever it is set up.
//
// Metres; y points up. Functions may be called from any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/world/world_config.h"
#include "shared/operation/request.h"

namespace scree {

/// A scene is built by what makes no pieces. Props come last: what is filled does not push them away.
using BuildStep = std::variant<FillRequest, PaintRequest, AddPropRequest>;

struct SceneSetup {
  WorldConfig config{};                 ///< with its ground
  std::vector<BuildStep> build{};       ///< in order
  glm::vec3 eye_m{0.0F};                ///< where to stand: the world's spawn
  glm::vec3 target_m{0.0F};             ///< where to look from there
  std::vector<CarveRequest> strikes{};  ///< blows that show what the scene is for, in order
};

struct SceneRow {
  std::string_view name;
  std::string_view summary;
  /// `folder`: exists; a scene whose ground is a file writes it there as NAME.ground. The file is read while
  /// the configuration is in use, and may be removed meanwhile. The error says what could not be read or
  /// written.
  Result<SceneSetup> (*set_up)(const std::string& folder);
};

/// Every scene there is.
std::span<const SceneRow> all_scenes();

/// Null: none is called so.
const SceneRow* scene_named(std::string_view name);

/// "plain, cliffs, … or maunga-whau"
std::string scene_names();

}  // namespace scree
