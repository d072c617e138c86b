#include "server/formats/world_codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <world.pb.h>

#include "proto/operation_codec.h"
#include "proto/wire_values.h"
#include "server/formats/packed_lists.h"
#include "server/formats/recording_values.h"
#include "server/formats/world_props.h"
#include "shared/base/check.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

/// Corners of a hull, points of a surface, and parts of one piece: more than four times what pieces have.
constexpr size_t hull_points_max = 4096;
constexpr size_t surface_points_max = 8192;
constexpr int parts_max = 256;

void write(kept::Turns& to, const TurnsValue& from) {
  to.set_served_ns(from.served_ns);
  to.set_turns(pack_turns(from.turns));
}

TurnsValue read(const kept::Turns& from, FieldChecker& check) {
  return {check.value_or_refuse(unpack_turns(from.turns())), from.served_ns()};
}

void write(kept::Session& to, const SessionValue& from) {
  to.set_session(from.session);
  to.set_waiting_us(from.waiting_us);
  std::vector<Command> commands;
  for (const WaitingValue& waiting : from.requests) commands.push_back(waiting.command);
  to.set_requests(to_string(encode(commands)));
  to.set_waiting(packed([&](ByteWriter& writer) {
    for (const WaitingValue& waiting : from.requests)
      writer.f32(waiting.cost_us), writer.varint(waiting.since);
  }));
}

SessionValue read(const kept::Session& from, FieldChecker& check) {
  SessionValue session;
  session.session = from.session();
  session.waiting_us = check.finite(from.waiting_us(), "waiting_us");
  const auto commands = check.value_or_refuse(decode_recorded_commands(as_span(from.requests())));
  const auto waiting = check.value_or_refuse(
      unpacked<WaitingValue>(from.waiting(), "waiting requests", commands.size(), [](ByteReader& reader) {
        WaitingValue value;
        value.cost_us = reader.f32("cost");
        if (value.cost_us < 0.0F) reader.refuse("a cost is negative");
        value.since = reader.varint("tick");
        return value;
      }));
  if (waiting.size() != commands.size()) check.refuse("requests and their costs differ in number");
  if (check.failed()) return session;
  session.requests = waiting;
  for (size_t i = 0; i < commands.size(); ++i) session.requests[i].command = commands[i];
  return session;
}

void write(kept::Cut& to, const PendingRefracture& from) {
  to.set_piece(from.piece);
  to.set_pieces(from.pieces);
  to.set_pattern(static_cast<uint32_t>(from.pattern));
  to.set_random_seed(from.random_seed);
  to.set_impact(pack_vec3s({from.impact_m}));
  to.set_party(from.party);
  to.set_blasted(from.blasted);
  if (from.thrown_by == nullptr) return;
  to.set_thrown_by(to_string(encode(std::vector{Command{0, 0, *from.thrown_by, 0}})));
}

PendingRefracture read(const kept::Cut& from, FieldChecker& check) {
  PendingRefracture pending{.piece = from.piece(),
                            .pieces = from.pieces(),
                            .pattern = check.kind<SeedPattern>(from.pattern(), "pattern"),
                            .random_seed = from.random_seed(),
                            .party = from.party(),
                            .blasted = from.blasted()};
  const auto impact = check.value_or_refuse(unpack_vec3s(from.impact(), "impact of a cut", 1));
  if (impact.size() == 1)
    pending.impact_m = impact.front();
  else
    check.refuse("a cut without an impact");
  if (from.thrown_by().empty()) return pending;
  const auto commands = check.value_or_refuse(decode_recorded_commands(as_span(from.thrown_by())));
  if (commands.size() == 1 && std::holds_alternative<CarveRequest>(commands.front().body))
    pending.thrown_by = std::make_shared<const CarveRequest>(std::get<CarveRequest>(commands.front().body));
  else
    check.refuse("a cut's pieces are thrown by an operation that is not a carve");
  return pending;
}

void write(kept::Piece& to, const PieceRecord& from) {
  const BodyShape& shape = *from.shape;
  to.set_id(from.id);
  to.set_generation(from.traits.generation);
  to.set_fell(from.traits.fell);
  to.set_owner(from.traits.owner);
  to.set_kept(from.traits.kept);
  to.set_volume(to_string(encode_volume(*from.volume)));
  to.set_mass_kg(shape.mass_kg);
  to.set_friction(shape.friction);
  to.set_inertia(pack_vec3s({shape.inertia_kg_m2[0], shape.inertia_kg_m2[1], shape.inertia_kg_m2[2]}));
  to.set_hull(pack_vec3s(shape.hull_m));
  to.set_surface(pack_vec3s(shape.surface_m));
  if (shape.centre_m != glm::vec3(0.0F)) to.set_centre(pack_vec3s({shape.centre_m}));
  to.set_restitution(shape.restitution);
  for (const std::vector<glm::vec3>& part : shape.parts_m) to.add_parts(pack_vec3s(part));
}

BodyShape read_shape(const kept::Piece& from, FieldChecker& check) {
  BodyShape shape;
  shape.mass_kg = check.finite(from.mass_kg(), "mass_kg");
  shape.friction = check.not_negative(from.friction(), "friction");
  const auto inertia = check.value_or_refuse(unpack_vec3s(from.inertia(), "inertia", 3));
  if (inertia.size() == 3)
    shape.inertia_kg_m2 = glm::mat3(inertia[0], inertia[1], inertia[2]);
  else
    check.refuse("a tensor of inertia without nine numbers");
  shape.hull_m = check.value_or_refuse(unpack_vec3s(from.hull(), "hull", hull_points_max));
  shape.surface_m = check.value_or_refuse(unpack_vec3s(from.surface(), "surface", surface_points_max));
  const auto centre = check.value_or_refuse(unpack_vec3s(from.centre(), "centre of mass", 1));
  if (!centre.empty()) shape.centre_m = centre.front();
  if (from.has_restitution()) shape.restitution = check.not_negative(from.restitution(), "restitution");
  if (from.parts_size() > parts_max) check.refuse(fmt::format("more than {} parts", parts_max));
  for (int i = 0; i < from.parts_size() && !check.failed(); ++i)
    shape.parts_m.push_back(check.value_or_refuse(unpack_vec3s(from.parts(i), "part", hull_points_max)));
  return shape;
}

PieceRecord read(const kept::Piece& from, FieldChecker& check) {
  PieceRecord piece;
  piece.id = from.id();
  piece.traits.generation =
      static_cast<uint8_t>(check.within(from.generation(), 0, UINT8_MAX, "generation of a piece"));
  piece.traits.fell = from.fell();
  piece.traits.owner = from.owner();
  piece.traits.kept = from.kept();
  piece.volume = std::make_shared<const Volume>(check.value_or_refuse(decode_volume(as_span(from.volume()))));
  piece.shape = std::make_shared<const BodyShape>(read_shape(from, check));
  return piece;
}

using Shares = google::protobuf::RepeatedPtrField<kept::Share>;

/// All bricks in one list, and in `shares` whose they are; party 0 alone needs none.
std::string write(Shares& shares, const std::vector<PartyBricks>& from) {
  std::vector<BrickCoord> all;
  const bool has_parties = std::ranges::any_of(from, [](const PartyBricks& one) { return one.party != 0; });
  for (const auto& [party, bricks] : from) {
    all.insert(all.end(), bricks.begin(), bricks.end());
    if (!has_parties) continue;
    kept::Share& share = *shares.Add();
    share.set_party(party);
    share.set_bricks(static_cast<uint32_t>(bricks.size()));
  }
  return pack_bricks(all);
}

std::vector<PartyBricks> read(const Shares& shares, const std::string& packed_bricks, const char* what,
                              FieldChecker& check) {
  std::vector<BrickCoord> all = check.value_or_refuse(unpack_bricks(packed_bricks, what));
  if (all.empty() && shares.empty()) return {};
  if (shares.empty()) return {{0, std::move(all)}};
  std::vector<PartyBricks> parties;
  auto next = all.begin();
  for (const kept::Share& share : shares) {
    if (share.bricks() == 0 || share.bricks() > static_cast<size_t>(all.end() - next)) break;
    const auto end = next + share.bricks();
    parties.push_back({share.party(), {next, end}});
    next = end;
  }
  if (next != all.end() || parties.size() != static_cast<size_t>(shares.size()))
    check.refuse(fmt::format("{}: not as many as their parties have", what));
  if (std::ranges::adjacent_find(parties, std::ranges::greater_equal{}, &PartyBricks::party) != parties.end())
    check.refuse(fmt::format("{}: their parties are not in order", what));
  return parties;
}

void write(kept::Moment& to, const WorldMoment& from) {
  write(*to.mutable_config(), from.config);
  to.set_tick(from.tick);
  to.set_next_piece(from.next_piece);
  write(*to.mutable_ledger(), from.ledger);
  to.set_field_hash(from.field_hash);
  to.set_state_hash(from.state_hash);
  to.set_bodies(pack_bodies(from.motion.bodies));
  to.set_freed(pack_bounds(from.motion.freed));
  to.set_changes(pack_boxes(from.motion.changes));
  to.set_rest(pack_timers(from.rest.timers));
  to.set_rest_put_off(from.rest.put_off);
  write(*to.mutable_party_turns(), from.requests.turns);
  for (const PartyValue& party : from.requests.parties) {
    kept::Party& added = *to.add_parties();
    added.set_party(party.party);
    write(*added.mutable_turns(), party.turns);
    for (const SessionValue& session : party.sessions) write(*added.add_sessions(), session);
  }
  to.set_requested(from.requested);
  to.set_debt_us(from.debt_us);
  for (const PendingRefracture& pending : from.refractures) write(*to.add_cuts(), pending);
  to.set_cut_at(from.refractured_at);
  to.set_island_at(from.island_at);
  for (const LooseningEdit& search : from.islands) {
    kept::Search& added = *to.add_searches();
    added.set_bricks(pack_bricks(search.bricks));
    added.set_restarts(search.restarts);
    added.set_party(search.party);
  }
  to.set_cut(write(*to.mutable_cut_shares(), from.loosened_bricks));
  to.set_strained(write(*to.mutable_strained_shares(), from.strained));
  to.set_slopes(write(*to.mutable_slope_shares(), from.slopes));
  to.set_gained(pack_boxes(from.gained));
  to.set_buried(pack_ids(from.buried));
  to.set_sunk(pack_ids(from.sunk));
  write(*to.mutable_materials(), from.materials);
  write_world_props(to, from);
  for (const StruckPlace& place : from.struck) {
    kept::StruckPlace& added = *to.add_struck();
    added.set_x(place.cell.x);
    added.set_y(place.cell.y);
    added.set_z(place.cell.z);
    added.set_energy_j(place.energy_j);
    added.set_at(place.at);
  }
}

RequestsValue read_requests(const kept::Moment& from, FieldChecker& check) {
  RequestsValue requests{read(from.party_turns(), check), {}};
  for (const kept::Party& one : from.parties()) {
    PartyValue party{one.party(), read(one.turns(), check), {}};
    for (const kept::Session& session : one.sessions()) party.sessions.push_back(read(session, check));
    if (check.failed()) break;
    requests.parties.push_back(std::move(party));
  }
  return requests;
}

WorldMoment read(const kept::Moment& from, FieldChecker& check) {
  WorldMoment moment;
  moment.config = read(from.config(), check);
  if (!reads_recording_format(moment.config.format)) check.refuse("its settings are of another format");
  moment.tick = from.tick();
  moment.next_piece = from.next_piece();
  moment.ledger = scree::read(from.ledger(), check);
  moment.field_hash = from.field_hash();
  moment.state_hash = from.state_hash();
  moment.motion.bodies = check.value_or_refuse(unpack_bodies(from.bodies()));
  moment.motion.freed = check.value_or_refuse(unpack_bounds(from.freed(), "places of removed bodies"));
  moment.motion.changes = check.value_or_refuse(unpack_boxes(from.changes(), "changes of terrain"));
  moment.rest.timers = check.value_or_refuse(unpack_timers(from.rest()));
  moment.rest.put_off = from.rest_put_off();
  moment.requests = read_requests(from, check);
  moment.requested = from.requested();
  moment.debt_us = check.not_negative(from.debt_us(), "debt_us");
  for (const kept::Cut& pending : from.cuts()) moment.refractures.push_back(read(pending, check));
  moment.refractured_at = from.cut_at();
  moment.island_at = from.island_at();
  for (const kept::Search& search : from.searches())
    moment.islands.push_back({check.value_or_refuse(unpack_bricks(search.bricks(), "searched bricks")),
                              search.restarts(), search.party()});
  moment.loosened_bricks = read(from.cut_shares(), from.cut(), "cut bricks", check);
  moment.strained = read(from.strained_shares(), from.strained(), "strained bricks", check);
  moment.slopes = read(from.slope_shares(), from.slopes(), "slopes", check);
  moment.gained = check.value_or_refuse(unpack_boxes(from.gained(), "gained terrain"));
  moment.buried = check.value_or_refuse(unpack_piece_ids(from.buried(), "buried pieces"));
  moment.sunk = check.value_or_refuse(unpack_piece_ids(from.sunk(), "sunk pieces"));
  moment.materials = scree::read(from.materials(), check);
  read_world_props(from, moment, check);
  for (const kept::StruckPlace& one : from.struck())
    moment.struck.push_back(
        {{one.x(), one.y(), one.z()}, check.not_negative(one.energy_j(), "energy of blows"), one.at()});
  return moment;
}

constexpr const char* header_subject = "header of the world";
constexpr const char* chunk_subject = "chunk of the world";
constexpr const char* piece_subject = "piece of the world";
constexpr const char* moment_subject = "state of the world";

}  // namespace

std::vector<uint8_t> encode(const WorldHeader& header) {
  kept::WorldHeader to;
  to.set_format(header.format);
  to.set_world(header.world);
  write(*to.mutable_config(), header.config);
  return bytes_of(to);
}

Result<WorldHeader> decode_world_header(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<kept::WorldHeader>(bytes, header_subject));
  WorldHeader header;
  header.format = from.format();
  if (!reads_world_format(header.format))
    return header;  // in another format the fields may mean something else
  FieldChecker check(header_subject);
  header.world = from.world();
  if (header.world == 0) check.refuse("the world has no number");
  header.config = read(from.config(), check);
  if (!reads_recording_format(header.config.format)) check.refuse("its settings are of another format");
  return checked(std::move(header), check);
}

std::vector<uint8_t> encode(const WorldChunk& chunk) {
  CHECK(!chunk.bricks.empty());
  kept::Chunk to;
  to.set_x(chunk.chunk.x);
  to.set_y(chunk.chunk.y);
  to.set_z(chunk.chunk.z);
  to.set_version(chunk.version);
  to.set_hash(chunk.hash);
  to.set_bricks(to_string(encode_bricks(chunk.bricks)));
  if (chunk.ground_mass) to.set_ground_mass(*chunk.ground_mass);
  return bytes_of(to);
}

Result<WorldChunk> decode_world_chunk(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<kept::Chunk>(bytes, chunk_subject));
  FieldChecker check(chunk_subject);
  WorldChunk chunk{{from.x(), from.y(), from.z()}, from.version(), from.hash(), {}, {}};
  chunk.bricks = check.value_or_refuse(decode_bricks(as_span(from.bricks())));
  uint64_t hash = 0;
  for (const BrickPatch& patch : chunk.bricks) {
    hash += brick_hash(patch.coord, patch.brick, patch.materials);
    if (chunk_of(patch.coord) != chunk.chunk) check.refuse("a brick of another chunk");
  }
  if (chunk.bricks.empty()) check.refuse("no bricks");
  if (std::ranges::adjacent_find(chunk.bricks, std::ranges::greater_equal{}, &BrickPatch::coord) !=
      chunk.bricks.end())
    check.refuse("bricks are not in order");
  if (from.has_ground_mass()) {
    chunk.ground_mass = from.ground_mass();
    if (*chunk.ground_mass < 0 || *chunk.ground_mass > brick_mass(solid_brick()) * ssize(chunk.bricks))
      check.refuse("its ground weighs more than rock, or less than nothing");
  }
  if (hash != chunk.hash) check.refuse("its hash is not that of its bricks");
  return checked(std::move(chunk), check);
}

std::vector<uint8_t> encode(const PieceRecord& piece) {
  kept::Piece to;
  write(to, piece);
  return bytes_of(to);
}

Result<PieceRecord> decode_piece_record(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<kept::Piece>(bytes, piece_subject));
  FieldChecker check(piece_subject);
  return checked(read(from, check), check);
}

std::vector<uint8_t> encode(const WorldMoment& moment) {
  kept::Moment to;
  write(to, moment);
  return bytes_of(to);
}

Result<WorldMoment> decode_world_moment(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<kept::Moment>(bytes, moment_subject));
  FieldChecker check(moment_subject);
  return checked(read(from, check), check);
}

std::vector<uint8_t> encode(const WorldSnapshot& world) {
  kept::World to;
  write(*to.mutable_moment(), world.moment);
  for (const PieceRecord& piece : world.moment.pieces) write(*to.add_pieces(), piece);
  const std::span<const BrickPatch> bricks(world.bricks);
  for (size_t at = 0; at < bricks.size(); at += limits::bricks_per_message_max)
    to.add_bricks(to_string(
        encode_bricks(bricks.subspan(at, std::min(limits::bricks_per_message_max, bricks.size() - at)))));
  return bytes_of(to);
}

Result<WorldSnapshot> decode_world(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<kept::World>(bytes, moment_subject));
  FieldChecker check(moment_subject);
  WorldSnapshot world{read(from.moment(), check), {}};
  size_t voxels = 0;
  for (int i = 0; i < from.pieces_size() && !check.failed(); ++i) {
    world.moment.pieces.push_back(read(from.pieces(i), check));
    voxels += world.moment.pieces.back().volume->window.codes.size();
    if (voxels > limits::piece_voxels_max)
      check.refuse(
          fmt::format("pieces of more than {} voxels (limits.piece_voxels_max)", limits::piece_voxels_max));
  }
  for (int i = 0; i < from.bricks_size() && !check.failed(); ++i) {
    const std::vector<BrickPatch> bricks = check.value_or_refuse(decode_bricks(as_span(from.bricks(i))));
    world.bricks.insert(world.bricks.end(), bricks.begin(), bricks.end());
  }
  return checked(std::move(world), check);
}

}  // namespace scree
