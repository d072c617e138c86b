#include "tools/import/gdal/packed_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cpl_vsi.h>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <string_view>
#include <unistd.h>

#include "tools/import/file_forms.h"
#include "tools/import/gdal/gdal_library.h"
#include "tools/import/gdal/raster_file.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

constexpr size_t block_bytes = size_t{1} << 20U;

/// A file of netCDF's fourth version begins as HDF5 does.
bool is_named_netcdf(std::string address) {
  constexpr std::string_view packed = ".gz";
  if (ending_of(address) == packed) address.resize(address.size() - packed.size());
  constexpr std::array<std::string_view, 4> endings = {".nc", ".nc4", ".cdf", ".grd"};
  return std::ranges::find(endings, ending_of(address)) != endings.end();
}

/// Empty: GDAL reads it in its archive.
std::string_view ending_for(const std::string& address) {
  auto* const driver =
      static_cast<GDALDriver*>(GDALIdentifyDriverEx(address.c_str(), GDAL_OF_RASTER, nullptr, nullptr));
  const std::string_view name = driver == nullptr ? "" : driver->GetDescription();
  if (name == "netCDF" || (name.starts_with("HDF5") && is_named_netcdf(address))) return ".nc";
  return name.starts_with("HDF4") ? ".hdf" : "";
}

Error too_long() {
  return {
      fmt::format("unpacked, it has more than {} bytes (limits.unpacked_bytes_max): unpack the archive, "
                  "and import its file by itself",
                  limits::unpacked_bytes_max)};
}

Result<void> write_all(int descriptor, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return fail(std::string("it cannot be unpacked: ") + std::strerror(errno));
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
  return {};
}

}  // namespace

Result<std::optional<PackedFile>> find_packed(const std::string& path, const std::string& layer) {
  PackedFile file;
  file.layer = layer;
  const auto address = TRY(address_in_archive(path, file.layer, file.said));
  if (!address) return std::optional<PackedFile>();
  file.address = *address;
  file.ending = ending_for(*address);
  if (file.ending.empty()) return std::optional<PackedFile>();
  return std::optional(std::move(file));
}

Result<void> send_packed(const PackedFile& file, ReaderChannel& channel) {
  const std::unique_ptr<VSILFILE, CloseFile> from(VSIFOpenL(file.address.c_str(), "rb"));
  if (from == nullptr) return fail(gdal_words("it cannot be read in its archive"));
  TRY(channel.put_text(file.ending));
  TRY(channel.put_text(file.layer));
  TRY(channel.put_text(file.said.empty() ? "" : file.said.front()));
  std::vector<char> block;
  uint64_t bytes = 0;
  do {
    block.resize(block_bytes);
    block.resize(VSIFReadL(block.data(), 1, block.size(), from.get()));
    bytes += block.size();
    if (bytes > limits::unpacked_bytes_max) return tl::unexpected(too_long());
    TRY(channel.put_list(block));
  } while (!block.empty());
  return {};
}

Result<std::unique_ptr<UnpackedFile>> UnpackedFile::receive(ReaderChannel& channel) {
  std::unique_ptr<UnpackedFile> file(new UnpackedFile());
  const std::string ending = TRY(channel.get_text());
  if (ending != ".nc" && ending != ".hdf") return fail("its reader sends a file of an unknown form");
  file->layer_ = TRY(channel.get_text());
  if (std::string said = TRY(channel.get_text()); !said.empty()) file->said_.push_back(std::move(said));
  std::error_code error;
  const auto folder = std::filesystem::temp_directory_path(error);
  if (error) return fail("there is no folder to unpack it into: " + error.message());
  file->path_ = (folder / ("scree-import-XXXXXX" + ending)).string();
  file->descriptor_ = ::mkstemps(file->path_.data(), static_cast<int>(ending.size()));
  if (file->descriptor_ < 0) return fail(std::string("it cannot be unpacked: ") + std::strerror(errno));
  file->has_name_ = true;
  TRY(file->fill(channel));
  return file;
}

Result<void> UnpackedFile::fill(ReaderChannel& channel) {
  uint64_t bytes = 0;
  while (true) {
    const auto block = TRY(channel.get_list<char>(block_bytes));
    if (block.empty()) return {};
    bytes += block.size();
    if (bytes > limits::unpacked_bytes_max) return tl::unexpected(too_long());
    TRY(write_all(descriptor_, block));
  }
}

UnpackedFile::~UnpackedFile() {
  remove_name();
  if (descriptor_ >= 0) ::close(descriptor_);
}

void UnpackedFile::remove_name() {
  if (has_name_) ::unlink(path_.c_str());
  has_name_ = false;
}

}  // namespace scree
