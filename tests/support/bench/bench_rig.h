// Rigs and runs as an experimenter would have them on a bench, drawn from a seed, for data sets
// whose truth is known. Nothing of model/ or calibration/ is used: tubes, volumes and flows follow
// the contract by code of their own, and pressures come from effect_form.h.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_RIG_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_RIG_H_

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/effects/effect_form.h"
#include "tests/support/random.h"

namespace plenum::test {

// The declared numbers that may be uncertain, by the contract's names, and one value for each:
// a factor on the declared number, or a standard deviation relative to it.
inline constexpr std::array<std::string_view, 8> kNumberNames = {
    "rest_volume",       "expansion_ratio", "operating_pressure",  "source_pressure",
    "sonic_conductance", "critical_ratio",  "tube_inner_diameter", "reservoir_volume"};
enum Number {
  kRestVolume,
  kExpansionRatio,
  kOperatingPressure,
  kSourcePressure,
  kSonicConductance,
  kCriticalRatio,
  kTubeInnerDiameter,
  kReservoirVolume
};
using Numbers = std::array<double, kNumberNames.size()>;
inline constexpr Numbers kAsDeclared = {1, 1, 1, 1, 1, 1, 1, 1};

enum class BenchSupply { kNone, kRegulated, kMeasured, kCompressor };

struct BenchRig {
  double rest_volume_m3 = 0.0;
  double expansion_ratio = 1.0;
  double operating_gauge_pa = 0.0;
  MassElement fill, exhaust;  // at the source's end of the tube
  bool one_pair = false;      // both ways the same
  std::optional<LineDynamics> tube;
  BenchSupply supply = BenchSupply::kRegulated;
  std::vector<std::pair<double, double>> delivery;  // absolute Pa, m³/s ANR
  double reservoir_m3 = 0.0;
  double ambient_pa = 1e5;
  double ambient_k = 293.15;
};

struct BenchRun {
  std::string id;
  bool blocked = false;
  double source_gauge_pa = 0.0;  // of a reservoir: at the start
  double initial_gauge_pa = 0.0;
  std::vector<MassCommand> schedule;
  std::function<double(double)> source_course;  // absolute, of a measured supply
  double end_s = 0.0;
  std::vector<double> t_s;  // of the samples
};

// C = 0.029·d²/√(L/d^1.25 + 510), b = 474·C/d² within [0, 0.528].
MassElement TubeAsElement(const LineDynamics& tube);

// The rig of one run with the true numbers `factors` times the declared ones; source and operating
// pressure are gauge numbers. The bore of the tube is dead volume.
EffectRig Plant(const BenchRig& declared, const BenchRun& run, const Numbers& factors);

// Time scales of the base model from one source: from ambient to the operating pressure (or to
// 97 % of what is reached), and back to 5 %.
struct StrokeTimes {
  double rise_s = 0.0, fall_s = 0.0;
};
StrokeTimes TimesOf(const BenchRig& rig, bool blocked, double source_gauge_pa);

// 10 to 200 mL, ε 1.2 to 2.5, 40 to 200 kPa, a rise in 0.15 to 1.5 s.
BenchRig DrawRig(BenchSupply supply, Random& random);

// Four to seven runs and one to hold out, which comes last and has a source pressure (without a
// source: an initial pressure) of its own: steps with long holds, cycles, stairs; two to four
// source pressures; mostly with blocked runs. Samples of 50 to 1000 Hz, at most 30,000, some
// uneven.
std::vector<BenchRun> DrawRuns(const BenchRig& rig, Random& random);

// The same with five runs and one to hold out, of 1,000 even samples each.
std::vector<BenchRun> DrawFiveRuns(const BenchRig& rig, Random& random);

// What a hasty experimenter records: one or two runs that are all alike and one to hold out that
// repeats them, from one source (initial) pressure, free or blocked, with one way to move the
// valve: a rise alone, with a hold, with a fall, or all of these; without a source closed, emptying
// or both. 40 to 600 samples a run. Effects that act alike there cannot be told apart.
std::vector<BenchRun> DrawNarrowRuns(const BenchRig& rig, Random& random);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_RIG_H_
