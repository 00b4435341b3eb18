// Measured runs of one rig, as values: what was declared, what was commanded, what was read.
//
// SI and absolute pressures inside; a missing sample is NaN. Sample times rise within a run but
// need not be evenly spaced; two samples may share an instant (overlaid repeats).
#ifndef PLENUM_CALIBRATION_VALUES_DATASET_H_
#define PLENUM_CALIBRATION_VALUES_DATASET_H_

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/simulate/simulate.h"

namespace plenum::calibration {

// The declared numbers that carry an uncertainty, named as in the contract. One factor on each
// serves all runs and both directions.
enum class Declared {
  kRestVolume,
  kExpansionRatio,
  kOperatingPressure,
  kSourcePressure,
  kSonicConductance,
  kCriticalRatio,
  kTubeInnerDiameter,
  kReservoirVolume
};
inline constexpr int kDeclaredCount = 8;
std::string_view Name(Declared number);

inline constexpr double kUnknown = std::numeric_limits<double>::infinity();

// One element of the line, in the order from the source; a tube's pairs follow from its size.
struct LinePiece {
  model::FlowElement fill, exhaust;
  struct Tube {
    double inner_diameter_m = 0.0;
    double length_m = 0.0;
  };
  std::optional<Tube> tube;
};

enum class Supply { kNone, kRegulated, kMeasured, kCompressor };

struct Channels {  // each empty, or as long as t_s
  std::vector<double> source_pressure_pa, inlet_pressure_pa, temperature_k, volume_m3;
  std::vector<double> flow_m3_per_s;  // ANR, into the line
};

struct Run {
  std::string id;
  // The rig as declared for this run.
  model::Ambient ambient;
  model::Chamber chamber;
  std::vector<LinePiece> line;
  Supply supply = Supply::kNone;
  double source_pressure_pa = 0.0;
  model::CompressorCurve compressor;
  double reservoir_volume_m3 = 0.0;
  bool blocked = false;
  std::optional<double> initial_pressure_pa, initial_temperature_k;
  std::vector<model::ValveCommand> valve;

  std::vector<double> t_s;
  std::vector<double> pressure_pa;  // reading of the gauge sensor + ambient pressure
  Channels channels;
};

// Whether the run's readings depend on that number.
bool Has(const Run& run, Declared number);

struct Dataset {
  std::string name;
  std::vector<Run> runs;
  // One standard deviation relative to the declared value: 0 exact, kUnknown free.
  std::array<double, kDeclaredCount> relative_uncertainty{};
  std::vector<std::string> holdout;  // ids of runs that no fit may see
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_DATASET_H_
