// Binary glTF 2.0 (.glb), as the looks of props: https://registry.khronos.org/glTF/specs/2.0. The bytes are
// hostile. nlohmann's JSON, whose parser does not recurse, reads the head; the rest is typed arrays in the
// one buffer of the file, of which each access is checked.
//
// Read: the default scene's nodes with their transforms, triangles, normals, base colour factors and colours
// of vertices. Left out: textures, skins, animations, morphs and transparency, so that a model stands as its
// nodes do. Refused: what has another buffer than the file's own, other primitives than triangles, sparse
// accessors, and required extensions but those of materials. Any thread.
#pragma once

#include <cstdint>
#include <span>

#include "shared/base/result.h"
#include "shared/prop/model_mesh.h"

namespace scree {

/// The error says what is wrong with the file, and which limit it is beyond.
Result<ModelMesh> read_glb(std::span<const uint8_t> bytes);

}  // namespace scree
