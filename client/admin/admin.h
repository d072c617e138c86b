// A client that reads a running server's status and settings, changes settings, and manages its sessions.
// Each function makes one connection that follows no terrain, and waits for the server's answers. Safe to
// call from any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "client/connection/endpoint.h"
#include "proto/messages.h"
#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/material/material_image.h"
#include "shared/material/palette.h"

namespace scree {

/// Its token is the server's admin token, or an access token with the role admin.
struct AdminServer : ServerEndpoint {
  std::chrono::milliseconds within{10000};  ///< all of the server's answers
};

/// The server's health: needs no token, no place and, where TLS is required, no TLS.
Result<HealthMessage> read_health(const AdminServer& server);
std::string health_json(const HealthMessage& health);
/// "healthy, ready, at tick 1200", or what is wrong, a line each.
std::string health_lines(const HealthMessage& health);

/// The server's next status, settings included. Needs no token where anonymous sessions are taken.
Result<StatusMessage> read_status(const AdminServer& server);
/// The same with the names of the world's materials by row.
struct NamedStatus {
  StatusMessage status;
  std::vector<std::string> materials;
};
Result<NamedStatus> read_named_status(const AdminServer& server);
/// The status as JSON, or as lines of a name and a value. A material without a name is known by its number.
std::string status_json(const StatusMessage& status, const std::vector<std::string>& materials = {});
std::string status_lines(const StatusMessage& status, const std::vector<std::string>& materials = {});

/// The materials of the server's world as they stand. Needs no token where anonymous sessions are taken.
Result<Palette> read_materials(const AdminServer& server);
/// What who brings voxels to the world has to know of it.
struct WorldFacts {
  float voxel_size_m = 0.0F;
  Palette palette;
};
Result<WorldFacts> read_world(const AdminServer& server);
/// All rows, with a few numbers each; or as JSON, with all.
std::string materials_lines(const Palette& palette);
std::string materials_json(const Palette& palette);
/// What the server says of an image when a client begins to fetch it.
struct ImageFacts {
  uint32_t bytes = 0;  ///< 0: the server does not have it
  ImageSize size;
};
using ImageFactsOf = std::map<Digest, ImageFacts>;
/// Reads them for the images that a row names.
Result<ImageFactsOf> read_images(const AdminServer& server, const MaterialRow& row);
/// All members of one row, with their units.
std::string material_lines(const MaterialRow& row, const ImageFactsOf& images = {});
std::string material_json(const MaterialRow& row, const ImageFactsOf& images = {});
/// The material of that name; the error names the nearest one.
Result<Material> material_named(const Palette& palette, const std::string& name);
/// Changes these numbers, named "brick.strength", as settings: all or none. The error is the server's
/// refusal. Returns all numbers that differ from the palette's own, by the same names.
Result<SettingValues> change_materials(const AdminServer& server, SettingValues changes);

/// All current settings. Needs no token where anonymous sessions are taken.
Result<SettingValues> read_settings(const AdminServer& server);

/// Changes all these settings or none, and returns all current settings. The error is the server's refusal,
/// as of all that follow.
Result<SettingValues> change_settings(const AdminServer& server, const SettingValues& changes);

/// The sessions that have joined, this one included.
Result<std::vector<SessionRow>> list_sessions(const AdminServer& server);
std::string sessions_json(const std::vector<SessionRow>& sessions);
std::string sessions_lines(const std::vector<SessionRow>& sessions);

/// Controls a replay, and returns where it stands then: after its next tick, or after the jump.
Result<PlaybackMessage> control_replay(const AdminServer& server, const ControlReplayRequest& wish);
std::string playback_json(const PlaybackMessage& playback);
std::string playback_lines(const PlaybackMessage& playback);
/// Says that the recording does not have the wished tick, or no longer, and where it went; empty: it went
/// there.
std::string went_elsewhere(const ControlReplayRequest& wish, const PlaybackMessage& playback);

Result<std::vector<BanRow>> list_bans(const AdminServer& server);
std::string bans_json(const std::vector<BanRow>& bans);
std::string bans_lines(const std::vector<BanRow>& bans);

Result<void> kick_session(const AdminServer& server, const KickRequest& kick);
Result<void> ban_address(const AdminServer& server, const BanRequest& ban);
Result<void> lift_ban(const AdminServer& server, const LiftBanRequest& lift);

/// Asks for a request about bodies (AddPropRequest and others, BlastRequest), and returns the answer. A blast
/// changes terrain, so it takes a place as any client does. The eye is where the request acts.
Result<ReplyMessage> ask_world(const AdminServer& server, const Request& request);

/// The pieces and props, or the joints, that there are. Takes a director's token, too.
Result<AdminListMessage> list_bodies(const AdminServer& server, const ListBodiesRequest& request);
std::string bodies_json(const AdminListMessage& list);
std::string bodies_lines(const AdminListMessage& list);
Result<AdminListMessage> list_joints(const AdminServer& server, const ListJointsRequest& request);
std::string joints_json(const AdminListMessage& list);
std::string joints_lines(const AdminListMessage& list);

/// The regions of the world. Needs no token where anonymous sessions are taken.
Result<std::vector<Region>> list_regions(const AdminServer& server);
std::string regions_json(const std::vector<Region>& regions);
/// A line each.
std::string regions_lines(const std::vector<Region>& regions);

/// Cubic metres of solid rock that units of the ledger are.
double m3_of(MassUnits mass, const WorldFacts& world);

/// The stores of the world. Takes a director's token, too.
Result<AdminListMessage> list_stores(const AdminServer& server);
/// Masses are units of the ledger; materials without a name are known by their numbers.
std::string stores_json(const AdminListMessage& list, const WorldFacts& world);
std::string stores_lines(const AdminListMessage& list, const WorldFacts& world);

/// What became of the rock of a region that counts, or of all (empty). Takes a director's token, too.
Result<AdminListMessage> list_region_masses(const AdminServer& server, const std::string& region);
/// As of stores. `regions`: for their names.
std::string region_masses_json(const AdminListMessage& list, const std::vector<Region>& regions,
                               const WorldFacts& world);
std::string region_masses_lines(const AdminListMessage& list, const std::vector<Region>& regions,
                                const WorldFacts& world);

/// Controls the server's rules, and returns what they said: lines for people, of any bytes.
Result<std::string> control_rules(const AdminServer& server, const ControlRulesRequest& wish);
/// Asks for the edits that the server remembers, or has some taken back: lines for people, or JSON, of any
/// bytes.
Result<std::string> ask_history(const AdminServer& server, const HistoryAct& act);
/// For a terminal: of a line with anything but clean text, all that is not printable ASCII is escaped.
std::string rules_lines(const std::string& text);
std::string rules_json(const std::string& text);

/// What the server keeps of its last ticks: slow ones and their causes, or work by party.
Result<AdminListMessage> list_flight(const AdminServer& server, const ListFlightRequest& request);
std::string slow_ticks_json(const AdminListMessage& list);
std::string slow_ticks_lines(const AdminListMessage& list);
std::string parties_json(const AdminListMessage& list);
std::string parties_lines(const AdminListMessage& list);

/// What the server keeps for administrators line by line: an object of JSON each, of any bytes.
Result<std::string> list_lines(const AdminServer& server, const ListLinesRequest& request);
/// An array of these objects; the error: a line is none.
Result<std::string> lines_json(const std::string& lines);
/// A line each for a terminal.
Result<std::string> lines_text(const std::string& lines, LinesOf of);

/// An answer, and the tick that it is of.
struct SpaceAnswer {
  Tick tick = 0;
  QuestionAnswer answer;
  bool more = false;           ///< ids are left out
  float voxel_size_m = 0.25F;  ///< of the world
};
/// Asks a valid question about space, from an eye in the middle of what it is about: it takes a place as any
/// client does. `as_of`: a tick; 0: the newest; negative: so many ticks before the newest.
Result<SpaceAnswer> ask_space(const AdminServer& server, const Question& question, int64_t as_of = 0);
/// Whether it names materials, so that the palette is needed to say it.
bool names_materials(const SpaceAnswer& said);
/// By the palette's names, and masses in kg.
std::string answer_json(const SpaceAnswer& said, const Palette& palette);
std::string answer_lines(const SpaceAnswer& said, const Palette& palette);

}  // namespace scree
