#include "shared/field/material_changes.h"

#include "shared/base/check.h"

namespace scree {

MaterialChanges::BrickChange::BrickChange(const MaterialReader::BrickOf& of) : of_(of), one_(of.uniform()) {}

void MaterialChanges::BrickChange::set(size_t index, Material material) {
  if (!differs_) of_.said->unpack(says_);
  differs_ = true;
  const bool own = said(material) == of_.ground->at(static_cast<int>(index));
  says_[index] = own ? ground_own : said(material);
}

MaterialChanges::MaterialChanges(const MaterialReader& were) : were_(were), by_place_(were.bricks()) {}

MaterialChanges::BrickChange& MaterialChanges::brick(BrickCoord coord) {
  const size_t place = were_.place_of(coord);
  if (by_place_[place] == nullptr) by_place_[place] = std::make_unique<BrickChange>(were_.brick_at(place));
  return *by_place_[place];
}

std::vector<BrickSays> MaterialChanges::says() const {
  std::vector<BrickSays> says;
  size_t place = 0;
  for_each_brick(were_.box(), [&](BrickCoord coord) {
    CHECK_DEBUG(were_.place_of(coord) == place);
    const auto& change = by_place_[place++];
    if (change != nullptr && change->differs()) says.push_back({coord, change->says()});
  });
  return says;
}

}  // namespace scree
