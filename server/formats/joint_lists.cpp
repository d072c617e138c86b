#include "server/formats/joint_lists.h"

#include <algorithm>

#include "proto/codec.h"
#include "proto/limits.h"

namespace scree {

namespace {

template <typename T>
std::vector<T> batch_of(const std::vector<T>& all, size_t batch) {
  const size_t first = std::min(batch * limits::joints_a_message, all.size()),
               last = std::min(first + limits::joints_a_message, all.size());
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last)};
}

template <typename T>
void append_ascending(std::vector<T>& to, const std::vector<T>& next, FieldChecker& check) {
  if (!to.empty() && !next.empty() && to.back().id >= next.front().id)
    check.refuse("joints are not in the order of their ids");
  to.insert(to.end(), next.begin(), next.end());
}

}  // namespace

void write_joints(PackedJoints& to, const JointsMessage& joints) {
  for (size_t batch = 0;; ++batch) {
    const JointsMessage some{batch_of(joints.here, batch), batch_of(joints.gone, batch)};
    if (some.empty()) return;
    const std::vector<uint8_t> bytes = encode(ServerMessage(some));
    *to.Add() = {bytes.begin() + length_prefix_bytes, bytes.end()};
  }
}

JointsMessage read_joints(const PackedJoints& from, FieldChecker& check) {
  JointsMessage all;
  for (const std::string& packed : from) {
    if (check.failed()) break;
    const ServerMessage message = check.value_or_refuse(decode_server(as_span(packed)));
    const auto* const joints = std::get_if<JointsMessage>(&message);
    if (joints == nullptr) {
      check.refuse("a message has no joints, as it should");
      break;
    }
    append_ascending(all.here, joints->here, check);
    append_ascending(all.gone, joints->gone, check);
  }
  return all;
}

}  // namespace scree
