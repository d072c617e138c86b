#include "server/provenance/origin_shares.h"

#include <algorithm>
#include <numeric>

#include "shared/base/check.h"

namespace scree {

MassUnits sum_of(const OriginShares& shares) {
  return std::accumulate(shares.begin(), shares.end(), MassUnits{0},
                         [](MassUnits sum, const OriginShare& share) { return sum + share.mass; });
}

void add(OriginShares& to, const MassOrigin& origin, MassUnits mass) {
  CHECK(mass >= 0);
  if (mass == 0) return;
  const auto place = std::ranges::lower_bound(to, origin, {}, &OriginShare::origin);
  if (place != to.end() && place->origin == origin)
    place->mass += mass;
  else
    to.insert(place, {origin, mass});
}

void add(OriginShares& to, const OriginShares& more) {
  for (const OriginShare& share : more) add(to, share.origin, share.mass);
}

OriginShares take_part(OriginShares& from, MassUnits part, MassUnits whole) {
  const MassUnits known = sum_of(from);
  whole = std::max(whole, known);
  CHECK(part >= 0 && part <= whole);
  if (part == 0 || known == 0) return {};
  OriginShares taken = from;
  MassUnits left = part;
  for (OriginShare& share : taken) {
    // Masses stay below 2^63, and so their product below 2^126.
    const auto product = static_cast<unsigned __int128>(share.mass) * static_cast<uint64_t>(part);
    share.mass = static_cast<MassUnits>(product / static_cast<uint64_t>(whole));
    left -= share.mass;
  }
  // What rounding leaves is of no origin, as far as there is such mass.
  MassUnits missing = left - (whole - known);
  for (size_t i = 0; i < taken.size() && missing > 0; ++i) {
    if (taken[i].mass == from[i].mass) continue;
    ++taken[i].mass;
    --missing;
  }
  CHECK(missing <= 0);
  for (size_t i = 0; i < taken.size(); ++i) from[i].mass -= taken[i].mass;
  const auto is_nothing = [](const OriginShare& share) { return share.mass == 0; };
  std::erase_if(from, is_nothing);
  std::erase_if(taken, is_nothing);
  return taken;
}

OriginShares MixedMass::draw(MassUnits mass) {
  CHECK(mass >= 0 && mass <= total);
  OriginShares drawn = take_part(shares, mass, total);
  total -= mass;
  return drawn;
}

}  // namespace scree
