#include "studies/matrix/combination.h"

#include <fmt/format.h>

namespace scree {

std::string text_of(const Simulated& simulated) {
  return fmt::format("{} {} {} {} {}", name_of(simulated.cutter), name_of(simulated.simplifier),
                     name_of(simulated.collider), name_of(simulated.recombine), name_of(simulated.pattern));
}

std::vector<Simulated> all_simulated() {
  std::vector<Simulated> all;
  for (const Cutter cutter : all_kinds<Cutter>)
    for (const Simplifier simplifier : all_kinds<Simplifier>)
      for (const TerrainColliderKind collider : all_kinds<TerrainColliderKind>)
        for (const Recombination recombine : all_kinds<Recombination>)
          for (const SeedPattern pattern : compared_patterns)
            all.push_back({cutter, simplifier, collider, recombine, pattern});
  return all;
}

WorldConfig config_of(const Simulated& simulated, const TerrainSource& terrain) {
  WorldConfig config;
  config.terrain = terrain;
  config.methods.cutter = simulated.cutter;
  config.methods.simplifier = simulated.simplifier;
  config.methods.collider = simulated.collider;
  config.methods.recombine = simulated.recombine;
  return config;
}

std::string text_of(const Combination& combination) {
  return combination.drawing + " " + text_of(combination.simulated);
}

Simulated papers_program() {
  return {Cutter::slice, Simplifier::hull, TerrainColliderKind::mesh, Recombination::sphere,
          SeedPattern::radial};
}

}  // namespace scree
