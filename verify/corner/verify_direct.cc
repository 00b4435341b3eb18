#include "verify/corner/verify_direct.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/problem/pump_feed.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr double kSlack = 1.0 + kSumTolerance;
constexpr int kPanels = 128;
constexpr double kWidth = 1e-7;  // of a bracket of pressures, relative

}  // namespace

DirectPumps::DirectPumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts,
                         KnownStrokes& strokes)
    : problem_(problem),
      plan_(plan),
      amounts_(amounts),
      choices_(strokes.pumps()),
      compressor_(SlotOf(plan, PumpFamily(plan.configuration), -1)),
      battery_(SlotOf(plan, Family::kBattery, -1)),
      units_(UnitsOf(problem)),
      running_(FeedsRunning(problem)) {}

const DirectPumps::Stroke& DirectPumps::StrokeOf(Range compressors, const BestLine& line,
                                                 const Unit& unit) {
  const auto [entry, fresh] = known_.try_emplace({compressors, &line, unit.group, unit.count});
  if (fresh) entry->second = MakeStroke(compressors, line, unit);
  return entry->second;
}

DirectPumps::Stroke DirectPumps::MakeStroke(Range compressors, const BestLine& line,
                                            const Unit& unit) const {
  const PumpCells& cells = choices_.CellsIn(compressors);
  const ProofItem& first = plan_.slots[compressor_].choices[compressors.first];
  const bool single = compressors.second == compressors.first + 1;
  const model::CompressorCurve& curve = PumpsOf(problem_, plan_.configuration)[first.part].curve;
  const int g = unit.group, count = unit.count / unit.feeds;  // of one feed
  const double share = static_cast<double>(count) / problem_.groups[g].count;
  const double highest_pa = std::min(cells.highest_pa, line.source_high_pa);
  const auto delivered = [&](double p) {
    if (!single) return choices_.DeliveryAt(cells, p);
    const model::MonotoneCurve& flow = curve.free_air_m3_per_s;
    return first.quantity * flow(std::clamp(p, flow.front(), flow.back()));
  };
  const auto taken = [&](double p, double chamber_pa) {
    return count *
           model::FlowBetween(line.series.fill, model::MirrorPa(line.chamber), p, chamber_pa);
  };
  // Around the pressure at which both are equal.
  const auto node_around = [&](double chamber_pa) {
    std::pair<double, double> around{chamber_pa, std::max(highest_pa, chamber_pa)};
    while (around.second - around.first > kWidth * around.second) {
      const double p = 0.5 * (around.first + around.second);
      (delivered(p) > taken(p, chamber_pa) ? around.first : around.second) = p;
    }
    return around;
  };
  const double from_pa = problem_.ambient.pressure_pa;
  const double operating_pa = problem_.groups[g].chamber.operating_pressure_pa;
  const double target_pa = PressureAt(problem_, g, problem_.rise_fraction);
  Stroke stroke;
  const auto panel = [&](double low_pa, double high_pa) {
    const double air_m3 =
        share *
        (Drawn(problem_, g, line.chamber, high_pa) - Drawn(problem_, g, line.chamber, low_pa)) /
        ContentPerVolume(problem_);
    const auto [under_pa, over_pa] = node_around(low_pa);
    const double flow = taken(over_pa, low_pa);
    stroke.inflate_s += flow > 0.0 ? air_m3 / flow : kUnlimited;
    const std::size_t cell = choices_.CellOf(single ? under_pa : low_pa);
    stroke.pump_j += air_m3 * cells.energy_j_per_m3[cell];
    if (!cells.holding_w.empty()) stroke.beyond_j += air_m3 * cells.beyond_j_per_m3[g][cell];
  };
  double low_pa = from_pa;
  for (int i = 1; i <= kPanels; ++i) {
    const double high_pa =
        i == kPanels ? operating_pa : from_pa + (operating_pa - from_pa) * i / kPanels;
    if (low_pa < target_pa && target_pa < high_pa) {
      panel(low_pa, target_pa);
      stroke.rise_s = stroke.inflate_s;
      low_pa = target_pa;
    }
    panel(low_pa, high_pa);
    if (high_pa <= target_pa) stroke.rise_s = stroke.inflate_s;
    low_pa = high_pa;
  }
  stroke.node_pa = single ? node_around(operating_pa).first : operating_pa;
  return stroke;
}

// Whether some valve of each group holds, and some switches without pressure at its inlet.
bool DirectPumps::Suits(const Ranges& ranges, const std::vector<const BestLine*>& lines) const {
  if (SomeAtOnce(problem_)) return false;
  for (int g = 0; g < static_cast<int>(lines.size()); ++g) {
    const int slot = SlotOf(plan_, Family::kValve, g);
    bool switches = false;
    for (int i = ranges[slot].first; i < ranges[slot].second && !switches; ++i)
      switches = problem_.parts.valves[plan_.slots[slot].choices[i].part].pressure_min_pa <=
                 problem_.ambient.pressure_pa;
    if (!switches || !lines[g]->some_hold) return false;
  }
  return true;
}

// Of those that drive some pump of the box and give its current up to this pressure and the coils'.
double DirectPumps::LeastBattery(const Ranges& ranges, double energy_j, double node_pa,
                                 double coil_w) const {
  const std::vector<model::Compressor>& compressors = PumpsOf(problem_, plan_.configuration);
  double least = kUnlimited;
  for (int i = ranges[battery_].first; i < ranges[battery_].second; ++i) {
    const ProofItem& item = plan_.slots[battery_].choices[i];
    const model::Battery& pack = problem_.parts.batteries[item.part];
    if (item.quantity * model::UsableEnergy(pack.capacity_ah, pack.nominal_voltage_v) * kSlack <
        energy_j)
      continue;
    const double pumps_a =
        item.quantity * pack.current_max_a * kSlack - coil_w / pack.nominal_voltage_v;
    for (int c = ranges[compressor_].first; c < ranges[compressor_].second; ++c) {
      const ProofItem& pump = plan_.slots[compressor_].choices[c];
      const model::CompressorCurve& curve = compressors[pump.part].curve;
      if (!AirSuffices(problem_, compressors[pump.part], pump.quantity) ||
          !model::VoltageMatches(pack.nominal_voltage_v, curve.voltage_v) ||
          running_ * pump.quantity *
                  model::LargestCurrent(curve, problem_.ambient.pressure_pa, node_pa) >
              pumps_a)
        continue;
      least = std::min(least, amounts_[battery_][i].objective);
      break;
    }
  }
  return least;
}

double DirectPumps::Least(const Ranges& ranges, const std::vector<const BestLine*>& lines,
                          double chosen) {
  const PumpCells& cells = choices_.CellsIn(ranges[compressor_]);
  if (!Suits(ranges, lines)) return kUnlimited;
  double high_pa = std::min(cells.highest_pa, problem_.source_pressure_max_pa);
  double node_pa = problem_.ambient.pressure_pa;
  double beyond_j = 0.0, coils_j = 0.0, coil_w = 0.0;  // per cycle
  const bool own_pumps = problem_.pump_feed != PumpFeed::kShared;
  std::vector<double> on_s(problem_.groups.size(), 0.0);  // of each feed of pumps
  for (const Unit& unit : units_) {
    const int g = unit.group;
    const double strokes = problem_.groups[g].gait.strokes_per_period;
    const double share = static_cast<double>(unit.count) / problem_.groups[g].count;
    const BestLine& line = *lines[g];
    const Stroke& stroke = StrokeOf(ranges[compressor_], line, unit);
    const double fill_max_s = std::min(FillWindow(problem_, g), UntilNext(problem_, units_, unit));
    if (stroke.inflate_s > fill_max_s * kSlack ||
        stroke.rise_s > problem_.groups[g].rise_time_max_s * kSlack)
      return kUnlimited;
    double run_s = strokes * stroke.inflate_s, pump_j = strokes * stroke.pump_j;
    if (PumpsHoldOn(problem_)) {
      run_s = RunSeconds(problem_, units_, unit);
      pump_j = std::max(pump_j, run_s * cells.holding_w[g] + strokes * stroke.beyond_j);
    }
    on_s[own_pumps ? g : 0] += run_s;
    beyond_j += unit.feeds * pump_j;
    if (line.all_hold && !problem_.groups[g].fed_past_valve && !PumpsHoldOn(problem_))
      beyond_j += strokes * share * line.coil_w * stroke.inflate_s;
    coil_w += share * line.coil_w;
    coils_j += share * line.coil_w * line.coil_s;
    // A constant source at the highest pressure is faster.
    node_pa = std::max({node_pa, stroke.node_pa, line.source_low_pa});
    high_pa = std::min(high_pa, line.source_high_pa);
  }
  const double longest_s = *std::max_element(on_s.begin(), on_s.end());
  if (node_pa > high_pa * kSlack || longest_s * problem_.frequency_hz > cells.duty_max * kSlack)
    return kUnlimited;
  beyond_j *= problem_.actuations;
  return chosen + LeastBattery(ranges, beyond_j + problem_.actuations * coils_j, node_pa, coil_w) +
         problem_.objective.energy_wh * beyond_j / optimizer::kJoulePerWattHour;
}

}  // namespace plenum::verify
