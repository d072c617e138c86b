// A binary glTF file, as the model of a prop.
//
// Holds: what cannot be drawn has a reason. What is read lies within reach, is no more than the limits, and
// its triangles have their vertices.
#include <cmath>

#include "content/model/glb.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

void check_model_file(std::span<const uint8_t> bytes) {
  const Result<ModelMesh> mesh = read_glb(bytes);
  if (!mesh) {
    CHECK(!mesh.error().message.empty());
    return;
  }
  CHECK(mesh->triangles() > 0 && mesh->corners.size() % 3 == 0);
  CHECK(mesh->vertices.size() <= limits::model_vertices_max);
  CHECK(mesh->triangles() <= limits::model_triangles_max);
  CHECK(mesh->reach_m <= limits::model_reach_max_m);
  for (const uint32_t corner : mesh->corners) CHECK(corner < mesh->vertices.size());
  for (const ModelVertex& vertex : mesh->vertices)
    for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(vertex.place_m[axis]) <= mesh->reach_m + 1e-3F);
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::check_model_file({data, size});
  return 0;
}
