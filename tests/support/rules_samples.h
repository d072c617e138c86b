// Messages of a game's rules, one or more of each kind.
#pragma once

#include <vector>

#include "proto/messages.h"
#include "tests/support/materials.h"

namespace scree::samples {

inline std::vector<Sign> signs() {
  Sign round{.name = "round", .text = "round 2"};
  round.until = 1ULL << 40U;
  round.counts = true;
  Sign tower{.name = "tower", .to = {.kind = AudienceKind::session, .session = 9}, .kind = SignKind::marker};
  tower.text = "bring this down";
  tower.place_m = {1.0F, -2.0F, 3.5F};
  tower.colour = {0x12, 0x34, 0x56};
  Sign score{.name = "score", .to = {.kind = AudienceKind::team, .team = "red"}, .kind = SignKind::bar};
  score.text = "12 of 40 t";
  score.share = 0.25F;
  return {round, tower, score};
}

inline Cue cue(CueKind kind) {
  return {kind, {4.0F, -5.0F, 6.5F}, 0.5F, 2500.0F, material::ice};
}

inline ChannelData channel_data() {
  return {"shop", {0, 255, 10}};
}

inline std::vector<ServerMessage> rules_server_messages() {
  return {SignsMessage{signs()}, SignsMessage{}, CuesMessage{77, {cue(CueKind::ring), cue(CueKind::dust)}},
          ChannelMessage{channel_data()},
          AdminListMessage{.request = 7, .text = "demolition: 9 handlers\n  tick rests"}};
}

inline std::vector<ClientMessage> rules_client_messages() {
  const Audience red{.kind = AudienceKind::team, .team = "red"};
  const auto act = [](RulesAct rules, uint32_t request) { return RulesMessage{{std::move(rules)}, request}; };
  return {ChannelMessage{channel_data()},
          act(KeepValue{{"score", std::string("\0\xFF", 2)}}, 1),
          act(ForgetValue{"score"}, 2),
          act(ShowSign{signs().back()}, 3),
          act(RemoveSign{red, "score"}, 4),
          act(SetPlayer{7, "red", 1.5F, glm::vec3(1.0F, 2.0F, 3.0F)}, 5),
          act(Notice{red, NoticeLine{"the tower falls"}}, 6),
          act(Notice{{}, cue(CueKind::rattle)}, 7),
          act(Notice{red, channel_data()}, 8),
          RestoreMessage{{.bricks = std::make_shared<const std::vector<RestoreRequest::Brick>>(1),
                          .pieces = {5, 4000000000U},
                          .loose = {{1, -2, 3}, {-100, 0, 100}}},
                         9},
          AdminMessage{22, "", HistoryRequest{glm::vec3(1.0F, 2.0F, 3.0F), 4.0F, "Ann", 1200, true}},
          AdminMessage{23, "", HistoryRequest{}},
          AdminMessage{24, "",
                       UndoRequest{UndoMode::keep_others, "session:7", 1200, 5400, glm::vec3(-1.0F),
                                   glm::vec3(2.0F), true, 12}},
          AdminMessage{25, "", UndoRequest{}},
          AdminMessage{20, "", ControlRulesRequest{RulesControl::console, "demolition", "return 1 + 1"}},
          AdminMessage{21, "", ControlRulesRequest{}}};
}

}  // namespace scree::samples
