#include "tools/import/option_fit.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

#include "tools/import/file_forms.h"

namespace scree {

namespace {

enum Form : unsigned { heights = 1, meshes = 2, volumes = 4, voxels = 8 };
constexpr unsigned solids = meshes | volumes | voxels;

struct OptionFit {
  std::string_view option;
  unsigned forms;
};
constexpr std::array<OptionFit, 25> fits{{{"--band", heights},
                                          {"--layer", heights},
                                          {"--crs", heights},
                                          {"--vertical-unit", heights},
                                          {"--nodata", heights},
                                          {"--cell", heights},
                                          {"--sample", heights},
                                          {"--vertical-scale", heights},
                                          {"--zero", heights},
                                          {"--fill", heights},
                                          {"--preview", heights},
                                          {"--cover", heights},
                                          {"--cover-map", heights},
                                          {"--cover-depth", heights},
                                          {"--on", solids},
                                          {"--level", solids},
                                          {"--at", solids},
                                          {"--scale", solids},
                                          {"--z-up", meshes | volumes},
                                          {"--grid", volumes},
                                          {"--density", volumes},
                                          {"--sheet", meshes},
                                          {"--material", solids},
                                          {"--material-map", solids},
                                          {"--palette", meshes | voxels}}};

unsigned form_of(const std::string& file) {
  if (is_mesh_file(file)) return meshes;
  if (is_volume_file(file)) return volumes;
  return is_voxels_file(file) ? voxels : heights;
}

std::string words_on(unsigned forms) {
  constexpr std::array<std::pair<unsigned, std::string_view>, 4> names{{{heights, "elevation models"},
                                                                        {meshes, "meshes"},
                                                                        {volumes, "OpenVDB files"},
                                                                        {voxels, "MagicaVoxel files"}}};
  if (forms == solids) return "solids";
  std::string words;
  for (const auto& [form, name] : names)
    if ((forms & form) != 0) words += (words.empty() ? "" : " and ") + std::string(name);
  return words;
}

}  // namespace

Result<void> check_options_fit(const std::vector<std::string>& given, const std::vector<std::string>& files) {
  unsigned forms = 0;
  for (const std::string& file : files) forms |= form_of(file);
  for (const OptionFit& fit : fits)
    if ((fit.forms & forms) == 0 && std::ranges::count(given, fit.option) > 0)
      return fail(fmt::format("{} is only for {}, and {} is none of them", fit.option, words_on(fit.forms),
                              files.front()));
  return {};
}

}  // namespace scree
