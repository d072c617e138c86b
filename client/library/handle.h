// What stands behind the handles of scree/client.h. One thread at a time uses a client and its meshers.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/library/array_block.h"
#include "client/library/include/scree/client.h"
#include "client/session/attempts.h"
#include "client/session/client.h"
#include "client/session/walk_prediction.h"

namespace scree {

/// An event with what it points to.
struct ToldEvent {
  scree_event event{};
  std::string name{};
  std::string text{};
  std::vector<uint8_t> data{};
  std::vector<int32_t> coords{};

  explicit ToldEvent(uint32_t kind) { event.kind = kind; }
  /// The event, whose pointers hold as long as this does not move.
  const scree_event& view();
};

/// Who waits for the reply to a request; without a function, the reply is an event.
struct ReplyWish {
  scree_reply_function reply = nullptr;
  void* user = nullptr;
};

/// A server's socket, as this build has them; or a page's. The error says which option cannot be.
Result<std::unique_ptr<Connector>> make_connector(const scree_options& options);

}  // namespace scree

struct scree_client;

namespace scree {

inline constexpr const char* no_call_from_callbacks =
    "this is no call for a function that gets a reply: it comes within scree_client_next()";

/// Why a server could not even read the request, and would end the connection; empty: it can.
std::string fault_of(const Request& request);
/// Why no client can have these options; empty: it can.
std::string fault_of(const scree_options& options);
scree_status status_of(scree_client& client);
/// Writes as many bodies as there is room for, and returns how many there are. Needs a mirror.
size_t bodies_of(const scree_client& client, double tick, scree_body* to, size_t room);

}  // namespace scree

struct scree_client {
  scree_client(std::unique_ptr<scree::Connector> connector, const scree_options& options);
  ~scree_client();
  scree_client(const scree_client&) = delete;
  scree_client& operator=(const scree_client&) = delete;

  /// What happens between two waits: messages, attempts, timers.
  void poll(uint32_t wait_ms);
  /// The next event; null: none until the next poll. It holds until the next call.
  const scree_event* next();
  /// Within a function of the program's; and whether that has destroyed the client.
  bool is_calling() const { return calling_; }
  bool has_ended() const { return ended_; }
  void end_after_call() { ended_ = true; }
  void follow(glm::vec3 eye_m, float radius_m);
  scree_result step_on_foot(glm::vec3 go, uint32_t buttons, glm::vec3 look);
  bool knows(glm::vec3 place_m) const;
  /// The number that the reply will have.
  uint32_t ask(const scree::Request& request, const scree::ReplyWish& wish);

  scree::ArraySource arrays;
  scree::Client client;
  uint32_t flags;
  std::optional<scree::WalkPrediction> walk{};
  std::set<scree_mesher*> meshers{};

 private:
  void join_if_due(double now_s);
  void tell(const scree::Client::Event& event);
  void tell(const scree::Client::Joined& joined);
  void tell(const scree::Client::Applied& applied);
  void tell(const scree::Client::Lost& lost);
  void tell(const scree::MirrorChanges& changes);
  void settle();
  void note(const scree::MirrorChanges& changes);
  bool hand_over(scree::ToldEvent& reply);

  scree::HelloMessage hello_;
  float contacts_j_;
  scree::Attempts attempts_;
  std::deque<scree::ToldEvent> told_;  ///< not taken yet
  std::optional<scree::ToldEvent> taken_;
  std::map<uint32_t, scree::ReplyWish> wishes_;  ///< by number: not answered
  /// The last number that was given. Inputs on foot have the numbers below, and a refused one is a reply,
  /// too.
  uint32_t requests_ = first_request - 1;
  static constexpr uint32_t first_request = 1U << 31U;
  bool settled_ = true;  ///< since the last poll
  bool tried_ = false;   ///< an attempt was begun
  bool calling_ = false, ended_ = false;
};
