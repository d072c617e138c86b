#include "shared/falling/support_search.h"

#include <algorithm>
#include <map>
#include <set>

#include "shared/falling/leverage.h"
#include "shared/falling/load_flow.h"
#include "shared/falling/support_network.h"
#include "shared/falling/support_parts.h"

namespace scree {

namespace {

class Search {
 public:
  Search(Field& field, const Palette& palette, std::span<const BrickCoord> changed, int reach_bricks,
         const Holding* holding)
      : field_(field),
        palette_(palette),
        parts_(field, palette, changed, reach_bricks, support_parts_max, holding),
        network_(parts_, palette, field.source().voxel_size_m, LoadKind::weight),
        changed_(changed.begin(), changed.end()) {}

  SupportFound run() {
    SupportFound found;
    found.parts = parts_.parts().size();
    found.given_up = parts_.overflow() || !flow();
    if (found.given_up) return found;
    for (auto& [mass, overload] : gather())
      if (overload.voxels >= overload_voxels_min && !overload.necks.empty())
        found.overloads.push_back(std::move(overload));
    if (found.overloads.empty()) found.overloads = find_levers(parts_, field_, palette_, changed_);
    return found;
  }

 private:
  bool flow() {
    LoadFlow flow;
    network_.add_to(flow, {}, true);
    if (!flow.run(flow_steps_per_part * std::max<size_t>(parts_.parts().size(), 1))) return false;
    for (uint32_t i = 0; i < parts_.parts().size(); ++i) overloaded_.push_back(flow.overloaded(i));
    return true;
  }

  /// Masses that the change touched, or whose neck it touched.
  std::map<uint32_t, Overload> gather() const {
    const std::vector<uint32_t> mass = network_.mass_of_parts(overloaded_);
    std::set<uint32_t> touched;
    const auto is_changed = [&](uint32_t part) { return changed_.contains(parts_.parts()[part].brick); };
    for (uint32_t i = 0; i < mass.size(); ++i)
      if (overloaded_[i] && is_changed(i)) touched.insert(mass[i]);
    for (const SupportLink& link : parts_.links()) {
      if (overloaded_[link.lower] == overloaded_[link.upper]) continue;
      const uint32_t beyond = overloaded_[link.lower] ? link.lower : link.upper;
      const uint32_t before = beyond == link.lower ? link.upper : link.lower;
      if (is_changed(before)) touched.insert(mass[beyond]);
    }
    std::map<uint32_t, Overload> masses = network_.masses(overloaded_);
    std::erase_if(masses, [&](const auto& entry) { return !touched.contains(entry.first); });
    return masses;
  }

  Field& field_;
  const Palette& palette_;
  SupportParts parts_;
  SupportNetwork network_;
  std::set<BrickCoord> changed_;
  std::vector<bool> overloaded_;  ///< by part
};

}  // namespace

SupportFound find_overloads(Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                            int reach_bricks, const Holding* holding) {
  return Search(field, palette, changed, reach_bricks, holding).run();
}

}  // namespace scree
