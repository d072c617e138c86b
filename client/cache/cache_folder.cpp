#include "client/cache/cache_folder.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string_view>
#include <unistd.h>

#include "client/cache/limits.h"
#include "client/cache/tile_folder.h"
#include "proto/byte_stream.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr uint64_t file_kind = 0x3130'4B48'4353'4353ULL;  // "SCSCHK01"
constexpr const char* extension = ".chunks";
constexpr const char* unfinished = ".unfinished";

std::string hex(uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

/// An address as the beginning of a file's name.
std::string name_of_address(const std::string& address) {
  std::string name = address.substr(0, limits::cache_name_bytes_max);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  return name + "_";
}

std::vector<uint8_t> bytes_of(const CachedWorld& cached) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  writer.u64(file_kind);
  writer.u64(cached.world);
  writer.f32(cached.voxel_size_m);
  for (const CachedChunk& chunk : cached.chunks) {
    writer.u32(static_cast<uint32_t>(chunk.bricks->size()));
    for (const int32_t axis : {chunk.chunk.x, chunk.chunk.y, chunk.chunk.z})
      writer.u32(static_cast<uint32_t>(axis));
    writer.u64(chunk.hash);
    bytes.insert(bytes.end(), chunk.bricks->begin(), chunk.bricks->end());
  }
  return bytes;
}

CachedWorld world_of(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, "cache file");
  if (reader.u64("kind") != file_kind) reader.refuse("is none");
  CachedWorld cached{reader.u64("world"), reader.f32("voxel size")};
  if (reader.failed() || cached.voxel_size_m < limits::voxel_size_min_m ||
      cached.voxel_size_m > limits::voxel_size_max_m)
    return {};
  const auto axis = [&] {
    const auto value = std::bit_cast<int32_t>(reader.u32("coordinate"));
    constexpr int32_t max = limits::voxel_coordinate_max / chunk_size;
    if (value < -max || value > max) reader.refuse("a coordinate is too large");
    return value;
  };
  while (!reader.at_end()) {
    CachedChunk chunk;
    const size_t size = reader.u32("bytes of bricks");
    if (size == 0 || size > limits::message_bytes_max) reader.refuse("a chunk of no or too many bytes");
    chunk.chunk.x = axis();
    chunk.chunk.y = axis();
    chunk.chunk.z = axis();
    chunk.hash = reader.u64("hash");
    const std::span<const uint8_t> bricks = reader.read_bytes(reader.failed() ? 0 : size, "bricks");
    if (reader.failed()) break;
    chunk.bricks = std::make_shared<const std::vector<uint8_t>>(bricks.begin(), bricks.end());
    cached.chunks.push_back(std::move(chunk));
  }
  return cached;
}

/// Whether a file of that name is one of ours: an address, a world, the extension.
bool is_ours(std::string_view name) {
  constexpr size_t world_digits = 16;
  if (!name.ends_with(extension)) return false;
  name.remove_suffix(std::string_view(extension).size());
  if (name.size() <= world_digits || name[name.size() - world_digits - 1] != '_') return false;
  return std::ranges::all_of(name.substr(name.size() - world_digits),
                             [](unsigned char c) { return std::isxdigit(c) != 0; });
}

struct CacheFile {
  fs::file_time_type written;
  uintmax_t bytes = 0;
  fs::path path;

  bool operator<(const CacheFile& other) const { return written < other.written; }
};

/// The files of the folder whose names begin and end so, those written longest ago first.
std::vector<CacheFile> files_in(const std::string& folder, const std::string& begin, const std::string& end) {
  std::vector<CacheFile> files;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code unreadable;
    if (!name.starts_with(begin) || !name.ends_with(end) || !entry->is_regular_file(unreadable)) continue;
    const CacheFile file{entry->last_write_time(unreadable), entry->file_size(unreadable), entry->path()};
    if (!unreadable) files.push_back(file);
  }
  std::ranges::sort(files, std::less{});
  return files;
}

}  // namespace

std::string CacheFolder::file_of(const std::string& address, uint64_t world) const {
  return fmt::format("{}/{}{}{}", path_, name_of_address(address), hex(world), extension);
}

std::optional<CachedWorld> CacheFolder::read(const std::string& address,
                                             std::optional<uint64_t> world) const {
  if (path_.empty()) return std::nullopt;
  std::string file;
  if (world) {
    file = file_of(address, *world);
  } else {
    const auto files = files_in(path_, name_of_address(address), extension);
    if (files.empty()) return std::nullopt;
    file = files.back().path.string();
  }
  std::error_code error;
  const uintmax_t size = fs::file_size(file, error);
  if (error || size > bytes_max_) return std::nullopt;
  std::vector<uint8_t> bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  CachedWorld cached = world_of(bytes);
  // A file under another's name, or of another form.
  if (cached.world == 0 || fs::path(file_of(address, cached.world)).filename() != fs::path(file).filename())
    return std::nullopt;
  return cached;
}

Result<void> CacheFolder::try_writing() const {
  if (path_.empty()) return {};
  std::error_code error;
  if (fs::create_directories(path_, error)) fs::permissions(path_, fs::perms::owner_all, error);
  if (error) return fail(fmt::format("{}: {}", path_, error.message()));
  const std::string probe = fmt::format("{}/{}{}", path_, getpid(), unfinished);
  std::ofstream out(probe, std::ios::binary | std::ios::trunc);
  out << "probe";
  out.close();
  const bool written = static_cast<bool>(out);
  fs::remove(probe, error);
  if (!written) return fail(path_ + ": cannot be written to");
  return {};
}

void CacheFolder::write(const std::string& address, const CachedWorld& cached) const {
  if (path_.empty() || cached.chunks.empty()) return;
  std::error_code error;
  if (fs::create_directories(path_, error)) fs::permissions(path_, fs::perms::owner_all, error);
  const std::string file = file_of(address, cached.world);
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  const std::string partial = fmt::format("{}.{}.{}{}", file, getpid(), now, unfinished);
  const std::vector<uint8_t> bytes = bytes_of(cached);
  {
    std::ofstream out(partial, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      fs::remove(partial, error);
      return;
    }
  }
  fs::rename(partial, file, error);
  if (error) fs::remove(partial, error);
  bound();
}

void CacheFolder::bound() const {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (const CacheFile& file : files_in(path_, "", unfinished))
    if (std::chrono::duration<double>(now - file.written).count() > limits::unfinished_seconds_max)
      fs::remove(file.path, error);
  std::vector<CacheFile> files = files_in(path_, "", extension);
  std::erase_if(files, [](const CacheFile& file) { return !is_ours(file.path.filename().string()); });
  for (const char* of_digests : {tile_extension, content_extension})
    for (CacheFile& file : files_in(path_, "", of_digests))
      if (is_tile_name(file.path.filename().string(), of_digests)) files.push_back(std::move(file));
  std::ranges::sort(files, std::less{});
  uintmax_t sum = 0;
  for (const CacheFile& file : files) sum += file.bytes;
  for (const CacheFile& file : files) {
    if (sum <= bytes_max_) return;
    fs::remove(file.path, error);
    sum -= file.bytes;
  }
}

}  // namespace scree
