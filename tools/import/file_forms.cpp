#include "tools/import/file_forms.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "shared/base/small_letters.h"

namespace scree {

namespace {

constexpr std::array<std::string_view, 9> mesh_endings = {".obj", ".ply", ".stl", ".gltf", ".glb",
                                                          ".off", ".dae", ".3ds", ".fbx"};

struct UnreadForm {
  std::string_view ending;
  std::string_view words;
};

constexpr std::string_view archive = "an archive: unpack it, and import the file that is in it";
constexpr std::string_view project =
    "a modelling program's own file: export the model from there as glTF, OBJ, PLY or STL";
constexpr std::string_view solid_model = "a model of exact curves: export it from its program as STL or OBJ";
constexpr std::string_view point_cloud =
    "a cloud of points without a surface: make an elevation model (pdal) or a mesh of it";
constexpr std::string_view scene =
    "a form of scenes that import does not read: convert it to glTF, OBJ or PLY";

constexpr UnreadForm unread_forms[] = {
    {".7z", archive},      {".rar", archive},        {".bz2", archive},     {".xz", archive},
    {".zst", archive},     {".blend", project},      {".max", project},     {".ma", project},
    {".mb", project},      {".c4d", project},        {".skp", project},     {".3dm", project},
    {".rvt", project},     {".step", solid_model},   {".stp", solid_model}, {".iges", solid_model},
    {".igs", solid_model}, {".sldprt", solid_model}, {".ifc", solid_model}, {".las", point_cloud},
    {".laz", point_cloud}, {".e57", point_cloud},    {".pcd", point_cloud}, {".pts", point_cloud},
    {".ptx", point_cloud}, {".usd", scene},          {".usda", scene},      {".usdc", scene},
    {".usdz", scene},      {".abc", scene},          {".x3d", scene},       {".wrl", scene},
    {".3mf", scene},       {".amf", scene},          {".lwo", scene},       {".nvdb", scene},
};

}  // namespace

std::string ending_of(const std::string& path) {
  return in_small_letters(std::filesystem::path(path).extension().string());
}

bool is_mesh_file(const std::string& path) {
  return std::ranges::find(mesh_endings, ending_of(path)) != mesh_endings.end();
}

bool is_volume_file(const std::string& path) {
  return ending_of(path) == ".vdb";
}

bool is_voxels_file(const std::string& path) {
  return ending_of(path) == ".vox";
}

std::optional<std::string> refusal_of_form(const std::string& path) {
  const auto* const form = std::ranges::find(unread_forms, ending_of(path), &UnreadForm::ending);
  if (form == std::ranges::end(unread_forms)) return std::nullopt;
  return path + ": " + std::string(form->words);
}

}  // namespace scree
