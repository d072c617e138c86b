#include "shared/fracture/material_shares.h"

#include <algorithm>
#include <array>
#include <span>

#include "shared/base/check.h"
#include "shared/field/eight_bytes.h"

namespace scree {

namespace {

/// A table of masses, a row for each piece and one for the dust, a column for each material. Sums of rows and
/// columns are given; what is missing in a row is filled up, and then moved within rows until the columns
/// agree as well.
class ShareTable {
 public:
  ShareTable(const Cut& cut, const MaterialMasses& lost) : lost_(lost), left_(lost.size()) {
    CHECK(!lost.empty());
    sums_.reserve(cut.pieces.size() + 1);
    for (const CutPiece& piece : cut.pieces) sums_.push_back(piece.volume.mass);
    sums_.push_back(cut.dust);
    shares_.resize(sums_.size() * lost.size());
  }

  /// A piece's first share: in proportion to the mass of its voxels, a number for each material.
  void propose(size_t row, std::span<const MassUnits> weights) {
    MassUnits sum = 0;
    for (const MassUnits weight : weights) sum += weight;
    if (sum == 0) return;
    // Products stay below 2^60: a window has at most 128³ voxels of 254 units.
    for (size_t m = 0; m < lost_.size(); ++m) share(row, m) = sums_[row] * weights[m] / sum;
  }

  void balance() {
    for (size_t m = 0; m < lost_.size(); ++m) {
      left_[m] = lost_[m].mass;
      for (size_t row = 0; row < sums_.size(); ++row) left_[m] -= share(row, m);
    }
    for (size_t row = 0; row < sums_.size(); ++row) fill_up(row);
    for (const bool among_own : {true, false})
      for (size_t row = 0; row < sums_.size(); ++row) move_within(row, among_own);
    CHECK(std::ranges::all_of(left_, [](MassUnits left) { return left == 0; }));
  }

  MaterialMasses row(size_t row) const {
    MaterialMasses masses;
    for (size_t m = 0; m < lost_.size(); ++m)
      if (const MassUnits mass = shares_[row * lost_.size() + m]; mass != 0)
        masses.push_back({lost_[m].material, mass});
    return masses;
  }

 private:
  MassUnits& share(size_t row, size_t m) { return shares_[row * lost_.size() + m]; }

  /// Gives a row what is missing in its sum: of its own materials first, of any in the end.
  void fill_up(size_t row) {
    MassUnits missing = sums_[row];
    for (size_t m = 0; m < lost_.size(); ++m) missing -= share(row, m);
    for (const bool among_own : {true, false})
      for (size_t m = 0; m < lost_.size() && missing > 0; ++m) {
        if (left_[m] <= 0 || (among_own && share(row, m) == 0)) continue;
        const MassUnits given = std::min(missing, left_[m]);
        share(row, m) += given;
        left_[m] -= given;
        missing -= given;
      }
    CHECK_EQ(missing, 0);  // as much is left as all rows miss together
  }

  /// Turns mass of materials of which too much was given into those of which some is left.
  void move_within(size_t row, bool among_own) {
    for (size_t from = 0; from < lost_.size(); ++from)
      for (size_t to = 0; to < lost_.size(); ++to) {
        if (left_[from] >= 0 || left_[to] <= 0 || (among_own && share(row, to) == 0)) continue;
        const MassUnits moved = std::min({-left_[from], left_[to], share(row, from)});
        share(row, from) -= moved;
        share(row, to) += moved;
        left_[from] += moved;
        left_[to] -= moved;
      }
  }

  const MaterialMasses& lost_;
  std::vector<MassUnits> sums_;    ///< by row
  std::vector<MassUnits> shares_;  ///< by row, and then by material
  std::vector<MassUnits> left_;    ///< by material; negative where too much is given
};

/// The masses of each piece by material, a row for each: of the voxels nearest to it, where the cutter told,
/// else of its codes.
std::vector<MassUnits> weights_of(const Cut& cut, const MaterialWindow& materials,
                                  const MaterialMasses& lost) {
  const size_t columns = lost.size();
  std::vector<MassUnits> weights(cut.pieces.size() * columns);
  if (cut.lost.empty() || materials.is_uniform()) {
    for (size_t i = 0; i < cut.pieces.size(); ++i) {
      const Window& window = cut.pieces[i].volume.window;
      const MaterialMasses masses = masses_of(window, part_of(materials, window.box));
      for (size_t m = 0; m < columns; ++m) weights[i * columns + m] = mass_of(masses, lost[m].material);
    }
    return weights;
  }
  CHECK_EQ(cut.lost.size(), materials.each.size());
  std::array<size_t, 256> column{};  // all that a voxel can have lost is among `lost`
  for (size_t m = 0; m < columns; ++m) column[row_number(lost[m].material)] = m;
  for_each_nonzero(cut.lost, [&](size_t i) {
    const size_t piece = cut.piece_of_cell[cut.cell_of_voxel[i]];
    weights[piece * columns + column[row_number(materials.each[i])]] += cut.lost[i];
  });
  return weights;
}

}  // namespace

MaterialMasses masses_lost(const std::vector<uint8_t>& lost, const MaterialWindow& materials) {
  std::array<MassUnits, 256> sums{};
  MassUnits& all = sums[row_number(materials.all)];
  if (materials.is_uniform()) {
    for (const uint8_t units : lost) all += units;
    return listed(sums);
  }
  CHECK_EQ(lost.size(), materials.each.size());
  for_each_nonzero(lost, [&](size_t i) { sums[row_number(materials.each[i])] += lost[i]; });
  return listed(sums);
}

MaterialMasses share_materials(Cut& cut, const MaterialWindow& materials, const MaterialMasses& lost) {
  if (lost.empty()) return {};
  if (lost.size() == 1) {
    for (CutPiece& piece : cut.pieces) piece.volume.materials.all = lost.front().material;
    if (cut.dust == 0) return {};
    return {{lost.front().material, cut.dust}};
  }
  ShareTable table(cut, lost);
  const std::vector<MassUnits> weights = weights_of(cut, materials, lost);
  for (size_t i = 0; i < cut.pieces.size(); ++i)
    table.propose(i, std::span(weights).subspan(i * lost.size(), lost.size()));
  table.balance();
  for (size_t i = 0; i < cut.pieces.size(); ++i) {
    Volume& volume = cut.pieces[i].volume;
    volume.masses = table.row(i);
    if (volume.masses.size() == 1) {
      volume.materials.all = volume.masses.front().material;
      volume.masses.clear();
    } else {
      volume.materials = part_of(materials, volume.window.box);
    }
  }
  return table.row(cut.pieces.size());
}

}  // namespace scree
