#pragma once
// What the standard library of Debian 12's emscripten (libc++ 13) lacks of C++20, for that build alone:
// cmake/wasm.cmake includes it before every source. The algorithms on ranges are those of range-v3, whose author wrote
// the proposal for std::ranges. Adding to namespace std is not ours to do; a compiler with libc++ 16 or later needs
// none of this.

#include <array>
#include <atomic>
#include <charconv>
#include <compare>
#include <memory>
#include <range/v3/algorithm/all_of.hpp>
#include <range/v3/algorithm/any_of.hpp>
#include <range/v3/algorithm/binary_search.hpp>
#include <range/v3/algorithm/copy.hpp>
#include <range/v3/algorithm/copy_if.hpp>
#include <range/v3/algorithm/count.hpp>
#include <range/v3/algorithm/count_if.hpp>
#include <range/v3/algorithm/fill.hpp>
#include <range/v3/algorithm/find.hpp>
#include <range/v3/algorithm/find_if.hpp>
#include <range/v3/algorithm/find_if_not.hpp>
#include <range/v3/algorithm/lower_bound.hpp>
#include <range/v3/algorithm/max.hpp>
#include <range/v3/algorithm/max_element.hpp>
#include <range/v3/algorithm/merge.hpp>
#include <range/v3/algorithm/min.hpp>
#include <range/v3/algorithm/min_element.hpp>
#include <range/v3/algorithm/minmax.hpp>
#include <range/v3/algorithm/move.hpp>
#include <range/v3/algorithm/none_of.hpp>
#include <range/v3/algorithm/nth_element.hpp>
#include <range/v3/algorithm/replace.hpp>
#include <range/v3/algorithm/reverse.hpp>
#include <range/v3/algorithm/set_algorithm.hpp>
#include <range/v3/algorithm/sort.hpp>
#include <range/v3/algorithm/stable_sort.hpp>
#include <range/v3/algorithm/transform.hpp>
#include <range/v3/algorithm/upper_bound.hpp>
#include <type_traits>
#include <vector>

namespace std {

namespace ranges {
using ::ranges::all_of;
using ::ranges::any_of;
using ::ranges::binary_search;
using ::ranges::copy;
using ::ranges::copy_if;
using ::ranges::count;
using ::ranges::count_if;
using ::ranges::fill;
using ::ranges::find;
using ::ranges::find_if;
using ::ranges::find_if_not;
using ::ranges::lower_bound;
using ::ranges::max;
using ::ranges::max_element;
using ::ranges::merge;
using ::ranges::min;
using ::ranges::min_element;
using ::ranges::minmax;
using ::ranges::move;
using ::ranges::none_of;
using ::ranges::nth_element;
using ::ranges::replace;
using ::ranges::reverse;
using ::ranges::set_intersection;
using ::ranges::sort;
using ::ranges::stable_sort;
using ::ranges::transform;
using ::ranges::upper_bound;
}  // namespace ranges

template <class T>
using order_of = decltype(declval<const T&>() <=> declval<const T&>());

template <class T, size_t N>
constexpr order_of<T> operator<=>(const array<T, N>& a, const array<T, N>& b) {
  for (size_t i = 0; i < N; ++i)
    if (const order_of<T> order = a[i] <=> b[i]; order != 0) return order;
  return strong_ordering::equal;
}

template <class T>
order_of<T> operator<=>(const vector<T>& a, const vector<T>& b) {
  for (size_t i = 0; i < a.size() && i < b.size(); ++i)
    if (const order_of<T> order = a[i] <=> b[i]; order != 0) return order;
  return a.size() <=> b.size();
}

template <class T>
unique_ptr<T> make_unique_for_overwrite(size_t count) {
  return unique_ptr<T>(new remove_extent_t<T>[count]);
}

/// As much of it as is used.
template <class T>
class atomic_ref {
 public:
  explicit atomic_ref(T& value) : value_(&value) {}
  T load(memory_order = memory_order_seq_cst) const {
    T value;
    __atomic_load(value_, &value, __ATOMIC_SEQ_CST);
    return value;
  }
  operator T() const { return load(); }
  bool compare_exchange_weak(T& expected, T desired) const {
    return __atomic_compare_exchange(value_, &expected, &desired, true, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
  }

 private:
  T* value_;
};

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

// Numbers from text by fast_float, which libstdc++ uses too; to text by printf, which rounds rightly for any precision.
from_chars_result from_chars(const char* first, const char* last, float& value);
from_chars_result from_chars(const char* first, const char* last, double& value);
to_chars_result to_chars(char* first, char* last, float value);
to_chars_result to_chars(char* first, char* last, double value);
to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision);

}  // namespace std
