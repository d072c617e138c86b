#include "server/formats/cursor_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "proto/byte_stream.h"
#include "proto/limits.h"
#include "server/formats/event_codec.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

constexpr double steps_per_m = 64.0;
/// Beyond the world, so that sums of two do not overflow.
constexpr int64_t coordinate_max = int64_t{1} << 30;

enum class Entry : uint8_t { moved, gone, is_new };
constexpr uint8_t entry_max = static_cast<uint8_t>(Entry::is_new);

/// Eye and aim in steps.
using Place = std::array<int64_t, 6>;

int64_t steps_of(float metres) {
  const double steps = std::round(static_cast<double>(metres) * steps_per_m);
  return static_cast<int64_t>(
      std::clamp(steps, -static_cast<double>(coordinate_max), static_cast<double>(coordinate_max)));
}

Place place_of(const PlayerCursor& cursor) {
  Place place{};
  for (int i = 0; i < 3; ++i) {
    place[static_cast<size_t>(i)] = steps_of(cursor.eye_m[i]);
    place[static_cast<size_t>(i) + 3] = steps_of(cursor.aim_m[i]);
  }
  return place;
}

void put_place(PlayerCursor& cursor, const Place& place) {
  for (int i = 0; i < 3; ++i) {
    cursor.eye_m[i] = static_cast<float>(static_cast<double>(place[static_cast<size_t>(i)]) / steps_per_m);
    cursor.aim_m[i] =
        static_cast<float>(static_cast<double>(place[static_cast<size_t>(i) + 3]) / steps_per_m);
  }
}

/// What is known of a person from the entries before.
struct Known {
  std::string name;
  Place place{};
};

class Packer {
 public:
  explicit Packer(std::vector<uint8_t>& bytes) : writer_(bytes) {}

  void sample(const CursorSample& sample, Tick ticks_since) {
    writer_.varint(ticks_since);
    writer_.varint(sample.moved.size() + sample.gone.size());
    uint64_t before = 0;
    auto gone = sample.gone.begin();
    const auto put_gone_below = [&](uint64_t session) {
      for (; gone != sample.gone.end() && *gone < session; ++gone) {
        head(*gone, before, Entry::gone);
        known_.erase(*gone);
      }
    };
    for (const PlayerCursor& cursor : sample.moved) {
      put_gone_below(cursor.session);
      put(cursor, before);
    }
    put_gone_below(UINT64_MAX);
  }

 private:
  void head(uint64_t session, uint64_t& before, Entry entry) {
    writer_.varint(session - before);
    writer_.u8(static_cast<uint8_t>(entry));
    before = session;
  }

  void put(const PlayerCursor& cursor, uint64_t& before) {
    const auto [known, is_new] = known_.try_emplace(cursor.session);
    head(cursor.session, before, is_new ? Entry::is_new : Entry::moved);
    if (is_new) {
      const std::string name = showable(cursor.name, limits::person_name_bytes_max);
      writer_.varint(name.size());
      for (const char byte : name) writer_.u8(static_cast<uint8_t>(byte));
    }
    const Place place = place_of(cursor);
    for (size_t i = 0; i < place.size(); ++i) writer_.zigzag(place[i] - known->second.place[i]);
    known->second.place = place;
  }

  ByteWriter writer_;
  std::map<uint64_t, Known> known_;
};

class Unpacker {
 public:
  Unpacker(const std::string& packed, FieldChecker& check)
      : reader_(as_span(packed), "cursors"), check_(check) {}

  bool at_end() const { return reader_.at_end() || check_.failed(); }
  Tick ticks_since() { return reader_.varint("ticks between two samples", limits::ticks_per_row_max); }
  void refuse(const std::string& reason) { reader_.refuse(reason); }
  void end() {
    if (reader_.failed()) check_.refuse(reader_.error().message);
  }

  CursorSample sample(Tick tick) {
    CursorSample sample{tick};
    const uint64_t entries = reader_.varint("entries", limits::cursors_per_row_max);
    entries_ += entries;
    if (entries_ > limits::cursors_per_row_max) refuse("too many entries (limits.cursors_per_row_max)");
    uint64_t session = 0;
    for (uint64_t i = 0; i < entries && !reader_.failed() && !check_.failed(); ++i) {
      const uint64_t step = reader_.varint("session");
      if ((i > 0 && step == 0) || session + step < session || session + step == UINT64_MAX)
        refuse("sessions do not ascend");
      session += step;
      entry(session, sample);
    }
    return sample;
  }

 private:
  void entry(uint64_t session, CursorSample& sample) {
    const auto what = static_cast<Entry>(reader_.u8("entry", entry_max));
    if (reader_.failed()) return;
    if ((what == Entry::is_new) == known_.contains(session))
      return refuse("a person is new twice, or was never");
    if (what == Entry::gone) {
      known_.erase(session);
      sample.gone.push_back(session);
      return;
    }
    Known& known = known_[session];
    if (what == Entry::is_new) known.name = name();
    for (int64_t& part : known.place) {
      part += reader_.zigzag("coordinate", 2 * coordinate_max);
      if (part < -coordinate_max || part > coordinate_max) return refuse("a coordinate is beyond 2^30");
    }
    PlayerCursor cursor{session, known.name};
    put_place(cursor, known.place);
    sample.moved.push_back(std::move(cursor));
  }

  std::string name() {
    const uint64_t length = reader_.varint("length of a name", limits::person_name_bytes_max);
    const auto bytes = reader_.read_bytes(length, "name");
    return check_.text({bytes.begin(), bytes.end()}, limits::person_name_bytes_max, "name");
  }

  ByteReader reader_;
  FieldChecker& check_;
  std::map<uint64_t, Known> known_;
  uint64_t entries_ = 0;
};

}  // namespace

std::vector<uint8_t> pack(std::span<const CursorSample> samples, Tick first) {
  std::vector<uint8_t> bytes;
  Packer packer(bytes);
  size_t entries = 0;
  for (const CursorSample& sample : samples) {
    entries += sample.moved.size() + sample.gone.size();
    if (entries > limits::cursors_per_row_max) break;
    CHECK(sample.tick >= first);
    packer.sample(sample, sample.tick - first);
    first = sample.tick;
  }
  return bytes;
}

std::vector<CursorSample> unpack_cursors(const std::string& packed, Tick first, Tick last,
                                         FieldChecker& check) {
  std::vector<CursorSample> samples;
  Unpacker unpacker(packed, check);
  for (Tick tick = first; !unpacker.at_end();) {
    const Tick since = unpacker.ticks_since();
    if (!samples.empty() && since == 0) unpacker.refuse("samples do not ascend");
    tick += since;
    if (tick > last) unpacker.refuse("a sample after the row's last tick");
    CursorSample sample = unpacker.sample(tick);
    samples.push_back(std::move(sample));
  }
  unpacker.end();
  return samples;
}

}  // namespace scree
