// The counts of a WorkStatus by name, for programs that print them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "proto/messages.h"

namespace scree {

struct WorkRow {
  std::string_view name;
  uint32_t WorkStatus::*count;
};

inline constexpr std::array work_rows{
    WorkRow{"budget_us", &WorkStatus::budget_us},
    WorkRow{"worst_us", &WorkStatus::worst_us},
    WorkRow{"requests_waiting", &WorkStatus::requests_waiting},
    WorkRow{"merges_put_off", &WorkStatus::merges_put_off},
    WorkRow{"breaks_left_out", &WorkStatus::breaks_left_out},
    WorkRow{"dents_left_out", &WorkStatus::dents_left_out},
    WorkRow{"ticks_cut_short", &WorkStatus::ticks_cut_short},
    WorkRow{"ticks_merging_sooner", &WorkStatus::ticks_merging_sooner},
    WorkRow{"supports_put_off", &WorkStatus::supports_put_off},
    WorkRow{"islands_put_off", &WorkStatus::islands_put_off},
    WorkRow{"islands_too_large", &WorkStatus::islands_too_large},
};
static_assert(sizeof(WorkStatus) == work_rows.size() * sizeof(uint32_t), "a count has no row");

}  // namespace scree
