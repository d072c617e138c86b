// A server whose host plays a game of words, for signs_test.js and others: what a client says on the channel
// "game" it shows, tells or takes away. Options as of scree-server.
//
//   line TEXT, bar SHARE TEXT, marker X Y Z TEXT, count SECONDS TEXT, clear, thud, dust, say TEXT, echo TEXT
#include <atomic>
#include <csignal>
#include <cstdio>
#include <sstream>

#include "server/app/live_server.h"
#include "server/app/server_options.h"

namespace {

using namespace scree;

class WordGame {
 public:
  void play_on(LiveServer& server) { server_ = &server; }
  void tick(Tick tick) { tick_ = tick; }

  void hear(uint64_t session, const ChannelData& data) {
    std::istringstream words(std::string(data.bytes.begin(), data.bytes.end()));
    std::string act;
    words >> act;
    if (act == "line") show({.name = "line", .text = rest(words)});
    if (act == "bar") {
      Sign bar{.name = "bar", .kind = SignKind::bar};
      words >> bar.share;
      bar.text = rest(words);
      bar.colour = {255, 128, 64};
      show(bar);
    }
    if (act == "marker") {
      Sign marker{.name = "marker", .kind = SignKind::marker};
      words >> marker.place_m.x >> marker.place_m.y >> marker.place_m.z;
      marker.text = rest(words);
      marker.colour = {120, 220, 255};
      show(marker);
    }
    if (act == "count") {
      Sign round{.name = "count"};
      Tick seconds = 0;
      words >> seconds;
      round.text = rest(words);
      round.until = tick_ + seconds * 60;
      round.counts = true;
      show(round);
    }
    if (act == "clear")
      for (const char* const name : {"line", "bar", "marker", "count"}) push(RemoveSign{{}, name});
    const Cue cue{act == "dust" ? CueKind::dust : CueKind::thud, {0.0F, 1.0F, 0.0F}, 2.0F, 1e5F};
    if (act == "thud" || act == "dust") push(Notice{{}, cue});
    if (act == "say") push(Notice{{}, NoticeLine{rest(words)}});
    if (act == "echo") {
      const std::string text = rest(words);
      push(Notice{{.kind = AudienceKind::session, .session = session},
                  ChannelData{data.channel, {text.begin(), text.end()}}});
    }
  }

 private:
  static std::string rest(std::istringstream& words) {
    std::string text;
    std::getline(words >> std::ws, text);
    return text;
  }
  void push(RulesAct act) {
    if (LiveServer* const server = server_)
      static_cast<void>(server->push({0, 0, RulesRequest{std::move(act)}}));
  }
  void show(Sign sign) { push(ShowSign{std::move(sign)}); }

  std::atomic<LiveServer*> server_ = nullptr;
  std::atomic<Tick> tick_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  const auto parsed = parse_server_options(argc, argv);
  if (const int* status = std::get_if<int>(&parsed)) return *status;
  ServerOptions options = std::get<ServerOptions>(parsed);
  WordGame game;
  options.live.hooks.heard = [&](uint64_t session, const ChannelData& data) { game.hear(session, data); };
  options.live.hooks.after = [&](const TickDelta& delta) { game.tick(delta.tick); };
  auto server = LiveServer::start(options.live);
  if (!server) return 1;
  game.play_on(**server);
  std::printf("{\"listening\": %u}\n", static_cast<unsigned>((*server)->port()));
  std::fflush(stdout);
  int signal = 0;
  sigwait(&signals, &signal);
  return (*server)->stop() ? 0 : 1;
}
