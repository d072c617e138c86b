// What shows a prop in place of its parts: coloured triangles, of the glTF file that the prop names
// (Prop::model). It is no part of the simulation.
//
// On its way: a server reads a folder of files (content/files/model_folder.h), checks each by its reader
// (content/model/glb.h), and has them by their hash, as it has the palette's images. A client that gets a
// prop asks for its model (client/cache/received_content.h), reads the bytes off its main thread, and hands
// the mesh to the renderer, which draws an instance for each prop (client/render/pieces/prop_views.h). The
// page reads in JavaScript (client/web/page/glb.js). All go through checked_model(): what it lets through can
// be drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/result.h"

namespace scree {

namespace limits {

/// Bytes of a model's file, as of any content, and of the JSON in it: some thousand nodes and meshes. Above:
/// refused before they are read.
inline constexpr size_t model_bytes_max = size_t{4} << 20;
inline constexpr size_t model_json_bytes_max = size_t{1} << 20;

/// Vertices and triangles of a model, with a mesh as often as nodes have it: 4 MiB on the GPU. Above:
/// refused.
inline constexpr size_t model_vertices_max = size_t{1} << 17;
inline constexpr size_t model_triangles_max = size_t{1} << 17;

/// Nodes of a model's scene. Above: refused.
inline constexpr size_t model_nodes_max = 4096;

/// How far a point of a model may lie from the prop's origin, metres: twice as far as of its parts
/// (prop_reach_max_m). Beyond: refused.
inline constexpr float model_reach_max_m = 32.0F;

}  // namespace limits

/// As the GPU takes it. The place is in the prop's axes, metres.
struct ModelVertex {
  glm::vec3 place_m{0.0F};
  std::array<int8_t, 4> normal{};   ///< 127 times a unit vector, then 0; all 0: its triangles are flat
  std::array<uint8_t, 4> colour{};  ///< 255 times the square root of linear red, green and blue, then 0

  bool operator==(const ModelVertex&) const = default;
};
static_assert(sizeof(ModelVertex) == 20);

struct ModelMesh {
  std::vector<ModelVertex> vertices;
  std::vector<uint32_t> corners;  ///< three a triangle, counterclockwise as seen from outside
  float reach_m = 0.0F;           ///< of the farthest vertex from the origin

  size_t triangles() const { return corners.size() / 3; }
  size_t bytes() const { return vertices.size() * sizeof(ModelVertex) + corners.size() * sizeof(uint32_t); }
};

using ModelMeshes = std::map<Digest, std::shared_ptr<const ModelMesh>>;

/// Refuses what cannot be drawn: nothing, too much, corners without a vertex, and places that are not finite
/// or beyond limits::model_reach_max_m. Any thread.
Result<ModelMesh> checked_model(std::vector<ModelVertex> vertices, std::vector<uint32_t> corners);

}  // namespace scree
