#include "client/admin/admin.h"

#include <algorithm>

#include "client/cache/received_content.h"
#include "client/connection/connection.h"
#include "client/connection/health_probe.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds wait_step{50};

class Talk {
 public:
  Talk(std::unique_ptr<Connection> connection, Clock::time_point until)
      : connection_(std::move(connection)), until_(until) {}
  Talk(Talk&&) = default;
  Talk& operator=(Talk&&) = default;
  ~Talk() {
    if (connection_) connection_->leave();
  }

  const WelcomeMessage& welcome() const { return connection_->welcome(); }
  void send(const ClientMessage& message) { connection_->send(message); }

  /// The next message of one kind; skips others.
  template <typename T>
  Result<T> next(const char* what) {
    for (;;) {
      const auto message = TRY(next_message(what));
      if (const T* wanted = std::get_if<T>(&message)) return *wanted;
    }
  }

  /// The next of the two that are about the palette.
  Result<ServerMessage> next_of_content() {
    for (;;) {
      auto message = TRY(next_message("palette"));
      if (std::holds_alternative<ContentMessage>(message) ||
          std::holds_alternative<PaletteChangedMessage>(message))
        return message;
    }
  }

  /// The answer to the one request; the error is the refusal, when it is one.
  template <typename T>
  Result<T> answer() {
    for (;;) {
      const auto message = TRY(next_message("reply"));
      const auto* reply = std::get_if<ReplyMessage>(&message);
      if (reply != nullptr && !reply->refusal.empty()) return fail(reply->refusal);
      if (const T* wanted = std::get_if<T>(&message)) return *wanted;
    }
  }

  Result<std::vector<Region>> regions() {
    for (std::vector<Region> regions;;) {
      auto message = TRY(next_message("status"));
      if (auto* const all = std::get_if<RegionsMessage>(&message)) regions = std::move(all->regions);
      if (std::holds_alternative<StatusMessage>(message)) return regions;
    }
  }

 private:
  Result<ServerMessage> next_message(const char* what) {
    for (;;) {
      if (at_ < received_.size()) return received_[at_++].message;
      // Read before the last messages are taken: no message can come after the end.
      const bool open = connection_->connected();
      received_ = connection_->wait(wait_step);
      at_ = 0;
      if (!received_.empty()) continue;
      if (!open) return fail(connection_->close_reason());
      if (Clock::now() > until_)
        return fail(std::string("no ") + what + " came in time: does the server tick?");
    }
  }

  std::unique_ptr<Connection> connection_;
  Clock::time_point until_;
  std::vector<Received> received_;
  size_t at_ = 0;
};

Result<Talk> join(const AdminServer& server, HelloMessage hello) {
  const Clock::time_point until = Clock::now() + server.within;
  hello.client = "scree-admin";
  auto connected = TRY(Connection::connect(server, hello, server.within));
  return Talk(std::move(connected), until);
}

Result<Talk> join(const AdminServer& server) {
  HelloMessage hello;
  hello.administers = true;
  return join(server, hello);
}

/// Where a request acts; the origin where it is of no place.
glm::vec3 eye_for(const Request& request) {
  if (const std::optional<Shape> shape = shape_of(request)) return centre_of(*shape);
  const glm::vec3* const place_m = place_of(request);
  return place_m == nullptr ? glm::vec3(0.0F) : *place_m;
}

Result<StatusMessage> status_of(Talk& talk) {
  return talk.next<StatusMessage>("status");
}

Result<SettingValues> settings_of_status(Talk& talk) {
  StatusMessage status = TRY(status_of(talk));
  return std::move(status.settings);
}

/// The palette comes by its digest, as to any client.
Result<Palette> palette_from(Talk& talk) {
  if (!talk.welcome().palette) return fail("this server does not say what its world is made of");
  ReceivedContent content(TileFolder(""), false);
  content.begin_session(talk.welcome().palette);
  for (;;) {
    if (const AskContentMessage request = content.next_request(); !request.wanted.empty()) talk.send(request);
    if (content.is_current()) return *content.palette();
    if (!content.fault().empty()) return fail(content.fault());
    const auto message = TRY(talk.next_of_content());
    if (const auto* changed = std::get_if<PaletteChangedMessage>(&message))
      content.change_palette(changed->palette);
    else
      content.accept(std::get<ContentMessage>(message));
  }
}

/// The first part of an image has its header; the rest is not waited for.
Result<ImageFacts> facts_of_image(Talk& talk, const Digest& image) {
  const AskContentMessage request{{image}};
  talk.send(request);
  for (;;) {
    const auto part = TRY(talk.next<ContentMessage>("image"));
    if (part.digest != image || part.offset != 0) continue;
    const auto size = check_image(part.part);
    return ImageFacts{part.total, size ? *size : ImageSize{}};
  }
}

/// Joins, asks, and waits for the answer: an error when it is a refusal.
template <typename Answer>
Result<std::pair<Answer, Talk>> ask(const AdminServer& server, const AdminRequest& act) {
  Talk talk = TRY(join(server));
  talk.send(AdminMessage{1, "", act});
  Result<Answer> answer = talk.answer<Answer>();
  TRY(answer);
  return std::pair{std::move(*answer), std::move(talk)};
}

Result<void> done_by(const AdminServer& server, const AdminRequest& act) {
  const auto asked = TRY(ask<ReplyMessage>(server, act));
  return {};
}

}  // namespace

Result<HealthMessage> read_health(const AdminServer& server) {
  return ask_health(server, server.within);
}

Result<StatusMessage> read_status(const AdminServer& server) {
  Talk talk = TRY(join(server));
  Result<StatusMessage> status = status_of(talk);
  if (status && status->clients > 0) --status->clients;  // the others: this program is one while it asks
  return status;
}

/// The status comes first: a server that does not tell its materials has one, too.
Result<NamedStatus> read_named_status(const AdminServer& server) {
  auto status = TRY(read_status(server));
  NamedStatus named{std::move(status), {}};
  const Result<Palette> palette = read_materials(server);
  if (palette)
    for (const MaterialRow& row : palette->rows) named.materials.push_back(row.name);
  return named;
}

Result<Palette> read_materials(const AdminServer& server) {
  Talk talk = TRY(join(server));
  return palette_from(talk);
}

Result<WorldFacts> read_world(const AdminServer& server) {
  Talk talk = TRY(join(server));
  const float voxel_size_m = talk.welcome().terrain.voxel_size_m;
  auto palette = TRY(palette_from(talk));
  return WorldFacts{voxel_size_m, std::move(palette)};
}

Result<ImageFactsOf> read_images(const AdminServer& server, const MaterialRow& row) {
  ImageFactsOf images;
  Talk talk = TRY(join(server));
  for (const std::optional<Digest>& image : {row.look.albedo, row.look.normal}) {
    if (!image || images.contains(*image)) continue;
    images[*image] = TRY(facts_of_image(talk, *image));
  }
  return images;
}

Result<SettingValues> read_settings(const AdminServer& server) {
  Talk talk = TRY(join(server));
  return settings_of_status(talk);
}

Result<SettingValues> change_settings(const AdminServer& server, const SettingValues& changes) {
  auto asked = TRY(ask<ReplyMessage>(server, SettingsRequest{changes}));
  // A reply follows its own tick's messages, so the next status is of a later one.
  return settings_of_status(asked.second);
}

Result<SettingValues> change_materials(const AdminServer& server, SettingValues changes) {
  static const std::string prefix = "material.";
  for (SettingValue& change : changes) change.name.insert(0, prefix);
  auto settings = TRY(change_settings(server, changes));
  std::erase_if(settings, [](const SettingValue& setting) { return !setting.name.starts_with(prefix); });
  for (SettingValue& setting : settings) setting.name.erase(0, prefix.size());
  return settings;
}

Result<std::vector<SessionRow>> list_sessions(const AdminServer& server) {
  auto asked = ask<AdminListMessage>(server, ListSessionsRequest{});
  TRY(asked);
  return std::move(asked->first.sessions);
}

Result<std::vector<BanRow>> list_bans(const AdminServer& server) {
  auto asked = ask<AdminListMessage>(server, ListBansRequest{});
  TRY(asked);
  return std::move(asked->first.bans);
}

Result<PlaybackMessage> control_replay(const AdminServer& server, const ControlReplayRequest& wish) {
  Talk talk = TRY(join(server));
  if (!talk.welcome().replay) return fail("this server plays no recording (scree server --replay)");
  const auto before = TRY(talk.next<PlaybackMessage>("playback"));
  talk.send(AdminMessage{1, "", wish});
  TRY(talk.answer<ReplyMessage>());
  for (;;) {
    auto now = talk.next<PlaybackMessage>("playback");
    if (!now || now->heeded > before.heeded) return now;
  }
}

Result<void> kick_session(const AdminServer& server, const KickRequest& kick) {
  return done_by(server, kick);
}

Result<void> ban_address(const AdminServer& server, const BanRequest& ban) {
  return done_by(server, ban);
}

Result<void> lift_ban(const AdminServer& server, const LiftBanRequest& lift) {
  return done_by(server, lift);
}

Result<ReplyMessage> ask_world(const AdminServer& server, const Request& request) {
  HelloMessage hello;
  hello.administers = !shape_of(request);
  hello.eye_m = eye_for(request);
  Talk talk = TRY(join(server, hello));
  std::visit(Overloaded{[&](const auto& asked) {
                          talk.send(RequestMessage<std::decay_t<decltype(asked)>>{asked, 1});
                        },
                        [](const SettingsRequest&) { CHECK(!"a request about bodies"); },
                        [](const LeaveRequest&) { CHECK(!"a request about bodies"); }},
             request);
  return talk.answer<ReplyMessage>();
}

Result<AdminListMessage> list_bodies(const AdminServer& server, const ListBodiesRequest& request) {
  auto asked = TRY(ask<AdminListMessage>(server, request));
  return std::move(asked.first);
}

Result<AdminListMessage> list_joints(const AdminServer& server, const ListJointsRequest& request) {
  auto asked = TRY(ask<AdminListMessage>(server, request));
  return std::move(asked.first);
}

/// They come before the first status, and do not come where there are none.
Result<std::vector<Region>> list_regions(const AdminServer& server) {
  Talk talk = TRY(join(server));
  return talk.regions();
}

Result<AdminListMessage> list_stores(const AdminServer& server) {
  auto asked = TRY(ask<AdminListMessage>(server, ListStoresRequest{}));
  return std::move(asked.first);
}

Result<AdminListMessage> list_region_masses(const AdminServer& server, const std::string& region) {
  auto asked = TRY(ask<AdminListMessage>(server, ListRegionMassesRequest{region}));
  return std::move(asked.first);
}

Result<AdminListMessage> list_flight(const AdminServer& server, const ListFlightRequest& request) {
  auto asked = TRY(ask<AdminListMessage>(server, request));
  return std::move(asked.first);
}

Result<std::string> list_lines(const AdminServer& server, const ListLinesRequest& request) {
  auto asked = TRY(ask<AdminListMessage>(server, request));
  return std::move(asked.first.text);
}

Result<std::string> control_rules(const AdminServer& server, const ControlRulesRequest& wish) {
  auto asked = TRY(ask<AdminListMessage>(server, wish));
  return std::move(asked.first.text);
}

Result<std::string> ask_history(const AdminServer& server, const HistoryAct& act) {
  auto asked = TRY(std::visit([&](const auto& one) { return ask<AdminListMessage>(server, one); }, act));
  return std::move(asked.first.text);
}

Result<SpaceAnswer> ask_space(const AdminServer& server, const Question& question, int64_t as_of) {
  const SpaceBox bounds = bounds_of(question);
  const glm::dvec3 middle_m = 0.5 * (bounds.lo + bounds.hi);
  HelloMessage hello;
  hello.eye_m = glm::vec3(middle_m);
  hello.interest_radius_m = static_cast<float>(reach_from(question, middle_m)) + 1.0F;
  Talk talk = TRY(join(server, hello));
  const auto now = static_cast<int64_t>(talk.welcome().tick);
  talk.send(
      QueryMessage{1, static_cast<Tick>(as_of < 0 ? std::max<int64_t>(1, now + as_of) : as_of), {question}});
  const auto said = TRY(talk.next<AnswerMessage>("answer"));
  if (!said.refusal.empty()) return fail(said.refusal);
  if (said.answers.size() != 1) return fail("the server answered another question");
  const QuestionReply& reply = said.answers.front();
  if (!reply.answer)
    return fail(reply.refusal.empty() ? "this server does not know the question" : reply.refusal);
  return SpaceAnswer{said.tick, *reply.answer, reply.more, talk.welcome().terrain.voxel_size_m};
}

}  // namespace scree
