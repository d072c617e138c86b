#include <algorithm>
#include <array>
#include <regex>

#include "tests/style/style_rules.h"

namespace scree::style {
namespace {

/// The tables of methods that a setting or an operation chooses.
constexpr std::array tables{"shared/fracture/cutter.h",        "shared/fracture/seed_pattern.h",
                            "shared/recombine/stamp_method.h", "server/colliders/terrain_collider_kind.h",
                            "server/fracture/simplify.h",      "server/world/methods.h"};

/// What is measured and tested is one method or another.
constexpr std::array free_folders{"bench/", "studies/", "tests/"};

}  // namespace

Complaints check_methods_are_asked(const SourceFile& file) {
  static const std::regex kind(
      R"((case|==|!=)\s*(Cutter|SeedPattern|StampMethod|TerrainColliderKind|Simplifier|Recombination)::\w+)");
  static const std::regex name(R"re([=!]=\s*"(mesh|dual|cubes|raymarch|grid)")re");
  const bool is_free =
      std::ranges::find(tables, file.path) != tables.end() ||
      std::ranges::any_of(free_folders, [&](const char* folder) { return file.path.starts_with(folder); });
  if (is_free) return {};
  Complaints complaints;
  for (const std::regex& pattern : {kind, name})
    for (std::sregex_iterator it(file.text.begin(), file.text.end(), pattern), end; it != end; ++it)
      complaints.push_back(file.path + ": asks which method it is (" + it->str() +
                           "); let the method's row say what differs");
  return complaints;
}

}  // namespace scree::style
