// Rules that load: at the start, on demand, and when a file changes. And what comes in from other threads.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "server/rules/limits.h"
#include "server/rules/rules.h"

namespace scree {

namespace {

/// The newest change of any file of these folders, and how many there are.
std::pair<std::filesystem::file_time_type, size_t> state_of(const std::vector<std::string>& folders) {
  namespace fs = std::filesystem;
  std::pair<fs::file_time_type, size_t> state{fs::file_time_type::min(), 0};
  for (const std::string& folder : folders) {
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      if (at->path().extension() != ".lua") continue;
      const auto changed = fs::last_write_time(at->path(), error);
      if (error) break;
      state.first = std::max(state.first, changed);
      ++state.second;
    }
  }
  return state;
}

constexpr size_t kb_per_mb = 1024;

}  // namespace

Result<std::unique_ptr<Rules>> Rules::load(RulesOptions options) {
  auto rules = std::unique_ptr<Rules>(new Rules(std::move(options)));
  rules->mods_ = TRY(rules->load_mods());
  rules->worker_ = std::thread([self = rules.get()] { self->run_jobs(); });
  return rules;
}

Rules::~Rules() {
  {
    const std::scoped_lock lock(mutex_);
    stops_ = true;
  }
  wake_.notify_all();
  if (worker_.joinable()) worker_.join();
}

Result<Rules::Mods> Rules::load_mods() {
  Mods mods;
  for (const std::string& folder : options_.folders) {
    ModOptions mod;
    mod.folder = folder;
    mod.memory_bytes = size_t{options_.memory_mb} * kb_per_mb * kb_per_mb;
    mod.tick_rate_hz = options_.tick_rate_hz;
    mod.told = [this](const std::string& line, bool is_fault) { told(line, is_fault); };
    auto loaded = TRY(Mod::load(std::move(mod)));
    const auto is_same = [&](const auto& other) { return other->name() == loaded->name(); };
    if (std::ranges::any_of(mods, is_same))
      return fail("two folders of rules have the name " + loaded->name() + ": rename one");
    mods.push_back(std::move(loaded));
  }
  return mods;
}

Result<void> Rules::reload() {
  auto mods = TRY(load_mods());
  const std::scoped_lock lock(mutex_);
  next_mods_ = std::make_shared<Mods>(std::move(mods));
  return {};
}

void Rules::told(const std::string& line, bool is_fault) {
  {
    const std::scoped_lock lock(mutex_);
    lines_.push_back(line);
    if (lines_.size() > limits::lines_kept) lines_.pop_front();
  }
  if (options_.log) options_.log(line, is_fault);
}

void Rules::run_jobs() {
  auto seen = state_of(options_.folders);
  const std::chrono::duration<double> period(limits::watch_period_s);
  std::unique_lock lock(mutex_);
  while (!stops_) {
    wake_.wait_for(lock, period, [this] { return stops_ || !reloads_.empty(); });
    const std::vector<Control> asked = std::exchange(reloads_, {});
    lock.unlock();
    const auto now = options_.watch ? state_of(options_.folders) : seen;
    const bool changed = std::exchange(seen, now) != now;
    for (const Control& control : asked) reload_for(control);
    if (changed && asked.empty()) {
      const Result<void> done = reload();
      told(
          done ? "rules were read again: a file changed" : "rules stay as they were: " + done.error().message,
          !done);
    }
    lock.lock();
  }
}

void Rules::reload_for(const Control& control) {
  const Result<void> done = reload();
  told(done ? "rules were read again" : "rules stay as they were: " + done.error().message, !done);
  answer(control,
         done ? "rules were read again\n" : "error: rules stay as they were: " + done.error().message);
}

void Rules::answer(const Control& control, std::string text) {
  HostActs acts;
  {
    const std::scoped_lock lock(mutex_);
    acts = acts_;
  }
  AdminListMessage list;
  list.request = control.request;
  list.text = std::move(text);
  acts.send(control.session, std::move(list));
}

void Rules::start(const HostActs& acts) {
  const std::scoped_lock lock(mutex_);
  acts_ = acts;
}

bool Rules::hear_line(const SaidMessage& line) {
  const std::scoped_lock lock(mutex_);
  if (!hears_lines_) return true;
  if (inbox_.said.size() < limits::heard_waiting_max) inbox_.said.push_back(line);
  return false;
}

void Rules::join(const JoinedPerson& person) {
  const std::scoped_lock lock(mutex_);
  inbox_.joined.push_back(person);
}

void Rules::leave(uint64_t session) {
  const std::scoped_lock lock(mutex_);
  inbox_.left.push_back(session);
}

void Rules::hear(uint64_t session, const ChannelData& data) {
  const std::scoped_lock lock(mutex_);
  if (inbox_.heard.size() < limits::heard_waiting_max) inbox_.heard.emplace_back(session, data);
}

void Rules::control(uint64_t session, uint32_t request, const ControlRulesRequest& wish) {
  {
    const std::scoped_lock lock(mutex_);
    auto& waiting = wish.control == RulesControl::reload ? reloads_ : inbox_.controls;
    if (waiting.size() < limits::heard_waiting_max) waiting.push_back({session, request, wish});
  }
  wake_.notify_all();
}

}  // namespace scree
