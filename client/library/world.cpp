// What the copy of the world has: its state, bodies, materials, and questions about space.
#include <algorithm>

#include "client/library/call.h"
#include "client/library/handle.h"
#include "shared/base/timing.h"
#include "shared/query/limits.h"
#include "shared/query/query.h"

namespace scree {
namespace {

constexpr const char* no_world = "no server was reached yet";
constexpr size_t codes_max = size_t{1} << 24U;

void add_ledger(const StatusMessage& told, scree_status& status) {
  status.server_tick = told.tick;
  status.server_hash = told.field_hash;
  status.ledger_terrain = told.ledger_terrain;
  status.ledger_pieces = told.ledger_pieces;
  status.ledger_dust = told.ledger_dust;
  status.ledger_poured = told.ledger_poured;
  status.ledger_stored = told.ledger_stored;
}

void add_world(scree_client& client, Mirror& mirror, scree_status& status) {
  status.tick = mirror.tick();
  status.voxel_m = mirror.terrain().voxel_size_m;
  status.loaded = client.client.loaded(steady_now_s()) ? 1 : 0;
  status.pieces = static_cast<uint32_t>(mirror.pieces().size());
  status.bodies = static_cast<uint32_t>(mirror.props().size());
  status.held_chunks = static_cast<uint32_t>(mirror.held_chunks().size());
  status.edited_bricks = mirror.field().edited_brick_count();
  status.field_hash = mirror.field().hash();
  status.mismatches = mirror.mismatches();
  if (const Predictions* const shown = client.client.predictions())
    status.predictions = static_cast<uint32_t>(shown->outstanding());
  if (mirror.status()) add_ledger(*mirror.status(), status);
  if (!client.walk || !client.walk->on_foot()) return;
  status.on_foot = 1;
  write_vec3(client.walk->walker().feet_m(), status.feet_m);
}

/// Calls add(kind, id, pose) for pieces, then props, then the bodies of persons, each by id.
template <typename Add>
void each_body(const scree_client& client, double tick, Add&& add) {
  const Mirror& mirror = *client.client.mirror();
  const auto pose_of = [&](const BetweenPoses& motion) {
    return tick < 0.0 ? motion.to : mirror.pose_at(motion, tick);
  };
  for (const auto& [id, motion] : mirror.pieces()) add(0, id, pose_of(motion));
  if (const Predictions* const shown = client.client.predictions())
    for (const auto& [id, volume] : shown->pieces())
      add(0, id,
          Pose{volume->centre_voxels * mirror.terrain().voxel_size_m, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)});
  for (const bool persons : {false, true})
    for (const auto& [id, motion] : mirror.props())
      if (mirror.persons().contains(id) == persons) add(persons ? 2 : 1, id, pose_of(motion));
}

scree_result counted(size_t count, size_t room, size_t* to) {
  *to = count;
  return count <= room ? done : fail(SCREE_TOO_SMALL, "there are more bodies than room");
}

QueryMask mask_of(uint32_t mask) {
  return {.terrain = (mask & SCREE_MASK_TERRAIN) != 0,
          .pieces = (mask & SCREE_MASK_PIECES) != 0,
          .bodies = (mask & SCREE_MASK_BODIES) != 0};
}

scree_result answer(const scree_client& client, glm::vec3 from_m,
                    const QueryResult<std::optional<Hit>>& found, scree_hit* to) {
  if (!found) return fail(SCREE_INVALID, found.error().message);
  if (!found->answer) return nothing;
  const Hit& hit = *found->answer;
  scree_hit told{};
  told.kind = static_cast<uint32_t>(hit.kind);
  told.id = hit.id;
  told.material = static_cast<uint32_t>(hit.material);
  told.distance_m = hit.distance_m;
  told.inside = hit.inside ? 1 : 0;
  told.exact = found->cost.exact && client.knows(from_m) && client.knows(hit.place_m) ? 1 : 0;
  write_vec3(hit.place_m, told.place_m);
  write_vec3(hit.normal, told.normal);
  return write_struct(told, to) ? done : fail(SCREE_INVALID, "no release has such a hit");
}

/// Asks the mirror. `ask` gets it.
template <typename Ask>
scree_result asked(scree_client* client, bool has_all, Ask&& ask) {
  return guarded([&] {
    if (client == nullptr || !has_all)
      return fail(SCREE_INVALID, "an argument is null, or beyond its bounds");
    Mirror* const mirror = client->client.mirror();
    if (mirror == nullptr) return fail(SCREE_NOT_CONNECTED, no_world);
    return ask(*mirror);
  });
}

scree_result read_codes(Mirror& mirror, const int32_t lo[3], const int32_t hi[3], int8_t* codes,
                        size_t room) {
  constexpr int32_t furthest = 1 << 20;
  const VoxelBox box{{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
  size_t count = 1;
  for (int i = 0; i < 3; ++i) {
    if (lo[i] < -furthest || hi[i] > furthest || lo[i] >= hi[i])
      return fail(SCREE_INVALID, "the box is empty, or beyond any world");
    count *= static_cast<size_t>(hi[i] - lo[i]);
    if (count > codes_max) return fail(SCREE_INVALID, "the box has more than 2^24 voxels");
  }
  if (room < count) return fail(SCREE_TOO_SMALL, "the array has less room than the box has voxels");
  const Window window = gather(mirror.field(), box);
  std::copy_n(reinterpret_cast<const int8_t*>(window.codes.data()), count, codes);
  return done;
}

}  // namespace

scree_status status_of(scree_client& client) {
  scree_status status{};
  if (const WelcomeMessage* const welcome = client.client.welcome()) {
    status.connected = 1;
    status.session = welcome->session;
    status.tick_rate_hz = welcome->tick_rate_hz;
    status.role = static_cast<uint32_t>(welcome->role);
    status.radius_m = std::min(client.client.radius_m(), welcome->interest_radius_m);
    if (welcome->spawn) {
      const float yaw = glm::radians(welcome->spawn->yaw_degrees),
                  pitch = glm::radians(welcome->spawn->pitch_degrees);
      write_vec3({std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)},
                 status.spawn_look);
    }
  }
  write_vec3(client.client.eye_m(), status.eye_m);
  const ConnectionCounters counters = client.client.counters();
  status.received_bytes = counters.received_bytes;
  status.sent_bytes = counters.sent_bytes;
  if (Mirror* const mirror = client.client.mirror()) add_world(client, *mirror, status);
  return status;
}

size_t bodies_of(const scree_client& client, double tick, scree_body* to, size_t room) {
  size_t count = 0;
  each_body(client, tick, [&](uint32_t kind, PieceId id, const Pose& pose) {
    if (count++ >= room) return;
    scree_body& body = to[count - 1];
    body.id = id;
    body.kind = kind;
    write_pose(pose, body.position, body.rotation);
  });
  return count;
}

}  // namespace scree

using namespace scree;

scree_result scree_client::step_on_foot(glm::vec3 go, uint32_t buttons, glm::vec3 look) {
  constexpr uint32_t jump = 1, run = 2;
  if (!walk || !walk->on_foot()) return nothing;
  const float length = glm::length(look);
  if (!(length > 0.0F)) return fail(SCREE_INVALID, "one looks somewhere");
  const WalkInput input{
      .go = glm::clamp(go, -1.0F, 1.0F), .fast = (buttons & run) != 0, .jump = (buttons & jump) != 0};
  const std::optional<WalkMessage> message = walk->step(input, look / length, *client.mirror());
  if (!message) return nothing;
  client.send(*message);
  return done;
}

/// Whether the edits there are followed, and have arrived.
bool scree_client::knows(glm::vec3 place_m) const {
  const WelcomeMessage* const welcome = client.welcome();
  return welcome != nullptr && client.loaded(steady_now_s()) &&
         glm::distance(place_m, client.eye_m()) <= std::min(client.radius_m(), welcome->interest_radius_m);
}

void scree_client::follow(glm::vec3 eye_m, float radius_m) {
  hello_.eye_m = eye_m;
  hello_.interest_radius_m = radius_m;
  hello_.at_spawn = false;
  client.follow(eye_m, radius_m);
}

extern "C" {

scree_result scree_client_status(scree_client* client, scree_status* status) {
  return guarded([&] {
    if (client == nullptr) return fail(SCREE_INVALID, "the client is null");
    return write_struct(status_of(*client), status) ? done
                                                    : fail(SCREE_INVALID, "no release has such a status");
  });
}

scree_result scree_client_bodies(scree_client* client, double tick, scree_body* bodies, size_t room,
                                 size_t* count) {
  return asked(
      client, count != nullptr && (bodies != nullptr || room == 0) && std::isfinite(tick),
      [&](Mirror& /*mirror*/) { return counted(bodies_of(*client, tick, bodies, room), room, count); });
}

scree_result scree_client_body_columns(scree_client* client, double tick, const scree_body_columns* columns,
                                       size_t room, size_t* count) {
  const auto given = read_struct(columns);
  return asked(client, given && count != nullptr && std::isfinite(tick), [&](Mirror& /*mirror*/) {
    // Copies, for a write of a byte might be one of theirs.
    uint32_t* const ids = given->ids;
    uint8_t* const kinds = given->kinds;
    float *const positions = given->positions, *const rotations = given->rotations;
    size_t found = 0;
    each_body(*client, tick,
              [&found, room, ids, kinds, positions, rotations](uint32_t kind, PieceId id, const Pose& pose) {
                const size_t row = found++;
                if (row >= room) return;
                if (ids != nullptr) ids[row] = id;
                if (kinds != nullptr) kinds[row] = static_cast<uint8_t>(kind);
                if (positions != nullptr) write_vec3(pose.position_m, positions + 3 * row);
                if (rotations != nullptr) write_rotation(pose.rotation, rotations + 4 * row);
              });
    return counted(found, room, count);
  });
}

scree_result scree_client_prop(scree_client* client, uint32_t id, scree_prop* prop) {
  return asked(client, true, [&](Mirror& mirror) {
    const auto found = mirror.props().find(id);
    if (found == mirror.props().end()) return nothing;
    const Prop& body = *found->second.prop;
    const auto person = mirror.persons().find(id);
    scree_prop told{};
    told.motion = static_cast<uint32_t>(body.motion);
    told.material = static_cast<uint32_t>(body.material);
    told.mass_kg = body.mass_kg;
    told.tag = body.tag;
    told.session = person == mirror.persons().end() ? 0 : person->second;
    told.data = body.data.empty() ? nullptr : body.data.data();
    told.data_bytes = body.data.size();
    return write_struct(told, prop) ? done : fail(SCREE_INVALID, "no release has such a prop");
  });
}

scree_result scree_client_material(scree_client* client, uint32_t number, scree_material* material) {
  return asked(client, true, [&](Mirror& mirror) {
    const Palette& palette = *mirror.palette();
    if (number >= palette.rows.size()) return nothing;
    const MaterialRow& row = palette.rows[number];
    scree_material told{};
    std::copy_n(row.look.colour.data(), 3, told.colour);
    told.roughness = row.look.roughness;
    told.density_kg_m3 = row.density_kg_m3;
    told.friction = row.friction;
    told.name = row.name.c_str();
    return write_struct(told, material) ? done : fail(SCREE_INVALID, "no release has such a material");
  });
}

scree_result scree_client_find_material(scree_client* client, const char* name, uint32_t* number) {
  return asked(client, name != nullptr && number != nullptr, [&](Mirror& mirror) {
    const std::optional<Material> found = mirror.palette()->named(name);
    if (!found) return nothing;
    *number = static_cast<uint32_t>(*found);
    return done;
  });
}

scree_result scree_client_carried(scree_client* client, uint32_t material, int64_t* mass) {
  return asked(client, mass != nullptr && material < materials_max, [&](Mirror& mirror) {
    *mass = mass_of(mirror.carried(), static_cast<Material>(material));
    return done;
  });
}

scree_result scree_client_cast(scree_client* client, const float from_m[3], const float unit[3], float most_m,
                               float radius_m, uint32_t mask, scree_hit* hit) {
  return asked(client, from_m != nullptr && unit != nullptr && hit != nullptr, [&](Mirror& mirror) {
    const HeldScene scene = mirror.scene();
    const glm::vec3 from = vec3_of(from_m), along = vec3_of(unit);
    return answer(*client, from,
                  radius_m == 0.0F ? cast_ray(scene, from, along, most_m, mask_of(mask))
                                   : cast_sphere(scene, from, along, most_m, radius_m, mask_of(mask)),
                  hit);
  });
}

scree_result scree_client_nearest(scree_client* client, const float place_m[3], float most_m, uint32_t mask,
                                  scree_hit* hit) {
  return asked(client, place_m != nullptr && hit != nullptr, [&](Mirror& mirror) {
    const glm::vec3 place = vec3_of(place_m);
    return answer(*client, place, nearest_surface(mirror.scene(), place, most_m, mask_of(mask)), hit);
  });
}

scree_result scree_client_overlap(scree_client* client, const float place_m[3], float radius_m, uint32_t mask,
                                  uint32_t* terrain, uint32_t* ids, size_t room, size_t* count) {
  const bool has_all =
      place_m != nullptr && terrain != nullptr && count != nullptr && (ids != nullptr || room == 0);
  return asked(client, has_all, [&](Mirror& mirror) {
    const auto found = overlap_sphere(mirror.scene(), vec3_of(place_m), radius_m, mask_of(mask));
    if (!found) return fail(SCREE_INVALID, found.error().message);
    *terrain = found->answer.terrain ? 1 : 0;
    *count = found->answer.ids.size();
    std::copy_n(found->answer.ids.data(), std::min(*count, room), ids);
    return *count <= room ? done : fail(SCREE_TOO_SMALL, "there is more than room");
  });
}

scree_result scree_client_distances(scree_client* client, const float* places_m, size_t count,
                                    float* distances_m) {
  constexpr float furthest_m = limits::query_place_max_m;
  const bool has_all = places_m != nullptr && distances_m != nullptr;
  return asked(client, has_all, [&](Mirror& mirror) {
    if (!std::all_of(places_m, places_m + 3 * count, [](float v) { return std::abs(v) <= furthest_m; }))
      return fail(SCREE_INVALID, "a place is not finite, or beyond any world");
    const float voxel_m = mirror.terrain().voxel_size_m;
    for (size_t i = 0; i < count; ++i)
      distances_m[i] = sample(mirror.field(), vec3_of(places_m + 3 * i) / voxel_m).distance_voxels * voxel_m;
    return done;
  });
}

scree_result scree_client_codes(scree_client* client, const int32_t lo[3], const int32_t hi[3], int8_t* codes,
                                size_t room) {
  return asked(client, lo != nullptr && hi != nullptr && codes != nullptr,
               [&](Mirror& mirror) { return read_codes(mirror, lo, hi, codes, room); });
}
}
