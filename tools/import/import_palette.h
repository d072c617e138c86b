// The materials of an import: the rows of a palette that was chosen, and after them those that files bring.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "shared/field/brick_materials.h"
#include "shared/material/palette.h"

namespace scree {

/// Names in files, or numbers of their colours, and what they stand for: as --material-map says.
using MaterialMap = std::map<std::string, Material>;

/// A line of --material-map or --cover-map.
struct MapLine {
  std::string name;
  Material material{};
  int number = 0;  ///< from 1
};

/// Reads lines "NAME-or-NUMBER = material"; either side may stand in quotes, and # begins a comment. The
/// error names the file and the line.
Result<std::vector<MapLine>> read_map_lines(const std::string& path, const Palette& palette);
MaterialMap map_of(const std::vector<MapLine>& lines);

/// Sentences on the lines of the map `path` whose names are not `used`: the first few, and how many more.
std::vector<std::string> words_on_unused(const std::string& path, const std::vector<MapLine>& lines,
                                         const std::set<std::string>& used);

class ImportPalette {
 public:
  /// `chosen` is valid and not null.
  explicit ImportPalette(std::shared_ptr<const Palette> chosen) : palette_(*chosen), chosen_(chosen) {}

  const Palette& palette() const { return palette_; }
  size_t added() const { return palette_.rows.size() - chosen_->rows.size(); }
  /// The row of the chosen palette that a name of a file differs from in the case of letters alone, or by
  /// signs that no row's name has.
  std::optional<std::string> meant(const std::string& name) const;
  /// Adds a row under a name like that of the row: of letters, digits and _, and not taken. The error says
  /// that a palette has no more.
  Result<Material> add(MaterialRow row);
  /// The row of that name; else the row is added as above.
  Result<Material> add_if_new(const MaterialRow& row);
  /// What was chosen, if nothing was added.
  std::shared_ptr<const Palette> result() const;

 private:
  Palette palette_;
  std::shared_ptr<const Palette> chosen_;
};

/// A row of stone-like numbers that looks so.
MaterialRow row_of_colour(std::string name, const std::array<float, 3>& linear);

/// A part of a colour, 0 to 1 and 0 to 255, by IEC 61966-2-1. Back and forth it is the same byte.
float linear_of_srgb(uint8_t part);
uint8_t srgb_of_linear(float part);

}  // namespace scree
