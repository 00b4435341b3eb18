#include "api/measure/csv/clock.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <vector>

#include "catalog/tables/heading_phrases.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

using catalog::Split;
using catalog::Trimmed;

constexpr double kDayS = 86400.0;
constexpr double kHoursMax = 1e4;  // of an elapsed time

std::optional<double> Number(std::string_view digits) {
  if (digits.empty() || digits.size() > 18) return std::nullopt;
  double number = 0.0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number,
                                             std::chars_format::fixed);
  if (status != std::errc() || end != digits.data() + digits.size() || digits[0] == '-')
    return std::nullopt;
  return number;
}

// "+01:00", "+0100", "-05": minutes, taken off the end of the time.
double TakeOffsetMinutes(std::string_view& time) {
  if (time.ends_with('Z') || time.ends_with('z')) {
    time.remove_suffix(1);
    return 0.0;
  }
  const std::size_t at = time.find_last_of("+-");
  if (at == std::string_view::npos || at == 0) return 0.0;
  std::string digits;
  for (const char c : time.substr(at + 1))
    if (c != ':') digits += c;
  const auto number = digits.size() == 2 || digits.size() == 4 ? Number(digits) : std::nullopt;
  if (!number) return 0.0;
  const double sign = time[at] == '-' ? -1.0 : 1.0;
  time.remove_suffix(time.size() - at);
  const double whole = digits.size() == 2 ? *number * 100.0 : *number;
  return sign * (std::floor(whole / 100.0) * 60.0 + std::fmod(whole, 100.0));
}

// Hours that "AM" and "PM" behind the time add to those of a clock of twelve hours; none: no such
// clock.
std::optional<bool> TakeAfternoon(std::string_view& time) {
  if (time.size() < 3) return std::nullopt;
  const char letter = static_cast<char>(time[time.size() - 2] & ~0x20);
  if ((time.back() & ~0x20) != 'M' || (letter != 'A' && letter != 'P')) return std::nullopt;
  time = Trimmed(time.substr(0, time.size() - 2));
  return letter == 'P';
}

std::optional<double> SecondsOfDay(std::string_view time, bool has_date) {
  const auto afternoon = TakeAfternoon(time);
  const double offset_min = has_date ? TakeOffsetMinutes(time) : 0.0;
  if (!has_date && time.ends_with('Z')) time.remove_suffix(1);
  const auto parts = Split(time, ':');
  if (parts.size() < 3 || parts.size() > 4) return std::nullopt;
  std::string last(parts[2]);
  if (parts.size() == 4) last += "." + std::string(parts[3]);  // 12:03:04:250
  for (char& c : last)
    if (c == ',') c = '.';
  auto hours = Number(parts[0]);
  const auto minutes = Number(parts[1]), seconds = Number(last);
  if (!hours || !minutes || !seconds || *hours > kHoursMax || *minutes >= 60.0 || *seconds >= 61.0)
    return std::nullopt;
  if (afternoon) hours = std::fmod(*hours, 12.0) + (*afternoon ? 12.0 : 0.0);
  return *hours * 3600.0 + (*minutes - offset_min) * 60.0 + *seconds;
}

// Whether the text looks like a date, and which day it is if that is known.
struct Date {
  bool is_date = false;
  std::optional<long long> day;
};

Date DateOf(std::string_view text) {
  for (const char mark : {'-', '/', '.'}) {
    const auto parts = Split(text, mark);
    if (parts.size() != 3) continue;
    std::array<int, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = Number(parts[i]);
      if (!number || *number > 9999.0 || *number != std::floor(*number)) return {};
      numbers[i] = static_cast<int>(*number);
    }
    const bool year_first = parts[0].size() == 4;
    if (!year_first && parts[2].size() != 4 && parts[2].size() != 2) return {};
    int year = numbers[2] < 100 ? 2000 + numbers[2] : numbers[2], month = numbers[1],
        day = numbers[0];
    if (year_first) year = numbers[0], day = numbers[2];
    if (!year_first && mark != '.') {
      if (numbers[0] <= 12 && numbers[1] <= 12 && numbers[0] != numbers[1]) return {true, {}};
      if (numbers[1] > 12) std::swap(month, day);
    }
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return {};
    return {true, std::chrono::sys_days(date).time_since_epoch().count()};
  }
  return {};
}

}  // namespace

std::optional<long long> ParseDay(std::string_view cell) { return DateOf(Trimmed(cell)).day; }

std::optional<ClockTime> ParseClock(std::string_view cell) {
  cell = Trimmed(cell);
  if (cell.size() > 60 || cell.find(':') == std::string_view::npos) return std::nullopt;
  const std::size_t gap = cell.find_first_of("T ");
  Date date;
  if (gap != std::string_view::npos && gap < cell.find(':')) {
    date = DateOf(cell.substr(0, gap));
    if (!date.is_date) return std::nullopt;
    cell = Trimmed(cell.substr(gap + 1));
  }
  const auto seconds = SecondsOfDay(cell, date.is_date);
  if (!seconds) return std::nullopt;
  return ClockTime{*seconds, date.day};
}

double ClockSeconds::Add(const ClockTime& time) {
  if (!first_) first_ = time;
  const bool has_days = time.day && first_->day;
  if (!has_days && time.seconds < last_s_ - 0.5 * kDayS) ++midnights_;
  last_s_ = time.seconds;
  const long long days = has_days ? *time.day - *first_->day : midnights_;
  const double seconds = static_cast<double>(days) * kDayS + (time.seconds - first_->seconds);
  return std::round(seconds * 1e9) / 1e9;
}

}  // namespace plenum::api
