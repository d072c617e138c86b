#include "tools/export/live/live_terrain.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "shared/base/limits.h"
#include "shared/base/text.h"
#include "shared/base/timing.h"
#include "tools/export/limits.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto message_wait = 50ms;

/// The box in parts of so many chunks a side, at most.
std::vector<ChunkBox> parts_of(const ChunkBox& box, int side) {
  std::vector<ChunkBox> parts;
  for (int x = box.lo.x; x < box.hi.x; x += side)
    for (int y = box.lo.y; y < box.hi.y; y += side)
      for (int z = box.lo.z; z < box.hi.z; z += side)
        parts.push_back(
            {{x, y, z},
             {std::min(x + side, box.hi.x), std::min(y + side, box.hi.y), std::min(z + side, box.hi.z)}});
  return parts;
}

bool holds(const ChunkBox& box, ChunkCoord chunk) {
  return chunk.x >= box.lo.x && chunk.y >= box.lo.y && chunk.z >= box.lo.z && chunk.x < box.hi.x &&
         chunk.y < box.hi.y && chunk.z < box.hi.z;
}

void copy_edits(Field& from, const ChunkBox& box, Field& to) {
  for (const ChunkCoord chunk : from.edited_chunks()) {
    if (!holds(box, chunk)) continue;
    for (const BrickCoord brick : from.edited_bricks(chunk)) {
      to.set_brick(brick, from.brick(brick));
      to.set_materials(brick, from.materials(brick));
    }
  }
}

class Fetcher {
 public:
  explicit Fetcher(const LiveFetch& how) : Fetcher(how, std::make_unique<ServerConnector>(how.server)) {}

  Result<LiveTerrain> fetch(const std::function<void(double)>& progress) {
    TRY(join({}));
    return how_.box ? fetch_box(progress) : fetch_all(progress);
  }

 private:
  Fetcher(const LiveFetch& how, std::unique_ptr<ServerConnector> connector)
      : how_(how),
        ends_(Clock::now() + how.within),
        connector_(connector.get()),
        client_(std::move(connector)) {}

  /// Begins a session with as wide an interest as the server grants. It resumes the last one by its ticket.
  Result<void> join(glm::vec3 eye_m) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(ends_ - Clock::now());
    connector_->allow(std::clamp(left, 1ms, limits::export_connect_ms));
    const auto joined =
        join_and_wait(client_, {protocol_version, "scree-export", eye_m, limits::interest_radius_max_m});
    if (!joined) return fail(joined.error().message);
    ++sessions_;
    has_edits_ = has_all_edits_ = false;
    return {};
  }

  Result<void> follow() {
    client_.wait(message_wait);
    client_.poll(steady_now_s());
    while (const std::optional<Client::Event> event = client_.next()) {
      if (const auto* lost = std::get_if<Client::Lost>(&*event))
        return fail("the connection was lost: " + lost->end.message);
      const auto* applied = std::get_if<Client::Applied>(&*event);
      if (applied && std::holds_alternative<StatusMessage>(applied->received.message)) compare();
    }
    return {};
  }

  Result<void> follow_until(const std::function<bool()>& done, const std::function<std::string()>& missing) {
    while (!done()) {
      if (Clock::now() >= ends_)
        return fail(fmt::format("{}: not complete within {} s (--timeout): {}",
                                endpoint_text(how_.server.host, how_.server.port), how_.within.count(),
                                missing()));
      if (auto followed = follow(); !followed)
        return fail(endpoint_text(how_.server.host, how_.server.port) + ": " + followed.error().message);
    }
    return {};
  }

  Mirror& mirror() { return *client_.mirror(); }
  const Mirror& mirror() const { return *client_.mirror(); }

  /// The status has just come, so it is about the mirror as it is.
  void compare() {
    const StatusMessage& status = *mirror().status();
    const MirrorCounters& counted = mirror().counters();
    has_edits_ = status.tick == mirror().tick() && status.chunks_waiting == 0 &&
                 counted.repairs_asked == counted.repairs_arrived;
    has_all_edits_ = has_edits_ && status.field_hash == mirror().field().hash();
  }

  Result<void> complete_edits() {
    return follow_until([this] { return has_edits_; },
                        [this] {
                          const auto& status = mirror().status();
                          return status ? fmt::format("{} edited chunks wait", status->chunks_waiting)
                                        : std::string("the server says nothing");
                        });
  }

  /// Tiles that are missed are asked for; those that came make more chunks whole.
  Result<void> complete_ground(const ChunkBox& box) {
    if (client_.rejoin().tiles() == nullptr) return {};
    std::vector<ChunkCoord> missing;
    for_each_chunk(box.voxels(), [&](ChunkCoord chunk) { missing.push_back(chunk); });
    uint64_t seen = ~uint64_t{0};
    return follow_until(
        [&] {
          if (std::exchange(seen, client_.rejoin().tiles()->tiles_received()) !=
              client_.rejoin().tiles()->tiles_received())
            std::erase_if(missing, [&](ChunkCoord chunk) { return is_here(mirror().terrain(), chunk); });
          return missing.empty();
        },
        [&] {
          return fmt::format("the ground of {} chunks is missing; a smaller --box needs less",
                             missing.size());
        });
  }

  Result<void> complete_ground(const std::vector<ChunkBox>& parts,
                               const std::function<void(double)>& progress) {
    for (size_t i = 0; i < parts.size(); ++i) {
      TRY(complete_ground(parts[i]));
      progress(static_cast<double>(i + 1) / static_cast<double>(parts.size()));
    }
    return {};
  }

  /// Chunks a side of a cube that lies within the interest around its middle.
  int part_side() const {
    const float side_m = 2.0F * client_.welcome()->interest_radius_m / std::sqrt(3.0F);
    return std::max(1, static_cast<int>(side_m / chunk_m()));
  }
  float chunk_m() const { return static_cast<float>(chunk_size) * mirror().terrain().voxel_size_m; }

  LiveTerrain contents(const ChunkBox& box) const {
    return {std::make_unique<MapField>(mirror().terrain()), mirror().palette(), box, mirror().tick(),
            sessions_};
  }

  Result<LiveTerrain> fetch_box(const std::function<void(double)>& progress) {
    const auto box = how_.box(MapField(mirror().terrain()));
    TRY(box);
    const std::vector<ChunkBox> parts = parts_of(*box, part_side());
    LiveTerrain terrain = contents(*box);
    for (size_t i = 0; i < parts.size(); ++i) {
      const ChunkCoord sum = parts[i].lo + parts[i].hi;
      TRY(join(0.5F * chunk_m() * glm::vec3(sum.x, sum.y, sum.z)));
      TRY(complete_edits());
      TRY(complete_ground(parts[i]));
      copy_edits(mirror().field(), parts[i], *terrain.field);
      progress(static_cast<double>(i + 1) / static_cast<double>(parts.size()));
    }
    terrain.tick = mirror().tick();
    terrain.sessions = sessions_;
    return terrain;
  }

  Result<LiveTerrain> fetch_all(const std::function<void(double)>& progress) {
    if (const auto middle = place_above(mirror().terrain()); middle && *middle != glm::vec3{})
      TRY(join(*middle));
    TRY(complete_edits());
    if (!has_all_edits_)
      return fail(fmt::format(
          "edits lie farther than {:.0f} m from the middle of the world: choose a part of it (--box)",
          client_.welcome()->interest_radius_m));
    auto box = TRY(whole_of(mirror().field()));
    TRY(check_count(box));
    LiveTerrain terrain = contents(box);
    copy_edits(mirror().field(), box, *terrain.field);
    TRY(complete_ground(parts_of(box, part_side()), progress));
    return terrain;
  }

  const LiveFetch& how_;
  const Clock::time_point ends_;
  ServerConnector* connector_;  ///< the client's
  Client client_;
  size_t sessions_ = 0;
  bool has_edits_ = false;      ///< of this session's interest
  bool has_all_edits_ = false;  ///< of the world
};

}  // namespace

Result<LiveTerrain> fetch_terrain(const LiveFetch& how, const std::function<void(double)>& progress) {
  return Fetcher(how).fetch(progress);
}

}  // namespace scree
