// Builds a scene: in a world, in a field alone, or as the file of a world that a server hosts.
#pragma once

#include <string>

#include "server/world/world.h"
#include "tools/scenes/scene.h"

namespace scree {

/// Carries out what builds the scene, tick by tick, in a world of its configuration. The error names what the
/// world refused.
Result<void> build_scene(World& world, const SceneSetup& setup);

/// The world of a scene, built. `threads`: as World::create.
Result<std::unique_ptr<World>> scene_world(const SceneSetup& setup, size_t threads = 1);

/// The same terrain without a world, and without props: of a field on the scene's ground.
void build_scene(Field& field, const SceneSetup& setup);

/// Makes a world's file of it (scree-server --world); an error if the file exists. A ground file of the scene
/// must lie where servers look for it: beside the file. `number` tells worlds apart (WelcomeMessage::world);
/// not 0.
Result<void> make_scene_file(const SceneSetup& setup, const std::string& path, uint64_t number);

}  // namespace scree
