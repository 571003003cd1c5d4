// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of C++20 that the standard library of Debian 12's emscripten (libc++ 13) lacks. Included before every
// source by the wasm preset; delete it with a newer emscripten.
#pragma once

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <numeric>
#include <ranges>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

static_assert(_LIBCPP_VERSION < 15000, "this libc++ has the algorithms below");

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

inline strong_ordering operator<=>(const string& a, const string& b) { return a.compare(b) <=> 0; }

// Without threads: std::thread throws.
class jthread : public thread {
 public:
  using thread::thread;
  jthread(jthread&&) noexcept = default;
  jthread& operator=(jthread&&) noexcept = default;
  ~jthread() {
    if (joinable()) join();
  }
};

// Length of the decimal number at the start; 0 without one.
inline ptrdiff_t decimal_length(string_view text) {
  size_t at = text.starts_with('-') ? 1 : 0;
  const auto digits = [&] {
    const size_t begin = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at - begin;
  };
  const auto word = [&](string_view name) {
    return text.size() >= at + name.size() && std::equal(name.begin(), name.end(), text.begin() + at,
                                                         [](char a, char b) { return a == (b | 0x20); });
  };
  for (const string_view name : {"infinity", "inf", "nan"})
    if (word(name)) return static_cast<ptrdiff_t>(at + name.size());
  size_t count = digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    count += digits();
  }
  if (count == 0) return 0;
  if (const size_t end = at; at < text.size() && (text[at] | 0x20) == 'e') {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (digits() == 0) at = end;
  }
  return static_cast<ptrdiff_t>(at);
}

template <class Real>
from_chars_result real_from_chars(const char* first, const char* last, Real& value,
                                  Real (*parse)(const char*, char**)) {
  const ptrdiff_t length = decimal_length({first, static_cast<size_t>(last - first)});
  if (length == 0) return {first, errc::invalid_argument};
  errno = 0;
  const Real parsed = parse(string(first, first + length).c_str(), nullptr);
  if (errno == ERANGE) return {first + length, errc::result_out_of_range};
  value = parsed;
  return {first + length, errc{}};
}
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  return real_from_chars(first, last, value, strtod);
}
inline from_chars_result from_chars(const char* first, const char* last, long double& value) {
  return real_from_chars(first, last, value, strtold);
}

inline to_chars_result copied(char* first, char* last, string_view text) {
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  return {std::copy(text.begin(), text.end(), first), errc{}};
}
// Shortest; fixed unless the form with an exponent is shorter.
inline to_chars_result to_chars(char* first, char* last, double value) {
  char with_exponent[32], fixed[512];
  int places = 0;
  do snprintf(with_exponent, sizeof with_exponent, "%.*e", places, value);
  while (strtod(with_exponent, nullptr) != value && value == value && ++places < 17);
  const char* const exponent = strchr(with_exponent, 'e');
  if (exponent == nullptr) return copied(first, last, with_exponent);  // inf, nan
  const int length = snprintf(fixed, sizeof fixed, "%.*f", std::max(places - atoi(exponent + 1), 0), value);
  return copied(first, last, length <= static_cast<int>(strlen(with_exponent)) ? fixed : with_exponent);
}
inline to_chars_result to_chars(char* first, char* last, long double value, chars_format, int places) {
  char text[96];
  snprintf(text, sizeof text, "%.*Le", places, value);
  return copied(first, last, text);
}

namespace ranges {

template <class C, class P>
auto projected(C& compare, P& key) {
  return [&](const auto& a, const auto& b) -> bool {
    return std::invoke(compare, std::invoke(key, a), std::invoke(key, b));
  };
}
template <class F, class P>
auto applied(F& test, P& key) {
  return [&](auto&& value) -> decltype(auto) { return std::invoke(test, std::invoke(key, value)); };
}
template <class V, class P>
auto equal_to_value(const V& value, P& key) {
  return [&](const auto& other) -> bool { return std::invoke(key, other) == value; };
}

template <class Low, class High>
struct low_and_high {
  Low min;
  High max;
};
template <class A, class B>
struct two_places {
  A in1;
  B in2;
};

#define ASPERITY_BY_TEST(name)                                                \
  template <class R, class F, class P = identity>                             \
  auto name(R&& range, F test, P key = {}) {                                  \
    return std::name(std::begin(range), std::end(range), applied(test, key)); \
  }
ASPERITY_BY_TEST(find_if)
ASPERITY_BY_TEST(any_of)
ASPERITY_BY_TEST(all_of)
ASPERITY_BY_TEST(none_of)
ASPERITY_BY_TEST(count_if)
ASPERITY_BY_TEST(partition_point)
#undef ASPERITY_BY_TEST

#define ASPERITY_BY_ORDER(name)                                                    \
  template <class R, class C = less, class P = identity>                           \
  auto name(R&& range, C compare = {}, P key = {}) {                               \
    return std::name(std::begin(range), std::end(range), projected(compare, key)); \
  }
ASPERITY_BY_ORDER(sort)
ASPERITY_BY_ORDER(stable_sort)
ASPERITY_BY_ORDER(min_element)
ASPERITY_BY_ORDER(max_element)
ASPERITY_BY_ORDER(is_sorted)
#undef ASPERITY_BY_ORDER

template <class R, class V, class P = identity>
auto find(R&& range, const V& value, P key = {}) {
  return std::find_if(std::begin(range), std::end(range), equal_to_value(value, key));
}
template <class R, class V, class P = identity>
auto count(R&& range, const V& value, P key = {}) {
  return std::count_if(std::begin(range), std::end(range), equal_to_value(value, key));
}
template <class R, class C = equal_to, class P = identity>
auto adjacent_find(R&& range, C same = {}, P key = {}) {
  return std::adjacent_find(std::begin(range), std::end(range), projected(same, key));
}
template <class R, class C = less, class P = identity>
auto minmax_element(R&& range, C compare = {}, P key = {}) {
  const auto [low, high] = std::minmax_element(std::begin(range), std::end(range), projected(compare, key));
  return low_and_high<decltype(low), decltype(high)>{low, high};
}
template <class R, class C = less, class P = identity>
auto minmax(R&& range, C compare = {}, P key = {}) {
  const auto ends = minmax_element(range, compare, key);
  return low_and_high<range_value_t<R>, range_value_t<R>>{*ends.min, *ends.max};
}
template <class R>
auto min(R&& range) {
  return *std::min_element(std::begin(range), std::end(range));
}
template <class R>
auto max(R&& range) {
  return *std::max_element(std::begin(range), std::end(range));
}
template <class R, class V, class C = less, class P = identity>
auto lower_bound(R&& range, const V& value, C compare = {}, P key = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](const auto& a, const V& b) {
    return std::invoke(compare, std::invoke(key, a), b);
  });
}
template <class R, class V, class C = less, class P = identity>
auto upper_bound(R&& range, const V& value, C compare = {}, P key = {}) {
  return std::upper_bound(std::begin(range), std::end(range), value, [&](const V& a, const auto& b) {
    return std::invoke(compare, a, std::invoke(key, b));
  });
}
template <class R, class V>
bool binary_search(R&& range, const V& value) {
  return std::binary_search(std::begin(range), std::end(range), value);
}
template <class R, class Out>
auto copy(R&& range, Out to) {
  return std::copy(std::begin(range), std::end(range), to);
}
template <class R, class Out, class F>
auto copy_if(R&& range, Out to, F test) {
  return std::copy_if(std::begin(range), std::end(range), to, test);
}
template <class R, class Out, class F>
auto transform(R&& range, Out to, F function) {
  return std::transform(std::begin(range), std::end(range), to, function);
}
template <class A, class B, class Out, class F>
auto transform(A&& a, B&& b, Out to, F function) {
  return std::transform(std::begin(a), std::end(a), std::begin(b), to, function);
}
template <class R, class V>
void fill(R&& range, const V& value) {
  std::fill(std::begin(range), std::end(range), value);
}
template <class R, class V>
void replace(R&& range, const V& from, const V& to) {
  std::replace(std::begin(range), std::end(range), from, to);
}
template <class R, class F, class V>
void replace_if(R&& range, F test, const V& to) {
  std::replace_if(std::begin(range), std::end(range), test, to);
}
template <class R>
void reverse(R&& range) {
  std::reverse(std::begin(range), std::end(range));
}
template <class R, class I, class C = less>
void partial_sort(R&& range, I middle, C compare = {}) {
  std::partial_sort(std::begin(range), middle, std::end(range), compare);
}
template <class A, class B>
void swap_ranges(A&& a, B&& b) {
  std::swap_ranges(std::begin(a), std::end(a), std::begin(b));
}
template <class A, class B>
auto mismatch(A&& a, B&& b) {
  const auto [in1, in2] = std::mismatch(std::begin(a), std::end(a), std::begin(b), std::end(b));
  return two_places<decltype(in1), decltype(in2)>{in1, in2};
}

}  // namespace ranges
}  // namespace std
