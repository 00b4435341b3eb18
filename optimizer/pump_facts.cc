// Tables of pumps for the bounds of pump_bounds.h.
#include <algorithm>

#include "optimizer/pump_bounds.h"

namespace plenum::optimizer {
namespace {

constexpr double kNoDelivery = 1e12;

std::vector<double> EvenCells(double low_pa, double high_pa, int cells) {
  std::vector<double> edges;
  for (int i = 0; i <= cells; ++i) edges.push_back(low_pa + (high_pa - low_pa) * i / cells);
  return edges;
}

// Tables of a pump over cells of pressure, as minorants: delivery falls with pressure, so that a
// cell's lower edge has the most; the least power is at an edge or at a point of the table.
struct PumpTables {
  std::vector<double> energy_j_per_m3, seconds_per_m3, current_a;
};

void MakeNonFalling(std::vector<double>& values) {
  for (std::size_t i = values.size() - 1; i-- > 0;) values[i] = std::min(values[i], values[i + 1]);
}

PumpTables MakeTables(const model::CompressorCurve& curve, int pumps,
                      const std::vector<double>& edges) {
  const model::MonotoneCurve& current = curve.current_a;
  const auto current_at = [&](double pressure_pa) {
    return current.empty() ? 0.0
                           : current(std::clamp(pressure_pa, current.front(), current.back()));
  };
  PumpTables tables;
  for (std::vector<double>* table :
       {&tables.energy_j_per_m3, &tables.seconds_per_m3, &tables.current_a})
    table->reserve(edges.size() - 1);
  std::size_t knot = 0;
  while (knot < current.x().size() && current.x()[knot] <= edges.front()) ++knot;
  double high_a = current_at(edges.front()), largest_a = high_a;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    tables.current_a.push_back(pumps * largest_a);
    const double low_a = high_a;
    high_a = current_at(edges[i + 1]);
    double least_a = std::min(low_a, high_a);
    for (; knot < current.x().size() && current.x()[knot] < edges[i + 1]; ++knot) {
      least_a = std::min(least_a, current.y()[knot]);
      largest_a = std::max(largest_a, current.y()[knot]);
    }
    largest_a = std::max(largest_a, high_a);
    // Past the last delivery nothing can be pumped; a large number keeps integrals finite.
    const double delivery = model::FreeAirDelivery(curve, edges[i]);
    const double power_w = curve.voltage_v * least_a;
    tables.energy_j_per_m3.push_back(delivery > 0.0 ? power_w / delivery : kNoDelivery);
    tables.seconds_per_m3.push_back(delivery > 0.0 ? 1.0 / (pumps * delivery) : kNoDelivery);
  }
  MakeNonFalling(tables.energy_j_per_m3);
  MakeNonFalling(tables.seconds_per_m3);
  return tables;
}

PumpFacts MakeFacts(const Problem& problem, double highest_pa, PumpTables tables) {
  PumpFacts facts;
  facts.target_pa = kUnlimited;
  double rising_s = 0.0;
  for (const ActuatorGroup& group : problem.groups) {
    facts.target_pa = std::min(facts.target_pa, RiseTarget(problem, group));
    const double rise_s = std::min(group.rise_time_max_s, HalfPeriod(problem));
    rising_s = problem.simultaneous ? std::max(rising_s, rise_s) : rising_s + rise_s;
  }
  facts.early_m3 = rising_s / tables.seconds_per_m3.front();
  const auto minorant = [&](std::vector<double>& values) {
    return Minorant(problem.ambient.pressure_pa, highest_pa, std::move(values));
  };
  facts.energy_j_per_m3 = minorant(tables.energy_j_per_m3);
  facts.seconds_per_m3 = minorant(tables.seconds_per_m3);
  facts.current_a = minorant(tables.current_a);
  return facts;
}

}  // namespace

Minorant::Minorant(double low_pa, double high_pa, std::vector<double> value)
    : low_pa_(low_pa),
      cells_per_pa_(static_cast<double>(value.size()) / (high_pa - low_pa)),
      pa_per_cell_(1.0 / cells_per_pa_),
      last_(static_cast<double>(value.size() - 1)),
      value_(std::move(value)),
      inverse_(value_.size()),
      integral_(value_.size(), 0.0) {
  for (std::size_t i = 0; i < value_.size(); ++i) inverse_[i] = 1.0 / value_[i];
  for (std::size_t i = 0; i + 1 < value_.size(); ++i)
    integral_[i + 1] = integral_[i] + value_[i] * pa_per_cell_;
}

double Minorant::Integral(double pressure_pa) const {
  const std::size_t cell = Cell(pressure_pa);
  return integral_[cell] +
         value_[cell] * (pressure_pa - low_pa_ - static_cast<double>(cell) * pa_per_cell_);
}

double Minorant::Mean(double low_pa, double high_pa) const {
  constexpr double kNarrow = 1e-6;  // where the difference of integrals would lose digits
  if (!(high_pa - low_pa > kNarrow * high_pa)) return At(low_pa);
  return (Integral(high_pa) - Integral(low_pa)) / (high_pa - low_pa);
}

PumpFacts MakePumpFacts(const Problem& problem, const model::CompressorCurve& curve, int pumps,
                        int cells) {
  const double ambient_pa = problem.ambient.pressure_pa;
  const double highest_pa = std::max(model::HighestPressure(curve), 1.01 * ambient_pa);
  PumpFacts facts = MakeFacts(problem, highest_pa,
                              MakeTables(curve, pumps, EvenCells(ambient_pa, highest_pa, cells)));
  facts.exact = true;
  return facts;
}

double HighestPumpPressure(const Problem& problem) {
  double highest_pa = problem.ambient.pressure_pa * 1.01;
  for (const model::Compressor& compressor : problem.parts.compressors)
    highest_pa = std::max(highest_pa, model::HighestPressure(compressor.curve));
  return std::clamp(problem.source_pressure_max_pa, 1.01 * problem.ambient.pressure_pa, highest_pa);
}

CoarsePump MakeCoarsePump(const Problem& problem, double highest_pa,
                          const model::CompressorCurve& curve) {
  const PumpTables tables =
      MakeTables(curve, 1, EvenCells(problem.ambient.pressure_pa, highest_pa, kCoarseCells));
  CoarsePump coarse;
  std::copy_n(tables.energy_j_per_m3.begin(), kCoarseCells, coarse.energy_j_per_m3.begin());
  std::copy_n(tables.seconds_per_m3.begin(), kCoarseCells, coarse.seconds_per_m3.begin());
  std::copy_n(tables.current_a.begin(), kCoarseCells, coarse.current_a.begin());
  return coarse;
}

CoarsePump Several(CoarsePump one, int pumps) {
  for (double& seconds : one.seconds_per_m3) seconds /= pumps;
  for (double& current : one.current_a) current *= pumps;
  return one;
}

PumpFacts MakePumpFacts(const Problem& problem, double highest_pa, const CoarsePump& coarse) {
  const auto table = [](const std::array<double, kCoarseCells>& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return MakeFacts(
      problem, highest_pa,
      {table(coarse.energy_j_per_m3), table(coarse.seconds_per_m3), table(coarse.current_a)});
}

}  // namespace plenum::optimizer
