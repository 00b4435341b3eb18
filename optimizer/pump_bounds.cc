#include "optimizer/pump_bounds.h"

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate_strokes.h"
#include "optimizer/root.h"

namespace plenum::optimizer {
namespace {

constexpr int kCells = 256;
constexpr double kIntervalRatio = 1.25;
constexpr double kNeedTolerance = 3e-3;  // of the source pressure; its lower end is used

double ContentPerVolume(const Problem& problem) {
  return model::kReferencePressurePa * problem.ambient.temperature_k /
         model::kReferenceTemperatureK;
}

// The table's points and an even division: within a cell power and delivery are monotone.
std::vector<double> Cells(const model::CompressorCurve& curve, double low_pa) {
  const double high_pa = model::HighestPressure(curve);
  std::vector<double> edges{low_pa};
  for (int i = 1; i <= kCells; ++i) edges.push_back(low_pa + (high_pa - low_pa) * i / kCells);
  for (const model::MonotoneCurve* table : {&curve.free_air_m3_per_s, &curve.current_a})
    for (double knot : table->x())
      if (knot > low_pa && knot < high_pa) edges.push_back(knot);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void MakeNonFalling(std::vector<double>& values) {
  for (std::size_t i = values.size() - 1; i-- > 0;) values[i] = std::min(values[i], values[i + 1]);
}

}  // namespace

Minorant::Minorant(std::vector<double> pressure_pa, std::vector<double> value)
    : pressure_pa_(std::move(pressure_pa)), value_(std::move(value)) {
  integral_.assign(pressure_pa_.size(), 0.0);
  for (std::size_t i = 0; i < value_.size(); ++i)
    integral_[i + 1] = integral_[i] + value_[i] * (pressure_pa_[i + 1] - pressure_pa_[i]);
}

double Minorant::At(double pressure_pa) const {
  const auto above = std::upper_bound(pressure_pa_.begin(), pressure_pa_.end(), pressure_pa);
  const std::ptrdiff_t cell = std::clamp<std::ptrdiff_t>(
      above - pressure_pa_.begin() - 1, 0, static_cast<std::ptrdiff_t>(value_.size()) - 1);
  return value_[cell];
}

double Minorant::Integral(double pressure_pa) const {
  const auto above = std::upper_bound(pressure_pa_.begin(), pressure_pa_.end(), pressure_pa);
  const std::ptrdiff_t cell = std::clamp<std::ptrdiff_t>(
      above - pressure_pa_.begin() - 1, 0, static_cast<std::ptrdiff_t>(value_.size()) - 1);
  return integral_[cell] + value_[cell] * (pressure_pa - pressure_pa_[cell]);
}

double Minorant::Mean(double low_pa, double high_pa) const {
  if (!(high_pa > low_pa)) return At(high_pa);
  return (Integral(high_pa) - Integral(low_pa)) / (high_pa - low_pa);
}

PumpFacts MakePumpFacts(const Problem& problem, const model::CompressorCurve& curve) {
  PumpFacts facts;
  facts.target_pa = kUnlimited;
  double rising_s = 0.0;
  for (const ActuatorGroup& group : problem.groups) {
    facts.target_pa = std::min(facts.target_pa, RiseTarget(problem, group));
    const double rise_s = std::min(group.rise_time_max_s, HalfPeriod(problem));
    rising_s = problem.simultaneous ? std::max(rising_s, rise_s) : rising_s + rise_s;
  }
  facts.early_m3 = model::FreeAirDelivery(curve, problem.ambient.pressure_pa) * rising_s;

  const std::vector<double> edges = Cells(curve, problem.ambient.pressure_pa);
  std::vector<double> energy, seconds;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double delivery = model::FreeAirDelivery(curve, edges[i]);
    const double power_w = std::min(model::ElectricalPower(curve, edges[i]),
                                    model::ElectricalPower(curve, edges[i + 1]));
    energy.push_back(delivery > 0.0 ? power_w / delivery : kUnlimited);
    seconds.push_back(delivery > 0.0 ? 1.0 / delivery : kUnlimited);
  }
  // Past the last delivery nothing can be pumped; a large number keeps integrals finite.
  for (std::vector<double>* values : {&energy, &seconds})
    for (double& value : *values)
      if (std::isinf(value)) value = 1e12;
  MakeNonFalling(energy);
  MakeNonFalling(seconds);
  facts.energy_j_per_m3 = Minorant(edges, energy);
  facts.seconds_per_m3 = Minorant(edges, seconds);
  return facts;
}

PumpNeed LeastPumpNeed(const Problem& problem, const PumpFacts& facts, int pumps, double air_m3,
                       double air_to_target_m3, double source_min_pa) {
  const double early_m3 = pumps * facts.early_m3;
  // Strokes that take turns do not find the reservoir full; only (4) holds for them.
  const bool burst = problem.simultaneous || problem.groups.size() == 1;
  const double last_m3 = burst ? std::max(0.0, air_to_target_m3 - early_m3) : 0.0;
  const double other_m3 = std::max(0.0, air_m3 - early_m3 - last_m3);
  const double first_m3 = air_m3 - last_m3 - other_m3;
  const double high_pa = std::max(source_min_pa, facts.target_pa);
  const auto bound = [&](const Minorant& per_air) {
    return last_m3 * per_air.Mean(facts.target_pa, high_pa) +
           other_m3 * per_air.At(facts.target_pa) +
           first_m3 * per_air.At(problem.ambient.pressure_pa);
  };
  return {bound(facts.seconds_per_m3) / pumps, bound(facts.energy_j_per_m3)};
}

PumpNeed LeastPumpNeed(const Problem& problem, const PumpFacts& facts, int pumps, double air_m3,
                       double source_pa, double reservoir_m3, double* first_fill_j) {
  const double ambient_pa = problem.ambient.pressure_pa;
  const double per_volume = ContentPerVolume(problem);
  *first_fill_j = reservoir_m3 / per_volume * (source_pa - ambient_pa) *
                  facts.energy_j_per_m3.Mean(ambient_pa, source_pa);
  if (!problem.simultaneous && problem.groups.size() > 1)
    return LeastPumpNeed(problem, facts, pumps, air_m3, 0.0, source_pa);
  const double low_pa = source_pa - per_volume * air_m3 / reservoir_m3;  // by (1)
  const double from_pa = std::max(low_pa, ambient_pa);
  const double share = (source_pa - from_pa) / (source_pa - low_pa);
  const auto bound = [&](const Minorant& per_air) {
    return air_m3 *
           (share * per_air.Mean(from_pa, source_pa) + (1.0 - share) * per_air.At(from_pa));
  };
  return {bound(facts.seconds_per_m3) / pumps, bound(facts.energy_j_per_m3)};
}

namespace {

// Air that the reservoir must give by the end of the rise times, by (2).
double GivenByReservoir(const Problem& problem, const PumpFacts& facts, int pumps,
                        double air_to_target_m3) {
  const bool burst = problem.simultaneous || problem.groups.size() == 1;
  return burst ? std::max(0.0, air_to_target_m3 - pumps * facts.early_m3) : 0.0;
}

double LeastStopPressure(const Problem& problem, const PumpFacts& facts, int pumps,
                         double air_to_target_m3, double reservoir_m3) {
  return facts.target_pa + ContentPerVolume(problem) *
                               GivenByReservoir(problem, facts, pumps, air_to_target_m3) /
                               reservoir_m3;
}

}  // namespace

double LeastReservoirVolume(const Problem& problem, const PumpFacts& facts, int pumps,
                            double air_to_target_m3, double source_max_pa) {
  const double given_m3 = GivenByReservoir(problem, facts, pumps, air_to_target_m3);
  if (given_m3 == 0.0) return 0.0;
  if (!(source_max_pa > facts.target_pa)) return kUnlimited;
  return ContentPerVolume(problem) * given_m3 / (source_max_pa - facts.target_pa);
}

double AirToTarget(const Problem& problem, int group, const model::Chamber& chamber) {
  const ActuatorGroup& actuators = problem.groups[group];
  const double content = model::Content(chamber, RiseTarget(problem, actuators)) -
                         model::Content(chamber, problem.ambient.pressure_pa);
  return actuators.count * model::StandardVolume(content, problem.ambient.temperature_k);
}

namespace {

// Highest stop pressure that `bearable` accepts, from one that it accepts up to `high_pa`; a little
// too high rather than too low.
template <typename Bearable>
double MostBearable(ReservoirNeed need, double high_pa, Bearable&& bearable) {
  double low_pa = need.source_pa;
  need.source_pa = high_pa;
  if (bearable(need)) return high_pa;
  while (high_pa - low_pa > kNeedTolerance * high_pa) {
    need.source_pa = 0.5 * (low_pa + high_pa);
    (bearable(need) ? low_pa : high_pa) = need.source_pa;
  }
  return high_pa;
}

}  // namespace

std::vector<ReservoirNeed> ReservoirNeeds(const Problem& problem, const PumpFacts& facts,
                                          const Candidate& candidate, double energy_max_j,
                                          double low_m3, double high_m3) {
  std::vector<ReservoirNeed> needs;
  const Window window = SourceWindow(problem, candidate);
  if (window.empty()) return needs;
  const model::Compressor& compressor = problem.parts.compressors[candidate.compressor.index];
  const int pumps = candidate.compressor.quantity;
  double air_m3 = 0.0, air_to_target_m3 = 0.0, coil_j = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const Line& line = *candidate.lines[g];
    air_m3 += AirPerStroke(problem, g, line, window.low_pa);
    air_to_target_m3 += AirToTarget(problem, g, line.chamber);
    coil_j += CoilEnergyPerCycle(problem, line, line.inflate_time_least_s);
  }
  // Sets what stopping at need.source_pa at least takes; false if that is too much.
  const auto bearable = [&](ReservoirNeed& need) {
    double first_fill_j = 0.0;
    const PumpNeed pump =
        LeastPumpNeed(problem, facts, pumps, air_m3, need.source_pa, need.low_m3, &first_fill_j);
    need.energy_j = first_fill_j + problem.actuations * (pump.energy_j + coil_j);
    return pump.on_s * problem.frequency_hz <= compressor.duty_max && need.energy_j <= energy_max_j;
  };
  for (bool last = false; !last;) {
    ReservoirNeed need;
    need.low_m3 = low_m3;
    need.high_m3 = std::min(low_m3 * kIntervalRatio, high_m3);
    low_m3 = need.high_m3;
    last = low_m3 >= high_m3;
    // Cheap first: the mass balance (2) at the largest volume.
    need.source_pa = std::max(
        window.low_pa, LeastStopPressure(problem, facts, pumps, air_to_target_m3, need.high_m3));
    if (need.source_pa > window.high_pa || !bearable(need)) continue;
    const auto excess = [&](double source_pa) {
      return AloneExcess(problem, candidate, {source_pa, need.high_m3, need.low_m3});
    };
    need.source_max_pa = MostBearable(need, window.high_pa, bearable);
    const OperatingPoint most{need.source_max_pa, need.high_m3, need.low_m3};
    if (excess(need.source_max_pa) > 0.0 || AloneStrokeExcess(problem, candidate, most) > 0.0)
      continue;
    need.source_pa =
        FeasibleBracket(excess, need.source_pa, need.source_max_pa, kNeedTolerance).low;
    if (bearable(need)) needs.push_back(need);
  }
  return needs;
}

}  // namespace plenum::optimizer
