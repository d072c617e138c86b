#include "server/doors/bans.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "auth/replace_file.h"
#include "server/doors/limits.h"
#include "shared/base/regular_file.h"
#include "shared/base/small_letters.h"

namespace scree {

namespace {

bool has_ended(const Ban& ban, uint64_t now_s) {
  return ban.until_s != 0 && ban.until_s <= now_s;
}

std::string line_of(const std::string& key, const Ban& ban) {
  const std::string line = fmt::format("{} {}", key, ban.until_s);
  return ban.reason.empty() ? line : fmt::format("{} {}", line, ban.reason);
}

bool is_for_people(const std::string& line) {
  const size_t first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

}  // namespace

/// A line that is no ban stays as it is, so that nothing that somebody wrote is lost.
Result<Bans::File> Bans::read_file() const {
  File read;
  std::error_code error;
  read.is_there = !path_.empty() && std::filesystem::exists(path_, error);
  if (!read.is_there && !error) return read;
  const auto unreadable = fail(fmt::format("the file of bans {} cannot be read (--bans)", path_));
  if (error) return unreadable;
  // Writing takes the place of what is there, so it has to be a file.
  if (const auto small = check_is_small_file(path_, limits::bans_bytes_max); !small)
    return fail(small.error().message + " (--bans)");
  std::ifstream file(path_);
  if (!file) return unreadable;
  const auto parse = [](Line& line) -> Result<void> {
    std::istringstream words(line.text);
    std::string target;
    if (!(words >> target >> line.ban.until_s)) return fail("a ban is written as TARGET UNTIL REASON");
    std::getline(words >> std::ws, line.ban.reason);
    line.key = TRY(ban_key(target));
    return {};
  };
  size_t bans = 0, faults = 0;
  for (std::string text; std::getline(file, text);) {
    Line& line = read.lines.emplace_back(Line{std::move(text)});
    if (is_for_people(line.text)) continue;
    Result<void> parsed = parse(line);
    if (parsed && ++bans > limits::bans_max)
      parsed = fail(fmt::format("there are more than {} bans (limits.bans_max)", limits::bans_max));
    if (parsed) continue;
    line.key.clear();
    if (++faults == 1)
      read.fault = fmt::format("{}, line {}: {}", path_, read.lines.size(), parsed.error().message);
  }
  if (faults > 1) read.fault += fmt::format(" (and {} more such lines)", faults - 1);
  return read;
}

Result<Bans> Bans::open(const std::string& path) {
  Bans bans;
  bans.path_ = path;
  const File file = TRY(bans.read_file());
  bans.merge(file);
  return bans;
}

/// What differs from what was read or written last was done by hand. A file that is gone was moved away, and
/// lifts nothing; one that was emptied lifts all.
void Bans::merge(const File& file) {
  fault_ = file.fault;
  List now;
  for (const Line& line : file.lines)
    if (!line.key.empty()) now[line.key] = line.ban;
  for (const auto& [key, ban] : now) {
    const auto known = in_file_.find(key);
    if (known == in_file_.end() || !(known->second == ban)) bans_[key] = ban;
  }
  if (file.is_there)
    for (const auto& [key, ban] : in_file_)
      if (!now.contains(key)) bans_.erase(key);
  in_file_ = std::move(now);
  std::erase_if(targets_, [&](const auto& entry) { return !bans_.contains(entry.first); });
  for (const auto& [key, ban] : bans_)
    if (auto target = BanTarget::read(key); target && !targets_.contains(key)) targets_.emplace(key, *target);
}

Result<void> Bans::read_again() {
  if (path_.empty()) return {};
  const File file = TRY(read_file());
  merge(file);
  return fault_.empty() ? Result<void>() : fail(fault_);
}

Result<void> Bans::add(const std::string& key, const Ban& ban, uint64_t now_s) {
  static_cast<void>(read_again());  // what is wrong with it, writing says again
  std::erase_if(bans_, [&](const auto& entry) { return has_ended(entry.second, now_s); });
  if (bans_.size() >= limits::bans_max && !bans_.contains(key))
    return fail(fmt::format("there are {} bans already (limits.bans_max): lift some", limits::bans_max));
  bans_[key] = ban;
  if (auto target = BanTarget::read(key)) targets_.insert_or_assign(key, *target);
  return write();
}

Result<void> Bans::lift(const std::string& key) {
  static_cast<void>(read_again());
  const auto is_meant = [small = in_small_letters(key)](const auto& ban) {
    return in_small_letters(ban.first) == small;
  };
  if (std::erase_if(bans_, is_meant) == 0) return fail(key + " is not banned");
  std::erase_if(targets_, is_meant);
  return write();
}

std::optional<FoundBan> Bans::find(const BanSubject& subject, uint64_t now_s) const {
  const auto address = read_ip(subject.ip);
  for (const auto& [key, target] : targets_) {
    if (!target.fits(subject, address)) continue;
    const auto ban = bans_.find(key);
    if (ban != bans_.end() && !has_ended(ban->second, now_s)) return FoundBan{ban->second, target};
  }
  return std::nullopt;
}

/// Beside the old one, on the disk, then in its place: whatever ends the server, or the machine, none is lost
/// of before.
Result<void> Bans::write() {
  if (path_.empty()) return {};
  const auto failed =
      fail(fmt::format("the bans cannot be written to {} (--bans): they hold until the server ends", path_));
  const auto file_now = read_file();
  if (!file_now) return failed;
  std::string text;
  std::set<std::string> written;
  for (const Line& line : file_now->lines) {
    const auto ban = bans_.find(line.key);
    if (!line.key.empty() && (ban == bans_.end() || !written.insert(line.key).second)) continue;
    text += (line.key.empty() || ban->second == line.ban ? line.text : line_of(line.key, ban->second)) + "\n";
  }
  for (const auto& [key, ban] : bans_)
    if (!written.contains(key)) text += line_of(key, ban) + "\n";
  constexpr unsigned everybody_reads = 0644;
  if (!replace_file(path_, text, everybody_reads)) return failed;
  in_file_ = bans_;
  return {};
}

}  // namespace scree
