#include "server/formats/bus_codec.h"

#include <bus.pb.h>

#include "server/formats/recording_values.h"

namespace scree {

namespace {

std::span<const uint8_t> span_of(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

std::vector<uint8_t> vector_of(const std::string& bytes) {
  const auto span = span_of(bytes);
  return {span.begin(), span.end()};
}

void assign(std::string* to, std::span<const uint8_t> from) {
  to->assign(reinterpret_cast<const char*>(from.data()), from.size());
}

}  // namespace

std::vector<uint8_t> encode(const ToldPart& part) {
  told::Part message;
  message.set_run(part.run);
  message.set_tick(part.tick);
  message.set_number(part.number);
  message.set_count(part.count);
  assign(message.mutable_bytes(), part.bytes);
  return bytes_of(message);
}

std::vector<uint8_t> encode(const ToldWhole& whole) {
  told::Whole message;
  message.set_run(whole.run);
  message.set_tick(whole.tick);
  message.set_begins(whole.begins);
  return bytes_of(message);
}

std::vector<uint8_t> encode(const ToldKeyframe& keyframe) {
  told::Keyframe message;
  message.set_world(keyframe.world);
  assign(message.mutable_header(), keyframe.header);
  assign(message.mutable_state(), keyframe.state);
  for (const ToldKeyframe::Chunk& chunk : keyframe.chunks) {
    told::Chunk& to = *message.add_chunks();
    to.set_key(chunk.key);
    to.set_hash(chunk.hash);
    assign(to.mutable_data(), chunk.data);
  }
  for (const std::vector<uint8_t>& piece : keyframe.pieces) assign(message.add_pieces(), piece);
  return bytes_of(message);
}

std::vector<uint8_t> encode(const PipeMessage& from) {
  told::Pipe message;
  message.set_edge_run(from.edge_run);
  message.set_pipe(from.pipe);
  message.set_number(from.number);
  assign(message.mutable_bytes(), from.bytes);
  message.set_ends(from.ends);
  return bytes_of(message);
}

std::vector<uint8_t> encode_told(const RecordedFrame& frame) {
  told::Told message;
  assign(message.mutable_frame(), encode(frame));
  return bytes_of(message);
}

Result<ToldPart> decode_told_part(std::span<const uint8_t> bytes) {
  const auto message = TRY(parsed<told::Part>(bytes, "a part"));
  if (message.run() == 0) return fail("a part: it is of no run");
  if (message.count() == 0 || message.count() > limits::told_parts_max || message.number() >= message.count())
    return fail("a part: it is of no number among its parts (limits.told_parts_max)");
  if (message.bytes().size() > limits::told_part_bytes_max)
    return fail("a part: it is too long (limits.told_part_bytes_max)");
  return ToldPart{message.run(), message.tick(), message.number(), message.count(),
                  vector_of(message.bytes())};
}

Result<ToldWhole> decode_told_whole(std::span<const uint8_t> bytes) {
  const auto message = TRY(parsed<told::Whole>(bytes, "the end of a keyframe"));
  if (message.run() == 0 || message.begins() == 0) return fail("the end of a keyframe: it is of none");
  return ToldWhole{message.run(), message.tick(), message.begins()};
}

Result<ToldKeyframe> decode_told_keyframe(std::span<const uint8_t> bytes) {
  auto message = TRY(parsed<told::Keyframe>(bytes, "a keyframe"));
  ToldKeyframe keyframe{message.world(), vector_of(message.header()), vector_of(message.state()), {}, {}};
  for (const told::Chunk& chunk : message.chunks())
    keyframe.chunks.push_back({chunk.key(), chunk.hash(), vector_of(chunk.data())});
  for (const std::string& piece : message.pieces()) keyframe.pieces.push_back(vector_of(piece));
  return keyframe;
}

Result<PipeMessage> decode_pipe_message(std::span<const uint8_t> bytes) {
  const auto message = TRY(parsed<told::Pipe>(bytes, "bytes of a pipe"));
  if (message.edge_run() == 0) return fail("bytes of a pipe: they are of no run of an edge");
  if (message.bytes().size() > limits::pipe_bytes_max)
    return fail("bytes of a pipe: they are too many (limits.pipe_bytes_max)");
  return PipeMessage{message.edge_run(), message.pipe(), message.number(), vector_of(message.bytes()),
                     message.ends()};
}

Result<RecordedFrame> decode_told(std::span<const uint8_t> bytes) {
  const auto message = TRY(parsed<told::Told>(bytes, "a tick"));
  return decode_recorded_frame(span_of(message.frame()));
}

}  // namespace scree
