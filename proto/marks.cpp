#include "proto/marks.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace scree {

namespace {

std::tuple<EventKind, uint32_t, uint32_t> order_of(const Mark& mark) {
  return {mark.kind, mark.column, mark.count};
}

bool of_one_bar(const MarksMessage& a, const MarksMessage& b) {
  return a.first == b.first && a.ticks_per_column == b.ticks_per_column;
}

}  // namespace

MarksMessage news_since(const MarksMessage& known, const MarksMessage& now) {
  if (!of_one_bar(known, now)) return now;
  std::vector<Mark> changed;
  std::ranges::set_symmetric_difference(known.marks, now.marks, std::back_inserter(changed), {}, order_of,
                                        order_of);
  MarksMessage news{now.first, now.ticks_per_column, limits::mark_columns_max, now.read_to};
  for (const Mark& mark : changed) news.from = std::min(news.from, mark.column);
  std::ranges::copy_if(now.marks, std::back_inserter(news.marks),
                       [&](const Mark& mark) { return mark.column >= news.from; });
  return news;
}

void apply_news(MarksMessage& known, const MarksMessage& news) {
  if (news.from > 0 && !of_one_bar(known, news)) return;
  std::vector<Mark> marks = news.marks;
  std::ranges::copy_if(known.marks, std::back_inserter(marks),
                       [&](const Mark& mark) { return mark.column < news.from; });
  std::ranges::sort(marks, {}, order_of);
  known = {news.first, news.ticks_per_column, 0, news.read_to, std::move(marks)};
}

}  // namespace scree
