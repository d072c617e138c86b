#include "client/bot/bot.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <thread>

#include "client/bot/limits.h"
#include "client/bot/tally.h"
#include "client/cache/join_server.h"
#include "client/connection/come_again.h"
#include "client/session/join_and_wait.h"
#include "proto/spawn_direction.h"
#include "shared/base/near_name.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr auto step_wait = std::chrono::milliseconds(10);

double ms_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

Bot::Bot(BotConfig config, Log log)
    : config_(std::move(config)),
      log_(std::move(log)),
      carver_(config_.carver, config_.random_seed),
      eye_m_(config_.carver.centre_m),
      client_(std::make_unique<ServerConnector>(config_, std::chrono::milliseconds(limits::bot_connect_ms)),
              {.cache = config_.cache}) {
  report_.server = endpoint_text(config_.host, config_.port);
}

/// A hostile server cannot fill the disk.
void Bot::log(std::string_view kind, const std::string& line) {
  if (!log_) return;
  if (const auto more = log_limit_.admit(kind, steady_now_s())) log_(line + *more);
}

Result<void> Bot::join() {
  started_ = Clock::now();
  const auto joined = connect();
  if (joined) return {};
  report_.failure = joined.error().message;
  report_.refusal = joined.error().refusal;
  return tl::unexpected(joined.error());
}

tl::expected<void, ConnectionEnd> Bot::connect() {
  HelloMessage hello{protocol_version, "scree-bot", eye_m_, config_.interest_radius_m};
  hello.name = config_.name;
  hello.meets = !config_.name.empty() || !config_.lines.empty() || config_.hears_s > 0.0;
  hello.at_spawn = config_.at_spawn && !stands_;
  TRY(join_and_wait(client_, hello));
  report_.welcome = *client_.welcome();
  if (hello.at_spawn && report_.welcome.spawn) begin_at(*report_.welcome.spawn);
  repairs_asked_ = 0;
  ++report_.connections;
  stand_on_ground();
  for (const std::string& line : config_.lines) client_.send(SayMessage{line});
  for (const ChannelData& data : config_.messages) client_.send(ChannelMessage{data});
  log("connected", fmt::format("connected to {} at tick {} as {}", report_.server, report_.welcome.tick,
                               name_of(report_.welcome.role)));
  return {};
}

/// The ground that a visitor sees in the middle distance.
void Bot::begin_at(const Spawn& spawn) {
  CarverConfig carving = config_.carver;
  carving.centre_m = ahead_of(spawn, limits::bot_ahead_m);
  carver_ = Carver(carving, config_.random_seed);
  set_interest(carving.centre_m, config_.interest_radius_m);
}

/// Once, when the ground is known: as a rule from the welcome on, else when its tiles have come.
void Bot::stand_on_ground() {
  if (stands_ || !client_.rejoin().has_near_ground()) return;
  stands_ = true;
  const float ground_m = ground_height_m(client_.mirror()->terrain(), eye_m_.x, eye_m_.z);
  set_interest({eye_m_.x, ground_m, eye_m_.z}, config_.interest_radius_m);
}

/// Adds the counts of the connection that was lost to the report.
void Bot::count_connection() {
  report_.seen += client_.mirror()->counters();
  report_.bytes_sent += client_.counters().sent_bytes;
  for (const auto& [number, request] : requests_)
    ++(request.kind == Kind::carve ? report_.carves_lost : moves(request.kind).lost);
  requests_.clear();
  unseen_.clear();
  foot_.reset();
}

Result<void> Bot::reconnect(const ConnectionEnd& end) {
  count_connection();
  ConnectionEnd last = end;
  for (uint32_t tries = 1; report_.connections + tries - 1 <= config_.reconnects_max; ++tries) {
    if (!may_come_again(last.refusal)) break;
    log("lost", fmt::format("connection lost ({}): trying again", last.message));
    std::this_thread::sleep_for(std::chrono::milliseconds(limits::bot_retry_ms * tries));
    const auto connected = connect();
    if (connected) return {};
    last = connected.error();
  }
  report_.failure = fmt::format("gave up after {} connections: {}", report_.connections, last.message);
  report_.refusal = last.refusal;
  return fail(report_.failure);
}

Result<void> Bot::step(std::chrono::milliseconds wait) {
  if (!client_.connected()) return fail("the bot has not joined, or has given up");
  client_.wait(wait);
  client_.poll(steady_now_s());
  while (const std::optional<Client::Event> event = client_.next()) {
    if (const auto* lost = std::get_if<Client::Lost>(&*event)) return reconnect(lost->end);
    if (const auto* applied = std::get_if<Client::Applied>(&*event)) receive(*applied);
  }
  const Result<bool> may_paint = knows_paint();
  if (!may_paint) report_.failure = may_paint.error().message;
  TRY(may_paint);
  if (*may_paint) ask(Clock::now());
  if (config_.walks > 0) walk(Clock::now());
  return {};
}

/// Whether the material to paint with is known, or none is wanted. An error: this world has none of that
/// name.
Result<bool> Bot::knows_paint() const {
  if (config_.paint.empty()) return true;
  const ReceivedContent& content = client_.rejoin().content();
  if (!content.is_current()) {
    if (!content.fault().empty()) return fail(content.fault() + " (--paint)");
    if (!report_.welcome.palette) return fail("this server says no materials (--paint)");
    return false;
  }
  const Palette& palette = *content.palette();
  if (palette.named(config_.paint)) return true;
  const std::vector<std::string_view> names = palette.names();
  return fail(fmt::format("this world has no material '{}'{} (--paint); it has {}", config_.paint,
                          did_you_mean(config_.paint, std::vector<std::string>(names.begin(), names.end()),
                                       limits::bot_mistyped_max),
                          fmt::join(names, ", ")));
}

void Bot::receive(const Client::Applied& applied) {
  const Received& received = applied.received;
  tally(received, report_);
  const Mirror& mirror = *client_.mirror();
  const uint64_t repairs = mirror.counters().repairs_asked - repairs_asked_;
  if (repairs != 0)
    log("check", fmt::format("a check failed at tick {}: asking for {} chunks", mirror.tick(), repairs));
  repairs_asked_ += repairs;
  std::visit(Overloaded{[&](const FrameMessage& frame) { receive_frame(frame, received.arrived); },
                        [&](const ReplyMessage& reply) { receive_reply(reply, received.arrived); },
                        [&](const StatusMessage& status) { receive_status(status); },
                        [](const auto&) {}},  // the mirror has applied it
             received.message);
  receive_rules(received.message);
}

void Bot::receive_frame(const FrameMessage& frame, Clock::time_point arrived) {
  if (first_frame_ == 0 || frame.tick < first_frame_) {
    first_frame_ = frame.tick;
    first_frame_at_ = arrived;
  }
  last_frame_at_ = arrived;
  for (const Operation& operation : frame.operations) {
    const auto* carve = std::get_if<CarveOperation>(&operation);
    if (carve == nullptr) continue;
    const auto own = unseen_.find(carve->random_seed);
    if (own == unseen_.end()) continue;
    report_.edit_latencies_ms.push_back(ms_between(own->second, arrived));
    unseen_.erase(own);
  }
}

void Bot::receive_reply(const ReplyMessage& reply, Clock::time_point arrived) {
  const auto request = requests_.find(reply.request);
  if (request == requests_.end()) {
    if (reply.refusal.empty()) return;
    ++report_.walks.refused;
    // What no wait mends; else it asks again.
    if (reply.refusal_name == "persons_fly" || reply.refusal_name == "role")
      cannot_stand_ = fmt::format("the bot cannot stand ({}): {}", reply.refusal_name, reply.refusal);
    log("walk refused",
        fmt::format("on foot, {} was refused ({}): {}", reply.request, reply.refusal_name, reply.refusal));
    return;
  }
  const RequestLatency latency{ms_between(request->second.sent, arrived), reply.latency};
  report_.reply_latencies_ms.push_back(latency.total_ms);
  report_.network_latencies_ms.push_back(latency.network_ms());
  for (size_t i = 0; i < latency_stages.size(); ++i)
    report_.server_latencies_ms[i].push_back(static_cast<double>(latency.server.*latency_stages[i].us) /
                                             1000.0);
  if (!reply.refusal.empty()) unseen_.erase(request->second.random_seed);
  count(request->second.kind, reply);
  requests_.erase(request);
  if (all_asked() && requests_.empty()) log("answered", "all requests are answered");
}

void Bot::receive_status(const StatusMessage& status) {
  report_.carves_saved +=
      static_cast<uint32_t>(std::erase_if(unsaved_, [&](Tick tick) { return tick <= status.saved_tick; }));
  knows_store_ = report_.digs.asked == config_.digs && report_.digs.waiting() == 0;
  const Mirror& mirror = *client_.mirror();
  if (status.tick == mirror.tick()) {
    HashComparison& hash = report_.hash;
    hash = {hash.compared + 1, mirror.field().hash() == status.field_hash, status.tick, mirror.field().hash(),
            status.field_hash};
  }
  const bool at_rest = status.pieces == 0 && mirror.pieces().empty();
  const bool was_settled = report_.settled;
  report_.settled = all_done() && at_rest && rest_hash_ == status.field_hash;
  rest_hash_ = at_rest ? std::optional(status.field_hash) : std::nullopt;
  if (report_.settled && !was_settled) log("settled", fmt::format("settled at tick {}", status.tick));
  if (!scripted_work_done()) return;
  ++final_statuses_;
  compared_ = report_.hash.equal || final_statuses_ >= limits::bot_final_statuses_max;
}

bool Bot::finished() const {
  const bool handshake_only = config_.hears_s == 0.0 &&
                              config_.carves + config_.digs + config_.places + config_.walks == 0 &&
                              !config_.linger && !config_.check_hash;
  return scripted_work_done() && (handshake_only || compared_);
}

void Bot::set_interest(glm::vec3 eye_m, float radius_m) {
  eye_m_ = eye_m;
  config_.interest_radius_m = radius_m;
  if (client_.connected()) client_.follow(eye_m, radius_m);
}

BotReport Bot::run() {
  Result<void> going = join();
  while (going && !finished()) {
    going = step(step_wait);
    if (!cannot_stand_.empty()) {
      report_.failure = cannot_stand_;
      break;
    }
    if (going && ms_between(started_, Clock::now()) > config_.timeout_s * 1000.0) {
      report_.failure =
          fmt::format("not finished within {} s (--timeout): {} requests unanswered, {} pieces alive",
                      config_.timeout_s, requests_.size(), report_.status.pieces);
      break;
    }
  }
  if (report_.failure.empty() && config_.check_hash && !report_.hash.equal)
    report_.failure =
        "the hash of this client's edits is not the server's (does the interest cover them all?)";
  return report();
}

BotReport Bot::report() const {
  BotReport report = report_;
  report.duration_s = ms_between(started_, Clock::now()) / 1000.0;
  if (!client_.connected()) return report;
  const Mirror& mirror = *client_.mirror();
  report.seen += mirror.counters();
  report.bytes_sent += client_.counters().sent_bytes;
  report.pieces_alive = mirror.pieces().size();
  report.chunks_held = mirror.held_chunks().size();
  report.signs = mirror.signs();
  for (const MaterialMass& one : mirror.carried())
    report.carried[mirror.palette()->row_or_first(one.material).name] += one.mass;
  const double seconds = ms_between(first_frame_at_, last_frame_at_) / 1000.0;
  if (seconds > 0.0) report.ticks_per_s = static_cast<double>(mirror.tick() - first_frame_) / seconds;
  return report;
}

}  // namespace scree
