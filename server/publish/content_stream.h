// Answers requests for content (proto/content.proto): the palette's bytes as it stands, the images that its
// rows name, and the models of props. What waits is bounded (limits::contents_wanted_max a session), and so
// are the bytes of a tick, of each session and of all. Parties take turns, and the sessions of a party share
// its turns (SessionTurns). Nothing is sent to a session twice. A palette that has changed waits no longer:
// the session is told of the next one, and asks for that. No sockets and no clock. Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "proto/messages.h"
#include "server/publish/session_turns.h"
#include "server/publish/shared_bytes.h"
#include "server/world/material_settings.h"

namespace scree {

/// The bytes of images, or of models, by their SHA-256.
using ContentFiles = std::map<Digest, std::vector<uint8_t>>;

class ContentStream {
 public:
  /// `own`: the palette without changed numbers; null: clients are told of none. `images` and `models` may be
  /// null.
  ContentStream(std::shared_ptr<const Palette> own, const std::shared_ptr<const ContentFiles>& images,
                const std::shared_ptr<const ContentFiles>& models = nullptr);

  /// SHA-256 of the palette's bytes; nothing where there is none.
  const std::optional<Digest>& palette() const { return digest_; }
  /// Takes the settings as they stand; true when the palette is another one from now on.
  bool take_settings(const SettingValues& settings);

  /// Queues what the client wants. False, and nothing is queued, when more than limits::contents_wanted_max
  /// would wait.
  [[nodiscard]] bool ask(uint64_t session, uint64_t party, const AskContentMessage& request);
  void leave(uint64_t session);
  size_t waiting(uint64_t session) const;

  /// Answers as much as a tick may: calls send(session, bytes). `room(session)`: bytes that the session may
  /// get at once; 0: nothing in this tick. send() is false when that is the last one of this tick for the
  /// session.
  void serve(const std::function<size_t(uint64_t)>& room,
             const std::function<bool(uint64_t, const SharedBytes&)>& send);

 private:
  using Bytes = std::shared_ptr<const std::vector<uint8_t>>;
  struct Queue {
    std::deque<Digest> wanted;
    Bytes bytes{};  ///< of the first one, once it is begun: it stays until all parts are sent
    size_t sent = 0;
    int64_t credit_bytes = 0;
    size_t room = 0;  ///< within serve()
  };
  Bytes find(const Digest& digest) const;
  /// Drops palettes of before from what waits, but for one that is begun.
  void drop_former(Queue& queue) const;
  static SharedBytes part_of(Queue& queue);
  SharedBytes next_part(uint64_t session, Queue& queue);

  std::shared_ptr<const Palette> own_;
  std::map<Digest, Bytes> files_;
  std::optional<Digest> digest_;
  std::set<Digest> former_;  ///< palettes of before
  Bytes palette_;
  std::map<uint64_t, Queue> queues_;
  std::map<uint64_t, std::set<Digest>> sent_;  ///< of what is there
  SessionTurns turns_;
};

}  // namespace scree
