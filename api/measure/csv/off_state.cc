#include "api/measure/csv/off_state.h"

#include <algorithm>

namespace plenum::api {
namespace {

constexpr double kFilled = 0.2;  // of the largest gauge pressure
constexpr double kFallen = 0.1, kKept = 0.8;
constexpr double kSoon = 10.0;  // times the time on

struct OffReadings {
  int falls = 0, stays = 0, unclear = 0;
};

// One stretch off, from `begin` to `end`, after the valve was on from `on`.
void LookAtStretch(const RecordedRun& run, const std::vector<double>& kpa, std::size_t on,
                   std::size_t begin, std::size_t end, double high_kpa, OffReadings& count) {
  double start_kpa = 0.0, last_kpa = 0.0;
  for (std::size_t i = on; i <= begin; ++i)
    if (std::isfinite(kpa[i])) start_kpa = kpa[i];
  if (!(start_kpa >= kFilled * high_kpa)) return;
  std::optional<double> half_s;
  last_kpa = start_kpa;
  for (std::size_t i = begin; i < end; ++i) {
    if (!std::isfinite(kpa[i])) continue;
    last_kpa = kpa[i];
    if (!half_s && last_kpa <= 0.5 * start_kpa) half_s = run.t_s[i] - run.t_s[begin];
  }
  const double on_s = run.t_s[begin] - run.t_s[on];
  if (last_kpa >= kKept * start_kpa)
    ++count.stays;
  else if (last_kpa <= kFallen * start_kpa && half_s && *half_s <= kSoon * on_s)
    ++count.falls;
  else
    ++count.unclear;
}

void LookAtRun(const RecordedRun& run, const std::vector<Position>& positions, double high_kpa,
               OffReadings& count) {
  const std::vector<double>& kpa = run.readings.at(std::string(kPressureField));
  std::optional<std::size_t> on;
  for (std::size_t i = 0; i < positions.size();) {
    std::size_t end = i;
    while (end < positions.size() && positions[end] == positions[i]) ++end;
    if (positions[i] == Position::kOff && on) LookAtStretch(run, kpa, *on, i, end, high_kpa, count);
    on = positions[i] == Position::kInflate ? std::optional(i) : std::nullopt;
    i = end;
  }
}

}  // namespace

OffState OffStateOf(const Recording& recording,
                    const std::vector<std::vector<Position>>& positions) {
  double high_kpa = 0.0;
  for (const RecordedRun& run : recording.runs)
    for (const double kpa : run.readings.at(std::string(kPressureField)))
      if (std::isfinite(kpa)) high_kpa = std::max(high_kpa, kpa);
  OffReadings count;
  for (std::size_t r = 0; r < positions.size() && high_kpa > 0.0; ++r)
    LookAtRun(recording.runs[r], positions[r], high_kpa, count);
  if (count.falls > 0 && count.stays == 0 && count.unclear == 0)
    return {Position::kDeflate, "the pressure falls to ambient then"};
  if (count.stays > 0 && count.falls == 0 && count.unclear == 0)
    return {Position::kHold, "the pressure stays then"};
  if (count.falls + count.stays + count.unclear == 0)
    return {std::nullopt, "The recording does not show it off after a fill"};
  return {std::nullopt, "The pressure neither falls to ambient nor stays each time"};
}

}  // namespace plenum::api
