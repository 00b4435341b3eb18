#include "tests/support/pumps/direct_sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "model/flow/series.h"
#include "tests/support/flow/iso_chain.h"

namespace plenum::test {
namespace {

using optimizer::Candidate;
using optimizer::Line;
using optimizer::Problem;

constexpr double kJoulePerWattHour = 3600.0;
constexpr double kNever = std::numeric_limits<double>::infinity();

// What the pumps and the lines of one group do.
struct Filling {
  model::CompressorCurve curve;
  std::vector<model::FlowElement> elements;
  model::Chamber chamber;
  int pumps = 0, count = 0;
  double ambient_pa = 0.0, target_pa = 0.0, temperature_k = 0.0;
  bool operator==(const Filling&) const = default;
};

struct Filled {
  double rise_s = 0.0, inflate_s = 0.0, pump_j = 0.0, highest_pa = 0.0;
};

class Stroke {
 public:
  explicit Stroke(const Filling& filling)
      : in_(filling),
        series_(model::MakeSeries(filling.elements, std::sqrt(293.15 / filling.temperature_k))),
        highest_pa_(
            std::min(filling.curve.free_air_m3_per_s.back(), filling.curve.pressure_max_pa)) {}

  Filled Run() const {
    Filled filled;
    const double operating_pa = in_.chamber.operating_pressure_pa;
    filled.highest_pa = Node(operating_pa);
    if (!(operating_pa < highest_pa_) || !(Delivery(filled.highest_pa) > 0.0))
      return {kNever, kNever, kNever, kNever};
    Add(in_.ambient_pa, in_.target_pa, filled);
    filled.rise_s = filled.inflate_s;
    if (operating_pa > in_.target_pa) Add(in_.target_pa, operating_pa, filled);
    return filled;
  }

 private:
  double Delivery(double p) const {
    const model::MonotoneCurve& table = in_.curve.free_air_m3_per_s;
    return in_.pumps * table(std::clamp(p, table.front(), table.back()));
  }
  double Power(double p) const {
    const model::MonotoneCurve& table = in_.curve.current_a;
    return table.empty() ? 0.0
                         : in_.pumps * in_.curve.voltage_v *
                               table(std::clamp(p, table.front(), table.back()));
  }
  double Taken(double node_pa, double p) const {
    if (!in_.chamber.evacuated)
      return in_.count * node_pa * model::FlowAtRatio(series_, p / node_pa);
    const double chamber_pa = AsItIs(p);
    return in_.count * chamber_pa * model::FlowAtRatio(series_, AsItIs(node_pa) / chamber_pa);
  }
  double AsItIs(double image_pa) const { return 2.0 * in_.ambient_pa - image_pa; }
  double Node(double p) const {
    if (!(p < highest_pa_) || Delivery(highest_pa_) >= Taken(highest_pa_, p)) return highest_pa_;
    return Bisect(
        p, highest_pa_, [&](double x) { return Delivery(x) - Taken(x, p); }, 1e-8);
  }
  double Content(double p) const {
    const model::Chamber& c = in_.chamber;
    const double x =
        (p - c.ambient_pressure_pa) / (c.operating_pressure_pa - c.ambient_pressure_pa);
    const double volume_m3 =
        c.rest_volume_m3 * (1.0 + (c.expansion_ratio - 1.0) * x) + c.dead_volume_m3;
    return c.evacuated ? -AsItIs(p) * volume_m3 : p * volume_m3;
  }

  // Simpson's rule in the content, which is nearly even in p; finer towards the end.
  void Add(double from_pa, double to_pa, Filled& filled) const {
    constexpr int kSteps = 96, kHalvings = 10;
    double low_pa = from_pa;
    const auto step = [&](double high_pa) {
      const double middle_pa = 0.5 * (low_pa + high_pa);
      const auto at = [&](double p, double& power_w) {
        const double node_pa = Node(p);
        power_w = Power(node_pa);
        return std::min(Delivery(node_pa), Taken(node_pa, p));
      };
      double w[3];
      const double q[3] = {at(low_pa, w[0]), at(middle_pa, w[1]), at(high_pa, w[2])};
      const double to_m3 = in_.count / (1e5 * in_.temperature_k / 293.15);
      // dC/dp at both ends and in the middle, exact for the parabola that the content is.
      const double width = high_pa - low_pa, h = 0.5 * width;
      const double slope_low =
          (-3.0 * Content(low_pa) + 4.0 * Content(middle_pa) - Content(high_pa)) / width;
      const double slope_high =
          (Content(low_pa) - 4.0 * Content(middle_pa) + 3.0 * Content(high_pa)) / width;
      const double slope_middle = (Content(high_pa) - Content(low_pa)) / width;
      const double t[3] = {slope_low / q[0], slope_middle / q[1], slope_high / q[2]};
      filled.inflate_s += to_m3 * h / 3.0 * (t[0] + 4.0 * t[1] + t[2]);
      filled.pump_j += to_m3 * h / 3.0 * (t[0] * w[0] + 4.0 * t[1] * w[1] + t[2] * w[2]);
      low_pa = high_pa;
    };
    const double width_pa = (to_pa - from_pa) / kSteps;
    for (int i = 1; i < kSteps; ++i) step(from_pa + i * width_pa);
    double left_pa = width_pa;
    for (int i = 0; i < kHalvings; ++i, left_pa *= 0.5) step(to_pa - 0.5 * left_pa);
    step(to_pa);
  }

  const Filling& in_;
  model::Series series_;
  double highest_pa_;
};

// Batteries are the innermost choice of an enumeration: the last stroke of each squad is kept.
const Filled& Known(std::size_t group, const Filling& filling) {
  struct Last {
    Filling filling;
    Filled filled;
  };
  static thread_local std::vector<Last> last;
  if (last.size() <= group) last.resize(group + 1);
  if (!(last[group].filling == filling)) last[group] = {filling, Stroke(filling).Run()};
  return last[group].filled;
}

Filling FillingOf(const Problem& problem, const Candidate& candidate, std::size_t g, int count) {
  const Line& line = *candidate.lines[g];
  const double ambient_pa = problem.ambient.pressure_pa;
  Filling filling;
  filling.curve = ChosenPump(problem, candidate).curve;
  filling.elements = line.fill;
  filling.chamber = line.chamber;
  filling.pumps = candidate.compressor.quantity;
  filling.count = count;
  filling.ambient_pa = ambient_pa;
  filling.target_pa =
      ambient_pa + problem.rise_fraction * (line.chamber.operating_pressure_pa - ambient_pa);
  filling.temperature_k = problem.ambient.temperature_k;
  return filling;
}

// Actuators that fill at once, and when, as shares of the period.
struct Fills {
  std::size_t group;
  int count;
  std::vector<double> begins;
};

std::vector<Fills> FillsOf(const Problem& problem) {
  std::vector<Fills> all;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const int n = group.gait.strokes_per_period;
    std::map<double, int> counts;
    if (group.gait.phases.empty())
      counts[problem.simultaneous
                 ? 0.0
                 : static_cast<double>(g) / static_cast<double>(problem.groups.size()) / n] =
          group.count;
    for (const double phase : group.gait.phases)
      counts[phase] += group.gait.phases.size() == 1 ? group.count : 1;
    for (const auto& [phase, count] : counts) {
      Fills fills{g, count, {}};
      for (int k = 0; k < n; ++k)
        fills.begins.push_back(std::fmod(phase + static_cast<double>(k) / n, 1.0));
      all.push_back(fills);
    }
  }
  return all;
}

// Whether the same pumps fill both.
bool OnSamePumps(const Problem& problem, const Fills& a, const Fills& b) {
  return problem.pump_feed == optimizer::PumpFeed::kShared ||
         (problem.pump_feed == optimizer::PumpFeed::kPerGroup && a.group == b.group);
}

// Share of the period until any other begins, or 0 where one begins at the same time.
double ShareUntilNext(const Problem& problem, const std::vector<Fills>& all, const Fills& one) {
  double least = 1.0;
  for (const Fills& other : all) {
    if (&other != &one && !OnSamePumps(problem, one, other)) continue;
    for (const double next : other.begins)
      for (const double begin : one.begins) {
        if (&other == &one && next == begin) continue;
        const double share = std::fmod(next - begin + 1.0, 1.0);
        least = std::min(least, share < 1e-9 || share > 1.0 - 1e-9 ? 0.0 : share);
      }
  }
  return least;
}

// How long, as a share of the period, the pumps run for these if they hold on: from each begin to
// the end of its window, unless they begin to fill others before.
double ShareOfRun(const Problem& problem, const std::vector<Fills>& all, const Fills& one) {
  const optimizer::Gait& gait = problem.groups[one.group].gait;
  double sum = 0.0;
  for (const double begin : one.begins) {
    double end = begin + gait.inflate_fraction / gait.strokes_per_period;
    for (const Fills& other : all)
      for (const double at : other.begins)
        for (const double next : {at, at + 1.0})
          if ((&other == &one || OnSamePumps(problem, one, other)) && next > begin + 1e-9)
            end = std::min(end, next);
    sum += end - begin;
  }
  return sum;
}

// Most pumps of their own that are on at once, where each is for the whole of its window; looked
// for at many times of the period.
int RunningAtOnce(const Problem& problem, const std::vector<Fills>& all) {
  if (problem.pump_feed == optimizer::PumpFeed::kShared) return 1;
  constexpr int kTimes = 20'000;
  int most = 0;
  for (int i = 0; i < kTimes; ++i) {
    std::vector<int> of_group(problem.groups.size(), 0);
    for (const Fills& fills : all) {
      const optimizer::Gait& gait = problem.groups[fills.group].gait;
      const double window = gait.inflate_fraction / gait.strokes_per_period;
      for (const double begin : fills.begins)
        if (std::fmod((i + 0.5) / kTimes - begin + 1.0, 1.0) < window)
          of_group[fills.group] +=
              problem.pump_feed == optimizer::PumpFeed::kPerActuator ? fills.count : 1;
    }
    int running = 0;
    for (const int one : of_group)
      running += problem.pump_feed == optimizer::PumpFeed::kPerGroup ? std::min(one, 1) : one;
    most = std::max(most, running);
  }
  return most;
}

double MostCurrent(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  double most = 0.0;
  const model::MonotoneCurve& table = curve.current_a;
  for (int i = 0; i <= 2000 && !table.empty(); ++i)
    most = std::max(most, table(std::clamp(low_pa + (high_pa - low_pa) * i / 2000, table.front(),
                                           table.back())));
  return most;
}

}  // namespace

optimizer::Leaf SizeDirectPump(const Problem& problem, const Candidate& candidate) {
  optimizer::Leaf leaf;
  leaf.status = optimizer::LeafStatus::kInfeasible;
  const double period_s = 1.0 / problem.frequency_hz;
  const std::vector<Fills> fills = FillsOf(problem);
  const model::Compressor& pump = ChosenPump(problem, candidate);
  const model::Battery& pack = problem.parts.batteries[candidate.battery.index];
  std::vector<double> on_s(candidate.lines.size(), 0.0);  // of each group's pumps; [0]: of all
  const bool shared = problem.pump_feed == optimizer::PumpFeed::kShared;
  double per_cycle_j = 0.0, coil_w = 0.0, highest_pa = problem.ambient.pressure_pa;
  optimizer::Amounts sum;
  std::vector<double> slowest_s(candidate.lines.size(), 0.0), held_open_s = slowest_s;
  for (std::size_t f = 0; f < fills.size(); ++f) {
    const std::size_t g = fills[f].group;
    const optimizer::Gait& gait = problem.groups[g].gait;
    const double stroke_s = period_s / gait.strokes_per_period;
    const double open_s = gait.inflate_fraction * stroke_s;
    const double turn_s = std::min(open_s, ShareUntilNext(problem, fills, fills[f]) * period_s);
    const Line& line = *candidate.lines[g];
    const model::Valve& valve = problem.parts.valves[line.valve];
    if (valve.kind == model::ValveKind::kThreeWay ||
        valve.pressure_min_pa > problem.ambient.pressure_pa ||
        line.fall_time_s > std::min(stroke_s - open_s, problem.groups[g].fall_time_max_s))
      return leaf;
    const bool each = problem.pump_feed == optimizer::PumpFeed::kPerActuator;
    const int times = each ? fills[f].count : 1;
    const Filled& filled = Known(f, FillingOf(problem, candidate, g, fills[f].count / times));
    if (filled.inflate_s > turn_s || filled.rise_s > problem.groups[g].rise_time_max_s) return leaf;
    highest_pa = std::max(highest_pa, filled.highest_pa);
    const double filling_s = gait.strokes_per_period * filled.inflate_s;
    const double run_s = optimizer::PumpsHoldOn(problem)
                             ? ShareOfRun(problem, fills, fills[f]) * period_s
                             : filling_s;
    const double operating_pa = line.chamber.operating_pressure_pa;
    on_s[shared ? 0 : g] += run_s;
    held_open_s[g] += run_s * fills[f].count / problem.groups[g].count;
    per_cycle_j +=
        times * (gait.strokes_per_period * filled.pump_j +
                 (run_s - filling_s) * candidate.compressor.quantity * pump.curve.voltage_v *
                     MostCurrent(pump.curve, operating_pa, operating_pa));
    slowest_s[g] = std::max(slowest_s[g], filled.inflate_s);
  }
  for (std::size_t g = 0; g < candidate.lines.size(); ++g) {
    const Line& line = *candidate.lines[g];
    const optimizer::Gait& gait = problem.groups[g].gait;
    const double vent_s = (1.0 - gait.inflate_fraction) * period_s;
    if (highest_pa > line.source_max_pa) return leaf;
    const bool past_valve = problem.pump_feed == optimizer::PumpFeed::kPerActuator;
    const double filling_s = past_valve ? 0.0
                             : optimizer::PumpsHoldOn(problem)
                                 ? held_open_s[g]
                                 : gait.strokes_per_period * slowest_s[g];
    per_cycle_j += line.coil_power_w * (vent_s + filling_s);
    coil_w += line.coil_power_w;
    sum += line.amounts;
  }
  sum += candidate.compressor.amounts;
  sum += candidate.battery.amounts;
  const double packs = candidate.battery.quantity;
  const double current_a = RunningAtOnce(problem, fills) * candidate.compressor.quantity *
                               MostCurrent(pump.curve, problem.ambient.pressure_pa, highest_pa) +
                           coil_w / pack.nominal_voltage_v;
  const double energy_j = problem.actuations * per_cycle_j;
  const bool bears =
      highest_pa <= problem.source_pressure_max_pa &&
      *std::max_element(on_s.begin(), on_s.end()) <= pump.duty_max * period_s * (1.0 + 1e-9) &&
      energy_j <= packs * pack.capacity_ah * kJoulePerWattHour * pack.nominal_voltage_v * 0.8 &&
      current_a <= packs * pack.current_max_a && sum.mass_kg <= problem.mass_max_kg &&
      sum.volume_m3 * 1e3 <= problem.volume_max_l && sum.cost_eur <= problem.cost_max_eur;
  if (!bears) return leaf;
  leaf.status = optimizer::LeafStatus::kFeasible;
  leaf.point.source_pa = highest_pa;
  leaf.objective = leaf.lower_bound = problem.objective.mass_kg * sum.mass_kg +
                                      problem.objective.volume_l * sum.volume_m3 * 1e3 +
                                      problem.objective.cost_eur * sum.cost_eur +
                                      problem.objective.energy_wh * energy_j / kJoulePerWattHour;
  return leaf;
}

}  // namespace plenum::test
