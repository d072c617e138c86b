// What the sources use of C++20 and libc++ 13, emscripten's, lacks. Included before each of them by the web
// build alone (cmake/ScreeWeb.cmake). Only what is used, and only as it is used: ranges that can be iterated
// twice.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <vector>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

namespace std {

template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <typename T>
unique_ptr<T> make_unique_for_overwrite(size_t n) {
  return unique_ptr<T>(new remove_extent_t<T>[n]);
}
template <typename T>
enable_if_t<is_unbounded_array_v<T>, shared_ptr<T>> make_shared(size_t n) {
  return shared_ptr<T>(new remove_extent_t<T>[n]());
}

namespace ranges {

template <typename Compare, typename Of>
constexpr auto projected(Compare compare, Of of) {
  return [=](const auto& a, const auto& b) -> bool { return invoke(compare, invoke(of, a), invoke(of, b)); };
}
template <typename Is, typename Of>
constexpr auto projected_one(Is is, Of of) {
  return [=](const auto& a) -> bool { return invoke(is, invoke(of, a)); };
}

// A comparison of two elements, and what of them is compared.
#define SCREE_COMPARING(name)                                             \
  template <typename R, typename Compare = less, typename Of = identity>  \
  constexpr auto name(R&& r, Compare compare = {}, Of of = {}) {          \
    return std::name(std::begin(r), std::end(r), projected(compare, of)); \
  }
SCREE_COMPARING(is_sorted)
SCREE_COMPARING(make_heap)
SCREE_COMPARING(push_heap)
SCREE_COMPARING(pop_heap)
SCREE_COMPARING(min_element)
SCREE_COMPARING(max_element)
#undef SCREE_COMPARING

// By a heap, in a quarter of the code of std::sort; each use makes it anew, and a page fetches all of it.
template <typename R, typename Compare = less, typename Of = identity>
constexpr void sort(R&& r, Compare compare = {}, Of of = {}) {
  std::make_heap(std::begin(r), std::end(r), projected(compare, of));
  std::sort_heap(std::begin(r), std::end(r), projected(compare, of));
}

// By merges of runs of doubled length, likewise.
template <typename R, typename Compare = less, typename Of = identity>
void stable_sort(R&& r, Compare compare = {}, Of of = {}) {
  const auto begin = std::begin(r);
  const auto size = std::end(r) - begin;
  using Value = typename iterator_traits<remove_cvref_t<decltype(begin)>>::value_type;
  vector<Value> merged;
  merged.reserve(static_cast<size_t>(size));
  for (auto run = remove_const_t<decltype(size)>(1); run < size; run *= 2) {
    merged.clear();
    for (auto at = remove_const_t<decltype(size)>(0); at < size; at += 2 * run) {
      const auto lo = make_move_iterator(begin + at);
      const auto middle = make_move_iterator(begin + min(at + run, size));
      const auto hi = make_move_iterator(begin + min(at + 2 * run, size));
      std::merge(lo, middle, middle, hi, back_inserter(merged), projected(compare, of));
    }
    std::move(merged.begin(), merged.end(), begin);
  }
}

// A question to one element, and what of it is asked.
#define SCREE_ASKING(name)                                               \
  template <typename R, typename Is, typename Of = identity>             \
  constexpr auto name(R&& r, Is is, Of of = {}) {                        \
    return std::name(std::begin(r), std::end(r), projected_one(is, of)); \
  }
SCREE_ASKING(all_of)
SCREE_ASKING(any_of)
SCREE_ASKING(none_of)
SCREE_ASKING(find_if)
SCREE_ASKING(count_if)
#undef SCREE_ASKING

template <typename R, typename Value, typename Of = identity>
constexpr auto find(R&& r, const Value& value, Of of = {}) {
  return std::find_if(std::begin(r), std::end(r), [&](const auto& a) { return invoke(of, a) == value; });
}
template <typename R, typename Value>
constexpr auto count(R&& r, const Value& value) {
  return std::count(std::begin(r), std::end(r), value);
}
template <typename R, typename Value>
constexpr void fill(R&& r, const Value& value) {
  std::fill(std::begin(r), std::end(r), value);
}
template <typename R>
constexpr void reverse(R&& r) {
  std::reverse(std::begin(r), std::end(r));
}
template <typename R, typename Middle, typename Compare = less, typename Of = identity>
constexpr void nth_element(R&& r, Middle nth, Compare compare = {}, Of of = {}) {
  std::nth_element(std::begin(r), nth, std::end(r), projected(compare, of));
}
template <typename R, typename Middle, typename Compare = less, typename Of = identity>
constexpr void partial_sort(R&& r, Middle middle, Compare compare = {}, Of of = {}) {
  std::partial_sort(std::begin(r), middle, std::end(r), projected(compare, of));
}
template <typename R, typename Value, typename Compare = less, typename Of = identity>
constexpr auto lower_bound(R&& r, const Value& value, Compare compare = {}, Of of = {}) {
  return std::lower_bound(std::begin(r), std::end(r), value, [=](const auto& a, const Value& b) -> bool {
    return invoke(compare, invoke(of, a), b);
  });
}
template <typename R, typename Value>
constexpr auto upper_bound(R&& r, const Value& value) {
  return std::upper_bound(std::begin(r), std::end(r), value);
}
template <typename R, typename Value>
constexpr bool binary_search(R&& r, const Value& value) {
  return std::binary_search(std::begin(r), std::end(r), value);
}
template <typename R, typename Compare = equal_to, typename Of = identity>
constexpr auto adjacent_find(R&& r, Compare compare = {}, Of of = {}) {
  return std::adjacent_find(std::begin(r), std::end(r), projected(compare, of));
}
template <typename A, typename B, typename Equal = equal_to>
constexpr bool equal(A&& a, B&& b, Equal same = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), same);
}
template <typename A, typename B>
constexpr bool includes(A&& a, B&& b) {
  return std::includes(std::begin(a), std::end(a), std::begin(b), std::end(b));
}

template <typename Value>
struct LeastAndMost {
  Value min;
  Value max;
};
template <typename R>
constexpr auto minmax(R&& r) {
  const auto [least, most] = std::minmax_element(std::begin(r), std::end(r));
  return LeastAndMost<remove_cvref_t<decltype(*least)>>{*least, *most};
}

template <typename Out>
struct End {
  Out out;
};
template <typename R, typename Out>
constexpr End<Out> copy(R&& r, Out out) {
  return {std::copy(std::begin(r), std::end(r), out)};
}
template <typename R, typename Out>
constexpr End<Out> move(R&& r, Out out) {
  return {std::move(std::begin(r), std::end(r), out)};
}
template <typename R, typename Out, typename Is>
constexpr End<Out> copy_if(R&& r, Out out, Is is) {
  return {std::copy_if(std::begin(r), std::end(r), out, projected_one(is, identity{}))};
}
template <typename A, typename B, typename Out, typename Compare = less, typename OfA = identity,
          typename OfB = identity>
constexpr void set_symmetric_difference(A&& a, B&& b, Out out, Compare compare, OfA of, OfB) {
  std::set_symmetric_difference(std::begin(a), std::end(a), std::begin(b), std::end(b), out,
                                projected(compare, of));
}

}  // namespace ranges
}  // namespace std

#endif
