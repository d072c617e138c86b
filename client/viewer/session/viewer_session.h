// The viewer's session with a server: a client (client/session/client.h) that joins again after a lost
// connection, reports the camera's place and cursor, and knows the other persons. Without a connection, the
// last world stays visible. A refusal that cannot change by itself (come_again.h) is shown, and not tried
// against.
//
// Main thread only. Time comes in as seconds of std::chrono::steady_clock.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "client/render/scene/draw_method.h"
#include "client/session/attempts.h"
#include "client/session/client.h"
#include "client/session/walk_prediction.h"
#include "client/viewer/figures/figures.h"
#include "client/viewer/input/tool.h"
#include "client/viewer/session/conversation.h"
#include "client/viewer/session/pace.h"
#include "client/viewer/session/timeline.h"
#include "shared/base/timing.h"
#include "shared/base/water.h"

namespace scree {

/// The number by which a person in a recording is told from those who look at it.
constexpr uint64_t recorded_person(uint64_t session) {
  return session | (1ULL << 63U);
}

struct SessionStep {
  bool new_mirror = false;   ///< the mirror is another one; nothing of the last one's holds
  bool other_world = false;  ///< and it is not of the world that was shown before
  bool jumped = false;       ///< a replay is at another moment: what changed did not happen
  MirrorChanges changes;
  std::vector<Cue> cues{};           ///< of a game's rules, at most limits::piece_events_per_step_max
  std::vector<Operation> edits{};    ///< what was done to terrain; at most likewise
  std::vector<ChannelData> heard{};  ///< what the rules have for this program
};

struct SessionChoice {
  float interest_radius_m = 0.0F;
  std::string name{};                    ///< the person's, shown to others
  std::string program = "scree-viewer";  ///< for the server's log
  CacheConfig cache{};
  /// Seconds in which a step applies messages: after these, what is due waits for the next one. A message is
  /// applied as a whole.
  double apply_s = std::numeric_limits<double>::infinity();
};

class ViewerSession {
 public:
  ViewerSession(std::unique_ptr<Connector> connector, SessionChoice choice);

  SessionStep step(double now_s, const Camera& camera);

  /// Null until the first welcome.
  Mirror* mirror() { return client_.mirror(); }
  /// The field to draw and to aim at: the mirror's, with this client's own carves that the server has not
  /// answered yet laid over it. After the first welcome; valid until the next step() or strike().
  Field& field() { return client_.field(); }
  /// The pieces at the poses to draw now; those of predicted carves where they are cut.
  const ScenePieces& pieces(double now_s);
  /// The props, likewise.
  const SceneProps& props(double now_s);
  /// The field, the pieces and the props. After the first welcome; valid until the next step(), strike() or
  /// scene().
  Scene scene(double now_s) { return {field(), pieces(now_s), props(now_s)}; }
  /// The person's name from the next connection on.
  void set_name(const std::string& name) { choice_.name = name; }
  /// The camera has no place yet: the next welcome says it. Until this is off again, the server is not told
  /// where the camera is.
  void begin_at_spawn(bool on) { at_spawn_ = on; }
  /// Follows the server so far about the camera.
  void set_interest_radius(float metres);
  /// Whether carves are shown before the server has answered.
  void predict(bool on) { client_.predict(on); }
  /// Carves that are shown so now.
  size_t predictions() const { return client_.predictions() ? client_.predictions()->outstanding() : 0; }
  bool connected() const { return client_.connected(); }
  /// The file of an image that the palette names; null: it has not come, and perhaps never will.
  ReceivedContent::Bytes content(const Digest& image) const { return client_.content(image); }
  /// The file of a prop's model; null: it has not come, and perhaps never will.
  ReceivedContent::Bytes model(const Digest& model) const { return client_.model(model); }
  /// What was wrong with the server's content last; empty: nothing.
  const std::string& content_fault() const { return client_.rejoin().content().fault(); }
  /// Whether no content is on its way.
  bool content_settled() const { return client_.rejoin().content().is_settled(); }
  /// Whether the edits around the camera have arrived: no chunk came for a while.
  bool joined(double now_s) const { return client_.loaded(now_s); }
  /// Whether any piece was made in this world.
  bool carved() const;

  /// The point at which a ray (unit direction) meets rock within limits::carve_reach_m, metres.
  std::optional<glm::vec3> aim(glm::vec3 from_m, glm::vec3 direction);
  /// The shape of a strike at `hit_m` along `direction` (unit): a dig of who is on foot takes first what is
  /// in the way (way_ahead.h).
  Shape shape_of_strike(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction);
  /// Where the person's feet are from now on; nothing: the person is not on foot.
  void stand_at(std::optional<glm::vec3> feet_m) { feet_m_ = feet_m; }
  /// Whether the server refuses an edit of this shape from there as too far away, as far as it has told so.
  bool is_beyond_reach(const Shape& shape, glm::vec3 from_m) const;
  /// Who this person is to regions, as far as it is known here: the name counts if a token states it.
  Asker asker() const { return {welcome() == nullptr ? Role::viewer : welcome()->role, choice_.name}; }
  /// Requests what the tool does at the point where the ray meets rock; does nothing if it meets none. Beyond
  /// the server's reach, or with nothing to place, there is a notice instead.
  void strike(const Tool& tool, glm::vec3 from_m, glm::vec3 direction, double now_s);
  /// Requests that all of the own store goes to the world's.
  void give_away(double now_s);
  /// What one carries, and what one may do with it.
  ToolHolder holder() const;
  /// What became of the last strike: why it did nothing, in three words; empty: it was carried out.
  struct Answer {
    std::string refused;
    double at_s = 0.0;
    uint32_t number = 0;  ///< of the answers so far
  };
  const Answer& answer() const { return answer_; }
  /// The way of the last request that was answered, by stages; none before the first.
  const std::optional<RequestLatency>& latency() const { return latency_; }

  /// The other persons within interest, as of this moment, and those who were there in a recording, whose
  /// numbers are recorded_person() of the recorded session.
  const Figures& figures(double now_s);
  /// The colours of all persons who are known here, as of the last figures().
  const PersonColours& colours() const { return colours_; }
  /// Who is in the world, and what they said.
  const Conversation& conversation() const { return conversation_; }
  /// Whether the server moves persons on foot, as far as it has told so.
  bool persons_walk() const;
  /// As the server's settings said it last.
  WaterLevel water() const;
  /// Asks to be put on foot, or to leave it.
  void stand(bool away);
  /// This client's own person, foreseen as of this step; null without a world.
  WalkPrediction* foreseen_walk() { return foreseen_walk_ ? &*foreseen_walk_ : nullptr; }
  /// Carries out an input of one tick, and sends it. Only on foot.
  void walk(const WalkInput& input, glm::vec3 look);
  /// To all persons.
  void say(const std::string& text);
  /// To the server's rules. False: it is none that can be sent (validate()), or there is no connection.
  bool send(ChannelData data);
  /// Switches the server's PhysicsMessages on or off; and the last one, null before the first.
  void want_physics(bool physics) { wants_physics_ = physics; }
  const PhysicsMessage* physics() const { return physics_ ? &*physics_ : nullptr; }
  /// The last reported place of interest, and its radius.
  glm::vec3 interest_m() const { return client_.eye_m(); }
  float interest_radius_m() const { return choice_.interest_radius_m; }

  /// For display: the state of the connection, in one line; why the last request did nothing, or what else
  /// there is to know, for some seconds.
  std::string description() const;
  std::string notice(double now_s) const;
  /// Whether the server refused for a reason that stays (may_come_again): there is no other attempt.
  bool gave_up() const { return attempts_.gave_up(); }
  /// Seconds until the next attempt; nothing while there is a connection, or an attempt.
  std::optional<double> next_try_s(double now_s) const;
  /// The next attempt is now.
  void try_now() { attempts_.try_now(); }
  /// What the world is made of, as far as it has come.
  const Palette& palette() const {
    return client_.mirror() == nullptr ? *plain_palette() : *client_.mirror()->palette();
  }
  /// The counters of the connection; nothing without one.
  std::optional<ConnectionCounters> traffic() const;
  /// The welcome of the connection; null without one.
  const WelcomeMessage* welcome() const { return client_.welcome(); }
  /// The longest time that a message took to be applied, milliseconds.
  double apply_worst_ms() const { return apply_worst_ms_; }
  double received_bytes_per_s() const { return bytes_per_s_; }
  /// The pace of the world's time, and its rate.
  const Pace& pace() const { return pace_; }
  double tick_rate_hz() const { return tick_rate_hz_; }
  /// Whether the server plays a recording; and where it stands, known from its first word of that on.
  bool is_replay() const { return welcome() && welcome()->replay; }
  Timeline& timeline() { return timeline_; }
  /// Memory of received messages that wait, bytes.
  size_t waiting_bytes() const { return connected() ? client_.counters().waiting_bytes : 0; }

 private:
  void join(double now_s, glm::vec3 eye_m);
  void take_events(double now_s, SessionStep& step);
  void begin(const Client::Joined& joined, double now_s, SessionStep& step);
  void lose(double now_s, const ConnectionEnd& end);
  void apply(const Client::Applied& applied, double now_s, SessionStep& step);
  static void note(const CuesMessage& cues, SessionStep& step);
  static void note(const std::vector<Operation>& operations, SessionStep& step);
  void settle(const ReplyMessage& reply, double arrived_s, double now_s);
  void show_notice(std::string words, double now_s);
  void refuse(std::string words, std::string_view refusal, double now_s);
  void ask(const Request& request, double now_s);
  std::optional<float> reach_m() const;
  void add_bodies(double now_s, std::vector<PlayerCursor>& all, PersonFacts& facts);
  std::optional<uint64_t> person_of(PieceId body, const Prop& prop) const;
  void set_recorded_cursors(const RecordedCursorsMessage& recorded);
  void measure_rate(double now_s);
  void report(double now_s, glm::vec3 eye_m);
  void report_cursor(double now_s, const Camera& camera);
  void control_replay(double now_s);

  SessionChoice choice_;
  bool at_spawn_ = false;       ///< begin_at_spawn()
  bool radius_is_new_ = false;  ///< the server has not heard of it
  Client client_;
  Pace pace_;
  double tick_rate_hz_ = 60.0;
  ScenePieces pieces_;
  SceneProps props_;
  std::string trouble_;    ///< the reason for the missing connection
  bool was_here_ = false;  ///< connected before
  Attempts attempts_;
  double next_report_s_ = 0.0;
  double next_cursor_s_ = 0.0;
  CursorMessage reported_cursor_;
  std::vector<PlayerCursor> cursors_;
  std::vector<PlayerCursor> recorded_cursors_;  ///< by numbers of recorded_person()
  Timeline timeline_;
  Figures figures_;
  PersonColours colours_;
  Conversation conversation_;
  std::optional<WalkPrediction> foreseen_walk_;
  std::optional<glm::vec3> feet_m_;
  bool wants_physics_ = false;
  bool physics_requested_ = false;  ///< the last state sent to the server
  std::optional<PhysicsMessage> physics_;
  bool saw_pieces_ = false;
  uint32_t requests_ = 0;
  std::map<uint32_t, double> asked_s_;  ///< when, by request that is not answered
  std::optional<RequestLatency> latency_;
  Answer answer_;
  std::string notice_;
  double notice_until_s_ = 0.0;
  double rate_since_s_ = 0.0;
  uint64_t rate_bytes_ = 0;
  double bytes_per_s_ = 0.0;
  double apply_worst_ms_ = 0.0;
};

}  // namespace scree
