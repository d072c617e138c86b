#include "tools/import/gdal/raster_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <optional>
#include <string_view>

#include "shared/base/regular_file.h"
#include "shared/base/small_letters.h"
#include "tools/import/gdal/ascii_grid.h"
#include "tools/import/gdal/gdal_forms.h"
#include "tools/import/gdal/gdal_library.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// A raster within a file, or a file within an archive.
struct Part {
  std::string name;     ///< by which --layer chooses it
  std::string address;  ///< by which GDAL opens it
  std::string words;    ///< what the file says of it
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> archives{{{".zip", "/vsizip/"},
                                                                                 {".kmz", "/vsizip/"},
                                                                                 {".tar", "/vsitar/"},
                                                                                 {".tgz", "/vsitar/"},
                                                                                 {".tar.gz", "/vsitar/"},
                                                                                 {".gz", "/vsigzip/"}}};

std::string listed_parts(const std::vector<Part>& parts) {
  std::string names;
  for (size_t i = 0; i < std::min(parts.size(), limits::raster_names_max); ++i)
    names += fmt::format("{}{} '{}'{}", i > 0 ? "; " : "", i + 1, shown(parts[i].name.c_str()),
                         parts[i].words.empty() ? "" : fmt::format(" {}", shown(parts[i].words.c_str())));
  if (parts.size() > limits::raster_names_max)
    names += fmt::format("; and {} more", parts.size() - limits::raster_names_max);
  return names;
}

/// By its name, the end of it, or its number.
const Part* find_part(const std::vector<Part>& parts, const std::string& layer) {
  const auto same = [&](const Part& part) { return part.name == layer || part.address == layer; };
  if (const auto found = std::ranges::find_if(parts, same); found != parts.end()) return &*found;
  size_t number = 0;
  const auto [end, error] = std::from_chars(layer.data(), layer.data() + layer.size(), number);
  if (error == std::errc() && end == layer.data() + layer.size())
    return number >= 1 && number <= parts.size() ? &parts[number - 1] : nullptr;
  const auto ends = [&](const Part& part) { return part.name.ends_with(layer); };
  return std::ranges::count_if(parts, ends) == 1 ? &*std::ranges::find_if(parts, ends) : nullptr;
}

/// The one that is meant; the error lists all. `kind`: "raster", "file".
Result<Part> choose_part(const std::vector<Part>& parts, const std::string& layer, std::string_view kind,
                         std::vector<std::string>& said) {
  if (!layer.empty()) {
    if (const Part* const part = find_part(parts, layer)) {
      said.push_back(fmt::format("its {} '{}' was read, as --layer says", kind, shown(part->name.c_str())));
      return *part;
    }
    return fail(fmt::format("it has no {} '{}' (--layer); it has {}", kind, layer, listed_parts(parts)));
  }
  if (parts.size() == 1) {
    said.push_back(fmt::format("its only {}, '{}', was read", kind, shown(parts.front().name.c_str())));
    return parts.front();
  }
  return fail(fmt::format("it holds {} {}s; --layer NAME chooses one by its name or number: {}", parts.size(),
                          kind, listed_parts(parts)));
}

Result<Dataset> open(const std::string& address) {
  CPLErrorReset();
  Dataset dataset(GDALDataset::FromHandle(
      GDALOpenEx(address.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr,
                 nullptr)));
  if (!dataset) {
    const std::string words = gdal_words("GDAL does not know its format");
    TRY(check_holds_numbers(address));
    if (words.find("not recognized as a supported file format") != std::string::npos)
      return fail(
          "not an elevation model of a form that import reads; if gdalinfo knows it, make a GeoTIFF of it "
          "(gdal_translate FILE out.tif), import that");
    return fail("not an elevation model: " + words);
  }
  const GDALDriver* const driver = dataset->GetDriver();
  if (driver != nullptr && std::string_view(driver->GetDescription()) == "AAIGrid")
    TRY(check_ascii_grid(address, static_cast<uint64_t>(dataset->GetRasterXSize()),
                         static_cast<uint64_t>(dataset->GetRasterYSize())));
  return dataset;
}

/// The name of a subdataset: the part of its address after the file's.
std::string name_in(const std::string& address, const std::string& path) {
  const size_t at = address.rfind(path);
  std::string name = at == std::string::npos ? address : address.substr(at + path.size());
  while (!name.empty() && (name.front() == '"' || name.front() == ':' || name.front() == '/'))
    name.erase(0, 1);
  return name.empty() ? address : name;
}

/// Whether an address of a subdataset is one within the file: a driver's word, the file, a name. A file can
/// say any other one of itself.
bool is_within(const std::string& address, const std::string& path) {
  const size_t at = address.find(path);
  if (at == std::string::npos || at == 0) return false;
  const std::string_view word(address.data(), at), name = std::string_view(address).substr(at + path.size());
  return word.find('/') == std::string_view::npos && name.find("/vsi") == std::string_view::npos &&
         name.find("..") == std::string_view::npos && (name.empty() || name[0] == ':' || name[0] == '"');
}

std::vector<Part> subdatasets_of(GDALDataset& dataset, const std::string& path) {
  std::vector<Part> parts;
  char** const said = dataset.GetMetadata("SUBDATASETS");
  for (int i = 1;; ++i) {
    const char* const address = CSLFetchNameValue(said, fmt::format("SUBDATASET_{}_NAME", i).c_str());
    if (address == nullptr) return parts;
    if (!is_within(address, path)) continue;
    const char* const words = CSLFetchNameValue(said, fmt::format("SUBDATASET_{}_DESC", i).c_str());
    parts.push_back({name_in(address, path), address, words == nullptr ? "" : words});
    const bool numbered = parts.back().name.starts_with("GTIFF_DIR:");
    if (numbered) parts.back().name = std::to_string(i);
  }
}

/// GDAL's file system for the archive; nothing when the file is none, by its name.
std::optional<std::string> archive_of(const std::string& path) {
  const std::string name = in_small_letters(path);
  for (const auto& [ending, system] : archives)
    if (name.ends_with(ending) && !name.starts_with("/vsi")) return std::string(system) + path;
  return std::nullopt;
}

/// The files of an archive that are rasters.
Result<std::vector<Part>> files_of(const std::string& archive) {
  CPLErrorReset();
  const CPLStringList list(VSIReadDirRecursive(archive.c_str()));
  std::vector<std::string> names;
  for (int i = 0; i < list.size(); ++i)
    if (!std::string_view(list[i]).ends_with('/')) names.emplace_back(list[i]);
  if (names.empty()) return fail("no archive that can be read: " + gdal_words("it holds no file"));
  if (names.size() > limits::archive_files_max)
    return fail(fmt::format("it holds {} files, more than {} (limits.archive_files_max): unpack it",
                            names.size(), limits::archive_files_max));
  std::vector<Part> rasters;
  for (const std::string& name : names) {
    const std::string address = archive + "/" + name;
    if (GDALIdentifyDriverEx(address.c_str(), GDAL_OF_RASTER, nullptr, nullptr) != nullptr)
      rasters.push_back({name, address, {}});
  }
  std::ranges::sort(rasters, {}, &Part::name);
  if (!rasters.empty()) return rasters;
  std::vector<Part> all;
  for (const std::string& name : names) all.push_back({name, {}, {}});
  return fail("an archive without a raster. Unpack it, and import one of its files: " + listed_parts(all));
}

}  // namespace

Result<std::optional<std::string>> address_in_archive(const std::string& path, std::string& layer,
                                                      std::vector<std::string>& said) {
  const auto archive = archive_of(path);
  if (!archive || archive->starts_with("/vsigzip/")) return archive;
  const auto files = TRY(files_of(*archive));
  const bool two = find_part(files, layer) == nullptr && layer.find(':') != std::string::npos;
  const auto file = TRY(choose_part(files, two ? layer.substr(0, layer.find(':')) : layer, "file", said));
  layer = two ? layer.substr(layer.find(':') + 1) : std::string();
  return std::optional(file.address);
}

Result<Dataset> open_raster_file(const std::string& path, const std::string& layer,
                                 std::vector<std::string>& said) {
  TRY(check_is_file(path));
  std::string left = layer;
  const auto packed = TRY(address_in_archive(path, left, said));
  const std::string address = packed.value_or(path);
  Dataset dataset = TRY(open(address));
  const std::vector<Part> parts = subdatasets_of(*dataset, address);
  if (dataset->GetRasterCount() > 0 && (parts.size() < 2 || left.empty())) {
    if (!left.empty() && (parts.empty() || find_part(parts, left) == nullptr))
      return fail(fmt::format("it has one raster, and no '{}' (--layer)", left));
    if (parts.size() > 1)
      said.push_back(fmt::format("its first of {} rasters was read; --layer chooses: {}", parts.size(),
                                 listed_parts(parts)));
    return dataset;
  }
  if (parts.empty()) return fail("it has no band of heights");
  const auto part = TRY(choose_part(parts, left, "raster", said));
  return open(part.address);
}

}  // namespace scree
