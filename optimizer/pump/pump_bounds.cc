#include "optimizer/pump/pump_bounds.h"

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/pump/pump_march.h"
#include "optimizer/pump/stroke_bound.h"

namespace plenum::optimizer {

double AirToTarget(const Problem& problem, int group, const model::Chamber& chamber) {
  const ActuatorGroup& actuators = problem.groups[group];
  const double content = model::Content(chamber, RiseTarget(problem, actuators)) -
                         model::Content(chamber, problem.ambient.pressure_pa);
  return actuators.count * model::StandardVolume(content, problem.ambient.temperature_k);
}

namespace {

constexpr double kIntervalRatio = 1.25;
constexpr int kNeedDivisions = 8;        // of its range, for the energy
constexpr double kNeedTolerance = 3e-3;  // of the source pressure; its lower end is used

// Least stop pressure by (2): of the groups that are not placed yet the one that asks least comes
// last, of those that may.
double LeastStopPressure(const Problem& problem, const PumpFacts& facts, const PumpLoad& load,
                         double highest_pa, double low_m3, double high_m3) {
  double highest_target_pa = 0.0;
  for (const ActuatorGroup& group : problem.groups)
    highest_target_pa = std::max(highest_target_pa, RiseTarget(problem, group));
  if (!IsBurst(problem)) return highest_target_pa;
  struct Reach {
    double target_pa, within_s, least_s, air_m3;
  };
  std::vector<Reach> open;
  double drawn_m3 = 0.0;
  const bool orders = load.lines.size() > 1;  // else there is but one
  for (int g = 0; g < static_cast<int>(load.lines.size()); ++g) {
    const Line& line = *load.lines[g];
    open.push_back(
        {RiseTarget(problem, problem.groups[g]), RiseWindow(problem, g),
         orders ? LeastRiseTime(problem, g, line, facts, {highest_pa, highest_pa, low_m3, high_m3})
                : 0.0,
         AirToTarget(problem, g, line.chamber)});
    drawn_m3 += open.back().air_m3;
  }
  const double most_m3_per_s = facts.rates.Delivery(problem.ambient.pressure_pa);
  const double per_m3_pa = ContentPerVolume(problem) / high_m3;
  const auto asked = [&](const Reach& last) {
    return last.target_pa + per_m3_pa * std::max(0.0, drawn_m3 - most_m3_per_s * last.within_s);
  };
  double least_pa = highest_target_pa;
  while (!open.empty()) {
    double slowest_s = 0.0;
    for (const Reach& reach : open) slowest_s = std::max(slowest_s, reach.least_s);
    auto last = open.end();
    for (auto reach = open.begin(); reach != open.end(); ++reach) {
      // The others have to come before its limit.
      const bool may = reach->least_s == slowest_s || slowest_s <= reach->within_s;
      if (may && (last == open.end() || asked(*reach) < asked(*last))) last = reach;
    }
    least_pa = std::max(least_pa, asked(*last));
    drawn_m3 -= last->air_m3;
    open.erase(last);
  }
  return least_pa;
}

// Highest stop pressure that `bearable` accepts, from one that it accepts up to `high_pa`; a little
// too high rather than too low.
template <typename Bearable>
double MostBearable(ReservoirNeed need, double high_pa, double tolerance, Bearable&& bearable) {
  double low_pa = need.source_pa;
  need.source_pa = high_pa;
  if (bearable(need)) return high_pa;
  while (high_pa - low_pa > tolerance * high_pa) {
    need.source_pa = 0.5 * (low_pa + high_pa);
    (bearable(need) ? low_pa : high_pa) = need.source_pa;
  }
  return high_pa;
}

}  // namespace

PumpLoad MakePumpLoad(const Problem& problem, const std::vector<const Line*>& lines) {
  PumpLoad load{lines};
  const bool burst = IsBurst(problem);
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const double strokes = burst ? 1.0 : problem.groups[g].gait.strokes_per_period;
    load.air_m3 += strokes * LeastAirPerStroke(problem, g, *lines[g]);
    load.coil_j += CoilEnergyPerCycle(problem, g, *lines[g], lines[g]->inflate_time_least_s);
  }
  return load;
}

bool EnergyMayGrow(const Problem& problem, const PumpLoad& load) {
  return IsBurst(problem) && std::any_of(load.lines.begin(), load.lines.end(),
                                         [](const Line* line) { return line->all_hold; });
}

namespace {

// Coils of the mission at a stop pressure, at least.
double CoilEnergyAt(const Problem& problem, const PumpFacts& facts, const PumpLoad& load,
                    const ReservoirNeed& need, double source_pa) {
  double energy_j = 0.0;
  for (int g = 0; g < static_cast<int>(load.lines.size()); ++g) {
    const Line& line = *load.lines[g];
    const double inflate_s =
        line.all_hold
            ? std::max(line.inflate_time_least_s,
                       LeastInflateTime(problem, g, line, facts,
                                        {source_pa, source_pa, need.low_m3, need.high_m3}))
            : 0.0;
    energy_j += CoilEnergyPerCycle(problem, g, line, inflate_s);
  }
  return problem.actuations * energy_j;
}

}  // namespace

// The pumps take no less at a higher stop pressure while coils that are energised only for the
// strokes take no more: of each interval of pressures the lower end counts for the pumps and the
// upper end for the coils. The interval with the least energy is divided.
double LeastMissionEnergy(const Problem& problem, const PumpFacts& facts, const PumpLoad& load,
                          const ReservoirNeed& need, int divisions,
                          const std::function<bool(double, double)>& matters) {
  if (!EnergyMayGrow(problem, load)) return need.energy_j;
  constexpr double kNarrow = 1e-3;      // of a pressure
  constexpr double kShare = 0.4;        // energy mostly changes fastest next to the lowest pressure
  constexpr double kWorthwhile = 1e-3;  // of the energy
  const double least_coils_j = problem.actuations * load.coil_j;
  const auto pumps_j = [&](double source_pa) {
    const std::optional<PumpNeed> pump =
        LeastPumpNeed(problem, facts, load, {source_pa}, need.low_m3, need.high_m3);
    return pump ? LeastFirstFill(problem, facts, source_pa, need.low_m3) +
                      problem.actuations * pump->energy_j
                : kUnlimited;
  };
  const auto coils_j = [&](double source_pa) {
    return CoilEnergyAt(problem, facts, load, need, source_pa);
  };
  const double pump_j = need.energy_j - least_coils_j;
  const double coils_at_least_pa_j = coils_j(need.source_pa);
  if (!(coils_at_least_pa_j > least_coils_j + kWorthwhile * need.energy_j)) return need.energy_j;
  double most_j = pump_j + coils_at_least_pa_j;
  struct Interval {
    double low_pa, high_pa, pump_j, coils_j;
    double energy_j() const { return pump_j + coils_j; }
  };
  std::vector<Interval> intervals{
      {need.source_pa, need.source_max_pa, pump_j, coils_j(need.source_max_pa)}};
  const auto lowest = [&]() -> Interval& {
    return *std::min_element(
        intervals.begin(), intervals.end(),
        [](const Interval& a, const Interval& b) { return a.energy_j() < b.energy_j(); });
  };
  for (int i = 0; i < divisions; ++i) {
    Interval& low = lowest();
    if (low.high_pa - low.low_pa < kNarrow * low.low_pa) break;
    if (matters && !matters(low.energy_j(), most_j)) break;
    Interval high = low;
    low.high_pa = high.low_pa = low.low_pa + kShare * (low.high_pa - low.low_pa);
    low.coils_j = coils_j(low.high_pa);
    high.pump_j = pumps_j(high.low_pa);
    most_j = std::min(most_j, high.pump_j + low.coils_j);
    intervals.push_back(high);
  }
  return lowest().energy_j();
}

std::optional<ReservoirNeed> LeastReservoirNeed(const Problem& problem, const PumpFacts& facts,
                                                const PumpLoad& load, const PumpLimits& limits,
                                                const Window& window, ReservoirNeed need,
                                                double tolerance) {
  // Groups that take turns may find less than the stop pressure.
  const bool turns = !IsBurst(problem);
  std::vector<double> start_pa(1, 0.0);
  // Sets what stopping at need.source_pa at least takes; false if that is too much.
  const auto bearable = [&](ReservoirNeed& at) {
    if (!turns) start_pa.front() = at.source_pa;
    const std::optional<PumpNeed> pump =
        LeastPumpNeed(problem, facts, load, start_pa, at.low_m3, at.high_m3);
    if (!pump) return false;
    at.energy_j = LeastFirstFill(problem, facts, at.source_pa, at.low_m3) +
                  problem.actuations * (pump->energy_j + load.coil_j);
    return pump->on_s * problem.frequency_hz <= limits.duty_max &&
           at.energy_j <= limits.energy_max_j;
  };
  need.source_max_pa = std::min(need.source_max_pa, window.high_pa);
  // Cheap first: the mass balance (2) at the largest volume.
  need.source_pa = std::max(
      {need.source_pa, window.low_pa,
       LeastStopPressure(problem, facts, load, need.source_max_pa, need.low_m3, need.high_m3)});
  if (!(need.source_pa <= need.source_max_pa)) return std::nullopt;
  const auto excess = [&](double p) {
    return LeastStrokeExcess(problem, load.lines, facts,
                             {p, turns ? need.source_max_pa : p, need.low_m3, need.high_m3});
  };
  if (!turns) {
    // More pressure is no easier to bear, and this is cheaper than the strokes.
    if (!bearable(need)) return std::nullopt;
    if (limits.find_most)
      need.source_max_pa = MostBearable(need, need.source_max_pa, tolerance, bearable);
    const std::optional<double> least_pa =
        RaisedFloor(excess, need.source_pa, need.source_max_pa, tolerance, [&](double source_pa) {
          ReservoirNeed at = need;
          at.source_pa = source_pa;
          return bearable(at);
        });
    if (!least_pa) return std::nullopt;
    if (*least_pa == need.source_pa) return need;
    need.source_pa = *least_pa;
  } else if (Alternates(problem)) {
    start_pa.resize(2);
    if (!RaiseStarts(problem, load.lines, facts, need.source_max_pa, need.low_m3, need.high_m3,
                     tolerance, need.start_pa))
      return std::nullopt;
    start_pa.assign(need.start_pa.begin(), need.start_pa.end());
    need.source_pa = std::max({need.source_pa, need.start_pa[0], need.start_pa[1]});
  } else {  // some may draw at the same time: no phases to tell apart
    const std::optional<double> least_pa =
        RaisedFloor(excess, std::max(problem.ambient.pressure_pa, need.start_pa[0]),
                    need.source_max_pa, tolerance);
    if (!least_pa) return std::nullopt;
    need.start_pa[0] = start_pa.front() = *least_pa;
    need.source_pa = std::max(need.source_pa, *least_pa);
  }
  if (!bearable(need)) return std::nullopt;
  return need;
}

std::vector<ReservoirNeed> ReservoirNeeds(const Problem& problem, const PumpFacts& facts,
                                          const Candidate& candidate, double energy_max_j,
                                          double low_m3, double high_m3) {
  std::vector<ReservoirNeed> needs;
  const Window window = SourceWindow(problem, candidate);
  if (window.empty()) return needs;
  const PumpLimits limits{ChosenPump(problem, candidate).duty_max, energy_max_j, true};
  const PumpLoad load = MakePumpLoad(problem, candidate.lines);
  for (bool last = false; !last;) {
    const double next_m3 = std::min(low_m3 * kIntervalRatio, high_m3);
    last = next_m3 >= high_m3;
    std::optional<ReservoirNeed> need =
        LeastReservoirNeed(problem, facts, load, limits, window,
                           {.low_m3 = low_m3, .high_m3 = next_m3}, kNeedTolerance);
    if (need) need->energy_j = LeastMissionEnergy(problem, facts, load, *need, kNeedDivisions);
    if (need && need->energy_j <= limits.energy_max_j &&
        AloneStrokeExcess(problem, candidate, {need->source_max_pa, need->high_m3, need->low_m3}) <=
            0.0)
      needs.push_back(*need);
    low_m3 = next_m3;
  }
  return needs;
}

}  // namespace plenum::optimizer
