#include "tools/import/gdal/height_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

#include "tools/import/gdal/gdal_library.h"

namespace scree {

namespace {

struct Length {
  std::string_view name;
  double metres;
  std::string_view spellings;  ///< each between spaces
};

constexpr double foot_m = 0.3048;
constexpr double survey_foot_m = 1200.0 / 3937.0;

constexpr std::array lengths{
    Length{"metres", 1.0, " m metre metres meter meters metre(s) meter(s) mètre mètres gpm "},
    Length{"feet", foot_m, " ft foot feet ' international_foot international_feet ift ft_intl "},
    Length{"US survey feet", survey_foot_m,
           " us-ft us_ft ftus ft_us ft-us usft sft us_survey_foot us_survey_feet us_foot us_feet survey_foot "
           "survey_feet foot_us u.s._survey_foot "},
    Length{"centimetres", 0.01, " cm centimetre centimetres centimeter centimeters "},
    Length{"decimetres", 0.1, " dm decimetre decimetres decimeter decimeters "},
    Length{"millimetres", 0.001, " mm millimetre millimetres millimeter millimeters "},
    Length{"kilometres", 1000.0, " km kilometre kilometres kilometer kilometers "},
    Length{"fathoms", 1.8288, " fathom fathoms fath ftm "},
    Length{"yards", 0.9144, " yd yard yards "},
    Length{"inches", 0.0254, " in inch inches "},
};

/// In small letters, without brackets around it, words joined by '_'.
std::string normalised(std::string_view unit) {
  std::string text;
  for (const char c : unit) {
    if (c == '[' || c == ']') continue;
    const bool gap = std::isspace(static_cast<unsigned char>(c)) != 0;
    text += gap ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  while (text.starts_with('_')) text.erase(0, 1);
  while (text.ends_with('_') || (text.ends_with('.') && text.size() > 1)) text.pop_back();
  return text;
}

/// The unit of that name. "m above sea level" is metres.
const Length* find_length(std::string_view unit) {
  const std::string name = normalised(unit);
  const auto named = [](const std::string& spelling) {
    const auto found = std::ranges::find_if(lengths, [&](const Length& length) {
      return length.spellings.find(" " + spelling + " ") != std::string_view::npos;
    });
    return found == lengths.end() ? nullptr : &*found;
  };
  if (const Length* length = named(name)) return length;
  const size_t end = name.find_first_of("_,;(");
  if (end == std::string::npos) return nullptr;
  const std::string rest = name.substr(end + 1);
  const bool about_zero = name[end] == '(' || rest.starts_with("above") || rest.starts_with("asl") ||
                          rest.starts_with("a.s.l") || rest.starts_with("msl") || rest.starts_with("(");
  return about_zero ? named(name.substr(0, end)) : nullptr;
}

/// Words in the place of a unit.
bool says_nothing(std::string_view unit) {
  const std::string name = normalised(unit);
  return name == "-" || name == "unknown" || name == "undefined" || name == "none" || name == "n/a";
}

std::string known_lengths() {
  std::string names;
  for (const Length& length : lengths) names += fmt::format("{}{}", names.empty() ? "" : ", ", length.name);
  return names;
}

/// The vertical axis of a compound or three-dimensional coordinate system.
struct VerticalAxis {
  double metres = 1.0;
  bool down = false;
};

std::optional<VerticalAxis> vertical_axis(const OGRSpatialReference* crs) {
  if (crs == nullptr || crs->GetAxesCount() < 3) return std::nullopt;
  OGRAxisOrientation towards = OAO_Other;
  double metres = 0.0;
  if (crs->GetAxis(nullptr, 2, &towards, &metres) == nullptr) return std::nullopt;
  if (!(metres > 0.0) || !std::isfinite(metres)) return std::nullopt;
  return VerticalAxis{metres, towards == OAO_Down};
}

std::string name_of(double metres) {
  const auto found = std::ranges::find_if(
      lengths, [&](const Length& length) { return std::abs(length.metres / metres - 1.0) < 1.0e-9; });
  return found != lengths.end() ? std::string(found->name) : fmt::format("units of {:.9g} m", metres);
}

/// CF conventions: netCDF says so of depths.
bool counts_down(GDALRasterBand& band) {
  const char* const positive = band.GetMetadataItem("positive");
  return positive != nullptr && EQUAL(positive, "down");
}

std::string assumed(const OGRSpatialReference* crs) {
  std::string words = "in metres, which is assumed: the file says no vertical unit";
  if (crs == nullptr || crs->IsProjected() == 0) return words;
  const double metres = crs->GetLinearUnits();
  if (metres > 0.0 && std::abs(metres - 1.0) > 1.0e-6)
    words += fmt::format(", but its map is in {} (--vertical-unit)", name_of(metres));
  return words;
}

}  // namespace

Result<HeightUnit> height_unit_of(GDALRasterBand& band, const OGRSpatialReference* crs,
                                  const std::string& chosen) {
  std::string own = chosen.empty() ? shown(band.GetUnitType()) : chosen;
  if (chosen.empty() && says_nothing(own)) own.clear();
  const std::optional<VerticalAxis> axis = vertical_axis(crs);
  const bool down = counts_down(band) || (axis && axis->down);
  HeightUnit unit;
  if (!own.empty()) {
    const Length* const length = find_length(own);
    if (length == nullptr)
      return fail(
          fmt::format("its values are in '{}', which is no length that import knows; --vertical-unit "
                      "says another one: {}",
                      own, known_lengths()));
    unit = {length->metres, fmt::format("in {}", length->name)};
    if (!chosen.empty()) unit.words += " as --vertical-unit says";
  } else if (axis) {
    unit = {axis->metres, fmt::format("in {} by its coordinate system", name_of(axis->metres))};
  } else {
    unit.words = assumed(crs);
  }
  if (!down) return unit;
  unit.metres = -unit.metres;
  unit.words += ", counted downwards and turned to heights";
  return unit;
}

}  // namespace scree
