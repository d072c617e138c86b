#include "tests/style/style_rules.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <regex>
#include <sstream>

namespace scree::style {
namespace {

/// A folder, and the folders directly beneath it in the layering. It may include those, what they may
/// include, and itself with the rooms in it.
struct Layer {
  std::string_view folder;
  std::vector<std::string_view> beneath;
};

/// Bodies and scenes from files, measurements and studies.
std::vector<Layer> bench_layers() {
  return {
      {"tools/place/", {"tools/import/", "client/admin/"}},
      {"tools/scenes/", {"server/app/", "tools/import/", "client/viewer/base/"}},
      {"bench/support/", {"tools/scenes/", "tools/film/process/", "server/", "client/", "tools/export/"}},
      {"bench/peers/", {"bench/support/"}},
      {"bench/simulation/", {"bench/support/", "bench/peers/"}},
      {"bench/drawing/", {"bench/support/", "bench/peers/"}},
      {"bench/wire/", {"bench/support/"}},
      {"bench/results/", {"bench/support/"}},
      {"bench/programs/", {"bench/results/"}},
      {"studies/report/", {"tools/film/process/", "bench/support/"}},
      {"studies/support/", {"studies/report/", "bench/support/"}},
      {"studies/paper/", {"studies/support/", "bench/peers/"}},
      {"studies/matrix/", {"studies/support/"}},
      {"studies/scale/", {"studies/support/", "bench/wire/"}},
      {"studies/peers/", {"studies/support/", "bench/peers/"}},
      {"studies/programs/",
       {"bench/programs/", "studies/paper/", "studies/matrix/", "studies/scale/", "studies/peers/"}},
  };
}

/// The layers that both sides share.
std::vector<Layer> shared_layers() {
  return {
      {"cmake/", {}},  // precompiled headers of libraries
      {"shared/base/", {}},
      {"shared/material/", {"shared/base/"}},
      {"shared/prop/", {"shared/material/"}},
      {"shared/field/", {"shared/material/"}},
      {"shared/surface/", {"shared/field/"}},
      {"shared/falling/", {"shared/field/"}},
      {"shared/fracture/", {"shared/surface/"}},
      {"shared/recombine/", {"shared/surface/", "shared/falling/"}},
      {"shared/region/", {"shared/field/"}},
      {"shared/game/", {"shared/material/"}},
      {"shared/operation/",
       {"shared/fracture/", "shared/recombine/", "shared/prop/", "shared/region/", "shared/game/"}},
      {"shared/query/", {"shared/surface/", "shared/prop/"}},
      {"shared/person/", {"shared/query/"}},
      {"proto/", {"shared/operation/", "shared/query/", "shared/person/"}},
      {"crypto/", {"shared/base/"}},
      {"auth/", {"proto/", "crypto/"}},
      {"ground/", {"proto/", "crypto/", "content/"}},
      {"content/model/", {"shared/prop/"}},
      {"content/files/", {"content/", "content/model/", "proto/", "crypto/"}},
      {"content/", {"shared/material/"}},
  };
}

/// The layers of the server.
std::vector<Layer> server_layers() {
  return {
      {"server/log/", {"shared/base/"}},
      {"server/metrics/", {"shared/base/"}},
      {"server/command/", {"shared/operation/"}},
      {"server/provenance/", {"shared/operation/"}},
      {"server/formats/", {"proto/", "server/command/", "server/provenance/"}},
      {"server/field/", {"server/formats/"}},
      {"server/fracture/", {"server/field/"}},
      {"server/colliders/", {"shared/surface/"}},
      {"server/bodies/", {"server/field/", "server/colliders/", "content/"}},
      {"server/recombine/", {"server/field/"}},
      {"server/work/", {"server/bodies/"}},
      {"server/world/", {"server/fracture/", "server/work/", "server/recombine/", "content/"}},
      {"server/doors/", {"server/command/", "auth/"}},
      {"server/publish/", {"server/world/", "crypto/"}},
      {"server/web/", {"server/command/", "transport/"}},
      {"server/net/", {"server/doors/", "server/publish/", "server/web/", "server/log/", "server/metrics/"}},
      {"server/store/", {"proto/", "server/world/", "server/log/", "server/metrics/"}},
      {"server/replay/", {"server/store/"}},
      {"server/host/", {"server/world/", "server/metrics/"}},
      {"server/history/", {"server/store/", "auth/"}},
      {"server/flight/", {"server/store/"}},
      {"server/rules/sandbox/", {"shared/base/"}},
      {"server/rules/api/", {"server/rules/"}},
      {"server/rules/", {"server/host/", "server/store/", "server/rules/sandbox/"}},
      {"server/agones/", {"server/log/"}},
      {"server/bus/", {"shared/base/"}},
      {"server/told/", {"server/replay/", "server/net/", "server/bus/"}},
      {"server/app/",
       {"server/net/", "server/replay/", "server/rules/", "server/history/", "server/flight/", "server/told/",
        "server/agones/", "ground/", "content/files/"}},
  };
}

/// The layers of the other programs and of the tests.
std::vector<Layer> other_layers() {
  return {
      {"tools/import/", {"ground/", "content/files/"}},
      {"tools/export/", {"tools/import/", "server/app/", "client/session/"}},
      {"transport/", {"crypto/"}},
      {"client/mirror/", {"proto/"}},
      {"client/connection/", {"client/mirror/", "transport/"}},
      {"client/cache/", {"client/connection/"}},
      {"client/session/", {"client/cache/"}},
      {"client/bot/", {"client/session/"}},
      {"client/library/", {"client/session/", "client/render/meshing/"}},
      {"client/admin/console/", {"shared/base/"}},
      {"client/admin/", {"client/admin/console/", "client/cache/"}},
      {"client/render/scene/", {"client/mirror/"}},
      {"client/render/gl/", {"client/render/scene/"}},
      {"client/render/levels/", {"client/render/scene/"}},
      {"client/render/bricks/", {"client/render/gl/", "client/render/levels/"}},
      {"client/render/meshing/", {"client/render/levels/"}},
      {"client/render/pieces/", {"client/render/bricks/", "client/render/meshing/"}},
      {"client/render/details/", {"client/render/gl/", "client/render/levels/"}},
      {"client/render/mesh/", {"client/render/pieces/"}},
      {"client/render/raymarch/", {"client/render/pieces/"}},
      {"client/render/grid/", {"client/render/pieces/"}},
      {"client/render/", {"client/mirror/"}},
      {"client/viewer/base/", {"client/render/"}},
      {"client/viewer/input/", {"client/viewer/base/"}},
      {"client/viewer/session/", {"client/viewer/input/", "client/viewer/figures/", "client/session/"}},
      {"client/viewer/pictures/", {"client/viewer/base/"}},
      {"client/viewer/signs/", {"client/viewer/base/"}},
      {"client/viewer/figures/", {"client/viewer/base/"}},
      {"client/viewer/events/", {"client/viewer/base/"}},
      {"client/viewer/synthesis/", {"client/viewer/events/"}},
      {"client/viewer/sound/", {"client/viewer/synthesis/"}},
      {"client/viewer/viewing/",
       {"client/viewer/session/", "client/viewer/pictures/", "client/viewer/signs/", "client/viewer/sound/",
        "content/model/"}},
      {"client/viewer/window/", {"client/viewer/viewing/"}},
      {"client/viewer/", {"client/viewer/window/"}},
      {"client/web/", {"client/viewer/viewing/", "client/library/"}},
      {"tools/film/process/", {"shared/base/"}},
      {"tools/rules/", {"tools/film/process/", "server/app/"}},
      {"tools/film/",
       {"tools/film/process/", "server/app/", "client/viewer/pictures/", "client/viewer/signs/",
        "client/viewer/figures/", "client/viewer/synthesis/"}},
      {"python/", {"server/replay/", "client/library/"}},
      {"tests/", {"python/", "bench/", "studies/", "tools/film/", "tools/place/", "tools/rules/", "cmake/"}},
  };
}

/// Rooms come before the folder that they lie in: the first match is a file's layer.
const std::vector<Layer>& layers() {
  static const std::vector<Layer> table = [] {
    std::vector<Layer> all = shared_layers();
    std::ranges::move(server_layers(), std::back_inserter(all));
    std::ranges::move(other_layers(), std::back_inserter(all));
    std::ranges::move(bench_layers(), std::back_inserter(all));
    return all;
  }();
  return table;
}

/// A library, the includes that it is known by, and where it may be included.
struct Library {
  std::string_view name;
  std::regex includes;
  std::vector<std::string_view> homes;
};

const std::vector<Library>& libraries() {
  static const std::vector<Library> table = {
      // bench/peers/: its own tools are what ours are measured beside.
      {"OpenVDB",
       std::regex("(openvdb|nanovdb)/.*"),
       {"server/field/", "tools/import/vdb/", "tools/export/vdb/", "bench/peers/", "tests/ground/"}},
      {"assimp", std::regex("assimp/.*"), {"tools/import/assimp/"}},
      {"Bullet",
       std::regex("(btBullet|Bullet|bullet/|LinearMath/).*"),
       {"server/bodies/", "bench/peers/", "tests/bodies/"}},
      {"voro++", std::regex("voro\\+\\+.*"), {"server/fracture/", "bench/peers/", "tests/"}},
      {"NATS", std::regex("nats/.*"), {"server/bus/"}},
      {"libcurl", std::regex("curl/.*"), {"server/agones/"}},
      {"SQLite", std::regex("sqlite3.*"), {"server/store/", "tests/store/"}},
      {"GLFW", std::regex("GLFW/.*"), {"client/viewer/window/", "client/viewer/input/", "client/web/"}},
      {"Dear ImGui", std::regex("imgui.*"), {"client/viewer/window/", "client/viewer/signs/"}},
      {"OpenAL", std::regex("AL/.*"), {"client/viewer/sound/"}},
      {"EGL", std::regex("(epoxy/egl|EGL/).*"), {"client/render/", "client/viewer/"}},
      {"OpenGL",
       std::regex("(epoxy/gl|GL/|GLES).*"),
       {"client/render/", "client/viewer/", "client/web/", "bench/peers/"}},
      {"Asio",
       std::regex("(boost/)?asio.*"),
       {"transport/", "server/doors/", "server/net/", "client/connection/", "tests/", "bench/", "studies/"}},
      {"Boost.Beast", std::regex("boost/beast.*"), {"server/web/"}},
      {"Wslay", std::regex("wslay/.*"), {"transport/"}},
      {"utf8proc", std::regex("utf8proc\\.h"), {"server/net/"}},
      {"spdlog", std::regex("spdlog/.*"), {"server/log/", "client/bot/", "studies/scale/", "tests/"}},
      {"prometheus-cpp", std::regex("prometheus/.*"), {"server/metrics/"}},
      {"libsystemd", std::regex("systemd/.*"), {"server/app/", "server/log/"}},
      {"libedit", std::regex("histedit\\.h|editline/.*"), {"client/admin/console/"}},
      {"Lua", std::regex("(lua|lauxlib|lualib).*\\.h(pp)?"), {"server/rules/", "tests/rules/"}},
      {"pybind11", std::regex("pybind11/.*"), {"python/"}},
      {"RE2", std::regex("re2/.*"), {"server/rules/sandbox/"}},
      {"cmark-gfm", std::regex("cmark.*"), {"studies/report/"}},
      {"GDAL", std::regex("(gdal|ogr|cpl)_?.*\\.h"), {"tools/import/", "tools/export/gdal/"}},
      {"toml++", std::regex("toml(\\+\\+|plusplus)?/.*"), {"content/"}},
      {"libpng", std::regex("png\\.h"), {"content/files/", "client/viewer/pictures/"}},
      {"OpenSSL", std::regex("openssl/.*"), {"crypto/", "tests/"}},
      {"Protobuf", std::regex("google/protobuf/.*|.*\\.pb\\.h"), {"proto/", "server/formats/"}},
  };
  return table;
}

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](auto p) { return text.starts_with(p); });
}

/// Null for a file of no layer: also one in a folder that has rooms, but in none of them.
const Layer* layer_of(std::string_view path) {
  const std::vector<Layer>& all = layers();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Layer& layer) { return path.starts_with(layer.folder); });
  if (found == all.end()) return nullptr;
  const bool has_rooms = std::any_of(
      all.begin(), found, [&](const Layer& room) { return room.folder.starts_with(found->folder); });
  const std::string_view rest = path.substr(found->folder.size());
  const bool in_a_room = rest.find('/') != std::string_view::npos && !rest.starts_with("programs/");
  return has_rooms && in_a_room ? nullptr : &*found;
}

const Library* library_of(const std::string& include) {
  for (const Library& library : libraries())
    if (std::regex_match(include, library.includes)) return &library;
  return nullptr;
}

bool is_at_home(const Library& library, std::string_view path) {
  return starts_with_any(path, library.homes);
}

bool is_header(std::string_view path) {
  return path.ends_with(".h");
}

/// Whether a file of `layer` may include `target`: down the table, through any number of layers.
bool may_include(const Layer& layer, std::string_view target) {
  if (target.starts_with(layer.folder)) return true;
  for (const Layer& other : layers())
    if (starts_with_any(other.folder, layer.beneath) && other.folder != layer.folder &&
        may_include(other, target))
      return true;
  return false;
}

std::optional<std::string> layering_breach(const SourceFile& file, const Layer& layer,
                                           const std::string& target) {
  if (layer_of(target) == nullptr)
    return file.path + ": \"" + target +
           "\" is no path from the root; project includes are, libraries take <>";
  if (may_include(layer, target)) return std::nullopt;
  return file.path + ": must not include \"" + target + "\": " + std::string(layer.folder) +
         " does not lie above it (docs/architecture.md, Layers)";
}

}  // namespace

std::vector<Include> includes_of(const SourceFile& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  std::vector<Include> found;
  std::istringstream lines(file.text);
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (line.find("include") != std::string::npos && std::regex_search(line, match, pattern))
      found.push_back({match[2].str(), match[1].str() == "<"});
  return found;
}

Complaints check_file_length(const SourceFile& file) {
  const auto lines = static_cast<size_t>(std::count(file.text.begin(), file.text.end(), '\n'));
  if (lines <= file_lines_max) return {};
  return {file.path + ": " + std::to_string(lines) + " lines, over the " + std::to_string(file_lines_max) +
          " of a file; split it by concept"};
}

Complaints check_pragma_once(const SourceFile& file) {
  static const std::regex pattern(R"((^|\n)#pragma once\n)");
  if (!is_header(file.path) || std::regex_search(file.text, pattern)) return {};
  return {file.path + ": has no #pragma once"};
}

Complaints check_layering(const SourceFile& file) {
  const Layer* layer = layer_of(file.path);
  if (layer == nullptr)
    return {file.path + ": its folder is in no layer; give it one in tests/style/style_rules.cpp"};
  Complaints complaints;
  for (const Include& include : includes_of(file)) {
    if (include.angled) continue;
    if (auto breach = layering_breach(file, *layer, include.target)) complaints.push_back(*breach);
  }
  return complaints;
}

Complaints check_library_homes(const SourceFile& file) {
  static const std::regex known_to_shared(R"([a-z_0-9]+|emmintrin\.h|glm/.*|tl/expected\.hpp|xxhash\.h)");
  Complaints complaints;
  for (const Include& include : includes_of(file)) {
    const Library* library = library_of(include.target);
    if (library != nullptr && !is_at_home(*library, file.path))
      complaints.push_back(file.path + ": includes <" + include.target + ">, but " +
                           std::string(library->name) + " belongs to " + std::string(library->homes.front()));
    if (include.angled && file.path.starts_with("shared/") &&
        !std::regex_match(include.target, known_to_shared))
      complaints.push_back(file.path + ": includes <" + include.target +
                           ">, but shared/ knows only GLM, xxHash, tl::expected and the compiler's SSE2");
  }
  return complaints;
}

Complaints check_library_leaks(const std::vector<SourceFile>& files) {
  std::map<std::string, const Library*> leaky;  // header → library that it shows
  for (const SourceFile& file : files)
    for (const Include& include : includes_of(file))
      if (const Library* library = library_of(include.target); library != nullptr && is_header(file.path))
        leaky[file.path] = library;
  Complaints complaints;
  for (const SourceFile& file : files)
    for (const Include& include : includes_of(file))
      if (auto it = leaky.find(include.target); it != leaky.end() && !is_at_home(*it->second, file.path))
        complaints.push_back(file.path + ": includes \"" + it->first + "\", which shows " +
                             std::string(it->second->name) +
                             " to others; hide it behind a pointer to its implementation");
  return complaints;
}

Complaints check_class_names(const std::vector<SourceFile>& files) {
  static const std::regex definition(R"((?:^|\n)(?:class|struct|enum class) (\w+)(?:\s[^;\n]*)?\{)");
  std::map<std::string, std::string> defined_in;
  Complaints complaints;
  for (const SourceFile& file : files) {
    if (!is_header(file.path)) continue;
    for (std::sregex_iterator it(file.text.begin(), file.text.end(), definition), end; it != end; ++it) {
      const auto [first, fresh] = defined_in.emplace((*it)[1].str(), file.path);
      if (!fresh)
        complaints.push_back(file.path + ": defines " + first->first + ", as " + first->second +
                             " does; name both for what they are");
    }
  }
  return complaints;
}

Complaints check_kernel_arithmetic(const SourceFile& file) {
  static const std::regex inexact(
      R"(\b(std|glm)::(a?(sin|cos|tan)h?f?|atan2f?|exp[2m1]*f?|log[210p]*f?|powf?|cbrtf?|hypotf?|fmaf?|slerp|angleAxis|rotate)\s*\()");
  if (!starts_with_any(file.path, {"shared/", "client/viewer/synthesis/"})) return {};
  const std::string code = without_comments_and_literals(file.text);
  Complaints complaints;
  for (std::sregex_iterator it(code.begin(), code.end(), inexact), end; it != end; ++it)
    complaints.push_back(file.path + ": calls " + it->str() +
                         "…), whose last bits differ between math libraries; kernels use + - * / and sqrt");
  return complaints;
}

}  // namespace scree::style
