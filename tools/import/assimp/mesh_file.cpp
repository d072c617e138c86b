#include "tools/import/assimp/mesh_file.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include "shared/base/kind_table.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// Words of a PLY file's header that are looked at.
constexpr int ply_header_words_max = 4096;

glm::dvec3 placed(const aiVector3D& p, const Placement& place) {
  const glm::dvec3 own(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
  const glm::dvec3 turned = place.z_up ? glm::dvec3(own.x, own.z, -own.y) : own;
  return turned * place.scale + glm::dvec3(place.at_m[0], place.at_m[1], place.at_m[2]);
}

Result<TriangleMesh> mesh_of(const aiScene& scene, const aiMesh& from, const aiMatrix4x4& transform,
                             const std::string& name, const Placement& place) {
  TriangleMesh mesh;
  mesh.name = name;
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    mesh.points.push_back(placed(transform * from.mVertices[i], place));
    const glm::dvec3& p = mesh.points.back();
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return fail(fmt::format("mesh '{}' has a point that is not a number", name));
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines bound nothing
    for (unsigned k = 0; k < 3; ++k)
      if (face.mIndices[k] >= from.mNumVertices)
        return fail(fmt::format("mesh '{}' has a triangle without its points", name));
    mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  if (transform.Determinant() < 0.0F)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  if (from.mMaterialIndex < scene.mNumMaterials)
    mesh.material = kind_named<Material>(scene.mMaterials[from.mMaterialIndex]->GetName().C_Str());
  if (!mesh.material) mesh.material = kind_named<Material>(name);
  return mesh;
}

Result<void> collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above,
                     const Placement& place, std::vector<TriangleMesh>& meshes) {
  const aiMatrix4x4 transform = above * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& from = *scene.mMeshes[node.mMeshes[i]];
    const std::string own = from.mName.C_Str(), outer = node.mName.C_Str();
    auto mesh = mesh_of(scene, from, transform, own.empty() ? outer : own, place);
    TRY(mesh);
    weld(*mesh);
    if (!mesh->triangles.empty()) meshes.push_back(std::move(*mesh));
    if (meshes.size() > limits::import_meshes_max)
      return fail(fmt::format("more than {} meshes (limits.import_meshes_max)", limits::import_meshes_max));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    TRY(collect(scene, *node.mChildren[i], transform, place, meshes));
  return {};
}

/// The header of a PLY file may promise more than the file can hold: assimp would make room for it.
Result<void> check_ply(const std::string& path) {
  const uintmax_t bytes = std::filesystem::file_size(path);
  std::ifstream file(path, std::ios::binary);
  std::string word;
  for (int words = 0; words < ply_header_words_max && file >> word && word != "end_header"; ++words) {
    uintmax_t count = 0;
    if (word == "element" && file >> word && !(file >> count && count <= bytes))
      return fail(fmt::format("its header promises more '{}' than the file can hold", word));
  }
  return {};
}

Result<std::vector<TriangleMesh>> meshes_in(const std::string& path, const Placement& place) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return fail("there is no such file");
  if (path.ends_with(".ply") || path.ends_with(".PLY")) TRY(check_ply(path));
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) return fail(importer.GetErrorString());
  std::vector<TriangleMesh> meshes;
  TRY(collect(*scene, *scene->mRootNode, aiMatrix4x4(), place, meshes));
  if (meshes.empty()) return fail("it holds no triangle");
  return meshes;
}

}  // namespace

Result<std::vector<TriangleMesh>> read_meshes(const std::string& path, const Placement& place) {
  try {
    auto meshes = meshes_in(path, place);
    if (!meshes) return fail(path + ": " + meshes.error().message);
    return meshes;
  } catch (const std::bad_alloc&) {
    return fail(path + ": it does not fit into memory (--memory-max)");
  } catch (const std::exception& failure) {
    return fail(path + ": " + failure.what());
  }
}

}  // namespace scree
