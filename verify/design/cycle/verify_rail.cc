#include "verify/design/cycle/verify_rail.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/strokes/stroke.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_rig.h"

namespace plenum::verify {
namespace {

constexpr int kHalvings = 60;
constexpr int kPanels = 48;  // between two points of a pump's table

// ∫ f dP between two mirrored pressures, three Gauss points a panel.
template <typename Integrand>
double Integral(const model::CompressorCurve& curve, double low_pa, double high_pa,
                const Integrand& integrand) {
  std::vector<double> ends{low_pa, high_pa};
  for (const model::MonotoneCurve* table : {&curve.free_air_m3_per_s, &curve.current_a})
    for (const double at_pa : table->x())
      if (at_pa > low_pa && at_pa < high_pa) ends.push_back(at_pa);
  std::sort(ends.begin(), ends.end());
  const double root = std::sqrt(0.6);
  double sum = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double half = 0.5 * (ends[i] - ends[i - 1]) / kPanels;
    for (int panel = 0; panel < kPanels; ++panel) {
      const double middle = ends[i - 1] + (2 * panel + 1) * half;
      sum += half / 9.0 *
             (5.0 * integrand(middle - root * half) + 8.0 * integrand(middle) +
              5.0 * integrand(middle + root * half));
    }
  }
  return sum;
}

double AirOf(const Problem& problem, const std::vector<RailLine>& lines) {
  double air_m3 = 0.0;
  for (const RailLine& line : lines) {
    const ActuatorGroup& group = problem.groups[line.group];
    const double left = model::Content(line.chamber, line.chamber.low_pressure_pa);
    const double full = model::Content(line.chamber, line.chamber.operating_pressure_pa);
    air_m3 += group.count * group.gait.strokes_per_period *
              model::StandardVolume(full - left, problem.ambient.temperature_k);
  }
  return air_m3;
}

// Whether all falls are in time.
bool Falls(const Problem& problem, const std::vector<RailLine>& lines, double rail_pa,
           double slack) {
  return std::all_of(lines.begin(), lines.end(), [&](const RailLine& line) {
    const ActuatorGroup& group = problem.groups[line.group];
    model::Chamber chamber = line.chamber;
    chamber.exhaust_pressure_pa = rail_pa;
    const double rest_pa = chamber.low_pressure_pa, full_pa = chamber.operating_pressure_pa;
    const double fall_s = model::EmptyTime(line.exhaust, chamber, full_pa,
                                           rest_pa + problem.fall_fraction * (full_pa - rest_pa),
                                           problem.ambient.temperature_k);
    return fall_s <=
           std::min(group.fall_time_max_s, VentWindow(problem, line.group)) * (1.0 + slack);
  });
}

// The last of two pressures on the way from one that will do to one that will not.
template <typename WillDo>
double LastGood(double good_pa, double bad_pa, const WillDo& will_do) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_pa = 0.5 * (good_pa + bad_pa);
    (will_do(middle_pa) ? good_pa : bad_pa) = middle_pa;
  }
  return good_pa;
}

}  // namespace

std::vector<RailLine> RailLinesOf(const Problem& problem, const Assembly& assembly) {
  std::vector<RailLine> lines;
  const double factor = FactorOf(problem, assembly.configuration);
  for (const Unit& unit : UnitsOf(problem)) {
    const model::GroupRig rig = MakeGroup(problem, assembly, unit, 0.0, 0);
    const bool known = !lines.empty() && lines.back().group == unit.group;
    if (rig.chamber.low_pressure_pa > 0.0 && !known)
      lines.push_back({unit.group, model::MakeSeries(rig.exhaust, factor), rig.chamber});
  }
  return lines;
}

RailBorne BorneAt(const Problem& problem, const RailPumps& pumps,
                  const std::vector<RailLine>& lines, double rail_pa) {
  const double ambient_pa = problem.ambient.pressure_pa;
  const double m3_per_pa = model::StandardVolume(pumps.volume_m3, problem.ambient.temperature_k);
  const model::CompressorCurve& curve = pumps.pump->curve;
  RailBorne borne;
  borne.stop_pa = rail_pa - AirOf(problem, lines) / m3_per_pa;
  const double low_pa = 2.0 * ambient_pa - rail_pa, stop_pa = 2.0 * ambient_pa - borne.stop_pa;
  if (stop_pa > model::HighestPressure(curve)) return borne;
  const double slowest = curve.free_air_m3_per_s(
      std::clamp(stop_pa, curve.free_air_m3_per_s.front(), curve.free_air_m3_per_s.back()));
  if (!(slowest > 0.0)) return borne;
  const auto delivery = [&](double at_pa) { return model::FreeAirDelivery(curve, at_pa); };
  const double on_s = m3_per_pa / pumps.pumps * Integral(curve, low_pa, stop_pa, [&](double at_pa) {
                        return 1.0 / delivery(at_pa);
                      });
  borne.duty = on_s * problem.frequency_hz;
  borne.current_a = pumps.pumps * model::LargestCurrent(curve, ambient_pa, stop_pa);
  borne.per_cycle_j = on_s * borne.current_a * curve.voltage_v;
  borne.first_fill_j = m3_per_pa * Integral(curve, ambient_pa, stop_pa, [&](double at_pa) {
                         return model::ElectricalPower(curve, at_pa) / delivery(at_pa);
                       });
  return borne;
}

std::optional<double> WeakestRail(const Problem& problem, const RailPumps& pumps,
                                  const std::vector<RailLine>& lines, double slack) {
  double weakest_pa = problem.ambient.pressure_pa;
  for (const RailLine& line : lines)
    weakest_pa = std::min(weakest_pa, line.chamber.low_pressure_pa);
  const auto keeps = [&](double rail_pa) {
    const RailBorne borne = BorneAt(problem, pumps, lines, rail_pa);
    return borne.stop_pa >= problem.rail_floor_pa * (1.0 - kSumTolerance) &&
           borne.duty <= pumps.pump->duty_max * (1.0 + slack);
  };
  if (!keeps(weakest_pa)) return std::nullopt;
  if (Falls(problem, lines, weakest_pa, slack)) return weakest_pa;
  const double deepest_pa = LastGood(weakest_pa, problem.rail_floor_pa, keeps);
  if (!Falls(problem, lines, deepest_pa, slack)) return std::nullopt;
  return LastGood(deepest_pa, weakest_pa,
                  [&](double rail_pa) { return Falls(problem, lines, rail_pa, slack); });
}

std::optional<Assembly> OnItsRail(const Problem& problem, const Assembly& assembly, double slack) {
  Assembly on_rail = assembly;
  if (!assembly.rail.pump) return on_rail;
  const auto weakest_pa =
      WeakestRail(problem, RailPumpsOf(assembly), RailLinesOf(problem, assembly), slack);
  if (!weakest_pa) return std::nullopt;
  on_rail.rail.weakest_pa = *weakest_pa;
  return on_rail;
}

}  // namespace plenum::verify
