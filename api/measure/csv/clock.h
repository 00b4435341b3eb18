// Clock times of cells, with or without a date.
#ifndef PLENUM_API_MEASURE_CSV_CLOCK_H_
#define PLENUM_API_MEASURE_CSV_CLOCK_H_

#include <optional>
#include <string>
#include <string_view>

namespace plenum::api {

struct ClockTime {
  double seconds = 0.0;          // of the day, in UTC where the cell says its offset
  std::optional<long long> day;  // since 1970, of a date that has one meaning only
};

// "12:03:04.250", "12:03:04,25 PM", "12:03:04:250", each also behind a date: 2026-01-31,
// 2026/01/31, 31.01.2026, or 01/02/2026, whose order of day and month is not known. ISO 8601 with T
// and Z or an offset as "+01:00". Hours may pass 24 without a date. None: the cell is no such time.
std::optional<ClockTime> ParseClock(std::string_view cell);

// The day of a cell that holds a date alone; none: it is none, or its order is not known.
std::optional<long long> ParseDay(std::string_view cell);

// Seconds from the first time of a run. Without dates a time that is more than half a day before
// the last one is of the next day.
class ClockSeconds {
 public:
  double Add(const ClockTime& time);  // rounded to nanoseconds

 private:
  std::optional<ClockTime> first_;
  double last_s_ = 0.0;
  long long midnights_ = 0;
};

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_CLOCK_H_
