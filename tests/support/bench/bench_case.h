// Measured data sets whose truth is known: a rig whose declared numbers are somewhat wrong, an
// effect or none, and readings with the faults of a real record. Every case follows from its seed
// alone.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_CASE_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_CASE_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/bench/bench_effects.h"
#include "tests/support/bench/bench_rig.h"

namespace plenum::test {

// kFull: one listed effect, clearly visible: the residual that it leaves after the base model is
// re-fitted within its uncertainties has an RMS of 4 to 16 times the noise (over the fitted runs,
// without noise). kFifth: such an effect at a fifth of that size (Sized()). kPair: two listed
// effects, each at a third to the whole of it. kOutside: one effect that is not listed, as large as
// kFull. kTie: one listed effect, 1 to 6 times the noise, in runs that show little
// (DrawNarrowRuns); whether another effect does as well there is not known beforehand.
// kReal: real_case.h.
enum class CaseKind { kClean, kFull, kFifth, kPair, kOutside, kTie, kReal };
std::string_view NameOf(CaseKind kind);
inline constexpr double kVisibleLow = 4.0, kVisibleHigh = 16.0;  // times the noise

struct Sensor {
  double noise_pa = 0.0;          // standard deviation
  double correlated_share = 0.0;  // of the noise's variance that is a first-order process
  double correlation = 0.0;       // of that from sample to sample
  double quantum_pa = 0.0;        // 0: none
  double clip_low_pa = -1e9, clip_high_pa = 1e9;  // gauge
  double missing_share = 0.0;
  int outliers = 0;              // of 15 to 60 standard deviations, in the whole case
  double zero_drift_pa = 0.0;    // standard deviation of its zero from run to run
  double clock_share = 0.0;      // each run's clock is off by up to this share of a sample
  double source_noise_pa = 0.0;  // of the source channel
  // Standard deviation about what a perfect sensor shows, without outliers and clipped readings.
  double NoiseFloor() const;
  // Noise that remembers says less than white noise of its size: as much as white noise of its
  // spectral density at low frequencies.
  double EffectiveNoise() const;
};

struct Record {
  std::vector<double> t_s;               // as recorded
  std::vector<double> clean_gauge_pa;    // what the sensor would show without its noise
  std::vector<double> reading_gauge_pa;  // NaN: missing
  std::vector<double> source_gauge_pa;   // of a measured supply, else empty
};

struct BenchCase {
  std::uint64_t seed = 0;
  CaseKind kind = CaseKind::kClean;
  BenchRig declared;
  Numbers uncertainty{};  // relative standard deviations; infinity: unknown
  Numbers factors = kAsDeclared;
  std::optional<std::size_t> wrong;  // of kReal: a number far beyond its uncertainty
  bool initial_declared = true;
  std::vector<BenchRun> runs;    // the last is held out
  bool holdout_recorded = true;  // else it is no part of the measurement
  std::vector<TrueEffect> effects;
  Sensor sensor;
  double visible = 0.0;  // RMS after the re-fitted base model over that of the noise, without noise
  std::vector<Record> records;  // of the runs
};

// Draws until the effect is visible as its kind asks for. `effect` names it; for a pair and for a
// clean case it is not used. `supply_free`: any supply on which the effect shows.
// With `five`, of runs as DrawFiveRuns draws them.
BenchCase DrawCase(std::uint64_t seed, CaseKind kind, const std::string& effect = {},
                   bool five = false);

// The `index`-th case of a series: the kinds in turn, in each kind the effects in turn.
CaseKind KindOfSeries(int index);
BenchCase CaseOfSeries(std::uint64_t series, int index, bool five = false);

// The same of kTie, which is none of these kinds: the effects in turn.
BenchCase TieOfSeries(std::uint64_t series, int index);

// The true rig in a run, without the drift of a sensor, at these times.
EffectResult TrueCourse(const BenchCase& bench, const BenchRun& run, int number,
                        const Numbers& factors, const std::vector<TrueEffect>& effects,
                        const std::vector<double>& t_s);

// What its pressure sensor would show: without noise, gauge, at the run's sample times.
std::vector<double> TrueReadings(const BenchCase& bench, const BenchRun& run, int number,
                                 const Numbers& factors, const std::vector<TrueEffect>& effects);

// The same with a perfect sensor: clean readings at their true times.
BenchCase WithoutFaults(BenchCase bench);

// A run recorded with the case's sensor; `number` counts the runs of the session.
Record Observe(const BenchCase& bench, const BenchRun& run, int number);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_CASE_H_
