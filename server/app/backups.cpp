#include "server/app/backups.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <pthread.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

#include "server/app/limits.h"
#include "server/log/log.h"
#include "server/store/world_copy.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view unfinished_end = "-new";  // of copy_checked()
constexpr const char* stamp_form = "%Y%m%dT%H%M%SZ";
constexpr size_t stamp_length = 16;

std::string stamp_of(uint64_t unix_s) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::string text(stamp_length + 1, '\0');
  text.resize(std::strftime(text.data(), text.size(), stamp_form, &utc));
  return text;
}

std::optional<uint64_t> time_of(const std::string& stamp) {
  std::tm utc{};
  const char* const end = stamp.size() == stamp_length ? strptime(stamp.c_str(), stamp_form, &utc) : nullptr;
  if (end == nullptr || *end != '\0') return std::nullopt;
  const std::time_t seconds = timegm(&utc);
  if (seconds < 0) return std::nullopt;
  return static_cast<uint64_t>(seconds);
}

/// What was written goes to the disk bit by bit: all at once at the end would make saves wait.
void sync_written(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  ::fdatasync(file);
  ::close(file);
}

}  // namespace

std::string default_backup_folder(const std::string& world_path) {
  return world_path + ".backups";
}

BackupFolder::BackupFolder(const std::string& world_path, std::string folder)
    : stem_(fs::path(world_path).stem().string() + "-"),
      suffix_(fs::path(world_path).extension().string()),
      folder_(folder.empty() ? default_backup_folder(world_path) : std::move(folder)) {}

std::string BackupFolder::path_at(uint64_t unix_s) const {
  return (fs::path(folder_) / (stem_ + stamp_of(unix_s) + suffix_)).string();
}

std::vector<BackupFolder::Backup> BackupFolder::list() const {
  std::vector<Backup> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.size() != stem_.size() + stamp_length + suffix_.size() || !name.starts_with(stem_) ||
        !name.ends_with(suffix_))
      continue;
    if (const auto time = time_of(name.substr(stem_.size(), stamp_length)))
      found.push_back({entry.path().string(), *time});
  }
  std::ranges::sort(found, {}, &Backup::unix_s);
  return found;
}

Result<void> BackupFolder::keep_newest(size_t keep, uint64_t now_unix_s) const {
  std::vector<Backup> all = list();
  const auto later = std::ranges::upper_bound(all, now_unix_s, {}, &Backup::unix_s);
  std::rotate(all.begin(), later, all.end());  // clang 14 lacks std::ranges::rotate
  for (size_t i = 0; i + keep < all.size(); ++i) {
    std::error_code error;
    fs::remove(all[i].path, error);
    if (error) return fail(fmt::format("{} cannot be removed: {}", all[i].path, error.message()));
  }
  return {};
}

void BackupFolder::remove_unfinished() const {
  std::error_code ignored;
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(stem_) && name.find(suffix_ + std::string(unfinished_end)) != std::string::npos)
      left.push_back(entry.path());
  }
  for (const fs::path& path : left) fs::remove(path, ignored);
}

struct Backups::State {
  State(std::string world, const BackupPlan& p)
      : world_path(std::move(world)), plan(p), folder(world_path, p.folder) {}
  void run();
  double first_due_s() const;
  void make();
  bool give_way(const std::string& copy);
  bool wait_until(double when_s);

  const std::string world_path;
  const BackupPlan plan;
  const BackupFolder folder;
  std::thread thread;
  double part_began_s = 0.0;  ///< used by the thread

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  bool stopping = false;
  BackupStatus status;
};

/// By the steady clock.
double Backups::State::first_due_s() const {
  const uint64_t now_s = unix_now_ms() / 1000;
  auto all = folder.list();
  std::erase_if(all, [&](const auto& backup) { return backup.unix_s > now_s; });  // the clock was set back
  if (all.empty()) return steady_now_s();
  const double age_s = static_cast<double>(unix_now_ms()) / 1e3 - static_cast<double>(all.back().unix_s);
  return steady_now_s() + std::clamp(plan.every_s - age_s, 0.0, plan.every_s);
}

/// False when the server ends.
bool Backups::State::wait_until(double when_s) {
  std::unique_lock lock(mutex);
  const auto left = std::chrono::duration<double>(std::max(0.0, when_s - steady_now_s()));
  changed.wait_for(lock, left, [this] { return stopping; });
  return !stopping;
}

/// Between two parts of a copy: the disk is the others' for several times as long as the part took.
bool Backups::State::give_way(const std::string& copy) {
  sync_written(copy);
  const double took_s = steady_now_s() - part_began_s;
  const bool goes_on =
      wait_until(steady_now_s() + std::clamp(took_s * limits::backup_pause_parts, limits::backup_pause_min_s,
                                             limits::backup_pause_max_s));
  part_began_s = steady_now_s();
  return goes_on;
}

void Backups::State::make() {
  const double began_s = steady_now_s();
  uint64_t unix_s = unix_now_ms() / 1000;
  std::error_code ignored;
  if (fs::exists(folder.path_at(unix_s), ignored)) ++unix_s;  // by a clock that was set back
  const std::string path = folder.path_at(unix_s);
  fs::create_directories(folder.folder(), ignored);  // somebody may have moved it away
  part_began_s = began_s;
  const auto made = copy_checked(world_path, path, WorldCheck::all_rows,
                                 [&] { return give_way(path + std::string(unfinished_end)); });
  const auto rotated = made ? folder.keep_newest(plan.keep, unix_s) : Result<void>();
  const std::scoped_lock lock(mutex);
  if (stopping && !made) return;
  if (made) {
    ++status.made;
    status.last_tick = made->tick;
    status.last_unix_ms = unix_s * 1000;
    log_of(LogPart::store)
        .info("backup {}: tick {}, {:.1f} MB, in {:.1f} s", path, made->tick,
              static_cast<double>(fs::file_size(path, ignored)) / 1e6, steady_now_s() - began_s);
  }
  const std::optional<std::string> fault = !made      ? std::optional(made.error().message)
                                           : !rotated ? std::optional(rotated.error().message)
                                                      : std::nullopt;
  if (!fault && !status.health.ok()) log_of(LogPart::store).info("backups are made again");
  if (fault && status.health.ok())  // once: each try has another name
    log_of(LogPart::store).warn("no backup was made of {}, which is tried again: {}", world_path, *fault);
  if (fault && status.health.ok()) status.health.since_unix_ms = unix_now_ms();
  if (!fault) status.health = {};
  status.health.because = fault;
}

void Backups::State::run() {
  ::pthread_setname_np(::pthread_self(), "backups");
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), limits::backup_niceness);
  folder.remove_unfinished();
  double due_s = first_due_s();
  while (wait_until(due_s)) {
    const double began_s = steady_now_s();
    make();
    const bool failed = !status.health.ok();  // this thread alone writes it
    due_s = began_s + (failed ? std::min(plan.every_s, limits::backup_retry_s) : plan.every_s);
  }
}

Backups::Backups(std::unique_ptr<State> state) : state_(std::move(state)) {}

Result<std::unique_ptr<Backups>> Backups::start(const std::string& world_path, BackupPlan plan) {
  auto state = std::make_unique<State>(world_path, plan);
  std::error_code error;
  fs::create_directories(state->folder.folder(), error);
  if (::access(state->folder.folder().c_str(), W_OK | X_OK) != 0)
    return fail(fmt::format("backups cannot be kept: the folder {} cannot be written (--backup-dir)",
                            state->folder.folder()));
  if (const auto all = state->folder.list(); !all.empty())
    state->status.last_unix_ms = all.back().unix_s * 1000;
  state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<Backups>(new Backups(std::move(state)));
}

Backups::~Backups() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
}

BackupStatus Backups::status() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->status;
}

}  // namespace scree
