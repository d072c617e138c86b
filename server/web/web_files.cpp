#include "server/web/web_files.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <vector>

#include "crypto/sha256.h"
#include "server/web/limits.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view compressed = ".gz";
constexpr size_t hash_digits_min = 8;
constexpr size_t etag_digits = 16;

constexpr std::pair<std::string_view, std::string_view> types[] = {
    {".html", "text/html; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".wasm", "application/wasm"},
    {".json", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".webp", "image/webp"},
    {".ico", "image/x-icon"},
    {".txt", "text/plain; charset=utf-8"},
};

std::string type_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  for (const auto& [end, type] : types)
    if (extension == end) return std::string(type);
  return "application/octet-stream";
}

bool is_served(std::string_view name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.starts_with('.') && std::ranges::all_of(name, plain);
}

/// Links to files are followed as far as they stay within the folder.
bool lies_within(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  if (error) return false;
  return std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
}

/// Paths from the folder, of the files that are served.
Result<std::vector<fs::path>> paths_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code unreadable;
    const bool served = is_served(entry->path().filename().string()) && lies_within(entry->path(), folder);
    if (entry->is_directory(unreadable)) {
      if (!served || entry.depth() >= limits::web_folders_max) entry.disable_recursion_pending();
      continue;
    }
    if (!served || !entry->is_regular_file(unreadable)) continue;
    paths.push_back(entry->path().lexically_relative(folder));
    if (paths.size() > limits::web_files_max)
      return fail(fmt::format("{}: more than {} files: that is not a page (--web)", folder.string(),
                              limits::web_files_max));
  }
  if (error) return fail(folder.string() + ": " + error.message() + " (--web)");
  return paths;
}

Result<std::shared_ptr<const std::string>> read(const fs::path& path, size_t& room) {
  std::error_code error;
  const uintmax_t size = fs::file_size(path, error);
  if (!error && size > room)
    return fail(fmt::format("{}: more than {} MiB: that is not a page (--web)", path.parent_path().string(),
                            limits::web_bytes_max >> 20));
  std::ifstream file(path, std::ios::binary);
  std::string bytes(error ? 0 : size, '\0');
  if (error || !file.read(bytes.data(), static_cast<std::streamsize>(size)))
    return fail(path.string() + " cannot be read (--web)");
  room -= size;
  return std::make_shared<const std::string>(std::move(bytes));
}

std::string etag_of(const std::string& bytes) {
  const Digest digest = sha256({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  return "W/\"" + hex_of(digest).substr(0, etag_digits) + "\"";  // weak: of each way to send the file
}

}  // namespace

bool holds_hash(std::string_view name) {
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  for (size_t dot = name.find('.'); dot != name.npos;) {
    const size_t next = name.find('.', dot + 1);
    if (next == name.npos) return false;
    const std::string_view part = name.substr(dot + 1, next - dot - 1);
    const bool is_number = std::ranges::all_of(part, [](char c) { return c <= '9'; });  // a date, say
    if (part.size() >= hash_digits_min && std::ranges::all_of(part, is_hex) && !is_number) return true;
    dot = next;
  }
  return false;
}

Result<std::shared_ptr<const WebFiles>> WebFiles::load(const std::string& folder) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error || !fs::is_directory(root, error)) return fail(folder + " is not a folder (--web)");
  const auto paths = TRY(paths_in(root));
  auto files = std::make_shared<WebFiles>();
  size_t room = limits::web_bytes_max;
  std::map<std::string, std::shared_ptr<const std::string>> gzips;
  for (const fs::path& path : paths) {
    auto bytes = TRY(read(root / path, room));
    const std::string name = path.generic_string();
    if (name.ends_with(compressed)) {
      gzips[name.substr(0, name.size() - compressed.size())] = bytes;
      continue;
    }
    files->files_[name] = {bytes, nullptr, type_of(path), etag_of(*bytes),
                           holds_hash(path.filename().string())};
  }
  for (auto& [name, bytes] : gzips)
    if (const auto plain = files->files_.find(name); plain != files->files_.end())
      plain->second.gzip = std::move(bytes);
  return files;
}

Result<std::shared_ptr<const WebFiles>> web_files(const WebConfig& config) {
  if (!config.on || config.folder.empty()) return std::make_shared<const WebFiles>();
  auto files = WebFiles::load(config.folder);
  if (files && !(*files)->has_page()) return fail(config.folder + " has no index.html (--web)");
  return files;
}

const WebFile* WebFiles::find(std::string_view path) const {
  if (path == "/") path = "/index.html";
  if (path == "/status") path = "/status.html";
  if (path == "/admin") path = "/admin.html";
  if (!path.starts_with('/')) return nullptr;
  const auto found = files_.find(path.substr(1));
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace scree
