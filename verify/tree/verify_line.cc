#include "verify/tree/verify_line.h"

#include "model/flow/tube.h"
#include "model/strokes/stroke.h"
#include "verify/design/verify_design.h"

namespace plenum::verify {
namespace {

constexpr double kSourceTolerance = 1e-3;  // of the least source pressure; its lower end counts

void Raise(const model::FlowElement& flow, model::FlowElement& best) {
  best.sonic_conductance_m3_per_s_pa =
      std::max(best.sonic_conductance_m3_per_s_pa, flow.sonic_conductance_m3_per_s_pa);
  best.critical_ratio = std::max(best.critical_ratio, flow.critical_ratio);
  best.subsonic_index = std::min(best.subsonic_index, flow.subsonic_index);
}

// Indices of the parts that a slot may have in the box.
std::vector<int> PartsOf(const ProofPlan& plan, const Ranges& ranges, Family family, int group) {
  const int slot = SlotOf(plan, family, group);
  std::vector<int> parts;
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i)
    parts.push_back(plan.slots[slot].choices[i].part);
  return parts;
}

struct LineChoices {
  std::vector<int> tubes, fittings, valves;
};

// Whether some tube, fitting and valve fit.
bool Mates(const Problem& problem, int g, const LineChoices& choices) {
  const model::Parts& parts = problem.parts;
  if (problem.groups[g].fittings_per_line == 0) return true;
  return std::any_of(choices.fittings.begin(), choices.fittings.end(), [&](int f) {
    const model::Fitting& fitting = parts.fittings[f];
    return std::any_of(choices.tubes.begin(), choices.tubes.end(),
                       [&](int t) { return Fit(parts.tubing[t], fitting); }) &&
           std::any_of(choices.valves.begin(), choices.valves.end(),
                       [&](int v) { return Fit(fitting, parts.valves[v]); });
  });
}

// Elements, volumes and pressures.
BestLine Gather(const Problem& problem, int g, const LineChoices& choices,
                model::FlowElement& exhaust, double& switches_pa) {
  const model::Parts& parts = problem.parts;
  const ActuatorGroup& group = problem.groups[g];
  BestLine best;
  double narrowest_m = kUnlimited, widest_m = 0.0, tube_pa = 0.0, valve_pa = 0.0;
  double fitting_pa = group.fittings_per_line > 0 ? 0.0 : kUnlimited;
  model::FlowElement fill{0, 0, 1}, fitting{0, 0, 1};
  for (int t : choices.tubes) {
    narrowest_m = std::min(narrowest_m, parts.tubing[t].inner_diameter_m);
    widest_m = std::max(widest_m, parts.tubing[t].inner_diameter_m);
    tube_pa = std::max(tube_pa, parts.tubing[t].pressure_max_pa);
  }
  if (group.fittings_per_line > 0)
    for (int f : choices.fittings) {
      Raise(parts.fittings[f].flow, fitting);
      fitting_pa = std::max(fitting_pa, parts.fittings[f].pressure_max_pa);
    }
  best.coil_w = switches_pa = kUnlimited;
  for (int v : choices.valves) {
    const model::Valve& valve = parts.valves[v];
    Raise(valve.fill, fill);
    Raise(valve.exhaust, exhaust);
    valve_pa = std::max(valve_pa, valve.pressure_max_pa);
    switches_pa = std::min(switches_pa, valve.pressure_min_pa);
    best.coil_w = std::min(best.coil_w, group.count * valve.coil_power_w);
    best.some_hold |= model::Holds(valve.kind);
    best.all_hold &= model::Holds(valve.kind);
  }
  best.source_high_pa = std::min({tube_pa, fitting_pa, valve_pa, problem.source_pressure_max_pa});
  if (!best.some_hold) best.source_high_pa = std::min(best.source_high_pa, group.pressure_max_pa);
  best.fill.assign(group.fittings_per_line, fitting);
  best.fill.insert(best.fill.begin() + (group.fittings_per_line + 1) / 2,
                   model::TubeElement(widest_m, group.tube_length_m));
  best.fill.insert(best.fill.begin(), fill);
  best.chamber = group.chamber;
  best.chamber.dead_volume_m3 += model::BoreVolume(narrowest_m, group.tube_length_m);
  best.widest_dead_m3 =
      group.chamber.dead_volume_m3 + model::BoreVolume(widest_m, group.tube_length_m);
  return best;
}

}  // namespace

int SlotOf(const ProofPlan& plan, Family family, int group) {
  for (std::size_t s = 0; s < plan.slots.size(); ++s)
    if (plan.slots[s].family == family && plan.slots[s].group == group) return static_cast<int>(s);
  return -1;
}

double PressureAt(const Problem& problem, int group, double fraction) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return ambient_pa + fraction * (problem.groups[group].chamber.operating_pressure_pa - ambient_pa);
}

double Drawn(const Problem& problem, int group, const model::Chamber& chamber, double pressure_pa) {
  return problem.groups[group].count * (model::Content(chamber, pressure_pa) -
                                        model::Content(chamber, problem.ambient.pressure_pa));
}

BestLine BestOf(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int g) {
  const LineChoices choices{PartsOf(plan, ranges, Family::kTubing, g),
                            PartsOf(plan, ranges, Family::kFitting, g),
                            PartsOf(plan, ranges, Family::kValve, g)};
  if (!Mates(problem, g, choices)) return {};
  model::FlowElement exhaust_valve{0, 0, 1};
  double switches_pa = 0.0;
  BestLine best = Gather(problem, g, choices, exhaust_valve, switches_pa);
  best.mates = true;
  const ActuatorGroup& group = problem.groups[g];
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double temperature_k = problem.ambient.temperature_k;
  if (best.source_high_pa < std::max(operating_pa, switches_pa)) return best;

  const model::Gas gas =
      plan.configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
  const double factor =
      model::FlowFactor(gas) * std::sqrt(model::kReferenceTemperatureK / temperature_k);
  // Limits a hair wider than they are, so that rounding in the best of many never decides.
  const double slack = 1.0 + kSumTolerance;
  const double half_s = 0.5 / problem.frequency_hz * slack;
  std::vector<model::FlowElement> exhaust(best.fill.rbegin(), best.fill.rend());
  exhaust.back() = exhaust_valve;
  const double fall_s =
      model::EmptyTime(model::MakeSeries(exhaust, factor), best.chamber, operating_pa,
                       PressureAt(problem, g, problem.fall_fraction), temperature_k);
  if (fall_s > std::min(group.fall_time_max_s * slack, half_s)) return best;

  best.fill_series = model::MakeSeries(best.fill, factor);
  const auto seconds = [&](double source_pa, double to_pa) {
    return model::FillTime(best.fill_series, best.chamber, source_pa, problem.ambient.pressure_pa,
                           to_pa, temperature_k);
  };
  const auto fast_enough = [&](double source_pa) {
    const double inflate_s = seconds(source_pa, operating_pa);
    return inflate_s <= half_s &&
           (inflate_s <= group.rise_time_max_s ||
            seconds(source_pa, PressureAt(problem, g, problem.rise_fraction)) <=
                group.rise_time_max_s * slack);
  };
  if (!fast_enough(best.source_high_pa)) return best;
  double low_pa = operating_pa, high_pa = best.source_high_pa;
  while (high_pa - low_pa > kSourceTolerance * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (fast_enough(middle_pa) ? high_pa : low_pa) = middle_pa;
  }
  best.source_low_pa = low_pa;
  if (best.all_hold) best.inflate_s = seconds(best.source_high_pa, operating_pa);
  best.works = true;
  return best;
}

}  // namespace plenum::verify
