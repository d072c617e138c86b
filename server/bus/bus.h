// A connection to a bus: a server of NATS, which carries messages by subject to those who listen, and keeps
// those of a stream. Its library is seen by bus.cpp alone.
//
// The connection is made again by itself, from the start on: a bus that is away is no error, is_connected()
// says so. Calls wait at most limits::bus_answer_ms. All functions may be called from any thread; handlers
// run on threads of the library, those of one subscription one after the other.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct BusConfig {
  std::string url;               ///< nats://[USER:PASSWORD@]HOST[:PORT], or tls://…
  std::string credentials_path;  ///< file with the user's token and key, as `nsc` makes it; empty: none
  std::string ca_path;           ///< certificates that are trusted beside the system's; empty: none
  std::string name;              ///< of this program, for who looks at the server of NATS
};

/// A message of a stream, and its place in it, from 1 on.
struct KeptMessage {
  uint64_t sequence = 0;
  std::string subject;
  std::vector<uint8_t> bytes;
};

struct BusStreamConfig {
  std::string name;        ///< letters, digits, - and _
  std::string subjects;    ///< a pattern of NATS
  uint64_t bytes_max = 0;  ///< above: the oldest messages go
  bool in_memory = false;  ///< else in a file of the server of NATS
};

/// Whether the name may be that of a world or of an edge on the bus: 1 to limits::bus_name_bytes_max of a-z,
/// 0-9, - and _.
bool is_bus_name(std::string_view name);
/// The address as it may be shown: without the user and the password.
std::string without_password(const std::string& url);

/// Ends with its object: the handler does not run any more when the destructor returns. The handler must not
/// destroy its own subscription.
class BusSubscription {
 public:
  struct Handler;
  BusSubscription(void* subscription, std::shared_ptr<Handler> handler);
  ~BusSubscription();
  BusSubscription(const BusSubscription&) = delete;
  BusSubscription& operator=(const BusSubscription&) = delete;

 private:
  void* subscription_;
  std::shared_ptr<Handler> handler_;
};

class Bus {
 public:
  struct State;
  using Handler = std::function<void(const std::string& subject, std::span<const uint8_t> bytes)>;

  /// An error: the configuration cannot be used. A bus that does not answer is none.
  static Result<std::shared_ptr<Bus>> connect(const BusConfig& config);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  bool is_connected() const;
  /// How often the connection was made: while the number stays, no message of it was lost by a lost link.
  uint64_t connections() const;
  /// Why there is no connection, or what went wrong last; empty: nothing did.
  std::string fault() const;
  /// Bytes of a message at most, as the server of NATS says; 0 before the first connection.
  size_t payload_max() const;

  /// Sends to those who listen now. An error where there is no connection.
  Result<void> send(const std::string& subject, std::span<const uint8_t> bytes);
  /// `subject` may be a pattern. It goes on after a lost connection.
  Result<std::unique_ptr<BusSubscription>> subscribe(const std::string& subject, Handler handler);

  /// Makes the stream, or gives the one that is there these bounds.
  Result<void> open_stream(const BusStreamConfig& config);
  /// Sends a message of a subject of a stream, and waits until that has it; its place.
  Result<uint64_t> keep(const std::string& subject, std::span<const uint8_t> bytes);
  /// The same without waiting. What is not kept after all is counted by keep_failures(), except where the
  /// connection was lost (connections()).
  Result<void> keep_later(const std::string& subject, std::span<const uint8_t> bytes);
  uint64_t keep_failures() const;

  /// The message in that place; nothing where there is none (any more).
  Result<std::optional<KeptMessage>> kept(const std::string& stream, uint64_t sequence);
  /// The last one of a subject.
  Result<std::optional<KeptMessage>> last_kept(const std::string& stream, const std::string& subject);

 private:
  explicit Bus(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

}  // namespace scree
