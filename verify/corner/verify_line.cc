#include "verify/corner/verify_line.h"

#include <algorithm>

#include "model/flow/tube.h"
#include "model/strokes/stroke.h"
#include "verify/corner/verify_best.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_rig.h"
#include "verify/design/verify_closing.h"
#include "verify/design/verify_design.h"

namespace plenum::verify {
namespace {

// Of strokes out of a reservoir; a few of them make a coarser one.
constexpr int kPanelsToTarget = 96, kPanelsBeyond = 16;
constexpr double kSourceTolerance = 1e-3;  // of the least source pressure; its lower end counts

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

// The highest source pressure at which the peak of some line of the box keeps the limit.
double HighestForPeaks(const Problem& problem, const ProofPlan& plan, const LineChoices& choices,
                       int g, double most_pa) {
  LinesParts lines;
  for (const int t : choices.tubes) lines.tubes.push_back(&problem.parts.tubing[t]);
  for (const int f : choices.fittings)
    lines.fittings.push_back(f < 0 ? nullptr : &problem.parts.fittings[f]);
  for (const int v : choices.valves) lines.valves.push_back(&problem.parts.valves[v]);
  return std::min(most_pa, (1.0 + kSumTolerance) *
                               MostForPeaksPa(problem, plan.configuration, g, lines, most_pa));
}

// Elements, volumes and pressures.
BestLine Gather(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int g,
                const LineChoices& choices, model::FlowElement& exhaust, double& switches_pa) {
  const ActuatorGroup& group = problem.groups[g];
  const auto best_of = [&](Family family) {
    return BestNumbers(problem, plan, ranges, SlotOf(plan, family, g));
  };
  const BestNumbers tube = best_of(Family::kTubing), fitting = best_of(Family::kFitting),
                    valve = best_of(Family::kValve);
  const int fittings = group.fittings_per_line;
  const double narrowest_m = tube.Low("inner_diameter_mm"),
               widest_m = tube.High("inner_diameter_mm");
  BestLine best;
  best.coil_w = group.count * valve.Number("coil_power_w");
  best.some_hold = valve.High("function") > 0.0;
  best.all_hold = valve.Low("function") > 0.0;
  const double closing_s = CoilSeconds(problem, g, true), open_s = CoilSeconds(problem, g, false);
  best.coil_s = best.all_hold ? closing_s : best.some_hold ? std::min(closing_s, open_s) : open_s;
  exhaust = valve.Flow("sonic_conductance_exhaust_dm3_per_s_bar");
  switches_pa = valve.Number("pressure_min_kpa_gauge");
  best.source_high_pa =
      std::min({tube.Number("pressure_max_kpa_gauge"),
                fittings > 0 ? fitting.Number("pressure_max_kpa_gauge") : kUnlimited,
                valve.Number("pressure_max_kpa_gauge"), problem.source_pressure_max_pa});
  if (!best.some_hold) best.source_high_pa = std::min(best.source_high_pa, group.pressure_max_pa);
  if (best.some_hold)
    best.source_high_pa = HighestForPeaks(problem, plan, choices, g, best.source_high_pa);
  best.fill.assign(fittings, fitting.Flow("sonic_conductance_dm3_per_s_bar"));
  best.fill.insert(best.fill.begin() + (fittings + 1) / 2,
                   model::TubeElement(widest_m, group.tube_length_m));
  best.fill.insert(best.fill.begin(), valve.Flow("sonic_conductance_fill_dm3_per_s_bar"));
  best.chamber = group.chamber;
  best.chamber.dead_volume_m3 += model::BoreVolume(narrowest_m, group.tube_length_m);
  best.widest = group.chamber;
  best.widest.dead_volume_m3 += model::BoreVolume(widest_m, group.tube_length_m);
  return best;
}

// Closer to each other towards the end, where flow falls.
std::vector<StrokeKnot> KnotsOf(const Problem& problem, const BestLine& line, int g, double from_pa,
                                double to_pa, int panels) {
  const double share = static_cast<double>(MostAtOnce(problem, g)) / problem.groups[g].count;
  std::vector<StrokeKnot> knots;
  for (int i = 0; i <= panels; ++i) {
    const double left = 1.0 - static_cast<double>(i) / panels;
    const double pressure_pa = to_pa - (to_pa - from_pa) * left * left;
    knots.push_back({pressure_pa, share * Drawn(problem, g, line.chamber, pressure_pa),
                     share * Drawn(problem, g, line.widest, pressure_pa)});
  }
  return knots;
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

double FallenPa(const Problem& problem, int group) {
  const model::Chamber& chamber = problem.groups[group].chamber;
  const double rest_pa = model::RestPa(chamber);
  return rest_pa + problem.fall_fraction * (chamber.operating_pressure_pa - rest_pa);
}

double Drawn(const Problem& problem, int group, const model::Chamber& chamber, double pressure_pa) {
  return problem.groups[group].count *
         (model::Content(chamber, pressure_pa) - model::Content(chamber, model::RestPa(chamber)));
}

BestLine BestOf(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int g) {
  const LineChoices choices{PartsOf(plan, ranges, Family::kTubing, g),
                            PartsOf(plan, ranges, Family::kFitting, g),
                            PartsOf(plan, ranges, Family::kValve, g)};
  if (!Mates(problem, g, choices)) return {};
  model::FlowElement exhaust_valve;
  double switches_pa = 0.0;
  BestLine best = Gather(problem, plan, ranges, g, choices, exhaust_valve, switches_pa);
  best.mates = true;
  const ActuatorGroup& group = problem.groups[g];
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double temperature_k = problem.ambient.temperature_k;
  if (best.source_high_pa < std::max(operating_pa, switches_pa)) return best;

  const double factor = FactorOf(problem, plan.configuration);
  // Limits a hair wider than they are, so that rounding in the best of many never decides.
  const double slack = 1.0 + kSumTolerance;
  const double window_s = FillWindow(problem, g) * slack;
  // Gathered inward: that is how air is let in of evacuated actuators.
  std::vector<model::FlowElement> exhaust = best.fill;
  exhaust.front() = exhaust_valve;
  if (group.fed_past_valve) best.fill.erase(best.fill.begin());
  std::reverse(Evacuated(problem) ? best.fill.begin() : exhaust.begin(),
               Evacuated(problem) ? best.fill.end() : exhaust.end());
  best.series.exhaust = model::MakeSeries(exhaust, factor);
  const double fall_s = model::EmptyTime(best.series.exhaust, best.chamber, operating_pa,
                                         FallenPa(problem, g), temperature_k);
  if (fall_s > std::min(group.fall_time_max_s, VentWindow(problem, g)) * slack) return best;

  best.series.fill = model::MakeSeries(best.fill, factor);
  const auto seconds = [&](double source_pa, double to_pa) {
    return model::FillTime(best.series.fill, best.chamber, source_pa, model::RestPa(best.chamber),
                           to_pa, temperature_k);
  };
  const auto fast_enough = [&](double source_pa) {
    const double inflate_s = seconds(source_pa, operating_pa);
    return inflate_s <= window_s &&
           (inflate_s <= group.rise_time_max_s ||
            seconds(source_pa, PressureAt(problem, g, problem.rise_fraction)) <=
                group.rise_time_max_s * slack);
  };
  if (!fast_enough(best.source_high_pa)) return best;
  double low_pa = std::max(operating_pa, switches_pa), high_pa = best.source_high_pa;
  while (high_pa - low_pa > kSourceTolerance * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (fast_enough(middle_pa) ? high_pa : low_pa) = middle_pa;
  }
  best.source_low_pa = low_pa;
  if (best.all_hold) best.inflate_s = seconds(best.source_high_pa, operating_pa);
  best.filling.flow = model::FlowTable(best.series.fill, model::MirrorPa(best.chamber));
  const double target_pa = PressureAt(problem, g, problem.rise_fraction);
  best.filling.to_target =
      KnotsOf(problem, best, g, model::RestPa(best.chamber), target_pa, kPanelsToTarget);
  best.filling.to_operating = KnotsOf(problem, best, g, target_pa, operating_pa, kPanelsBeyond);
  best.works = true;
  return best;
}

}  // namespace plenum::verify
