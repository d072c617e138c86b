#include "server/app/admission.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <string>
#include <utility>

#include "server/app/limits.h"
#include "server/work/limits.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

Refused no_memory(double used_bytes, double added_bytes, uint32_t max_mb) {
  const auto whole = [](double bytes) { return static_cast<uint64_t>(std::ceil(bytes / bytes_per_mb)); };
  return {Refusal::memory_max,
          fmt::format("the terrain takes about {} of {} MB (memory-max) and this edit may add {} MB: edit "
                      "where terrain has been edited before, or have the limit raised (--memory-max)",
                      whole(used_bytes), max_mb, whole(added_bytes))};
}

/// The voxels that a request edits or reads; nothing: it does neither. Only a shape that an operation may
/// have, and a joint that is valid, has a bounded box. The simulation refuses the others.
std::optional<VoxelBox> box_of(const Request& request, float voxel_size_m) {
  if (const auto* const add = std::get_if<AddJointRequest>(&request)) {
    const glm::vec3* const anchor_m = anchor_of(request);
    if (anchor_m == nullptr || !validate(add->joint)) return std::nullopt;
    const glm::vec3 at = *anchor_m / voxel_size_m;
    const VoxelCoord voxel{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
    return VoxelBox{voxel, voxel + VoxelCoord{1, 1, 1}};
  }
  if (const auto* const restore = std::get_if<RestoreRequest>(&request)) {
    if (restore->bricks == nullptr) return std::nullopt;
    const VoxelCoord lo = first_voxel(chunk_of(restore->bricks->front().then.coord));
    return VoxelBox{lo, lo + VoxelCoord{chunk_size, chunk_size, chunk_size}};
  }
  std::optional<Shape> shape = shape_of(request);
  if (const auto* const blast = std::get_if<BlastRequest>(&request))
    shape = sphere(blast->centre_m, blast_reach_m(blast->energy_j, voxel_size_m));
  if (!shape || !validate_edit(*shape, voxel_size_m)) return std::nullopt;
  return band_box(in_voxels(*shape, voxel_size_m));
}

Reply refusal_of(const Command& command, const Refused& refused) {
  Reply reply{command.session, command.request, refused.message, 0};
  reply.reason = refused.reason;
  return reply;
}

}  // namespace

tl::expected<Admission::Verdict, Refused> Admission::judge(const Held& held, const EditGround& ground,
                                                           double now_s) {
  const auto& [world, pager, ahead, room_will_come] = ground;
  const WorldConfig& config = world.config();
  const std::optional<VoxelBox> asked = box_of(held.command.body, config.terrain.voxel_size_m);
  if (!asked) return admit_with(held.command, 0.0);
  const VoxelBox box = *asked;
  const VoxelBox around = box.grown(limits::admitted_margin_voxels);
  const double waited_s = now_s - held.since_s;
  const bool waited_long = waited_s > limits::held_seconds_max;
  if (!pager.is_in(around)) {
    if (const auto reason = pager.unreadable(around))
      return tl::unexpected(Refused{Refusal::terrain_unreadable,
                                    "the terrain here cannot be read from the world's file: " + *reason});
    if (!waited_long) return Verdict::hold;
    return tl::unexpected(
        Refused{Refusal::terrain_unreadable,
                fmt::format("the terrain here was not read from the world's file in {} s: ask again",
                            limits::held_seconds_max)});
  }
  if (ahead != nullptr && !ahead->has(world.field(), around) && waited_s <= limits::generated_wait_s)
    return Verdict::hold;
  const uint32_t max_mb = config.memory_max_mb;
  const double used = used_bytes(pager.memory(), max_mb) + reserved_sum_bytes_;
  const bool edits = shape_of(held.command.body).has_value();
  const double added = edits ? added_bytes(box, world.field()) : 0.0;
  if (added == 0.0 || used + added <= max_mb * bytes_per_mb * (1.0 - limits::merge_memory_share))
    return admit_with(held.command, added);
  if (room_will_come && !waited_long) return Verdict::hold;
  return tl::unexpected(no_memory(used, added, max_mb));
}

Admission::Verdict Admission::admit_with(const Command& command, double added_bytes) {
  reserved_bytes_[{command.session, command.request}].insert(added_bytes);
  reserved_sum_bytes_ += added_bytes;
  return Verdict::admit;
}

Admitted Admission::admit(std::vector<Command> arrived, const EditGround& ground) {
  const double now_s = steady_now_s();
  std::set<uint64_t> leaving, blocked;
  for (Command& command : arrived) {
    if (std::holds_alternative<LeaveRequest>(command.body)) leaving.insert(command.session);
    held_.push_back({std::move(command), now_s});
  }
  Admitted admitted;
  std::deque<Held> still_held;
  std::map<uint64_t, size_t> held_by;  // by party: each may have as many as there are places left
  for (Held& one : held_) {
    // Who leaves is answered by the simulation, whatever waits; a person walks on while an edit waits.
    if (leaving.contains(one.command.session) || std::holds_alternative<WalkRequest>(one.command.body)) {
      admitted.commands.push_back(std::move(one.command));
      continue;
    }
    const bool is_behind = blocked.contains(one.command.session);
    const auto verdict = is_behind ? Verdict::hold : judge(one, ground, now_s);
    if (!verdict) {
      admitted.refused.push_back(refusal_of(one.command, verdict.error()));
    } else if (*verdict == Verdict::admit) {
      admitted.commands.push_back(std::move(one.command));
    } else if (size_t& own = held_by[party_of(one.command)];
               own >=
               limits::requests_waiting_max - std::min(limits::requests_waiting_max, still_held.size())) {
      admitted.refused.push_back(refusal_of(
          one.command,
          {Refusal::requests_waiting,
           "too many requests of this client, or of those who share with it, wait for terrain to be "
           "read: ask again"}));
    } else {
      held_count_ += one.since_s == now_s && !is_behind ? 1 : 0;
      ++own;
      blocked.insert(one.command.session);
      still_held.push_back(std::move(one));
    }
  }
  held_ = std::move(still_held);
  return admitted;
}

/// Which of several commands under one number was answered is not known: it is taken for the smallest.
void Admission::answered(const std::vector<Reply>& replies) {
  for (const Reply& reply : replies) {
    const auto found = reserved_bytes_.find({reply.session, reply.request});
    if (found == reserved_bytes_.end()) continue;
    std::multiset<double>& reserved = found->second;
    reserved_sum_bytes_ -= *reserved.begin();
    reserved.erase(reserved.begin());
    if (reserved.empty()) reserved_bytes_.erase(found);
  }
  if (reserved_bytes_.empty()) reserved_sum_bytes_ = 0.0;
}

}  // namespace scree
