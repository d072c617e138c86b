#include "tools/import/gdal/picture.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include "tools/import/gdal/dataset.h"
#include "tools/import/gdal/gdal_library.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

constexpr const char* name_in_memory = "/vsimem/texture";

class FileInMemory {
 public:
  explicit FileInMemory(std::span<const uint8_t> file) : bytes_(file.begin(), file.end()) {
    VSIFCloseL(VSIFileFromMemBuffer(name_in_memory, bytes_.data(), bytes_.size(), 0));
  }
  ~FileInMemory() { VSIUnlink(name_in_memory); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;

 private:
  std::vector<uint8_t> bytes_;
};

/// A picture of one band is grey, or has a table of colours.
void colour(GDALRasterBand& band, Picture& picture) {
  const GDALColorTable* const table = band.GetColorTable();
  for (std::array<uint8_t, 3>& pixel : picture.pixels) {
    const uint8_t value = pixel[0];
    const GDALColorEntry* const entry =
        table != nullptr && value < table->GetColorEntryCount() ? table->GetColorEntry(value) : nullptr;
    pixel = entry == nullptr ? std::array{value, value, value}
                             : std::array{static_cast<uint8_t>(entry->c1), static_cast<uint8_t>(entry->c2),
                                          static_cast<uint8_t>(entry->c3)};
  }
}

}  // namespace

Result<Picture> read_picture(std::span<const uint8_t> file) {
  prepare_gdal();
  const FileInMemory in_memory(file);
  const char* const drivers[] = {"PNG", "JPEG", nullptr};
  const Dataset dataset(
      GDALDataset::Open(name_in_memory, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, nullptr, nullptr));
  if (dataset == nullptr) return fail("it is no PNG and no JPEG, or damaged");
  Picture picture{dataset->GetRasterXSize(), dataset->GetRasterYSize(), {}};
  const uint64_t pixels = static_cast<uint64_t>(picture.columns) * static_cast<uint64_t>(picture.rows);
  if (pixels > limits::picture_pixels_max)
    return fail(fmt::format("it has {} pixels, more than {} (limits.picture_pixels_max)", pixels,
                            limits::picture_pixels_max));
  const int bands = dataset->GetRasterCount();
  if (bands < 1) return fail("it has no colours");
  for (int i = 1; i <= bands; ++i)
    if (dataset->GetRasterBand(i)->GetRasterDataType() != GDT_Byte)
      return fail("its colours have more than 8 bits");
  picture.pixels.resize(pixels);
  for (int i = 0; i < (bands < 3 ? 1 : 3); ++i) {
    GDALRasterBand* const band = dataset->GetRasterBand(i + 1);
    if (band->RasterIO(GF_Read, 0, 0, picture.columns, picture.rows, picture.pixels.data()->data() + i,
                       picture.columns, picture.rows, GDT_Byte, 3, 3 * static_cast<GSpacing>(picture.columns),
                       nullptr) != CE_None)
      return fail(gdal_words("it is damaged"));
  }
  if (bands < 3) colour(*dataset->GetRasterBand(1), picture);
  return picture;
}

}  // namespace scree
