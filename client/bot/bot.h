// A client without a window: carves, digs and places by script, on foot or not, follows the results, and
// reports.
//
// step() does all work on the caller's thread; only the socket has another thread. After a lost connection
// the bot connects again, a bounded number of times, with a new mirror, unless the server refused it for a
// reason that stays (come_again.h). Not thread-safe.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>

#include "client/bot/carver.h"
#include "client/bot/place_plan.h"
#include "client/bot/random_walk.h"
#include "client/bot/report.h"
#include "client/connection/connection.h"
#include "client/session/client.h"
#include "client/session/walk_prediction.h"
#include "shared/base/log_limit.h"

namespace scree {

struct BotConfig : ServerEndpoint {
  std::string name{};                     ///< that of its person; empty: it has none
  uint32_t carves = 20;                   ///< 0: the bot ends after the handshake and one frame
  uint32_t digs = 0;                      ///< after the carves
  uint32_t places = 0;                    ///< after the digs, out of what the bot carries
  uint32_t walks = 0;                     ///< on foot, beside all of these; 0: the bot flies
  std::optional<WalkSquare> walk_square;  ///< in which it walks; nothing: anywhere
  std::vector<std::string> lines;     ///< that it says to everybody, once it has joined; at each connection
  std::vector<ChannelData> messages;  ///< likewise, to the server's rules
  double hears_s = 0.0;               ///< it stays so long for what the rules have for it
  uint64_t random_seed = 1;
  double rate_hz = 2.0;  ///< carves, digs and places a second; 0: as fast as replies come
  CarverConfig carver;
  std::optional<glm::vec3> place_m;  ///< middle of the square in which it places; y is found from the ground
  bool at_spawn = false;  ///< carve before the eyes of who begins in the world, not around carver.centre_m
  std::string paint;      ///< material with which the rock of each carve is painted first; empty: none
  float interest_radius_m = 96.0F;  ///< around the carver's centre
  bool linger = false;              ///< stay until no piece is left and the field is at rest
  bool check_hash = false;          ///< fail unless the hash of all edits equals the server's in the end
  double timeout_s = 300.0;
  uint32_t reconnects_max = 5;
  CacheConfig cache{};  ///< without a bound: it comes back with nothing
};

class Bot {
 public:
  using Log = std::function<void(const std::string&)>;

  explicit Bot(BotConfig config, Log log = {});

  /// Makes the first connection.
  Result<void> join();
  /// Waits up to `wait` for messages, applies them, and sends the requests that are due. An error: the bot
  /// has given up.
  Result<void> step(std::chrono::milliseconds wait);
  /// Whether all requests are answered, the terrain is settled (with linger), and the hashes are compared.
  bool finished() const;
  /// Calls join(), and step() until finished or out of time; the report holds the failure.
  BotReport run();

  BotReport report() const;

  /// Moves the bot's interest.
  void set_interest(glm::vec3 eye_m, float radius_m);
  /// Nothing between a lost connection and the next.
  Mirror* mirror() { return client_.connected() ? client_.mirror() : nullptr; }
  /// For tests: to cut it, or to pause its reading.
  Connection* connection() { return static_cast<Connection*>(client_.channel()); }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Kind : uint8_t { carve, dig, place };
  struct Request {
    Clock::time_point sent;
    Kind kind = Kind::carve;
    uint32_t random_seed = 0;  ///< of a carve
  };

  tl::expected<void, ConnectionEnd> connect();
  Result<void> reconnect(const ConnectionEnd& end);
  void begin_at(const Spawn& spawn);
  void stand_on_ground();
  void count_connection();
  void receive(const Client::Applied& applied);
  void receive_reply(const ReplyMessage& reply, Clock::time_point arrived);
  void receive_frame(const FrameMessage& frame, Clock::time_point arrived);
  void receive_status(const StatusMessage& status);
  void receive_rules(const ServerMessage& message);
  Result<bool> knows_paint() const;
  void ask(Clock::time_point now);
  std::optional<Kind> next_kind() const;
  bool may_edit() const;
  bool all_asked() const;
  void carve(Clock::time_point now);
  void dig(Clock::time_point now);
  void place(Clock::time_point now);
  uint32_t number_of(Kind kind);
  MoveReport& moves(Kind kind);
  void count(Kind kind, const ReplyMessage& reply);
  Carver::Target aim(Kind kind);
  Carver::Target aim_apart(float apart_m);
  float reach_m() const;
  void go_near(glm::vec3 place_m);
  void walk(Clock::time_point now);
  bool walked() const { return config_.walks == 0 || (walk_ && walk_->is_over()); }
  bool all_done() const { return first_frame_ != 0 && walked() && all_asked() && requests_.empty(); }
  bool heard_enough() const;
  bool scripted_work_done() const {
    return all_done() && heard_enough() && (!config_.linger || report_.settled);
  }
  void log(std::string_view kind, const std::string& line);

  BotConfig config_;
  Log log_;
  LogLimit log_limit_;
  Carver carver_;
  glm::vec3 eye_m_;
  bool stands_ = false;  ///< the interest is at the ground's height
  Client client_;
  std::unordered_map<uint32_t, Request> requests_;          ///< by request number: not answered yet
  std::vector<Tick> unsaved_;                               ///< of accepted carves that may still be lost
  std::unordered_map<uint32_t, Clock::time_point> unseen_;  ///< by random seed: not seen applied yet
  Clock::time_point started_;
  Clock::time_point first_frame_at_;
  Clock::time_point last_frame_at_;
  Tick first_frame_ = 0;
  bool knows_store_ = false;           ///< a status has come since all digs were answered
  std::optional<PlacePlan> places_;    ///< since the first place
  std::optional<uint64_t> rest_hash_;  ///< of the field when no piece was left, at the last status
  std::optional<RandomWalk> walk_;
  std::optional<WalkPrediction> foot_;  ///< of this connection
  std::string cannot_stand_;            ///< why the server never lets it; empty: it may
  Clock::time_point walked_to_;         ///< of the last tick on foot
  Clock::time_point asked_to_stand_;
  uint64_t repairs_asked_ = 0;   ///< chunks, by this connection
  uint32_t final_statuses_ = 0;  ///< since all scripted work was done
  bool compared_ = false;        ///< the final comparison of hashes is done
  BotReport report_;             ///< of past connections, and totals
};

}  // namespace scree
