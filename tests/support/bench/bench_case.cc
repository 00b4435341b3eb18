#include "tests/support/bench/bench_case.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "tests/support/bench/bench_draws.h"
#include "tests/support/bench/bench_refit.h"

namespace plenum::test {
namespace {

constexpr int kAttempts = 60;
constexpr int kKinds = 5;
constexpr double kSizeLow = 0.1, kSizeHigh = 4.0;  // of the typical size; outside: drawn anew
constexpr double kTieLow = 1.0, kTieHigh = 6.0;    // as kVisibleLow, kVisibleHigh
constexpr std::uint64_t kRunStream = 1000, kFaultStream = 500, kTieStream = 2000;
constexpr std::uint64_t kDriftStream = 3000;

BenchSupply DrawSupply(Random& random) {
  const double x = random.Uniform(0.0, 1.0);
  if (x < 0.55) return BenchSupply::kRegulated;
  if (x < 0.70) return BenchSupply::kMeasured;
  return x < 0.85 ? BenchSupply::kCompressor : BenchSupply::kNone;
}

}  // namespace

Numbers DrawUncertainty(const BenchRig& rig, Random& random) {
  Numbers sd{};
  sd[kRestVolume] = random.Uniform(0.005, 0.03);
  sd[kExpansionRatio] = random.Uniform(0.003, 0.015);
  if (random.Coin(0.3)) sd[kOperatingPressure] = random.Uniform(0.002, 0.01);
  sd[kSonicConductance] = random.Uniform(0.01, 0.05);
  sd[kCriticalRatio] = random.Uniform(0.02, 0.1);
  if (random.Coin(0.08)) sd[kSonicConductance] = std::numeric_limits<double>::infinity();
  const bool known_level =
      rig.supply == BenchSupply::kRegulated || rig.supply == BenchSupply::kCompressor;
  if (known_level && random.Coin()) sd[kSourcePressure] = random.Uniform(0.001, 0.005);
  if (rig.tube) sd[kTubeInnerDiameter] = random.Uniform(0.01, 0.03);
  if (rig.supply == BenchSupply::kCompressor) sd[kReservoirVolume] = random.Uniform(0.01, 0.03);
  for (double& u : sd) u = std::isinf(u) ? u : std::round(u * 1e4) * 1e-4;
  return sd;
}

namespace {}  // namespace

Numbers DrawFactors(const Numbers& sd, Random& random) {
  Numbers factors = kAsDeclared;
  for (std::size_t n = 0; n < sd.size(); ++n) {
    const double z = random.Normal();
    factors[n] = std::isinf(sd[n]) ? random.LogUniform(0.8, 1.25) : 1.0 + sd[n] * z;
  }
  return factors;
}

namespace {

Sensor DrawSensor(const BenchRig& rig, Random& random) {
  Sensor sensor;
  const double full_pa = rig.operating_gauge_pa;
  sensor.noise_pa = full_pa * random.LogUniform(5e-4, 4e-3);
  if (random.Coin(0.2)) {
    sensor.correlated_share = random.Uniform(0.2, 0.6);
    sensor.correlation = random.Uniform(0.3, 0.8);
  }
  if (random.Coin(0.6)) {
    const double bits = random.Pick<double>({10, 12, 12, 16});
    sensor.quantum_pa = 2.5 * full_pa / std::pow(2.0, bits);
  }
  if (random.Coin(0.06)) sensor.clip_low_pa = 0.0;
  if (random.Coin(0.08)) sensor.clip_high_pa = full_pa * random.Uniform(0.92, 1.0);
  if (random.Coin(0.2)) sensor.missing_share = random.Uniform(0.005, 0.03);
  if (random.Coin(0.08)) sensor.outliers = random.Integer(1, 4);
  if (random.Coin(0.3)) sensor.clock_share = 0.3;
  sensor.source_noise_pa = 0.3 * sensor.noise_pa;
  return sensor;
}

double StepOf(const std::vector<TrueEffect>& effects) {
  double step_s = 2e-3;
  for (const TrueEffect& e : effects) {
    if (e.id == "line_dynamics") step_s = std::min(step_s, 2e-4);
    if (e.id == "sensor_lag") step_s = std::min(step_s, 0.3 * e["time_constant_s"]);
    if (e.id == "heat_transfer") step_s = std::min(step_s, 0.1 * e["time_constant_s"]);
    if (e.id == "inertia") step_s = std::min(step_s, 0.05 / e["natural_frequency_rad_per_s"]);
    if (e.id == "snap_through" || e.id == "second_chamber") step_s = std::min(step_s, 5e-4);
  }
  return step_s;
}

Readings AllReadings(const BenchCase& bench, const std::vector<TrueEffect>& effects) {
  Readings readings;
  for (std::size_t r = 0; r < bench.runs.size(); ++r) {
    readings.push_back(
        TrueReadings(bench, bench.runs[r], static_cast<int>(r), bench.factors, effects));
  }
  return readings;
}

// How visible effects are, and how large one has to be.
class Scale {
 public:
  explicit Scale(const BenchCase& bench)
      : bench_(bench), fitter_(bench.declared, bench.runs, bench.uncertainty, bench.factors) {}

  double Visible(const std::vector<TrueEffect>& effects) const {
    const double floor_pa = bench_.sensor.NoiseFloor();
    return fitter_.Fit(AllReadings(bench_, effects), floor_pa).rms_pa / floor_pa;
  }

  // Makes the effect as visible as that; false if that is not a size to be met.
  bool MakeVisible(double low, double high, TrueEffect& effect, Random& random) const {
    const double target = random.LogUniform(low, high);
    const TrueEffect typical = effect;
    double size = 1.0;
    for (int k = 0; k < 4; ++k) {
      effect = Sized(typical, size);
      if (size < kSizeLow || size > kSizeHigh || !Possible(effect, bench_.declared)) return false;
      const double visible = Visible({effect});
      if (visible > low && visible < high) return true;
      size *= target / visible;
    }
    return false;
  }

 private:
  const BenchCase& bench_;
  BaseFitter fitter_;
};

std::vector<std::string> IdsOf(CaseKind kind, const std::string& effect, Random& random) {
  if (kind == CaseKind::kClean) return {};
  if (kind != CaseKind::kPair) return {effect};
  const std::string first = random.Pick(ListedEffects());
  std::string second = first;
  while (second == first) second = random.Pick(ListedEffects());
  return {first, second};
}

}  // namespace

bool DrawEffects(BenchCase& bench, const std::vector<std::string>& ids, Random& random) {
  if (ids.empty()) return true;
  const Scale scale(bench);
  const bool tie = bench.kind == CaseKind::kTie;
  const double low = tie ? kTieLow : kVisibleLow, high = tie ? kTieHigh : kVisibleHigh;
  const double rise_s = bench.declared.supply == BenchSupply::kNone
                            ? TimesOf(bench.declared, false, 0.0).fall_s
                            : TimesOf(bench.declared, false, bench.runs[0].source_gauge_pa).rise_s;
  for (const std::string& id : ids) {
    TrueEffect effect = DrawEffect(id, bench.declared, rise_s, random);
    if (!scale.MakeVisible(low, high, effect, random)) return false;
    if (bench.kind == CaseKind::kFifth) effect = Sized(effect, 0.2);
    if (bench.kind == CaseKind::kPair) effect = Sized(effect, random.Uniform(1.0 / 3.0, 1.0));
    bench.effects.push_back(effect);
  }
  bench.visible = scale.Visible(bench.effects);
  return true;
}

namespace {

void AddNoise(const Sensor& sensor, Random& random, std::vector<double>& readings) {
  const double white = std::sqrt(1.0 - sensor.correlated_share) * sensor.noise_pa;
  const double slow = std::sqrt(sensor.correlated_share) * sensor.noise_pa;
  const double fresh = std::sqrt(1.0 - sensor.correlation * sensor.correlation);
  double process = random.Normal();
  for (double& p : readings) {
    p += white * random.Normal() + slow * process;
    process = sensor.correlation * process + fresh * random.Normal();
  }
}

// Of the case's outliers those that fall into this run.
void AddOutliers(const BenchCase& bench, int number, std::vector<double>& readings) {
  Random random(bench.seed, kFaultStream);
  for (int k = 0; k < bench.sensor.outliers; ++k) {
    const int run = random.Integer(0, static_cast<int>(bench.runs.size()) - 1);
    const double share = random.Uniform(0.0, 1.0);
    const double size = random.Sign() * random.Uniform(15.0, 60.0) * bench.sensor.noise_pa;
    if (run != number) continue;
    readings[static_cast<std::size_t>(share * static_cast<double>(readings.size() - 1))] += size;
  }
}

void LoseSome(double share, Random& random, std::vector<double>& readings) {
  if (share == 0.0) return;
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  for (double& p : readings) {
    if (random.Coin(share)) p = kMissing;
  }
  const auto gap = static_cast<std::size_t>(share * static_cast<double>(readings.size()));
  const auto start =
      static_cast<std::size_t>(random.Uniform(0.0, static_cast<double>(readings.size() - gap)));
  std::fill_n(readings.begin() + static_cast<std::ptrdiff_t>(start), gap, kMissing);
}

}  // namespace

std::string_view NameOf(CaseKind kind) {
  static constexpr std::array<std::string_view, 7> kNames = {"clean",   "full", "fifth", "pair",
                                                             "outside", "tie",  "real"};
  return kNames[static_cast<std::size_t>(kind)];
}

double Sensor::NoiseFloor() const {
  return std::sqrt(noise_pa * noise_pa + quantum_pa * quantum_pa / 12.0);
}

double Sensor::EffectiveNoise() const {
  const double grown = (1.0 + correlation) / (1.0 - correlation);
  return NoiseFloor() * std::sqrt(1.0 - correlated_share + correlated_share * grown);
}

EffectResult TrueCourse(const BenchCase& bench, const BenchRun& run, int number,
                        const Numbers& factors, const std::vector<TrueEffect>& effects,
                        const std::vector<double>& t_s) {
  EffectRig plant = Plant(bench.declared, run, factors);
  for (const TrueEffect& effect : effects) {
    Apply(effect, bench.declared, bench.seed * 64 + static_cast<std::uint64_t>(number), plant);
  }
  return SimulateEffects(plant, t_s, StepOf(effects));
}

std::vector<double> TrueReadings(const BenchCase& bench, const BenchRun& run, int number,
                                 const Numbers& factors, const std::vector<TrueEffect>& effects) {
  std::vector<double> readings =
      TrueCourse(bench, run, number, factors, effects, run.t_s).measured_pa;
  double session_s = 0.0;
  for (std::size_t r = 0; r < bench.runs.size() && static_cast<int>(r) < number; ++r) {
    session_s += bench.runs[r].end_s;
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i] -= bench.declared.ambient_pa;
    for (const TrueEffect& effect : effects) readings[i] += Drift(effect, session_s + run.t_s[i]);
  }
  return readings;
}

Record Observe(const BenchCase& bench, const BenchRun& run, int number) {
  const Sensor& sensor = bench.sensor;
  Random random(bench.seed, kRunStream + static_cast<std::uint64_t>(number));
  Record record;
  const double interval_s =
      (run.t_s.back() - run.t_s.front()) / static_cast<double>(run.t_s.size() - 1);
  const double late_s = sensor.clock_share * interval_s * random.Uniform(-1.0, 1.0);
  for (const double t_s : run.t_s) record.t_s.push_back(std::round((t_s + late_s) * 1e6) * 1e-6);
  record.clean_gauge_pa = TrueReadings(bench, run, number, bench.factors, bench.effects);
  if (run.source_course) {
    for (const double t_s : run.t_s) {
      record.source_gauge_pa.push_back(run.source_course(t_s) - bench.declared.ambient_pa +
                                       sensor.source_noise_pa * random.Normal());
    }
  }
  record.reading_gauge_pa = record.clean_gauge_pa;
  AddNoise(sensor, random, record.reading_gauge_pa);
  AddOutliers(bench, number, record.reading_gauge_pa);
  if (sensor.zero_drift_pa > 0.0) {
    Random drift(bench.seed, kDriftStream + static_cast<std::uint64_t>(number));
    const double zero_pa = sensor.zero_drift_pa * drift.Normal();
    for (double& p : record.reading_gauge_pa) p += zero_pa;
  }
  for (double& p : record.reading_gauge_pa) {
    if (sensor.quantum_pa > 0.0) p = std::round(p / sensor.quantum_pa) * sensor.quantum_pa;
    p = std::clamp(p, sensor.clip_low_pa, sensor.clip_high_pa);
  }
  LoseSome(sensor.missing_share, random, record.reading_gauge_pa);
  return record;
}

BenchCase WithoutFaults(BenchCase bench) {
  for (std::size_t r = 0; r < bench.runs.size(); ++r) {
    const BenchRun& run = bench.runs[r];
    Record& record = bench.records[r];
    record.t_s = run.t_s;
    record.reading_gauge_pa = record.clean_gauge_pa;
    for (std::size_t i = 0; i < record.source_gauge_pa.size(); ++i) {
      record.source_gauge_pa[i] = run.source_course(run.t_s[i]) - bench.declared.ambient_pa;
    }
  }
  return bench;
}

BenchCase DrawCase(std::uint64_t seed, CaseKind kind, const std::string& effect, bool five) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const bool tie = kind == CaseKind::kTie;
    Random random(seed, static_cast<std::uint64_t>(attempt) + (tie ? kTieStream : 0));
    BenchCase bench;
    bench.seed = seed;
    bench.kind = kind;
    const std::vector<std::string> ids = IdsOf(kind, effect, random);
    const BenchSupply supply = DrawSupply(random);
    if (!std::all_of(ids.begin(), ids.end(), [&](const auto& id) { return Shows(id, supply); })) {
      continue;
    }
    bench.declared = DrawRig(supply, random);
    bench.runs = tie    ? DrawNarrowRuns(bench.declared, random)
                 : five ? DrawFiveRuns(bench.declared, random)
                        : DrawRuns(bench.declared, random);
    bench.holdout_recorded = !tie || random.Coin();
    bench.uncertainty = DrawUncertainty(bench.declared, random);
    bench.factors = DrawFactors(bench.uncertainty, random);
    bench.sensor = DrawSensor(bench.declared, random);
    bench.initial_declared = supply == BenchSupply::kNone || random.Coin(0.8);
    if (!DrawEffects(bench, ids, random)) continue;
    for (std::size_t r = 0; r < bench.runs.size(); ++r) {
      bench.records.push_back(Observe(bench, bench.runs[r], static_cast<int>(r)));
    }
    return bench;
  }
  throw std::runtime_error("bench_case: " + effect + " cannot be made visible");
}

CaseKind KindOfSeries(int index) { return static_cast<CaseKind>(index % kKinds); }

BenchCase CaseOfSeries(std::uint64_t series, int index, bool five) {
  const CaseKind kind = KindOfSeries(index);
  const auto turn = static_cast<std::size_t>(index / kKinds);
  const auto& ids = kind == CaseKind::kOutside ? OutsideEffects() : ListedEffects();
  const std::uint64_t seed = series * 1'000'003 + static_cast<std::uint64_t>(index);
  return DrawCase(seed, kind, ids[turn % ids.size()], five);
}

BenchCase TieOfSeries(std::uint64_t series, int index) {
  const auto& ids = ListedEffects();
  const std::uint64_t seed = series * 1'000'003 + static_cast<std::uint64_t>(index);
  return DrawCase(seed, CaseKind::kTie, ids[static_cast<std::size_t>(index) % ids.size()]);
}

}  // namespace plenum::test
