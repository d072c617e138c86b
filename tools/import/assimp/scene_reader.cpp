#include "tools/import/assimp/scene_reader.h"

#include <algorithm>
#include <array>
#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string_view>

#include "tools/import/assimp/folder_files.h"
#include "tools/import/assimp/materials_file.h"
#include "tools/import/assimp/nesting.h"
#include "tools/import/assimp/ply_header.h"
#include "tools/import/assimp/scene_textures.h"
#include "tools/import/assimp/scene_warnings.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// By the standards of their forms.
constexpr std::array<std::string_view, 2> metre_endings = {".gltf", ".glb"};

constexpr double metres_a_centimetre = 0.01;

/// Axes of FBX files.
constexpr int32_t fbx_up_x = 0, fbx_up_z = 2;

/// The base colour of glTF, or else what an older form calls diffuse.
SceneColour colour_of(const aiMaterial& material) {
  aiColor4D colour;
  const bool is_known = material.Get(AI_MATKEY_BASE_COLOR, colour) == AI_SUCCESS ||
                        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS;
  return {{colour.r, colour.g, colour.b}, static_cast<uint8_t>(is_known ? 1 : 0)};
}

/// All meshes of a scene, in the order of its nodes.
class SceneTriangles {
 public:
  SceneTriangles(const aiScene& scene, const MaterialMap& named, SceneTextures& textures)
      : scene_(scene), named_(named), textures_(textures) {}

  Result<void> collect(const aiNode& node, const aiMatrix4x4& above) {
    const aiMatrix4x4 transform = above * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      const std::string own = mesh.mName.C_Str();
      TRY(add(mesh, transform, own.empty() ? node.mName.C_Str() : own));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) TRY(collect(*node.mChildren[i], transform));
    return {};
  }

  std::vector<std::array<double, 3>> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<SceneMaterial> materials;
  std::vector<std::string> foreign_names;
  std::vector<SceneColour> foreign_colours;
  std::set<std::string> named_used;
  uint64_t meshes = 0;

 private:
  /// By the material's name, or else by the mesh's.
  SceneMaterial material_of(const aiMesh& mesh, const std::string& name) {
    std::string material;
    if (mesh.mMaterialIndex < scene_.mNumMaterials)
      material = scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    for (const std::string& one : {material, name})
      if (const auto found = named_.find(one); found != named_.end()) {
        named_used.insert(one);
        return said(found->second);
      }
    if (material.empty() || material == AI_DEFAULT_MATERIAL_NAME) return 0;
    return own_material(material, colour_of(*scene_.mMaterials[mesh.mMaterialIndex]));
  }

  /// A material that is none of the palette's has a number for each of its colours.
  SceneMaterial own_material(const std::string& name, const SceneColour& colour) {
    std::array<int, 3> key{};
    for (size_t i = 0; i < 3; ++i) key[i] = srgb_of_linear(colour.linear[i]);
    const auto found = foreign_.find({name, key});
    if (found != foreign_.end()) return static_cast<SceneMaterial>(scene_own_first + found->second);
    if (foreign_names.size() >= limits::scene_materials_max) return 0;
    foreign_.emplace(std::pair(name, key), foreign_names.size());
    foreign_names.push_back(name);
    foreign_colours.push_back(colour);
    return static_cast<SceneMaterial>(scene_own_first + foreign_names.size() - 1);
  }

  /// Those of the mesh's triangles from `first` on: one for all, or by the picture of the material.
  void add_materials(const aiMesh& mesh, const std::string& name, const std::vector<const aiFace*>& faces) {
    const SceneMaterial one = material_of(mesh, name);
    if (one < scene_own_first || textures_.of(mesh.mMaterialIndex) == nullptr) {
      materials.resize(triangles.size(), one);
      return;
    }
    const std::string material = scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    const SceneColour factor = colour_of(*scene_.mMaterials[mesh.mMaterialIndex]);
    for (const aiFace* const face : faces) {
      const auto texel = textures_.colour(mesh, *face);
      SceneColour colour{{}, 1};
      for (size_t i = 0; texel && i < 3; ++i)
        colour.linear[i] = coarse((*texel)[i] * (factor.is_known != 0 ? factor.linear[i] : 1.0F));
      materials.push_back(texel ? own_material(material, colour) : one);
    }
  }
  /// Brightness in 32 steps, as it is seen.
  static float coarse(float linear) {
    return linear_of_srgb(static_cast<uint8_t>((srgb_of_linear(linear) & 0xF8) | 4));
  }

  Result<void> add(const aiMesh& mesh, const aiMatrix4x4& transform, const std::string& name) {
    if (points.size() + mesh.mNumVertices > limits::import_triangles_max ||
        triangles.size() + mesh.mNumFaces > limits::import_triangles_max)
      return fail(fmt::format("more than {} triangles or points (limits.import_triangles_max)",
                              limits::import_triangles_max));
    const auto first = static_cast<uint32_t>(points.size());
    const size_t had = triangles.size();
    const bool mirrored = transform.Determinant() < 0.0F;
    std::vector<const aiFace*> faces;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines bound nothing
      for (unsigned k = 0; k < 3; ++k)
        if (face.mIndices[k] >= mesh.mNumVertices)
          return fail(fmt::format("mesh '{}' has a triangle without its points", name));
      triangles.push_back({first + face.mIndices[0], first + face.mIndices[mirrored ? 2 : 1],
                           first + face.mIndices[mirrored ? 1 : 2]});
      faces.push_back(&face);
    }
    if (triangles.size() == had) return {};
    ++meshes;
    add_materials(mesh, name, faces);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D p = transform * mesh.mVertices[i];
      points.push_back({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
    return {};
  }

  const aiScene& scene_;
  const MaterialMap& named_;
  SceneTextures& textures_;
  std::map<std::pair<std::string, std::array<int, 3>>, size_t> foreign_;
};

/// assimp would also try its readers of other forms, by what a file begins with.
void leave_readers_of(Assimp::Importer& importer, const std::string& ending) {
  const std::string_view form = std::string_view(ending).substr(1);
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::istringstream endings(importer.GetImporterInfo(i)->mFileExtensions);
    bool is_of_form = false;
    for (std::string one; endings >> one;) is_of_form = is_of_form || one == form;
    if (is_of_form) continue;
    const std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
    importer.UnregisterLoader(other.get());
  }
}

/// The time that assimp takes to make triangles of a polygon grows with the square of its corners.
Result<void> check_polygons(const aiScene& scene) {
  uint64_t work = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i)
    for (unsigned k = 0; k < scene.mMeshes[i]->mNumFaces; ++k) {
      const uint64_t corners = scene.mMeshes[i]->mFaces[k].mNumIndices;
      if (corners > limits::polygon_corners_max)
        return fail(
            fmt::format("it has a polygon of {} corners: at most {} can be imported "
                        "(limits.polygon_corners_max); make triangles of it before",
                        corners, limits::polygon_corners_max));
      work += corners > 4 ? corners * corners : 0;
    }
  if (work <= limits::polygon_work_max) return {};
  return fail("its large polygons are too many (limits.polygon_work_max): make triangles of them before");
}

Result<const aiScene*> read_scene(Assimp::Importer& importer, const std::string& path,
                                  const std::string& ending) {
  constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType;
  std::string file;
  if (ending == ".ply" || is_nested_form(ending)) {
    std::ifstream in(path, std::ios::binary);
    file.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    TRY(check_nesting(file, ending));
  }
  const aiScene* scene = nullptr;
  if (ending == ".ply") {
    file = TRY(mended_ply(std::move(file)));
    scene = importer.ReadFileFromMemory(file.data(), file.size(), 0, "ply");
  } else {
    file = {};
    scene = importer.ReadFile(path, 0);
  }
  if (scene == nullptr) return scene;
  TRY(check_polygons(*scene));
  return importer.ApplyPostProcessing(steps);
}

/// For a file in which nothing was found: letters of two bytes, by a mark or by the zeros among the first.
Result<void> check_letters(const std::string& path) {
  std::string start(64, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<size_t>(in.gcount()));
  const bool has_mark = start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF");
  size_t zeros[2] = {0, 0};
  for (size_t i = 0; i < start.size(); ++i) zeros[i % 2] += start[i] == '\0' ? 1 : 0;
  const size_t letters = start.size() / 2;
  const bool in_pairs =
      letters > 0 && ((zeros[0] == letters && zeros[1] == 0) || (zeros[1] == letters && zeros[0] == 0));
  if (!has_mark && !in_pairs) return {};
  return fail("its letters are not UTF-8: write it as UTF-8");
}

Result<const aiScene*> opened(Assimp::Importer& importer, const FolderFiles& files, const std::string& path,
                              const std::string& ending) {
  const aiScene* const scene = TRY(read_scene(importer, path, ending));
  if (!files.refused().empty())
    return fail(
        fmt::format("it names the file '{}', which import does not read: only .bin, .buffer, .mtl, .png and "
                    ".jpg in its own folder and below. Put the file there, and write its name alone",
                    files.refused()));
  if (scene != nullptr && scene->mRootNode != nullptr) return scene;
  TRY(check_letters(path));
  for (const std::string& beside : files.materials())
    if (const auto fault = fault_of_materials(beside)) return fail(*fault);
  const std::string words = importer.GetErrorString();
  if (words.starts_with("No suitable reader"))
    return fail("it is not of the form that its name says, or damaged");
  return fail(words);
}

/// Unit and axis of the file's form: glTF's by its standard, Collada's by assimp, which turns and scales by
/// the file, FBX's by the file. In 3DS z points up, and assimp has turned it. The transform that is left to
/// do.
aiMatrix4x4 read_unit(const aiScene& scene, const std::string& ending, SceneHead& head) {
  aiMatrix4x4 transform;
  if (std::ranges::find(metre_endings, ending) != metre_endings.end() || ending == ".dae") {
    head.metres_a_unit = 1.0;
    head.says_up = 1;
  }
  if (ending == ".3ds") head.says_up = 1;
  if (ending != ".fbx" || scene.mMetaData == nullptr) return transform;
  double centimetres = 0.0;
  float rounded = 0.0F;
  if (scene.mMetaData->Get("UnitScaleFactor", rounded)) centimetres = static_cast<double>(rounded);
  scene.mMetaData->Get("UnitScaleFactor", centimetres);
  if (centimetres > 0.0) {
    head.metres_a_unit = centimetres * metres_a_centimetre;
    const auto scale = static_cast<float>(head.metres_a_unit);
    aiMatrix4x4::Scaling({scale, scale, scale}, transform);
  }
  int32_t up = 0;
  if (!scene.mMetaData->Get("UpAxis", up)) return transform;
  head.says_up = 1;
  aiMatrix4x4 turn;
  if (up == fbx_up_x) turn = aiMatrix4x4(0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  if (up == fbx_up_z) turn = aiMatrix4x4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
  return turn * transform;
}

}  // namespace

Result<void> send_scene(ReaderChannel& channel, const std::string& path, const std::string& ending,
                        const MaterialMap& named) {
  const SceneWarnings warnings;
  Assimp::Importer importer;
  leave_readers_of(importer, ending);
  auto* const files = new FolderFiles(path);  // the importer owns it
  importer.SetIOHandler(files);
  const aiScene* const scene = TRY(opened(importer, *files, path, ending));
  SceneHead head;
  const aiMatrix4x4 transform = read_unit(*scene, ending, head);
  SceneTextures textures(*scene, path);
  SceneTriangles all(*scene, named, textures);
  TRY(all.collect(*scene->mRootNode, transform));
  head.meshes = all.meshes;
  head.foreign_materials = all.foreign_names.size();
  head.unread_textures = textures.unread();
  head.warnings = warnings.lines().size();
  head.named = all.named_used.size();
  if (all.triangles.empty()) TRY(check_letters(path));
  TRY(channel.put(head));
  TRY(channel.put_list(all.points));
  TRY(channel.put_list(all.triangles));
  TRY(channel.put_list(all.materials));
  TRY(channel.put_list(all.foreign_colours));
  for (const std::string& name : all.foreign_names) TRY(channel.put_text(name));
  for (const std::string& line : warnings.lines()) TRY(channel.put_text(line));
  for (const std::string& name : all.named_used) TRY(channel.put_text(name));
  return channel.put_text(files->missing_materials());
}

}  // namespace scree
