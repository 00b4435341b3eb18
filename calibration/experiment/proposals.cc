#include "calibration/experiment/proposals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>

#include "calibration/noise/phases.h"
#include "calibration/values/crossing.h"

namespace plenum::calibration {
namespace {

using model::ValveState;

constexpr double kReached = 0.97;      // of what a source can reach, and a sensor read
constexpr double kEmptied = 0.05;      // of the gauge pressure before
constexpr double kHoldInRises = 6.0;   // where the data have no hold
constexpr double kRestSamples = 20.0;  // before the first command
constexpr double kLongest = 10.0;      // of the data's longest run
constexpr int kShortStrokes = 10, kStepsDown = 4;

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string Kpa(double gauge_pa) { return Short(gauge_pa / 1e3) + " kPa"; }

// What the data have shown to be possible.
struct Bench {
  Run pattern;
  double spacing_s = 0.0, longest_run_s = 0.0, longest_hold_s = 0.0;
  double initial_pa = 0.0;  // the highest
  double highest_pa = 0.0;  // that the sensor reads
  std::set<double> sources_pa;
};

double MedianSpacing(const Run& run) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < run.t_s.size(); ++i)
    if (run.t_s[i] > run.t_s[i - 1]) gaps.push_back(run.t_s[i] - run.t_s[i - 1]);
  if (gaps.empty()) return 0.0;
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2),
                   gaps.end());
  return gaps[gaps.size() / 2];
}

// The pressure that a measured source has on the whole.
double SourcePressure(const Run& run) {
  if (run.source_pressure_pa > run.ambient.pressure_pa || Evacuates(run))
    return run.source_pressure_pa;
  double sum = 0.0, count = 0.0;
  for (const double pa : run.channels.source_pressure_pa) {
    if (!std::isfinite(pa)) continue;
    sum += pa;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : run.source_pressure_pa;
}

// How far one comes towards a pressure that cannot be passed.
double Reached(double below_pa, double ambient_pa) {
  return ambient_pa + kReached * (below_pa - ambient_pa);
}

Bench BenchOf(const Dataset& dataset, const std::vector<std::size_t>& runs, double highest_pa) {
  Bench bench;
  bench.highest_pa = highest_pa;
  for (const std::size_t i : runs) {
    const Run& run = dataset.runs[i];
    if (run.t_s.size() < 2) continue;
    if (bench.longest_run_s == 0.0) {
      bench.pattern = run;
      bench.spacing_s = MedianSpacing(run);
    }
    bench.longest_run_s = std::max(bench.longest_run_s, run.t_s.back() - run.t_s.front());
    for (const PhaseSpan& span : PhasesOf(run))
      if (span.phase == Phase::kHold)
        bench.longest_hold_s = std::max(bench.longest_hold_s, span.end_s - span.start_s);
    if (run.supply != Supply::kNone) bench.sources_pa.insert(SourcePressure(run));
    const auto first = std::find_if(run.pressure_pa.begin(), run.pressure_pa.end(),
                                    [](double pa) { return std::isfinite(pa); });
    if (run.initial_pressure_pa)
      bench.initial_pa = std::max(bench.initial_pa, *run.initial_pressure_pa);
    else if (first != run.pressure_pa.end())
      bench.initial_pa = std::max(bench.initial_pa, *first);
  }
  Run& pattern = bench.pattern;
  bench.initial_pa = std::min(bench.initial_pa, Reached(highest_pa, pattern.ambient.pressure_pa));
  pattern.id = "next";
  if (pattern.supply == Supply::kMeasured) pattern.supply = Supply::kRegulated;
  pattern.channels = {};
  pattern.pressure_pa.clear();
  pattern.valve.clear();
  pattern.valve_uncertainty_s.clear();
  pattern.t_s.clear();
  return bench;
}

// Commands one after the other.
class Schedule {
 public:
  explicit Schedule(double rest_s) : at_s_(rest_s) {}
  Schedule& Then(ValveState state, double duration_s) {
    commands_.push_back({at_s_, state});
    at_s_ += duration_s;
    return *this;
  }
  Run On(Run run, double spacing_s) const {
    run.valve = commands_;
    run.valve.insert(run.valve.begin(), {0.0, ValveState::kHold});
    const int count = std::min(kProposalSamples, static_cast<int>(at_s_ / spacing_s) + 1);
    for (int i = 0; i < count; ++i) run.t_s.push_back(at_s_ * i / std::max(1, count - 1));
    return run;
  }

 private:
  double at_s_;
  std::vector<model::ValveCommand> commands_;
};

// Of one source, blocked or free.
class Strokes {
 public:
  Strokes(const Bench& bench, Run run, double spacing_s, const StrokeTime& stroke_time)
      : bench_(bench), run_(std::move(run)), spacing_s_(spacing_s), stroke_time_(stroke_time) {
    run_.initial_pressure_pa = run_.ambient.pressure_pa;
    ambient_pa_ = run_.ambient.pressure_pa;
  }

  void Propose(std::vector<Proposal>& proposals) {
    const double end_pa = std::min(run_.source_pressure_pa, bench_.highest_pa);
    const double operating_pa = run_.chamber.operating_pressure_pa;
    const double reached_pa = Reached(end_pa, ambient_pa_);
    // Of what shrinks the operating pressure is the deepest, of what swells the highest.
    const bool below = model::Shrinks(run_.chamber);
    const double full_pa =
        below ? std::max(operating_pa, reached_pa) : std::min(operating_pa, reached_pa);
    if (!(below ? full_pa < ambient_pa_ : full_pa > ambient_pa_)) return;
    const double half_pa = 0.5 * (full_pa + ambient_pa_);
    const double rise_s = Time(ValveState::kInflate, ambient_pa_, full_pa);
    const double half_s = Time(ValveState::kInflate, ambient_pa_, half_pa);
    const double fall_s =
        Time(ValveState::kDeflate, full_pa, ambient_pa_ + kEmptied * (full_pa - ambient_pa_));
    if (!std::isfinite(rise_s + half_s + fall_s)) return;
    const double hold_s = std::max(bench_.longest_hold_s, kHoldInRises * rise_s);
    const double long_hold_s =
        std::max(hold_s, std::min(4.0 * hold_s, kLongest * bench_.longest_run_s));
    const double rest_s = kRestSamples * spacing_s_;
    const auto add = [&](const Schedule& schedule, const std::string& what) {
      const std::string from = " from a source of " + Kpa(run_.source_pressure_pa - ambient_pa_);
      proposals.push_back(
          {schedule.On(run_, spacing_s_), (run_.blocked ? "blocked, " : "") + what + from});
    };
    using enum ValveState;
    for (const double hold : {hold_s, long_hold_s})
      add(Schedule(rest_s).Then(kInflate, rise_s).Then(kHold, hold).Then(kDeflate, 2.0 * fall_s),
          "inflate to " + Kpa(full_pa - ambient_pa_) + ", hold " + Short(hold) + " s, deflate");
    add(Schedule(rest_s).Then(kInflate, half_s).Then(kHold, long_hold_s).Then(kDeflate, fall_s),
        "inflate to " + Kpa(half_pa - ambient_pa_) + ", hold " + Short(long_hold_s) +
            " s, deflate");
    Schedule cycles(rest_s), stairs(rest_s), strokes(rest_s);
    for (int i = 0; i < 3; ++i)
      cycles.Then(kInflate, rise_s).Then(kHold, rise_s).Then(kDeflate, fall_s);
    cycles.Then(kHold, hold_s);
    add(cycles,
        "three cycles to " + Kpa(full_pa - ambient_pa_) + ", then rest " + Short(hold_s) + " s");
    for (int i = 0; i < 4; ++i) stairs.Then(kInflate, rise_s / 4.0).Then(kHold, hold_s / 4.0);
    for (int i = 0; i < 4; ++i) stairs.Then(kDeflate, fall_s / 6.0).Then(kHold, hold_s / 4.0);
    stairs.Then(kDeflate, fall_s);
    add(stairs, "four steps up to " + Kpa(full_pa - ambient_pa_) + " and four down, each held " +
                    Short(hold_s / 4.0) + " s");
    for (int i = 0; i < kShortStrokes; ++i)
      strokes.Then(kInflate, 0.5 * rise_s).Then(kDeflate, fall_s);
    add(strokes, std::to_string(kShortStrokes) + " half strokes of " + Short(0.5 * rise_s) +
                     " s up and " + Short(fall_s) + " s down");
  }

 private:
  double Time(ValveState state, double from_pa, double to_pa) const {
    Run stroke = run_;
    stroke.initial_pressure_pa = from_pa;
    stroke.valve = {{0.0, state}};
    return stroke_time_(stroke, to_pa);
  }

  const Bench& bench_;
  Run run_;
  double spacing_s_, ambient_pa_ = 0.0;
  const StrokeTime& stroke_time_;
};

void ProposeWithoutSource(const Bench& bench, const Run& run, double spacing_s,
                          const StrokeTime& stroke_time, std::vector<Proposal>& proposals) {
  const double ambient_pa = run.ambient.pressure_pa;
  for (const double share : {1.0, 0.5}) {
    Run from = run;
    from.initial_pressure_pa = ambient_pa + share * (bench.initial_pa - ambient_pa);
    const std::string start = "from " + Kpa(*from.initial_pressure_pa - ambient_pa) + ", ";
    for (const double longer : {1.0, 4.0}) {
      const double duration_s = longer * bench.longest_run_s;
      const double rest_s = kRestSamples * spacing_s;
      proposals.push_back({Schedule(0.0).Then(ValveState::kHold, duration_s).On(from, spacing_s),
                           start + "closed for " + Short(duration_s) + " s"});
      if (run.line.empty()) continue;
      proposals.push_back(
          {Schedule(rest_s).Then(ValveState::kDeflate, duration_s).On(from, spacing_s),
           start + "emptying for " + Short(duration_s) + " s"});
    }
    if (run.line.empty()) continue;
    const double empty_pa = ambient_pa + kEmptied * (*from.initial_pressure_pa - ambient_pa);
    from.valve = {{0.0, ValveState::kDeflate}};
    const double fall_s = stroke_time(from, empty_pa);
    if (!std::isfinite(fall_s)) continue;
    const double hold_s = bench.longest_run_s / kStepsDown;
    Schedule stairs(hold_s);
    for (int i = 0; i < kStepsDown; ++i)
      stairs.Then(ValveState::kDeflate, fall_s / (kStepsDown + 2)).Then(ValveState::kHold, hold_s);
    stairs.Then(ValveState::kDeflate, fall_s);
    proposals.push_back({stairs.On(from, spacing_s),
                         start + "emptying in four steps, each held " + Short(hold_s) + " s"});
  }
}

}  // namespace

std::vector<Proposal> ProposeRuns(const Dataset& dataset, const std::vector<std::size_t>& runs,
                                  double rate, double highest_pa, const StrokeTime& stroke_time) {
  std::vector<Proposal> proposals;
  Bench bench = BenchOf(dataset, runs, highest_pa);
  if (!(bench.spacing_s > 0.0)) return proposals;
  const double spacing_s = bench.spacing_s / rate;
  const bool gives =
      bench.pattern.chamber.expansion_ratio != 1.0 || !bench.pattern.chamber.volume_curve.empty();
  // An imposed volume that is held is a blocked one, and a free one there is not.
  const bool imposed = std::exchange(bench.pattern.volume_imposed, false);
  std::set<double> sources_pa;
  if (!bench.sources_pa.empty()) {
    const double low = *bench.sources_pa.begin(), high = *bench.sources_pa.rbegin();
    sources_pa = {low, 0.5 * (low + high), high};
    const double ambient_pa = bench.pattern.ambient.pressure_pa;
    if (low == high) sources_pa.insert(ambient_pa + kLowerSource * (low - ambient_pa));
  }
  for (const bool blocked : {false, true}) {
    if (blocked ? !gives && !imposed : imposed) continue;
    Run run = bench.pattern;
    run.blocked = blocked;
    if (run.supply == Supply::kNone)
      ProposeWithoutSource(bench, run, spacing_s, stroke_time, proposals);
    for (const double source_pa : sources_pa) {
      run.source_pressure_pa = source_pa;
      Strokes(bench, run, spacing_s, stroke_time).Propose(proposals);
    }
  }
  return proposals;
}

}  // namespace plenum::calibration
