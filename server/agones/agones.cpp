#include "server/agones/agones.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <optional>
#include <pthread.h>
#include <utility>

#include "server/agones/limits.h"
#include "server/agones/side_car.h"
#include "server/log/log.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

/// Whether Kubernetes takes it as the value of a label.
bool is_label(const std::string& text) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return !text.empty() && text.size() <= 63 && is_letter(text.front()) && is_letter(text.back()) &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || c == '-' || c == '_' || c == '.'; });
}

/// Agones' thread: what the side-car was told, and what it is to be told next.
class Telling {
 public:
  explicit Telling(const AgonesConfig& config) : config_(config), side_car_(config.port) {}

  /// Tells what is new, up to the first request that fails: a side-car that does not answer costs one wait.
  /// Afterwards it is called again within seconds_to_next().
  void tell(bool ready, bool is_alive, uint32_t people, uint32_t seats) {
    failed_ =
        !(tell_life(is_alive) && (!ready || (tell_start() && count(people, seats) && tell_use(people))));
  }
  void end() { note(side_car_.shut_down()); }
  double seconds_to_next() const { return failed_ ? limits::agones_retry_s : limits::agones_health_s; }

 private:
  bool tell_life(bool is_alive) {
    const double now_s = steady_now_s();
    if (!is_alive || now_s < health_at_s_) return true;
    if (!note(side_car_.health())) return false;
    health_at_s_ = now_s + limits::agones_health_s;
    return true;
  }
  bool tell_start() {
    is_ready_ = is_ready_ || note(side_car_.ready());
    is_labelled_ = is_labelled_ || (is_ready_ && label());
    return is_labelled_;
  }
  bool label() {
    return note(side_car_.set_label("scree-version", SCREE_VERSION)) &&
           note(side_car_.set_label("scree-part", config_.edge ? "edge" : "world")) &&
           (!is_label(config_.world) || note(side_car_.set_label("scree-world", config_.world)));
  }
  bool count(uint32_t people, uint32_t seats) {
    seats = std::max(seats, people);  // where the setting is lowered, nobody is sent away, and Agones takes
                                      // no more than the capacity
    if (!has_counter_ || counted_ == std::pair(people, seats)) return true;
    const Result<bool> counted = side_car_.set_counter("players", people, seats);
    if (!note(counted)) return false;
    counted_ = {people, seats};
    has_counter_ = *counted;
    if (!has_counter_)
      log_of(LogPart::app).info("Agones: the fleet has no counter \"players\": nobody is counted there");
    return true;
  }
  bool tell_use(uint32_t people) {
    if ((people > 0) == is_taken_) return true;
    if (!note(is_taken_ ? leave() : side_car_.allocate())) return false;
    is_taken_ = !is_taken_;
    return true;
  }
  Result<void> leave() { return config_.kept_s == 0 ? side_car_.ready() : side_car_.reserve(config_.kept_s); }

  /// Says once that the side-car does not do what it is told, and that it does again.
  template <typename Value>
  bool note(const Result<Value>& told) {
    if (told && is_away_) log_of(LogPart::app).info("Agones' side-car answers again");
    if (!told && !is_away_)
      log_of(LogPart::app).warn("Agones' side-car is not told, and is tried again: {}", told.error().message);
    is_away_ = !told;
    return told.has_value();
  }

  const AgonesConfig& config_;
  SideCar side_car_;
  double health_at_s_ = 0.0;
  bool failed_ = false, is_away_ = false;
  bool is_ready_ = false, is_labelled_ = false, is_taken_ = false, has_counter_ = true;
  std::optional<std::pair<uint32_t, uint32_t>> counted_;
};

}  // namespace

Agones::Agones(AgonesConfig config) : config_(std::move(config)), thread_([this] { run(); }) {}

Agones::~Agones() {
  shut_down();
}

void Agones::ready() {
  const std::scoped_lock lock(mutex_);
  known_.ready = true;
  changed_.notify_one();
}

void Agones::pulse(uint32_t people, uint32_t seats) {
  const std::scoped_lock lock(mutex_);
  ++known_.pulses;
  known_.people = people;
  known_.seats = seats;
  changed_.notify_one();
}

void Agones::shut_down() {
  {
    const std::scoped_lock lock(mutex_);
    known_.ends = true;
    changed_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

Agones::Known Agones::await(double seconds, const Known& known) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
    return known_.ends || known_.ready != known.ready || known_.pulses != known.pulses;
  });
  return known_;
}

void Agones::run() {
  ::pthread_setname_np(::pthread_self(), "agones");
  Telling telling(config_);
  Known known;
  for (double wait_s = limits::agones_health_s; !known.ends; wait_s = telling.seconds_to_next()) {
    const Known now = await(wait_s, known);
    if (!now.ends) telling.tell(now.ready, now.pulses != known.pulses, now.people, now.seats);
    known = now;
  }
  telling.end();
}

}  // namespace scree
