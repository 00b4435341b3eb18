#include "tests/support/flow/fanno.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace plenum::test {
namespace {

constexpr double kGamma = 1.4;
constexpr double kGasConstant = 287.05;
constexpr double kTemperatureK = 293.15;
constexpr double kReferenceDensity = 1e5 / (kGasConstant * kTemperatureK);
constexpr double kViscosityPaS = 1.813e-5;

// f·L/d from Mach number M to the choking point.
double FrictionLength(double mach) {
  const double m2 = mach * mach;
  return (1.0 - m2) / (kGamma * m2) +
         (kGamma + 1.0) / (2.0 * kGamma) *
             std::log((kGamma + 1.0) * m2 / (2.0 + (kGamma - 1.0) * m2));
}

// Subsonic Mach number with this friction length, by bisection.
double MachAt(double friction_length) {
  double low = 1e-6, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (FrictionLength(middle) > friction_length ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double StagnationFactor(double mach) { return 1.0 + 0.5 * (kGamma - 1.0) * mach * mach; }

// Mass flow per area and stagnation pressure.
double MassFlux(double mach) {
  return mach * std::sqrt(kGamma / (kGasConstant * kTemperatureK)) *
         std::pow(StagnationFactor(mach), -(kGamma + 1.0) / (2.0 * (kGamma - 1.0)));
}

// Static exit over stagnation inlet pressure when the inlet runs at this Mach number.
double PressureRatio(double inlet_mach, double resistance) {
  const double exit_mach = MachAt(std::max(0.0, FrictionLength(inlet_mach) - resistance));
  const auto static_over_critical = [](double mach) {
    return std::sqrt((kGamma + 1.0) / (2.0 * StagnationFactor(mach))) / mach;
  };
  return std::pow(StagnationFactor(inlet_mach), -kGamma / (kGamma - 1.0)) *
         static_over_critical(exit_mach) / static_over_critical(inlet_mach);
}

double Friction(double reynolds) {
  return reynolds < 2300.0 ? 64.0 / reynolds : 0.3164 * std::pow(reynolds, -0.25);
}

double InletMachAtFlux(double flux, double choked_mach) {
  double low = 0.0, high = choked_mach;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (MassFlux(middle) < flux ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

FannoTube SolveFanno(double inner_diameter_m, double length_m, double upstream_pa,
                     double entry_loss) {
  const double area = std::numbers::pi / 4.0 * inner_diameter_m * inner_diameter_m;
  const auto reynolds = [&](double flux) {
    return flux * upstream_pa * inner_diameter_m / kViscosityPaS;
  };
  const auto resistance = [&](double friction) {
    return entry_loss + friction * length_m / inner_diameter_m;
  };
  FannoTube tube{};
  double mach = 0.0;
  tube.friction_factor = 0.02;
  for (int i = 0; i < 100; ++i) {
    mach = MachAt(resistance(tube.friction_factor));
    tube.reynolds_number = reynolds(MassFlux(mach));
    tube.friction_factor = Friction(tube.reynolds_number);
  }
  tube.sonic_conductance_m3_per_s_pa = MassFlux(mach) * area / kReferenceDensity;
  for (const double share : {0.8, 0.6, 0.4, 0.2}) {
    const double flux = share * MassFlux(mach);
    const double ratio =
        PressureRatio(InletMachAtFlux(flux, mach), resistance(Friction(reynolds(flux))));
    const double x = std::sqrt(1.0 - share * share);
    tube.critical_ratio += (ratio - x) / (1.0 - x) / 4.0;
  }
  return tube;
}

}  // namespace plenum::test
