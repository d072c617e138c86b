// The page's parts that need no canvas, for Node: the socket's states, and what keys and gamepads mean.
// Aborts when one is wrong.
#include <cstdio>

#include "client/web/limits.h"
#include "client/web/page_input.h"
#include "client/web/socket_connector.h"
#include "proto/codec.h"
#include "shared/base/check.h"

namespace scree {
namespace {

using Wish = PageSocket::Wish;

std::vector<uint8_t> welcome_bytes() {
  WelcomeMessage welcome;
  welcome.session = 7;
  welcome.world = 1;
  welcome.terrain = {TerrainKind::flat, 1, 0.25F};
  welcome.interest_radius_m = 32.0F;
  return encode(ServerMessage(welcome));
}

/// With a hello that has gone out.
PageSocket opened() {
  PageSocket socket;
  socket.open({HelloMessage{}});
  CHECK(socket.pop_wish() == Wish::open);
  CHECK(socket.pop_wish() == Wish::nothing);  // told once
  CHECK(socket.drain_outgoing().empty());     // there is no socket yet
  socket.opened();
  CHECK(!socket.drain_outgoing().empty());
  CHECK(socket.drain_outgoing().empty());
  return socket;
}

void messages_may_be_cut_anywhere() {
  PageSocket socket = opened();
  const std::vector<uint8_t> bytes = welcome_bytes();
  for (size_t i = 0; i < bytes.size(); ++i) {
    CHECK(!socket.next());
    socket.received({&bytes[i], 1});
  }
  const std::optional<Received> welcome = socket.next();
  CHECK(welcome && std::get<WelcomeMessage>(welcome->message).session == 7);
  CHECK_EQ(welcome->bytes, bytes.size());
  CHECK_EQ(socket.counters().received_bytes, bytes.size());
  socket.received(bytes);
  CHECK(!socket.next() && socket.is_closed());  // a second welcome
  CHECK(socket.pop_wish() == Wish::close);
  CHECK(socket.pop_wish() == Wish::nothing);
}

void what_is_no_protocol_closes() {
  PageSocket socket = opened();
  const std::vector<uint8_t> nonsense(64, 0xFF);
  socket.received(nonsense);
  CHECK(!socket.next() && socket.is_closed());
  CHECK(socket.end().message.find("does not follow this protocol") != std::string::npos);
  socket.open({HelloMessage{}});
  CHECK(socket.pop_wish() == Wish::close);  // the old one first
  CHECK(socket.pop_wish() == Wish::open);
}

void a_socket_that_closes_is_told_and_asked_for_again() {
  PageSocket socket = opened();
  socket.closed("");
  CHECK(socket.is_closed() && !socket.end().message.empty());
  CHECK(socket.pop_wish() == Wish::nothing);
  socket.received(welcome_bytes());
  CHECK(!socket.next());  // of a socket that is gone
  socket.open({HelloMessage{}});
  CHECK(socket.pop_wish() == Wish::open);
  socket.closed("refused");
  CHECK(socket.end().message == "refused");
}

void a_refusal_is_read_though_the_server_closed_behind_it() {
  PageSocket socket = opened();
  const std::vector<uint8_t> refusal = encode(RefusalMessage{"ask for a token", "token_missing"});
  socket.received(refusal);
  socket.closed("");
  CHECK(!socket.next());
  CHECK(socket.end().refusal == "token_missing");
  CHECK(socket.end().message.find("ask for a token") != std::string::npos);
}

void who_does_not_keep_up_is_closed() {
  PageSocket socket = opened();
  const std::vector<uint8_t> much(size_t{1} << 20);
  for (size_t i = 0; i <= (limits::page_unread_bytes_max >> 20U); ++i) socket.received(much);
  CHECK(socket.is_closed());
  CHECK(socket.end().message.find("page_unread_bytes_max") != std::string::npos);
}

void keys_move_and_act_once() {
  PageInput input;
  CHECK(input.key("KeyW", true) && input.key("KeyD", true) && input.key("ShiftLeft", true));
  CHECK(input.key("KeyM", true) && input.key("KeyM", true));  // repeated by the keyboard
  CHECK(!input.key("Tab", true) && !input.key("Unidentified", true));
  PageIntents intents = input.drain(0.02F);
  CHECK(intents.fly.move == glm::vec3(1.0F, 0.0F, 1.0F) && intents.fly.fast);
  CHECK(intents.actions == std::vector{Action::next_method});
  intents = input.drain(0.02F);
  CHECK(intents.fly.move == glm::vec3(1.0F, 0.0F, 1.0F) && intents.actions.empty());
  input.keys_up();
  CHECK(input.drain(0.02F).fly.move == glm::vec3(0.0F));
  input.turn(3.0F, -2.0F);
  input.turn(1.0F, 0.0F);
  input.strike();
  intents = input.drain(0.02F);
  CHECK(intents.fly.turn == glm::vec2(4.0F, -2.0F) && intents.strikes == 1);
  CHECK(input.drain(0.02F).strikes == 0);
  CHECK(input.key("KeyE", true));
  intents = input.drain(0.02F);
  CHECK(intents.strikes == 1 && intents.strike_held && intents.actions.empty());
  CHECK(input.key("ArrowLeft", true) && input.key("ArrowDown", true));
  CHECK(input.drain(0.02F).turn_keys == glm::vec2(-1.0F, 1.0F));
  input.keys_up();
  CHECK(!input.drain(0.02F).strike_held);
}

void a_gamepad_of_the_standard_mapping_is_the_viewers() {
  PageInput input;
  PadState sticks;
  sticks.left_trigger = sticks.right_trigger = 0.0F;
  input.pad(sticks, 0);
  CHECK(input.drain(0.02F).strikes == 0);
  sticks.left_y = -1.0F;
  sticks.right_trigger = 1.0F;
  input.pad(sticks, 1U << 12U);  // up, on the cross
  const PageIntents intents = input.drain(0.02F);
  CHECK(intents.strikes == 1 && intents.strike_held && intents.fly.move.z > 0.9F);
  CHECK(intents.actions == std::vector{Action::stronger});
  CHECK(input.drain(0.02F).fly.move.z == 0.0F);  // it is gone
}

}  // namespace
}  // namespace scree

int main() {
  scree::messages_may_be_cut_anywhere();
  scree::what_is_no_protocol_closes();
  scree::a_socket_that_closes_is_told_and_asked_for_again();
  scree::a_refusal_is_read_though_the_server_closed_behind_it();
  scree::who_does_not_keep_up_is_closed();
  scree::keys_move_and_act_once();
  scree::a_gamepad_of_the_standard_mapping_is_the_viewers();
  std::printf("all parts do as they should\n");
}
