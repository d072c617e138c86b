// The kinds of messages, for counts by kind: which one encoded bytes are, without decoding them. Rows are as
// the oneofs of ServerMessage and ClientMessage in proto/scree.proto, which a test compares.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace scree {

struct MessageKindRow {
  uint32_t number = 0;  ///< of the oneof's field
  std::string_view name;
};

/// The last row of each table is for kinds that this version does not know.
inline constexpr auto server_message_kinds = std::to_array<MessageKindRow>({{1, "welcome"},
                                                                            {2, "refusal"},
                                                                            {3, "frame"},
                                                                            {4, "chunk"},
                                                                            {5, "piece"},
                                                                            {6, "reset"},
                                                                            {7, "reply"},
                                                                            {8, "status"},
                                                                            {9, "cursors"},
                                                                            {10, "physics"},
                                                                            {11, "ground"},
                                                                            {12, "kept"},
                                                                            {14, "admin_list"},
                                                                            {20, "tile"},
                                                                            {30, "persons"},
                                                                            {31, "said"},
                                                                            {35, "playback"},
                                                                            {45, "marks"},
                                                                            {46, "recorded_cursors"},
                                                                            {50, "health"},
                                                                            {90, "content"},
                                                                            {91, "palette_changed"},
                                                                            {100, "prop"},
                                                                            {101, "contacts"},
                                                                            {102, "joints"},
                                                                            {103, "kept_pieces"},
                                                                            {120, "answer"},
                                                                            {130, "stores"},
                                                                            {140, "regions"},
                                                                            {165, "stone"},
                                                                            {150, "person_places"},
                                                                            {170, "signs"},
                                                                            {171, "channel"},
                                                                            {172, "cues"},
                                                                            {0, "unknown"}});

inline constexpr auto client_message_kinds = std::to_array<MessageKindRow>(
    {{1, "hello"},       {2, "interest"},  {3, "carve"},      {4, "fill"},          {5, "repair"},
     {6, "ack"},         {8, "cursor"},    {9, "watch"},      {7, "admin"},         {10, "paint"},
     {11, "ground"},     {12, "offer"},    {13, "goodbye"},   {20, "tiles"},        {30, "say"},
     {50, "ask_health"}, {90, "content"},  {100, "add_prop"}, {101, "remove_prop"}, {102, "move_prop"},
     {103, "push"},      {104, "break"},   {105, "blast"},    {106, "add_joint"},   {107, "remove_joint"},
     {108, "set_motor"}, {109, "cut_out"}, {110, "release"},  {111, "add_piece"},   {120, "query"},
     {130, "dig"},       {131, "place"},   {132, "transfer"}, {140, "set_region"},  {141, "remove_region"},
     {150, "stand"},     {151, "walk"},    {170, "rules"},    {171, "channel"},     {172, "restore"},
     {0, "unknown"}});

/// The row of a message in one of the tables. `body`: a whole message without its length.
template <size_t size>
size_t message_kind(std::span<const uint8_t> body, const std::array<MessageKindRow, size>& kinds) {
  // Protobuf begins a field with its number and type, 7 bits a byte.
  uint32_t key = 0;
  for (size_t i = 0; i < std::min<size_t>(3, body.size()); ++i) {
    key |= (body[i] & 0x7fU) << (7 * i);
    if ((body[i] & 0x80U) == 0) break;
  }
  const auto found = std::ranges::find(kinds, key >> 3U, &MessageKindRow::number);
  return static_cast<size_t>(std::min(found, kinds.end() - 1) - kinds.begin());
}

}  // namespace scree
