#pragma once
// Checks for other people's tests. A failing check prints counts by cause, the worst pair with its buckets
// and depths, the bounding box of the wrong pixels, and a map of them in letters:
//
//     const auto report = inspect::inspect(trace, {});
//     CHECK(wrong_pixels(report) == 0);
//     CHECK(wrong_pixels(report, inspect::Cause::bucket_tie) < 10);
//
// Works with every test framework that prints through operator<<: doctest, Catch2, GoogleTest.

#include <concepts>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "inspect/report.h"

namespace inspect {

/// What a failed check prints: everything about the report, and how many pixels have `cause` (nothing: all).
std::string explain(const Report& report, std::optional<Cause> cause);

/// A number that can explain itself. Refers to the report, which must outlive it.
class WrongCount {
 public:
  WrongCount(const Report& report, std::optional<Cause> cause)
      : report_(&report), cause_(cause), count_(cause ? report.count(*cause) : report.wrong_pixels()) {}

  [[nodiscard]] std::uint64_t value() const { return count_; }

  template <std::integral T>
  friend bool operator==(const WrongCount& a, T b) {
    return std::cmp_equal(a.count_, b);
  }
  template <std::integral T>
  friend bool operator!=(const WrongCount& a, T b) {
    return !std::cmp_equal(a.count_, b);
  }
  template <std::integral T>
  friend bool operator<(const WrongCount& a, T b) {
    return std::cmp_less(a.count_, b);
  }
  template <std::integral T>
  friend bool operator<=(const WrongCount& a, T b) {
    return std::cmp_less_equal(a.count_, b);
  }
  template <std::integral T>
  friend bool operator>(const WrongCount& a, T b) {
    return std::cmp_greater(a.count_, b);
  }
  template <std::integral T>
  friend bool operator>=(const WrongCount& a, T b) {
    return std::cmp_greater_equal(a.count_, b);
  }
  friend std::ostream& operator<<(std::ostream& out, const WrongCount& count) {
    return out << explain(*count.report_, count.cause_);
  }

 private:
  const Report* report_;
  std::optional<Cause> cause_;
  std::uint64_t count_;
};

/// All wrong pixels, or those whose first cause is `cause`. The report must outlive the check.
inline WrongCount wrong_pixels(const Report& report, std::optional<Cause> cause = std::nullopt) {
  return {report, cause};
}
WrongCount wrong_pixels(const Report&&, std::optional<Cause> = std::nullopt) = delete;

}  // namespace inspect
