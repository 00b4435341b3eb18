#include "catalog/fields/laws/pump_law.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "catalog/fields/laws/laws.h"

namespace plenum::catalog {
namespace {

constexpr double kAmbientKpa = 100.0;  // a sheet's free air is counted there
constexpr double kSecondsPerMinute = 60.0;
constexpr int kSteps = 10;

// As the program of catalog/estimates writes them.
double Rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

// Isothermal power in W of a flow from ambient to the pressure, or from it to ambient.
double Work(double pressure_kpa, double flow_l_per_min) {
  const double ratio = (kAmbientKpa + pressure_kpa) / kAmbientKpa;
  if (!(flow_l_per_min > 0) || !(ratio > 0)) return 0.0;
  return kAmbientKpa * flow_l_per_min / kSecondsPerMinute * std::abs(std::log(ratio));
}

// Share of the free flow that a measured piston pump gives at a share of its highest pressure.
double PistonShare(double x) {
  const std::vector<LawPower>& shape = PumpCoefficient("piston_shape").powers;
  for (std::size_t i = 0; i + 1 < shape.size(); ++i) {
    const double x1 = std::atof(shape[i].of.c_str()), x2 = std::atof(shape[i + 1].of.c_str());
    const double y1 = shape[i].exponent, y2 = shape[i + 1].exponent;
    if (x1 <= x && x <= x2) return y1 + (y2 - y1) * (x - x1) / (x2 - x1);
  }
  return shape.back().exponent;
}

struct Flows {
  std::vector<double> pressures, flows;  // from free flow on
  bool is_cut = false;
};

Flows FlowsOf(const PumpSheet& sheet, double power_high_w) {
  const double efficiency = PumpCoefficient("efficiency").factor;
  Flows along;
  double last = HUGE_VAL;
  for (int i = 0; i <= kSteps; ++i) {
    const double pressure = sheet.far_kpa_gauge * i / kSteps;
    const double share = pressure / sheet.far_kpa_gauge;
    double flow = sheet.free_flow_l_per_min *
                  (sheet.is_piston ? PistonShare(share) : std::max(0.0, 1 - share));
    if (i > 0) {
      const double unit_work = Work(pressure, 1.0);
      const double most = unit_work > 0 ? efficiency * power_high_w / unit_work : HUGE_VAL;
      along.is_cut |= most < flow;
      flow = std::min({flow, most, last});
    }
    last = flow;
    along.pressures.push_back(pressure);
    along.flows.push_back(flow);
  }
  return along;
}

double Together(double a, double b) { return std::sqrt(a * a + b * b); }

}  // namespace

PumpEstimate EstimatePump(const PumpSheet& sheet) {
  const FieldLaw& power_law = PumpCoefficient("power_max_w");
  double high = 0, of_power = 0;
  if (sheet.power_max_w) {
    high = *sheet.power_max_w;
  } else {
    high =
        power_law.factor * std::pow(sheet.free_flow_l_per_min, power_law.powers.front().exponent);
    of_power = power_law.uncertainty.value_or(0.0);
  }
  const double low = sheet.power_min_w.value_or(high / 2);
  const Flows along = FlowsOf(sheet, high);
  double hardest = 0;
  for (std::size_t i = 0; i < along.flows.size(); ++i)
    hardest = std::max(hardest, Work(along.pressures[i], along.flows[i]));
  PumpEstimate estimate;
  double power = low;
  for (std::size_t i = 0; i < along.flows.size(); ++i) {
    const double share = hardest > 0 ? Work(along.pressures[i], along.flows[i]) / hardest : 0.0;
    power = std::max(power, low + (high - low) * share);
    estimate.points.push_back({Rounded(along.pressures[i], 6), Rounded(along.flows[i], 5),
                               Rounded(power / sheet.voltage_v, 5)});
  }
  if (sheet.far_kpa_gauge < 0) std::reverse(estimate.points.begin(), estimate.points.end());
  const double line = PumpCoefficient("line").uncertainty.value_or(0.0);
  const double spread = PumpCoefficient("efficiency").uncertainty.value_or(0.0);
  estimate.free_air_uncertainty = Rounded(std::max(line, along.is_cut ? spread : 0.0), 2);
  // Anywhere between the two ends of the power, as likely here as there.
  const double range_of_power = (high - low) / (high + low) / std::sqrt(3.0);
  estimate.current_uncertainty = Rounded(Together(of_power, range_of_power), 2);
  return estimate;
}

}  // namespace plenum::catalog
