#include "server/doors/bans.h"

#include <asio/ip/address.hpp>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include "server/doors/limits.h"

namespace scree {

namespace {

constexpr std::string_view network_bits = "/64";
constexpr size_t network_bytes = 8;

bool has_ended(const Ban& ban, uint64_t now_s) {
  return ban.until_s != 0 && ban.until_s <= now_s;
}

Result<void> parse_line(const std::string& line, std::map<std::string, Ban>& bans) {
  std::istringstream words(line);
  std::string address;
  Ban ban;
  if (!(words >> address >> ban.until_s)) return fail("a ban is written as ADDRESS UNTIL REASON");
  std::getline(words >> std::ws, ban.reason);
  const auto key = TRY(ban_key(address));
  if (bans.size() >= limits::bans_max && !bans.contains(key))
    return fail(fmt::format("there are more than {} bans (limits.bans_max)", limits::bans_max));
  bans[key] = ban;
  return {};
}

}  // namespace

Result<std::string> ban_key(const std::string& address) {
  std::string bare = address;
  if (bare.ends_with(network_bits)) bare.resize(bare.size() - network_bits.size());
  asio::error_code error;
  const auto parsed = asio::ip::make_address(bare, error);
  if (error) return fail("'" + address + "' is not an IPv4 or IPv6 address");
  if (parsed.is_v4()) return parsed.to_string();
  const asio::ip::address_v6 v6 = parsed.to_v6();
  if (v6.is_v4_mapped()) return asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_string();
  if (v6.is_loopback()) return v6.to_string();
  asio::ip::address_v6::bytes_type bytes = v6.to_bytes();
  for (size_t i = network_bytes; i < bytes.size(); ++i) bytes[i] = 0;
  return asio::ip::address_v6(bytes).to_string() + std::string(network_bits);
}

Result<Bans> Bans::open(const std::string& path) {
  Bans bans;
  bans.path_ = path;
  std::error_code error;
  const bool there = !path.empty() && std::filesystem::exists(path, error);
  if (!there && !error) return bans;
  // Writing takes the place of what is there, so it has to be a file.
  if (!error && !std::filesystem::is_regular_file(path, error)) return fail(path + " is not a file (--bans)");
  std::ifstream file(path);
  if (error || !file) return fail(fmt::format("the file of bans {} cannot be read (--bans)", path));
  size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty()) continue;
    if (Result<void> taken = parse_line(line, bans.bans_); !taken)
      return fail(fmt::format("{}, line {}: {}", path, number, taken.error().message));
  }
  return bans;
}

Result<void> Bans::add(const std::string& key, const Ban& ban, uint64_t now_s) {
  std::erase_if(bans_, [&](const auto& entry) { return has_ended(entry.second, now_s); });
  if (bans_.size() >= limits::bans_max && !bans_.contains(key))
    return fail(fmt::format("there are {} bans already (limits.bans_max): lift some", limits::bans_max));
  bans_[key] = ban;
  return write();
}

Result<void> Bans::lift(const std::string& key) {
  if (bans_.erase(key) == 0) return fail(key + " is not banned");
  return write();
}

const Ban* Bans::find(const std::string& address, uint64_t now_s) const {
  if (bans_.empty()) return nullptr;
  const auto key = ban_key(address);
  const auto found = key ? bans_.find(*key) : bans_.end();
  return found == bans_.end() || has_ended(found->second, now_s) ? nullptr : &found->second;
}

/// Beside the old one, on the disk, then in its place: whatever ends the server, or the machine, none is lost
/// of before.
Result<void> Bans::write() const {
  if (path_.empty()) return {};
  std::ostringstream lines;
  for (const auto& [key, ban] : bans_) lines << key << ' ' << ban.until_s << ' ' << ban.reason << '\n';
  const std::string fresh = path_ + ".new", text = lines.str();
  std::FILE* const file = std::fopen(fresh.c_str(), "wb");
  bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                 std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (file != nullptr) written = std::fclose(file) == 0 && written;
  if (written && std::rename(fresh.c_str(), path_.c_str()) == 0) return {};
  return fail("the bans cannot be written to " + path_ + " (--bans): they hold until the server ends");
}

}  // namespace scree
