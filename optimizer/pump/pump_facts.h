// What pumps take and deliver by pressure, as tables for the bounds of pump_bounds.h.
#ifndef PLENUM_OPTIMIZER_PUMP_PUMP_FACTS_H_
#define PLENUM_OPTIMIZER_PUMP_PUMP_FACTS_H_

#include <algorithm>
#include <array>
#include <vector>

#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

// An even division of [low, high]; the end cells go on outside.
class EvenCells {
 public:
  EvenCells() = default;
  EvenCells(double low_pa, double high_pa, std::size_t count)
      : low_pa_(low_pa),
        cells_per_pa_(static_cast<double>(count) / (high_pa - low_pa)),
        pa_per_cell_(1.0 / cells_per_pa_),
        last_(static_cast<double>(count - 1)) {}
  std::size_t Cell(double pressure_pa) const {
    const double position = (pressure_pa - low_pa_) * cells_per_pa_;
    if (!(position > 0.0)) return 0;
    return static_cast<std::size_t>(static_cast<int>(std::min(position, last_)));
  }
  double Beyond(double pressure_pa, std::size_t cell) const {  // where the cell begins
    return pressure_pa - low_pa_ - static_cast<double>(cell) * pa_per_cell_;
  }
  double width_pa() const { return pa_per_cell_; }

 private:
  double low_pa_ = 0.0, cells_per_pa_ = 0.0, pa_per_cell_ = 0.0, last_ = 0.0;
};

// What pumps take by pressures, as tables over an even division: step functions that nowhere exceed
// the true ones and do not fall.
struct PumpTables {
  std::vector<double> energy_j_per_m3;  // P/Q
  std::vector<double> seconds_per_m3;   // 1/Q
  std::vector<double> current_a;        // largest on the way to a pressure
};
struct PerAir {  // m³ ANR
  double seconds = 0.0, energy_j = 0.0;
};
class PumpRates {
 public:
  PumpRates() = default;
  PumpRates(double low_pa, double high_pa, PumpTables tables);
  PerAir At(double pressure_pa) const { return sums_[cells_.Cell(pressure_pa)].value; }
  std::size_t Cell(double pressure_pa) const { return cells_.Cell(pressure_pa); }
  double CurrentAt(double pressure_pa) const { return current_a_[cells_.Cell(pressure_pa)]; }
  double Delivery(double pressure_pa) const { return PaceAt(pressure_pa).delivery_m3_per_s; }
  struct Pace {
    double seconds_per_m3, delivery_m3_per_s;
  };
  const Pace& PaceAt(double pressure_pa) const { return paces_[cells_.Cell(pressure_pa)]; }
  // No less than the true time, which does not fall with pressure.
  double SecondsAtMost(double pressure_pa) const {
    const std::size_t cell = cells_.Cell(pressure_pa);
    return cell + 1 < sums_.size() ? sums_[cell + 1].value.seconds : kUnlimited;
  }
  // From the lowest pressure on.
  PerAir Integral(double pressure_pa) const {
    const std::size_t cell = cells_.Cell(pressure_pa);
    const Sums& sums = sums_[cell];
    const double beyond_pa = cells_.Beyond(pressure_pa, cell);
    return {sums.integral.seconds + sums.value.seconds * beyond_pa,
            sums.integral.energy_j + sums.value.energy_j * beyond_pa};
  }
  // Over the pressures in between; where they are next to each other, at the lower one. Also from
  // the integrals up to both.
  PerAir Mean(double low_pa, double high_pa) const {
    return Mean(low_pa, Integral(low_pa), high_pa, Integral(high_pa));
  }
  PerAir Mean(double low_pa, const PerAir& low, double high_pa, const PerAir& high) const {
    constexpr double kNarrow = 1e-6;  // where the difference of integrals would lose digits
    if (!(high_pa - low_pa > kNarrow * high_pa)) return At(low_pa);
    return {(high.seconds - low.seconds) / (high_pa - low_pa),
            (high.energy_j - low.energy_j) / (high_pa - low_pa)};
  }

 private:
  struct Sums {
    PerAir value, integral;  // in the cell, up to it
  };
  EvenCells cells_;
  std::vector<Sums> sums_;
  std::vector<Pace> paces_;
  std::vector<double> current_a_;
};

// Pumps that hold on take a power P_h while they hold, and P while they fill: for the air that
// flows while the pressure in front of the lines is p, (P(p) − P_h)/Q(p) beyond P_h all the time.
// As a step function over the cells of the tables that does not fall and nowhere exceeds that; −∞
// where the pumps may stand at their highest pressure and take less there than while they hold.
struct HoldingPump {
  double power_w = 0.0;
  std::vector<double> beyond_j_per_m3;
};

// What the bounds need of the pumps of a choice, all that run in parallel together. From a single
// choice, or from the coarse tables of many: then each number holds for the best of them.
struct PumpFacts {
  PumpRates rates;
  bool exact = false;                     // of a single choice
  std::vector<HoldingPump> holding = {};  // actuators of each group; empty: pumps do not hold on
};
inline constexpr int kPumpTableCells = 2048;  // of pressure
PumpFacts MakePumpFacts(const Problem& problem, const model::CompressorCurve& curve, int pumps,
                        int cells = kPumpTableCells);

// The same tables over an even division of the pressures from ambient to the highest that any
// compressor of the problem may reach, small enough to be kept for every box.
inline constexpr int kCoarseCells = 32;
struct CoarsePump {
  std::array<double, kCoarseCells> energy_j_per_m3{}, seconds_per_m3{}, current_a{};
  std::vector<HoldingPump> holding = {};
};
double HighestPumpPressure(const Problem& problem, Configuration configuration);
CoarsePump MakeCoarsePump(const Problem& problem, double highest_pa,
                          const model::CompressorCurve& curve);
CoarsePump Several(CoarsePump one, int pumps);
PumpFacts MakePumpFacts(const Problem& problem, double highest_pa, const CoarsePump& coarse);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_PUMP_FACTS_H_
