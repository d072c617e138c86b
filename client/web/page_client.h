// The client of one page: a visit by the page's socket, drawn into its canvas, under its person's hand.
// bridge.h says what the page asks for; this is what it gets. Lives as long as the page. The socket outlives
// it. Needs the WebGL context current.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/viewer/input/hand_choice.h"
#include "client/viewer/input/repeat.h"
#include "client/viewer/session/hints.h"
#include "client/viewer/session/whereabouts.h"
#include "client/viewer/viewing/hud_facts.h"
#include "client/viewer/viewing/visit.h"
#include "client/web/page_input.h"
#include "client/web/socket_connector.h"

namespace scree {

/// Milliseconds.
struct FrameTimes {
  double last = 0.0;  ///< from one frame to the next
  double median = 0.0;
  double worst = 0.0;
  double update = 0.0;  ///< of the last frame: messages, and what has changed
  double draw = 0.0;    ///< the commands alone
};

class PageClient {
 public:
  /// Fails when the context cannot draw what it has to.
  static Result<std::unique_ptr<PageClient>> begin(PageSocket& socket);
  void resize(int width, int height);
  /// From what the person did to the picture.
  Result<void> frame();

  void set_token(const std::string& token) { connector_->set_token(token); }
  Result<void> choose_method(const MethodEntry& entry) { return visit_.view->methods().choose(entry); }
  /// Actions that are the page's to do; takes them.
  std::vector<Action> drain_asked() { return std::exchange(asked_, {}); }
  FrameTimes frame_times() const;
  /// What a newcomer may try next; empty: nothing.
  std::string_view hint(double now_s);
  HudFacts facts();
  float aspect() const;

  PageInput input;
  Tool tool;
  HandChoice hand;
  std::optional<Quality> quality;  ///< nothing: by the first frames
  OverlayChoice overlay;
  bool particles = true;
  bool details = true;
  bool shake = true;
  bool has_past = false;  ///< the page knows who replays this world
  bool predicts = true;

  Visit& visit() { return visit_; }
  const Whereabouts& whereabouts() const { return whereabouts_; }
  /// How many times the timeline's marks have changed.
  uint64_t marks_told() const { return marks_told_; }

 private:
  PageClient(std::unique_ptr<View> view, std::unique_ptr<SocketConnector> connector);
  void act(Action action, double now_s);
  void strike(const PageIntents& intents, double now_s);
  void work_later();
  void work();
  void note(double elapsed_ms, double update_ms, double draw_ms);

  SocketConnector* connector_;  ///< the session's
  Visit visit_;
  Whereabouts whereabouts_;
  Repeat strike_;
  Hints hints_;
  FactFinder facts_;
  std::vector<Action> asked_;
  MarksMessage marks_;
  uint64_t marks_told_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::optional<double> last_s_;
  Result<void> stepped_;  ///< the first error of a step: it cannot go on
  bool works_ = false;    ///< a timer will
  std::deque<float> frames_ms_;
  FrameTimes times_;
};

}  // namespace scree
