// A client without drawing and sound: it joins a server, keeps a mirror of the server's world up to date, and
// sends its owner's requests. Every program of ours that is a client of a world has one of these.
//
// Use: poll() once a frame, or after each wait(); then next() until it returns nothing. An event is told when
// the mirror is as of that event, before anything newer is applied. The client answers the server by itself:
// it acknowledges frames, asks for repairs, for tiles of the ground and for the palette, and offers the
// chunks that it has kept (client/cache/rejoin.h). It never joins by itself: after Lost, its owner decides.
//
// Threads: one at a time; the connector may have more of its own. Time is an argument: seconds of
// std::chrono::steady_clock, by which messages are stamped when they arrive. Lengths are in metres. A
// server that sends nonsense causes Lost, and nothing worse.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "client/cache/connector.h"
#include "client/cache/rejoin.h"
#include "client/mirror/mirror.h"
#include "client/mirror/predictions.h"
#include "client/session/playback.h"
#include "shared/operation/request.h"

namespace scree {

struct ClientOptions {
  CacheConfig cache{};   ///< of edits and tiles for the next connection; without a bound, none is kept
  bool delayed = false;  ///< messages wait for a clock that runs a little behind the server: drawing needs it
};

class Client {
 public:
  /// The server has welcomed this client: welcome() and mirror() are other ones than before.
  struct Joined {
    bool other_world = false;  ///< than that of the last welcome
  };
  /// A message of the server is applied; owners visit it for replies, statuses, persons and so on.
  struct Applied {
    Received received;
    MirrorChanges changes;  ///< by the message
  };
  /// The attempt to join has failed, or the connection has ended. The mirror stays as it was.
  struct Lost {
    ConnectionEnd end;  ///< with the name of the refusal, if the server refused; see come_again.h
  };
  using Event = std::variant<Joined, Applied, Lost>;

  explicit Client(std::unique_ptr<Connector> connector, const ClientOptions& options = {});
  /// Waits for an attempt that is under way, writes the cache, and says goodbye to the server.
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Begins an attempt; none may be under way. The hello says the place and the radius of interest, or that
  /// the place is the welcome's spawn; ticket and offer are added. An open connection ends as by drop().
  void join(const HelloMessage& hello, double now_s);
  /// Ends the connection without a goodbye, and without an event: the server keeps the session for a while,
  /// and the next attempt resumes it.
  void drop();
  bool joining() const { return connector_->busy(); }
  bool connected() const { return channel_ != nullptr; }

  /// Sleeps until a message, a welcome or an end has come, or the time is over. Returns at once if next() has
  /// more to tell. Only with a connector that has a thread of its own.
  void wait(std::chrono::milliseconds within);
  /// Takes in the messages that have come. `now_s` never runs backwards.
  void poll(double now_s);
  /// Applies the next message that is due, or tells that the client has joined or was lost. Returns
  /// nothing when no more is due. An owner that stops earlier gets the rest after the next poll().
  std::optional<Event> next();

  /// Queues a message; does nothing without a connection.
  void send(const ClientMessage& message);
  /// Sends a carve, a fill or a paint under a number, which the reply returns. With predict(), shows its
  /// probable result at once, where all that the request reads has arrived.
  void ask(const Request& request, uint32_t number, double now_s);
  /// Asks questions about space: at most limits::questions_max, by the newest tick or by that of `as_of`, at
  /// most a quarter of a second back. Returns the number that the AnswerMessage will have, which comes as any
  /// message; 0, and nothing is asked, without a connection. What the mirror has is asked without the server:
  /// Mirror::scene().
  uint32_t query(std::vector<Question> questions, Tick as_of = 0);
  /// Moves the interest. Needs a connection.
  void follow(glm::vec3 eye_m, float radius_m);

  /// Whether requests are shown before the server answers. Then call settle() once a frame, after the events:
  /// it adds the changes by predictions to those by messages.
  void predict(bool on) { predict_ = on; }
  void settle(double now_s, MirrorChanges& changes);
  /// Null before the first welcome.
  const Predictions* predictions() const { return predictions_.get(); }
  /// The mirror's field with the predictions over it, for drawing and aiming. Needs a mirror; valid until the
  /// next call of settle() or ask().
  Field& field() { return predictions_->field(); }

  /// Null before the first welcome; stays when the connection is lost, until the next Joined.
  Mirror* mirror() { return mirror_.get(); }
  const Mirror* mirror() const { return mirror_.get(); }
  /// Null without a connection.
  const WelcomeMessage* welcome() const { return channel_ ? &channel_->welcome() : nullptr; }
  /// Null without a connection.
  ServerChannel* channel() { return channel_.get(); }
  /// The counters of the connection, or of the last one.
  ConnectionCounters counters() const { return channel_ ? channel_->counters() : counters_; }
  /// The place and the radius of interest that the server was last told.
  glm::vec3 eye_m() const { return eye_m_; }
  float radius_m() const { return radius_m_; }
  /// Whether the edits within the interest seem to have arrived: no chunk came for a while.
  bool loaded(double now_s) const;
  /// The tick, with its fraction, at which pieces are to be drawn; for delayed messages.
  double draw_tick(double now_s) { return playback_.draw_tick(now_s); }
  /// The bytes of an image that the palette names; null: it has not come, and perhaps never will.
  ReceivedContent::Bytes content(const Digest& image) const { return rejoin_.content().find(image); }
  /// The bytes of the model of a prop; null: it has not come, and perhaps never will.
  ReceivedContent::Bytes model(const Digest& model) const { return rejoin_.content().find_model(model); }
  /// The cache, the tiles of the ground, and the palette with its images, and models.
  const Rejoin& rejoin() const { return rejoin_; }
  /// The server, for people.
  std::string where() const { return connector_->where(); }

 private:
  Joined begin(std::unique_ptr<ServerChannel> channel);
  Lost lose(const ConnectionEnd& end);
  void receive();
  std::optional<Received> next_due();
  Event apply(Received received);
  void take_content(const ServerMessage& message, MirrorChanges& changes);
  void answer();
  void foresee(const Request& request, uint32_t number, double now_s);

  Rejoin rejoin_;  ///< of the attempt, while one is under way
  std::unique_ptr<Connector> connector_;
  std::unique_ptr<ServerChannel> channel_;
  std::unique_ptr<Mirror> mirror_;
  std::unique_ptr<Predictions> predictions_;  ///< over the mirror
  Playback playback_;                         ///< messages that are not applied yet
  bool delayed_;
  bool predict_ = false;
  bool over_ = false;     ///< the channel is closed and has nothing more
  bool answered_ = true;  ///< since the last poll()
  uint64_t world_ = 0;    ///< of the mirror; 0: none
  uint32_t queries_ = 0;  ///< asked so far
  ConnectionCounters counters_;
  double now_s_ = 0.0;
  glm::vec3 eye_m_{0.0F};
  float radius_m_ = 0.0F;
  Tick acknowledged_ = 0;
  double next_ack_s_ = 0.0;
  double last_chunk_s_ = 0.0;
};

}  // namespace scree
