#include "bench/search/base_instance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "bench/search/synthetic.h"
#include "model/flow/tube.h"
#include "model/physics/storage.h"
#include "model/strokes/stroke.h"

namespace plenum::bench {
namespace {

constexpr double kAboveOperatingPa = 1e5;

template <typename Key>
class Classes {
 public:
  int Of(const Key& key) {
    return classes_.try_emplace(key, static_cast<int>(classes_.size())).first->second;
  }

 private:
  std::map<Key, int> classes_;
};

// One battery that weighs nothing and gives enough; regulators that differ in flow, mass and the
// highest pressure at their inlet alone.
void Restrict(optimizer::Problem& problem, double source_pa) {
  problem.configurations = {optimizer::Configuration::kCylinder};
  problem.count = 1;
  problem.limits = {1, 1, 1, 1, 1};
  model::Battery battery;
  battery.basics.id = "battery";
  battery.nominal_voltage_v = 12.0;
  battery.capacity_ah = 1e9;
  battery.current_max_a = 1e9;
  problem.parts.batteries = {battery};
  for (model::Regulator& regulator : problem.parts.regulators) {
    regulator.flow_max_m3_per_s = optimizer::kUnlimited;
    regulator.electrical_power_w = 0.0;
    regulator.inlet_pressure_min_pa = source_pa;
    regulator.outlet_pressure_min_pa = regulator.outlet_pressure_max_pa = source_pa;
  }
}

bool NoBetter(const model::FlowElement& a, const model::FlowElement& b) {
  return a.sonic_conductance_m3_per_s_pa <= b.sonic_conductance_m3_per_s_pa &&
         a.critical_ratio <= b.critical_ratio;
}

template <typename Flow, typename TooSlow>
Cut CutOf(const BaseInstance& base, Selection s, const std::vector<int>& families, bool lifted,
          const Flow& flow, const TooSlow& too_slow) {
  for (const int family : families)
    for (int i = 0; i < base.size && lifted; ++i) {
      Selection better = s;
      better[family] = i;
      if (NoBetter(flow(family, s[family]), flow(family, i)) && too_slow(better)) s = better;
    }
  Cut cut;
  for (const int family : families)
    for (int i = 0; i < base.size; ++i)
      if (NoBetter(flow(family, i), flow(family, s[family]))) cut[family].push_back(i);
  const std::vector<model::Tubing>& tubes = base.problem.parts.tubing;
  for (int i = 0; i < base.size; ++i) {
    Selection other = s;
    other[kTubes] = i;
    if (lifted ? too_slow(other) : tubes[i].inner_diameter_m == tubes[s[kTubes]].inner_diameter_m)
      cut[kTubes].push_back(i);
  }
  return cut;
}

}  // namespace

BaseAttributes BaseInstance::AttributesOf(const Selection& s) const {
  const model::Parts& parts = problem.parts;
  return {parts.valves[s[kValves]].fill, parts.valves[s[kValves]].exhaust,
          parts.fittings[s[kFittings]].flow, parts.regulators[s[kRegulators]].flow,
          parts.tubing[s[kTubes]].inner_diameter_m};
}

double BaseInstance::Rise(const BaseAttributes& a) const {
  const optimizer::ActuatorGroup& group = problem.groups.front();
  model::FlowElement share = a.regulator;
  share.sonic_conductance_m3_per_s_pa /= group.count;
  const std::array elements{share, a.fill, a.fitting,
                            model::TubeElement(a.bore_m, group.tube_length_m), a.fitting};
  const model::Series fill = model::MakeSeries(elements);
  model::Chamber chamber = group.chamber;
  chamber.dead_volume_m3 += model::BoreVolume(a.bore_m, group.tube_length_m);
  const double ambient_pa = problem.ambient.pressure_pa;
  const double operating_pa = chamber.operating_pressure_pa;
  const auto seconds = [&](double to_pa) {
    return model::FillTime(fill, chamber, source_pa, ambient_pa, to_pa);
  };
  return std::max(seconds(ambient_pa + problem.rise_fraction * (operating_pa - ambient_pa)) /
                      group.rise_time_max_s,
                  seconds(operating_pa) * 2.0 * problem.frequency_hz);
}

double BaseInstance::Fall(const BaseAttributes& a) const {
  const optimizer::ActuatorGroup& group = problem.groups.front();
  const std::array elements{a.fitting, model::TubeElement(a.bore_m, group.tube_length_m), a.fitting,
                            a.exhaust};
  model::Chamber chamber = group.chamber;
  chamber.dead_volume_m3 += model::BoreVolume(a.bore_m, group.tube_length_m);
  const double ambient_pa = problem.ambient.pressure_pa;
  const double operating_pa = chamber.operating_pressure_pa;
  return model::EmptyTime(model::MakeSeries(elements), chamber, operating_pa,
                          ambient_pa + problem.fall_fraction * (operating_pa - ambient_pa)) /
         std::min(group.fall_time_max_s, 0.5 / problem.frequency_hz);
}

bool BaseInstance::LinearOk(const Selection& s) const {
  for (int f = 0; f < kBaseFamilies; ++f)
    if (!stands[f][s[f]]) return false;
  return tube_class[s[kTubes]] == fitting_class[s[kFittings]] &&
         fitting_thread[s[kFittings]] == valve_thread[s[kValves]] &&
         gas_m3[s[kCylinders]] >= need_m3[s[kTubes]] &&
         fill_pa[s[kCylinders]] <= inlet_max_pa[s[kRegulators]];
}

bool BaseInstance::Feasible(const Selection& s) const {
  if (!LinearOk(s)) return false;
  const BaseAttributes attributes = AttributesOf(s);
  return Fall(attributes) <= 1.0 && Rise(attributes) <= 1.0;
}

double BaseInstance::Mass(const Selection& s) const {
  double sum = 0.0;
  for (int f = 0; f < kBaseFamilies; ++f) sum += mass_kg[f][s[f]];
  return sum;
}

Cut BaseInstance::RiseCut(Selection s, bool lifted) const {
  const model::Parts& parts = problem.parts;
  return CutOf(
      *this, s, {kValves, kRegulators, kFittings}, lifted,
      [&](int family, int i) {
        return family == kValves     ? parts.valves[i].fill
               : family == kFittings ? parts.fittings[i].flow
                                     : parts.regulators[i].flow;
      },
      [&](const Selection& other) { return Rise(AttributesOf(other)) > 1.0; });
}

Cut BaseInstance::FallCut(Selection s, bool lifted) const {
  const model::Parts& parts = problem.parts;
  return CutOf(
      *this, s, {kValves, kFittings}, lifted,
      [&](int family, int i) {
        return family == kValves ? parts.valves[i].exhaust : parts.fittings[i].flow;
      },
      [&](const Selection& other) { return Fall(AttributesOf(other)) > 1.0; });
}

BaseInstance MakeBaseInstance(std::uint64_t catalogue, std::uint64_t requirements, int size) {
  BaseInstance base;
  base.size = size;
  optimizer::Problem& problem = base.problem;
  problem = SyntheticRequirements(requirements);
  problem.parts = SyntheticParts(catalogue, size);
  const optimizer::ActuatorGroup& group = problem.groups.front();
  base.source_pa = std::min(problem.source_pressure_max_pa,
                            group.chamber.operating_pressure_pa + kAboveOperatingPa);
  Restrict(problem, base.source_pa);
  const model::Parts& parts = problem.parts;
  const double p = base.source_pa;
  Classes<double> diameters;
  Classes<std::string> threads;
  for (const model::Valve& valve : parts.valves) {
    base.mass_kg[kValves].push_back(std::ceil(static_cast<double>(group.count) / valve.channels) *
                                    valve.basics.mass_kg);
    base.stands[kValves].push_back(valve.pressure_min_pa <= p && p <= valve.pressure_max_pa &&
                                   (model::Holds(valve.kind) || p <= group.pressure_max_pa));
    base.valve_thread.push_back(threads.Of(valve.port));
  }
  for (const model::Fitting& fitting : parts.fittings) {
    base.mass_kg[kFittings].push_back(group.count * group.fittings_per_line *
                                      fitting.basics.mass_kg);
    base.stands[kFittings].push_back(p <= fitting.pressure_max_pa);
    base.fitting_class.push_back(diameters.Of(fitting.tube_outer_diameter_m));
    base.fitting_thread.push_back(threads.Of(fitting.thread));
  }
  for (const model::Tubing& tube : parts.tubing) {
    base.mass_kg[kTubes].push_back(group.count * group.tube_length_m * tube.per_metre.mass_kg);
    base.stands[kTubes].push_back(p <= tube.pressure_max_pa);
    base.tube_class.push_back(diameters.Of(tube.outer_diameter_m));
    model::Chamber chamber = group.chamber;
    chamber.dead_volume_m3 += model::BoreVolume(tube.inner_diameter_m, group.tube_length_m);
    base.need_m3.push_back(problem.actuations * group.count *
                           model::StandardVolume(Content(chamber, chamber.operating_pressure_pa) -
                                                     Content(chamber, chamber.ambient_pressure_pa),
                                                 problem.ambient.temperature_k));
  }
  for (const model::Regulator& regulator : parts.regulators) {
    base.mass_kg[kRegulators].push_back(regulator.basics.mass_kg);
    base.stands[kRegulators].push_back(true);
    base.inlet_max_pa.push_back(regulator.inlet_pressure_max_pa);
  }
  for (const model::Cylinder& cylinder : parts.cylinders) {
    base.mass_kg[kCylinders].push_back(cylinder.basics.mass_kg +
                                       model::CylinderCharge(cylinder.water_volume_m3,
                                                             cylinder.fill_pressure_pa,
                                                             problem.ambient.temperature_k));
    base.stands[kCylinders].push_back(true);
    base.gas_m3.push_back(model::CylinderUsableVolume(
        cylinder.water_volume_m3, cylinder.fill_pressure_pa, p, problem.ambient.temperature_k));
    base.fill_pa.push_back(cylinder.fill_pressure_pa);
  }
  return base;
}

Enumerated EnumerateBase(const BaseInstance& base) {
  std::array<std::vector<int>, kBaseFamilies> order;
  for (int f = 0; f < kBaseFamilies; ++f) {
    for (int i = 0; i < base.size; ++i)
      if (base.stands[f][i]) order[f].push_back(i);
    std::sort(order[f].begin(), order[f].end(),
              [&](int a, int b) { return base.mass_kg[f][a] < base.mass_kg[f][b]; });
    if (order[f].empty()) return {};
  }
  Enumerated best;
  best.mass_kg = optimizer::kUnlimited;
  Selection s{};
  const auto least = [&](int f) { return base.mass_kg[f][order[f].front()]; };
  for (int t : order[kTubes])
    for (int f : order[kFittings]) {
      if (base.tube_class[t] != base.fitting_class[f]) continue;
      for (int v : order[kValves]) {
        if (base.valve_thread[v] != base.fitting_thread[f]) continue;
        s = {v, f, t, order[kRegulators].front(), order[kCylinders].front()};
        const double line =
            base.mass_kg[kValves][v] + base.mass_kg[kFittings][f] + base.mass_kg[kTubes][t];
        if (line + least(kRegulators) + least(kCylinders) >= best.mass_kg) break;
        if (base.Fall(base.AttributesOf(s)) > 1.0) continue;
        for (int r : order[kRegulators]) {
          s[kRegulators] = r;
          const double mass = line + base.mass_kg[kRegulators][r];
          if (mass + least(kCylinders) >= best.mass_kg) break;
          for (int c : order[kCylinders]) {
            s[kCylinders] = c;
            if (mass + base.mass_kg[kCylinders][c] >= best.mass_kg) break;
            if (!base.LinearOk(s)) continue;
            if (base.Rise(base.AttributesOf(s)) <= 1.0)
              best = {s, mass + base.mass_kg[kCylinders][c], true};
            break;  // a heavier cylinder is no faster
          }
        }
      }
    }
  return best;
}

}  // namespace plenum::bench
