#include "tests/support/pumps/direct_sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/flow/series.h"
#include "tests/support/iso_chain.h"

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
    return in_.count * node_pa * model::FlowAtRatio(series_, p / node_pa);
  }
  double Node(double p) const {
    if (!(p < highest_pa_) || Delivery(highest_pa_) >= Taken(highest_pa_, p)) return highest_pa_;
    return Bisect(
        p, highest_pa_, [&](double x) { return Delivery(x) - Taken(x, p); }, 1e-8);
  }
  double Content(double p) const {
    const model::Chamber& c = in_.chamber;
    const double x =
        (p - c.ambient_pressure_pa) / (c.operating_pressure_pa - c.ambient_pressure_pa);
    return p * (c.rest_volume_m3 * (1.0 + (c.expansion_ratio - 1.0) * x) + c.dead_volume_m3);
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

// Batteries are the innermost choice of an enumeration: the last stroke of each group is kept.
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

Filling FillingOf(const Problem& problem, const Candidate& candidate, std::size_t g) {
  const Line& line = *candidate.lines[g];
  const double ambient_pa = problem.ambient.pressure_pa;
  Filling filling;
  filling.curve = problem.parts.compressors[candidate.compressor.index].curve;
  filling.elements = line.fill;
  filling.chamber = line.chamber;
  filling.pumps = candidate.compressor.quantity;
  filling.count = problem.groups[g].count;
  filling.ambient_pa = ambient_pa;
  filling.target_pa =
      ambient_pa + problem.rise_fraction * (line.chamber.operating_pressure_pa - ambient_pa);
  filling.temperature_k = problem.ambient.temperature_k;
  return filling;
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
  const std::size_t groups = candidate.lines.size();
  if (groups > 1 && problem.simultaneous) return leaf;
  const double period_s = 1.0 / problem.frequency_hz, half_s = 0.5 * period_s;
  const double turn_s = std::min(half_s, period_s / static_cast<double>(groups));
  const model::Compressor& pump = problem.parts.compressors[candidate.compressor.index];
  const model::Battery& pack = problem.parts.batteries[candidate.battery.index];
  double on_s = 0.0, per_cycle_j = 0.0, coil_w = 0.0, highest_pa = problem.ambient.pressure_pa;
  optimizer::Amounts sum;
  for (std::size_t g = 0; g < groups; ++g) {
    const Line& line = *candidate.lines[g];
    const model::Valve& valve = problem.parts.valves[line.valve];
    if (valve.kind == model::ValveKind::kThreeWay ||
        valve.pressure_min_pa > problem.ambient.pressure_pa ||
        line.fall_time_s > std::min(half_s, problem.groups[g].fall_time_max_s))
      return leaf;
    const Filled& filled = Known(g, FillingOf(problem, candidate, g));
    if (filled.inflate_s > turn_s || filled.rise_s > problem.groups[g].rise_time_max_s) return leaf;
    highest_pa = std::max(highest_pa, filled.highest_pa);
    on_s += filled.inflate_s;
    per_cycle_j += filled.pump_j + line.coil_power_w * (half_s + filled.inflate_s);
    coil_w += line.coil_power_w;
    sum += line.amounts;
  }
  for (const Line* line : candidate.lines)
    if (highest_pa > line->source_max_pa) return leaf;
  sum += candidate.compressor.amounts;
  sum += candidate.battery.amounts;
  const double packs = candidate.battery.quantity;
  const double current_a = candidate.compressor.quantity *
                               MostCurrent(pump.curve, problem.ambient.pressure_pa, highest_pa) +
                           coil_w / pack.nominal_voltage_v;
  const double energy_j = problem.actuations * per_cycle_j;
  const bool bears =
      highest_pa <= problem.source_pressure_max_pa && on_s <= pump.duty_max * period_s &&
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
