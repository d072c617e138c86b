#include "server/app/audit_trail.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "server/app/limits.h"
#include "server/log/log.h"
#include "shared/base/regular_file.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

constexpr mode_t owner_alone = S_IRUSR | S_IWUSR;  // it names persons and addresses

std::string line_of(const std::string& who, const std::string& act) {
  const nlohmann::ordered_json json{{"time", iso_time(unix_now_ms())}, {"who", who}, {"act", act}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<void> write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(file, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return fail(std::strerror(errno));
    bytes.remove_prefix(static_cast<size_t>(done));
  }
  return {};
}

}  // namespace

Result<AuditTrail> AuditTrail::open(std::string path) {
  AuditTrail trail(std::move(path));
  std::error_code ignored;
  if (!trail.path_.empty() && std::filesystem::exists(trail.path_, ignored))
    if (const auto read = trail.read(); !read) return fail(trail.path_ + ": " + read.error().message);
  return trail;
}

/// What is no line of ours is left where it is, and not shown.
Result<void> AuditTrail::read() {
  const std::string bytes = TRY(read_bytes_of(path_, limits::audit_bytes_max + limits::audit_kept_bytes));
  torn_ = !bytes.empty() && bytes.back() != '\n';
  for (size_t at = 0; at < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', at), bytes.size());
    std::string line = bytes.substr(at, end - at);
    at = end + 1;
    if (nlohmann::json::accept(line)) keep(std::move(line));
  }
  return {};
}

void AuditTrail::keep(std::string line) {
  kept_bytes_ += line.size();
  lines_.push_back(std::move(line));
  size_t gone = 0;
  while (kept_bytes_ > limits::audit_kept_bytes) kept_bytes_ -= lines_[gone++].size();
  lines_.erase(lines_.begin(), lines_.begin() + static_cast<std::ptrdiff_t>(gone));
}

Result<void> AuditTrail::append(const std::string& line) {
  struct stat now {};
  if (::stat(path_.c_str(), &now) == 0 && static_cast<uint64_t>(now.st_size) > limits::audit_bytes_max &&
      std::rename(path_.c_str(), (path_ + ".1").c_str()) != 0)
    return fail(std::strerror(errno));
  const int file = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, owner_alone);
  if (file < 0) return fail(std::strerror(errno));
  auto written = write_all(file, (torn_ ? "\n" : "") + line + "\n");
  torn_ = !written;  // a full disk may have taken a part of it
  if (::close(file) != 0 && written) written = fail(std::strerror(errno));
  return written;
}

void AuditTrail::add(const std::string& who, const std::string& act) {
  std::string line = line_of(who, act);
  if (const auto written = path_.empty() ? Result<void>() : append(line); !written)
    if (const auto more = log_limit_.admit("audit", steady_now_s()))
      log_of(LogPart::admin)
          .error("{}: what administrators do is not kept: {}{}", path_, written.error().message, *more);
  keep(std::move(line));
}

}  // namespace scree
