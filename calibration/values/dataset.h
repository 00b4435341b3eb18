// Measured runs of one rig, as values: what was declared, what was commanded, what was read.
//
// SI and absolute pressures inside; a missing sample is NaN. Sample times rise within a run but
// need not be evenly spaced; two samples may share an instant (overlaid repeats).
#ifndef PLENUM_CALIBRATION_VALUES_DATASET_H_
#define PLENUM_CALIBRATION_VALUES_DATASET_H_

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration/values/line_piece.h"
#include "calibration/values/several.h"
#include "model/simulate/simulate.h"

namespace plenum::calibration {

// The declared numbers that carry an uncertainty, named as in the contract. One factor on each
// serves all runs and both directions; where runs are of several specimens, one of the actuator's
// own numbers serves those of one specimen.
enum class Declared {
  kRestVolume,
  kExpansionRatio,
  kOperatingPressure,
  kSourcePressure,
  kSonicConductance,
  kCriticalRatio,
  kTubeInnerDiameter,
  kReservoirVolume,
  kAmbientPressure,  // under which gauges and valves work; where it is wrong, all pressures are
  // Of the gauge, where its accuracy is stated (Sensor): the readings are
  //   gain·p + (zero − 1)·kSensorZeroPa,  p the gauge pressure.
  kSensorZero,
  kSensorGain
};
inline constexpr int kDeclaredCount = 11;
inline constexpr int kOfTheRig = 9;  // the first ones, of which documents state the uncertainty
// The first ones are the actuator's own: pieces of one kind differ in them. The operating pressure
// is not one: it is where the volume's law is stated, and beside the expansion ratio it is no
// second number of a piece, as the two are one slope of the volume.
inline constexpr int kOfActuator = 2;
inline constexpr double kSensorZeroPa = 1e5;
std::string_view Name(Declared number);

inline constexpr double kUnknown = std::numeric_limits<double>::infinity();

// kFlow: a flow controller, as a compressor that delivers the same at any pressure, without a
// reservoir.
enum class Supply { kNone, kRegulated, kMeasured, kCompressor, kFlow };

// What is known of the gauge in the chamber. Pressures absolute.
struct Sensor {
  // Readings at an end are cut off there; infinite where an end is not known.
  double low_pa = -std::numeric_limits<double>::infinity();
  double high_pa = std::numeric_limits<double>::infinity();
  double resolution_pa = 0.0;  // steps of the readings
  double accuracy_pa = 0.0;    // one standard deviation of its zero; 0: the zero is right
  bool HasRange() const { return low_pa < high_pa && std::isfinite(high_pa - low_pa); }
};

struct Channels {  // each empty, or as long as t_s
  std::vector<double> source_pressure_pa, inlet_pressure_pa, temperature_k, volume_m3;
  std::vector<double> flow_m3_per_s;  // ANR, into the line
  // These drive the model and are not compared with it: how far the valve is open, 0 to 1, on the
  // way that the commands open; what a regulator is told.
  std::vector<double> valve_opening, source_setpoint_pa;
};

// Whether any but the source's pressure is recorded.
bool RecordsMore(const Channels& channels);

// A number of a part of the catalogue that runs are to measure: fitted freely, whatever is
// declared. A pump's delivery is measured at the points of its table, as what it falls by from each
// point to the next and what is left at the last: none below 0 makes a curve that does not rise.
struct MeasuredNumber {
  enum class Kind { kConductance, kRatio, kVolume, kDelivery };
  std::string part;  // id
  std::string name;  // as in the contract: "sonic_conductance_fill"
  Kind kind = Kind::kConductance;
  double declared = 0.0;     // SI
  double pressure_pa = 0.0;  // kDelivery: of the point, absolute
};

// Where a measured number stands in the rig of a run. A number that both directions share has two
// places.
struct MeasuredPlace {
  enum class Of { kFillConductance, kFillRatio, kExhaustConductance, kExhaustRatio, kVolume };
  std::size_t number = 0;  // of Dataset::measured
  Of of = Of::kVolume;
  std::size_t piece = 0;  // of the line
};

struct MeasuredPlaces {
  std::vector<MeasuredPlace> places;
  std::vector<std::size_t> delivery;  // by point of the compressor's curve, or none
};

// What is stated of the record itself.
struct Recorded {
  Sensor sensor;
  // By command one standard deviation of its instant, 0: exact, kUnknown: not known, and the
  // instant that stands there is a guess. Empty: all are exact.
  std::vector<double> valve_uncertainty_s;
  // The volume channel drives the model, whatever the pressure: the run is `blocked`, too. It is
  // taken as exact: a factor on it and one on all conductances are the same to the pressure.
  bool volume_imposed = false;
  // The piece of the actuator on the bench, by Dataset::specimens; of several chambers the one with
  // the gauge.
  std::size_t specimen = 0;
};

struct Run : Recorded {
  std::string id;
  // The rig as declared for this run.
  model::Ambient ambient;
  model::Chamber chamber;  // of several the one with the gauge
  Several several;
  std::vector<LinePiece> line;
  model::Gas gas = model::Gas::kAir;
  Supply supply = Supply::kNone;
  double source_pressure_pa = 0.0;
  double exhaust_pressure_pa = 0.0;  // what the line opens into to deflate; 0: the ambient's
  model::CompressorCurve compressor;
  double reservoir_volume_m3 = 0.0;
  bool blocked = false;
  std::optional<double> initial_pressure_pa, initial_temperature_k;
  std::vector<model::ValveCommand> valve;
  MeasuredPlaces measured;

  std::vector<double> t_s;
  std::vector<double> pressure_pa;  // reading of the gauge sensor + ambient pressure
  Channels channels;
};

// Whether the run's readings depend on that number, beside those that it measures.
bool Has(const Run& run, Declared number);
// The same of one of the actuator's own numbers, of one of several chambers.
bool Has(const Run& run, Declared number, std::size_t piece);

// The chamber of a specimen that the run is of: of several that one.
const model::Chamber& ChamberOf(const Run& run, std::size_t specimen);

// Whether the source is a regulator whose recorded setpoint drives it.
bool FollowsSetpoint(const Run& run);

// The time at which a run begins: the first sample or the first command, whichever is earlier.
double StartOf(const Run& run);

// Of a command's instant; 0 where none is stated.
double InstantUncertainty(const Run& run, std::size_t command);
// Whether its error may be that of all commands to the same state: it is known to an uncertainty.
bool SharesInstant(const Run& run, std::size_t command);

// Mean of the readings before the valve first opens, at most ten; the first one if it is open from
// the start, or if the volume is imposed. Absolute.
double FirstReading(const Run& run);

struct Dataset {
  std::string name;
  std::vector<Run> runs;
  // One standard deviation relative to the declared value: 0 exact, kUnknown free.
  std::array<double, kDeclaredCount> relative_uncertainty{};
  std::vector<std::string> holdout;  // ids of runs that no fit may see
  // Names of the pieces of the actuator; empty of the common piece of runs that name none. None
  // where no run names one. With several chambers theirs: each run has all of them.
  std::vector<std::string> specimens;
  bool several = false;
  std::vector<MeasuredNumber> measured;
  bool as_written = false;  // the record is as it was meant, though it looks like a slip of the pen
};

// The lowest absolute pressure that anything in the run as declared has.
double LowestPressure(const Run& run);

// The expansion ratios of which the run's volume makes sense: at least 1; of an actuator that
// shrinks at most 1, and no less than what leaves kLeastVolume of the rest volume at the lowest
// pressure.
inline constexpr double kLeastVolume = 0.01;
std::pair<double, double> ExpansionRange(const Run& run, const model::Chamber& chamber);

// How many recordings the runs are: several gauges of one recording count once.
std::size_t RecordingsOf(const Dataset& dataset, const std::vector<std::size_t>& runs);

// The factors on a declared number with which all runs' rigs make sense: ε in ExpansionRange, b not
// above kCriticalRatioMax, no source below an absolute 0, an ambient pressure that there is on
// land. Other numbers: any.
inline constexpr double kCriticalRatioMax = 0.95;
std::pair<double, double> FactorRange(const Dataset& dataset, Declared number);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_DATASET_H_
