// Tables of pumps for the bounds of pump_bounds.h.
#include "optimizer/pump/pump_facts.h"

#include <algorithm>

namespace plenum::optimizer {
namespace {

constexpr double kNoDelivery = 1e12;

struct Division {
  double low_pa, high_pa;
  int count;
  double Edge(int i) const { return low_pa + (high_pa - low_pa) * i / count; }
};

void MakeNonFalling(std::vector<double>& values) {
  for (std::size_t i = values.size() - 1; i-- > 0;) values[i] = std::min(values[i], values[i + 1]);
}

// Delivery falls with pressure, so that a cell's lower edge has the most; the least power is at an
// edge or at a point of the table.
PumpTables MakeTables(const model::CompressorCurve& curve, int pumps, const Division& cells) {
  const model::MonotoneCurve& current = curve.current_a;
  const auto current_at = [&](double pressure_pa) {
    return current.empty() ? 0.0
                           : current(std::clamp(pressure_pa, current.front(), current.back()));
  };
  PumpTables tables;
  for (std::vector<double>* table :
       {&tables.energy_j_per_m3, &tables.seconds_per_m3, &tables.current_a})
    table->reserve(static_cast<std::size_t>(cells.count));
  double edge_pa = cells.low_pa;
  std::size_t knot = 0;
  while (knot < current.x().size() && current.x()[knot] <= edge_pa) ++knot;
  double high_a = current_at(edge_pa), largest_a = high_a;
  for (int i = 0; i < cells.count; ++i) {
    const double low_pa = edge_pa;
    edge_pa = cells.Edge(i + 1);
    tables.current_a.push_back(pumps * largest_a);
    const double low_a = high_a;
    high_a = current_at(edge_pa);
    double least_a = std::min(low_a, high_a);
    for (; knot < current.x().size() && current.x()[knot] < edge_pa; ++knot) {
      least_a = std::min(least_a, current.y()[knot]);
      largest_a = std::max(largest_a, current.y()[knot]);
    }
    largest_a = std::max(largest_a, high_a);
    // Past the last delivery nothing can be pumped; a large number keeps integrals finite.
    const double delivery = model::FreeAirDelivery(curve, low_pa);
    const double power_w = curve.voltage_v * least_a;
    tables.energy_j_per_m3.push_back(delivery > 0.0 ? power_w / delivery : kNoDelivery);
    tables.seconds_per_m3.push_back(delivery > 0.0 ? 1.0 / (pumps * delivery) : kNoDelivery);
  }
  MakeNonFalling(tables.energy_j_per_m3);
  MakeNonFalling(tables.seconds_per_m3);
  return tables;
}

double LeastPower(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  double least_w =
      std::min(model::ElectricalPower(curve, low_pa), model::ElectricalPower(curve, high_pa));
  for (std::size_t i = 0; i < curve.current_a.x().size(); ++i)
    if (const double knot_pa = curve.current_a.x()[i]; knot_pa > low_pa && knot_pa < high_pa)
      least_w = std::min(least_w, curve.voltage_v * curve.current_a.y()[i]);
  return least_w;
}

// Of one pump beyond what it takes while it holds. The highest pressure itself is reached.
std::vector<double> BeyondHolding(const model::CompressorCurve& curve, double holding_w,
                                  const Division& cells) {
  const double highest_pa = model::HighestPressure(curve);
  const bool falls = model::ElectricalPower(curve, highest_pa) < holding_w;
  std::vector<double> beyond(static_cast<std::size_t>(cells.count), falls ? -kUnlimited : 0.0);
  if (falls) return beyond;
  for (int i = 0; i < cells.count; ++i) {
    const double low_pa = cells.Edge(i), high_pa = std::min(cells.Edge(i + 1), highest_pa);
    double& most = beyond[static_cast<std::size_t>(i)];
    most = kNoDelivery;
    if (low_pa > highest_pa) continue;
    const double more_w = LeastPower(curve, low_pa, high_pa) - holding_w;
    const model::MonotoneCurve& flow = curve.free_air_m3_per_s;
    const double delivery = flow(std::max(flow.front(), more_w < 0.0 ? high_pa : low_pa));
    if (delivery > 0.0) most = more_w / delivery;
    if (!(delivery > 0.0) && more_w < 0.0) most = -kUnlimited;
  }
  MakeNonFalling(beyond);
  return beyond;
}

std::vector<HoldingPump> MakeHolding(const Problem& problem, const model::CompressorCurve& curve,
                                     int pumps, const Division& cells) {
  std::vector<HoldingPump> all;
  if (!PumpsHoldOn(problem)) return all;
  for (const ActuatorGroup& group : problem.groups) {
    const double one_w = model::ElectricalPower(curve, group.chamber.operating_pressure_pa);
    all.push_back({pumps * one_w, BeyondHolding(curve, one_w, cells)});
  }
  return all;
}

}  // namespace

PumpRates::PumpRates(double low_pa, double high_pa, PumpTables tables)
    : cells_(low_pa, high_pa, tables.seconds_per_m3.size()),
      current_a_(std::move(tables.current_a)) {
  sums_.reserve(current_a_.size());
  paces_.reserve(current_a_.size());
  PerAir sum;
  for (std::size_t i = 0; i < current_a_.size(); ++i) {
    const PerAir value{tables.seconds_per_m3[i], tables.energy_j_per_m3[i]};
    sums_.push_back({value, sum});
    paces_.push_back({value.seconds, 1.0 / value.seconds});
    sum.seconds += value.seconds * cells_.width_pa();
    sum.energy_j += value.energy_j * cells_.width_pa();
  }
}

PumpFacts MakePumpFacts(const Problem& problem, const model::CompressorCurve& curve, int pumps,
                        int cells) {
  const double ambient_pa = problem.ambient.pressure_pa;
  const double highest_pa = std::max(model::HighestPressure(curve), 1.01 * ambient_pa);
  PumpFacts facts;
  facts.rates = {ambient_pa, highest_pa, MakeTables(curve, pumps, {ambient_pa, highest_pa, cells})};
  facts.exact = true;
  facts.holding = MakeHolding(problem, curve, pumps, {ambient_pa, highest_pa, cells});
  return facts;
}

double HighestPumpPressure(const Problem& problem, Configuration configuration) {
  double highest_pa = problem.ambient.pressure_pa * 1.01;
  for (const model::Compressor& compressor : PumpsOf(problem, configuration))
    highest_pa = std::max(highest_pa, model::HighestPressure(compressor.curve));
  return std::clamp(problem.source_pressure_max_pa, 1.01 * problem.ambient.pressure_pa, highest_pa);
}

CoarsePump MakeCoarsePump(const Problem& problem, double highest_pa,
                          const model::CompressorCurve& curve) {
  const PumpTables tables =
      MakeTables(curve, 1, {problem.ambient.pressure_pa, highest_pa, kCoarseCells});
  CoarsePump coarse;
  coarse.holding =
      MakeHolding(problem, curve, 1, {problem.ambient.pressure_pa, highest_pa, kCoarseCells});
  std::copy_n(tables.energy_j_per_m3.begin(), kCoarseCells, coarse.energy_j_per_m3.begin());
  std::copy_n(tables.seconds_per_m3.begin(), kCoarseCells, coarse.seconds_per_m3.begin());
  std::copy_n(tables.current_a.begin(), kCoarseCells, coarse.current_a.begin());
  return coarse;
}

CoarsePump Several(CoarsePump one, int pumps) {
  for (double& seconds : one.seconds_per_m3) seconds /= pumps;
  for (double& current : one.current_a) current *= pumps;
  for (HoldingPump& holding : one.holding) holding.power_w *= pumps;
  return one;
}

PumpFacts MakePumpFacts(const Problem& problem, double highest_pa, const CoarsePump& coarse) {
  const auto table = [](const std::array<double, kCoarseCells>& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  PumpFacts facts;
  facts.rates = {
      problem.ambient.pressure_pa,
      highest_pa,
      {table(coarse.energy_j_per_m3), table(coarse.seconds_per_m3), table(coarse.current_a)}};
  facts.holding = coarse.holding;
  return facts;
}

}  // namespace plenum::optimizer
