#include "tools/import/gdal/height_band.h"

#include <algorithm>
#include <cpl_string.h>
#include <fmt/format.h>
#include <vector>

#include "tools/import/gdal/gdal_library.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

bool is_colour(GDALColorInterp meaning) {
  return meaning >= GCI_RedBand && meaning <= GCI_YCbCr_CrBand && meaning != GCI_AlphaBand;
}

std::vector<int> bands_without_alpha(GDALDataset& dataset) {
  std::vector<int> bands;
  for (int i = 1; i <= dataset.GetRasterCount(); ++i)
    if (dataset.GetRasterBand(i)->GetColorInterpretation() != GCI_AlphaBand) bands.push_back(i);
  return bands;
}

/// "band 2, 'depth'"
std::string name_of(GDALDataset& dataset, int i) {
  const std::string description = shown(dataset.GetRasterBand(i)->GetDescription());
  return fmt::format("band {}{}", i, description.empty() ? "" : fmt::format(", '{}'", description));
}

/// Why the band is no heights, as the end of "its first band holds"; empty when it can be.
std::string other_than_heights(GDALDataset& dataset, const std::vector<int>& bands) {
  GDALRasterBand& band = *dataset.GetRasterBand(bands.front());
  const GDALColorInterp meaning = band.GetColorInterpretation();
  if (meaning == GCI_PaletteIndex || band.GetColorTable() != nullptr)
    return "indices of a palette of colours, no heights: gdal_translate -expand gray makes shades of it";
  if (band.GetCategoryNames() != nullptr && CSLCount(band.GetCategoryNames()) > 0)
    return fmt::format("numbers of {} classes such as '{}', no heights", CSLCount(band.GetCategoryNames()),
                       shown(band.GetCategoryNames()[0]));
  if (is_colour(meaning))
    return fmt::format("the colour '{}' of a picture, no heights", GDALGetColorInterpretationName(meaning));
  const bool bytes = std::ranges::all_of(
      bands, [&](int i) { return dataset.GetRasterBand(i)->GetRasterDataType() == GDT_Byte; });
  if (bytes && bands.size() >= 3)
    return fmt::format("the first of {} bands of 8 bits: a picture, no heights", bands.size());
  return {};
}

std::string others(GDALDataset& dataset, const std::vector<int>& bands) {
  std::string names;
  for (size_t i = 1; i < std::min(bands.size(), limits::raster_names_max); ++i)
    names += fmt::format("{}{}", i > 1 ? "; " : "", name_of(dataset, bands[i]));
  if (bands.size() > limits::raster_names_max)
    names += fmt::format(" and {} more", bands.size() - limits::raster_names_max);
  return names;
}

}  // namespace

Result<HeightBandChoice> choose_height_band(GDALDataset& dataset, std::optional<int> chosen) {
  const int count = dataset.GetRasterCount();
  if (count < 1) return fail("it has no band of heights");
  if (chosen && (*chosen < 1 || *chosen > count))
    return fail(fmt::format("it has no band {} (--band): its bands are 1 to {}", *chosen, count));
  std::vector<int> bands = bands_without_alpha(dataset);
  if (bands.empty()) bands = {1};
  const int number = chosen.value_or(bands.front());
  GDALRasterBand* const band = dataset.GetRasterBand(number);
  if (GDALDataTypeIsComplex(band->GetRasterDataType()) != 0)
    return fail("its numbers are complex, not heights");
  HeightBandChoice choice{band, count == 1 ? "its one band" : name_of(dataset, number)};
  if (chosen) {
    choice.words += ", as --band says";
    return choice;
  }
  if (const std::string other = other_than_heights(dataset, bands); !other.empty())
    return fail(fmt::format("{} holds {}. --band {} takes its numbers as heights all the same", choice.words,
                            other, number));
  if (bands.size() > 1)
    choice.words += fmt::format(" (it also has {}: --band chooses)", others(dataset, bands));
  return choice;
}

}  // namespace scree
