// Messages of questions about space, and of their answers. proto/query.proto specifies them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shared/base/ids.h"
#include "shared/query/question.h"

namespace scree {

/// Each of its questions is answered, all by the same tick.
struct QueryMessage {
  uint32_t query = 0;               ///< the client's number of it, which the answer returns
  Tick as_of = 0;                   ///< 0: the newest that there is when they are answered
  std::vector<Question> questions;  ///< at most limits::questions_max

  bool operator==(const QueryMessage&) const = default;
};

/// An answer, or the refusal to give it.
struct QuestionReply {
  std::optional<QuestionAnswer> answer{};
  bool more = false;  ///< there are more ids than limits::query_ids_max: the rest is left out
  std::string refusal{};
  std::string refusal_name{};  ///< for programs, as of RefusalMessage

  bool operator==(const QuestionReply&) const = default;
};

struct AnswerMessage {
  uint32_t query = 0;
  Tick tick = 0;                       ///< that all answers are of; 0: all are refused
  std::vector<QuestionReply> answers;  ///< one for each question; none where all are refused alike
  std::string refusal{};               ///< of all of them
  std::string refusal_name{};

  bool operator==(const AnswerMessage&) const = default;
};

}  // namespace scree
