#include "client/cache/tile_folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

#include "crypto/sha256.h"

namespace scree {

namespace fs = std::filesystem;

std::optional<std::vector<uint8_t>> TileFolder::read(const Digest& digest) const {
  if (path_.empty()) return std::nullopt;
  const std::string file = fmt::format("{}/{}{}", path_, hex_of(digest), extension_);
  std::error_code error;
  const uintmax_t size = fs::file_size(file, error);
  if (error || size > bytes_max_) return std::nullopt;
  std::vector<uint8_t> bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in || sha256(bytes) != digest) return std::nullopt;
  fs::last_write_time(file, fs::file_time_type::clock::now(), error);  // used now: others go first
  return bytes;
}

void TileFolder::write(const Digest& digest, const std::vector<uint8_t>& bytes) const {
  if (path_.empty()) return;
  std::error_code error;
  if (fs::create_directories(path_, error)) fs::permissions(path_, fs::perms::owner_all, error);
  const std::string file = fmt::format("{}/{}{}", path_, hex_of(digest), extension_);
  const std::string partial = fmt::format("{}.{}.unfinished", file, getpid());
  std::ofstream out(partial, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) fs::rename(partial, file, error);
  if (!out || error) fs::remove(partial, error);
}

bool is_tile_name(const std::string& name, const std::string& extension) {
  constexpr size_t digits = 2 * sizeof(Digest);
  return name.size() > digits && name.substr(digits) == extension &&
         std::all_of(name.begin(), name.begin() + digits,
                     [](unsigned char c) { return std::isxdigit(c) != 0; });
}

}  // namespace scree
