#include "proto/playback_codec.h"

#include <algorithm>

#include "proto/byte_stream.h"
#include "proto/limits.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Kinds of events of this version and of later ones. Above: a fault of the sender.
constexpr uint64_t mark_kinds_max = 256;

std::vector<uint8_t> pack(const std::vector<Mark>& marks, uint32_t from) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  for (auto kind = marks.begin(); kind != marks.end();) {
    const auto end =
        std::find_if(kind, marks.end(), [&](const Mark& mark) { return mark.kind != kind->kind; });
    writer.varint(static_cast<uint64_t>(kind->kind));
    writer.varint(static_cast<uint64_t>(end - kind));
    for (uint32_t before = from; kind != end; ++kind) {
      CHECK(kind->column >= before && kind->column < limits::mark_columns_max);
      writer.varint(kind->column - before);
      writer.varint(kind->count);
      before = kind->column;
    }
  }
  return bytes;
}

/// The columns of one kind. Those of an unknown kind are left out.
void unpack_columns(ByteReader& reader, uint64_t kind, uint32_t from, std::vector<Mark>& marks) {
  const uint64_t columns = reader.varint("columns", limits::mark_columns_max);
  if (columns == 0) reader.refuse("a kind without columns");
  uint64_t column = from;
  for (uint64_t i = 0; i < columns && !reader.failed(); ++i) {
    const uint64_t step = reader.varint("columns between two", limits::mark_columns_max);
    if (i > 0 && step == 0) reader.refuse("columns do not ascend");
    column += step;
    if (column >= limits::mark_columns_max)
      reader.refuse("a column beyond the last (limits.mark_columns_max)");
    const uint64_t count = reader.varint("events of a column", limits::mark_count_max);
    if (count == 0) reader.refuse("a column without events");
    if (kind < kind_count<EventKind>)
      marks.push_back(
          {static_cast<EventKind>(kind), static_cast<uint32_t>(column), static_cast<uint32_t>(count)});
  }
}

std::vector<Mark> unpack_marks(const std::string& packed, uint32_t from, FieldChecker& check) {
  std::vector<Mark> marks;
  ByteReader reader(as_span(packed), "marks");
  std::optional<uint64_t> before;
  while (!reader.at_end()) {
    const uint64_t kind = reader.varint("kind", mark_kinds_max - 1);
    if (before && kind <= *before) reader.refuse("kinds do not ascend");
    before = kind;
    unpack_columns(reader, kind, from, marks);
  }
  if (reader.failed()) check.refuse(reader.error().message);
  return marks;
}

}  // namespace

void write(wire::Playback& to, const PlaybackMessage& from) {
  to.set_moment(from.moment);
  to.set_first(from.first);
  to.set_last(from.last);
  to.set_speed(from.speed);
  to.set_playing(from.playing);
  to.set_heeded(from.heeded);
  to.set_grows(from.grows);
  to.set_refusal(showable(from.refusal, limits::reason_bytes_max));
}

PlaybackMessage read(const wire::Playback& from, FieldChecker& check) {
  PlaybackMessage playback{from.moment(),  from.first(),
                           from.last(),    check.finite(from.speed(), "speed of a replay"),
                           from.playing(), from.heeded(),
                           from.grows(),   check.text(from.refusal(), limits::reason_bytes_max, "refusal")};
  if (playback.speed == 0.0F) check.refuse("the speed of a replay is 0");
  if (playback.first > playback.moment || playback.moment > playback.last)
    check.refuse("a replay stands outside its recording");
  return playback;
}

void write(wire::Marks& to, const MarksMessage& from) {
  CHECK(from.ticks_per_column > 0);
  to.set_first(from.first);
  to.set_ticks_per_column(from.ticks_per_column);
  to.set_from(from.from);
  to.set_marks(to_string(pack(from.marks, from.from)));
  to.set_read_to(from.read_to);
}

MarksMessage read(const wire::Marks& from, FieldChecker& check) {
  MarksMessage marks{from.first(), from.ticks_per_column(),
                     check.within(from.from(), 0, limits::mark_columns_max, "first column of marks"),
                     from.read_to()};
  if (marks.ticks_per_column == 0) check.refuse("columns of marks without ticks");
  if (!check.failed()) marks.marks = unpack_marks(from.marks(), marks.from, check);
  return marks;
}

void write(wire::ControlReplay& to, const ControlReplayRequest& from) {
  to.set_play(static_cast<wire::ReplayPlay>(from.play));
  to.set_speed(from.speed);
  to.set_move(static_cast<wire::ReplayMove>(from.move));
  to.set_value(from.value);
}

}  // namespace scree
