// Bottle tests of a valve and of a pump, recorded on the independent simulator.
#ifndef PLENUM_TESTS_CALIBRATION_BOTTLE_H_
#define PLENUM_TESTS_CALIBRATION_BOTTLE_H_

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/values/dataset.h"
#include "tests/calibration/noise/processes.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::test {

// The hidden truth of a bench, as shares of what is declared, and its sensor.
struct HiddenBottle {
  double fill_c = 1.0, exhaust_c = 1.0;  // times the declared C
  double fill_b = 0.3, exhaust_b = 0.3;  // declared 0.3
  double volume = 1.0, source = 1.0;     // times the declared volume and gauge pressure
  double ambient_k = 293.15;             // as declared
  std::optional<double> heat_s;
  std::optional<OrificeLeak> leak;
  double noise_pa = 300.0;
};

inline constexpr double kBottleM3 = 1e-3, kBottleSourcePa = 6e5, kValveC = 0.2e-8;
inline constexpr double kBottleUncertainty = 0.004, kBottleSourceUncertainty = 0.005;

// 1 L filled to 500 kPa gauge and emptied through a valve of 0.2 dm³/(s·bar), three times.
inline calibration::Dataset BottleTestOfAValve(const HiddenBottle& truth, std::uint64_t seed) {
  using calibration::MeasuredPlace;
  using Kind = calibration::MeasuredNumber::Kind;
  using Of = MeasuredPlace::Of;
  calibration::Dataset dataset;
  dataset.name = "bottle";
  dataset.measured = {{"v", "sonic_conductance_fill", Kind::kConductance, kValveC, 0.0},
                      {"v", "critical_ratio_fill", Kind::kRatio, 0.3, 0.0},
                      {"v", "sonic_conductance_exhaust", Kind::kConductance, kValveC, 0.0},
                      {"v", "critical_ratio_exhaust", Kind::kRatio, 0.3, 0.0}};
  using calibration::Declared;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] =
      kBottleUncertainty;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSourcePressure)] =
      kBottleSourceUncertainty;
  for (int k = 0; k < 3; ++k) {
    calibration::Run run;
    run.id = "test " + std::to_string(k + 1);
    run.chamber = {.rest_volume_m3 = kBottleM3,
                   .expansion_ratio = 1.0,
                   .operating_pressure_pa = kBottleSourcePa,
                   .volume_curve = {}};
    const model::FlowElement pair{kValveC, 0.3};
    run.line = {{pair, pair, {}}};
    run.supply = calibration::Supply::kRegulated;
    run.source_pressure_pa = kBottleSourcePa;
    run.initial_pressure_pa = 1e5;
    run.valve = {{0.0, model::ValveState::kHold},
                 {1.0, model::ValveState::kInflate},
                 {10.0, model::ValveState::kHold},
                 {14.0, model::ValveState::kDeflate},
                 {33.0, model::ValveState::kHold}};
    run.measured.places = {{0, Of::kFillConductance, 0},
                           {1, Of::kFillRatio, 0},
                           {2, Of::kExhaustConductance, 0},
                           {3, Of::kExhaustRatio, 0}};
    for (int i = 0; i <= 340; ++i) run.t_s.push_back(0.1 * i);

    EffectRig rig;
    rig.rest_volume_m3 = kBottleM3 * truth.volume;
    rig.expansion_ratio = 1.0;
    rig.operating_pa = kBottleSourcePa;
    rig.source_pa = 1e5 + truth.source * (kBottleSourcePa - 1e5);
    rig.fill = {{kValveC * truth.fill_c, truth.fill_b}};
    rig.exhaust = {{kValveC * truth.exhaust_c, truth.exhaust_b}};
    rig.ambient_k = truth.ambient_k;
    rig.heat_time_constant_s = truth.heat_s;
    if (truth.leak) rig.leak = *truth.leak;
    for (const model::ValveCommand& command : run.valve)
      rig.schedule.push_back({command.time_s, command.state == model::ValveState::kInflate   ? 1
                                              : command.state == model::ValveState::kDeflate ? -1
                                                                                             : 0});
    run.pressure_pa = SimulateEffects(rig, run.t_s, 5e-3).measured_pa;
    const auto noise =
        WhiteNoise(100 * seed + static_cast<std::uint64_t>(k), run.t_s.size(), truth.noise_pa);
    for (std::size_t i = 0; i < noise.size(); ++i) run.pressure_pa[i] += noise[i];
    dataset.runs.push_back(std::move(run));
  }
  return dataset;
}

// Drawn from what is declared: C from ±20 %, b from 0.2 to 0.45, the rig from its uncertainties.
inline HiddenBottle DrawBottle(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  HiddenBottle truth;
  truth.fill_c = uniform(0.8, 1.2), truth.exhaust_c = uniform(0.8, 1.2);
  truth.fill_b = uniform(0.2, 0.45), truth.exhaust_b = uniform(0.2, 0.45);
  std::normal_distribution<double> normal;
  truth.volume = 1.0 + kBottleUncertainty * normal(generator);
  truth.source = 1.0 + kBottleSourceUncertainty * normal(generator);
  truth.ambient_k += calibration::kRoomK * normal(generator);
  return truth;
}

// A pump with 0.1 L behind it fills 1 L through a wide hose; `delivery` is the truth at the
// declared pressures.
inline const std::vector<double> kPumpPa = {1e5, 1.5e5, 2e5, 2.5e5, 3e5};
inline const std::vector<double> kPumpDelivery = {1e-4, 8e-5, 6e-5, 3.5e-5, 1e-5};  // m³/s ANR
inline calibration::Dataset BottleTestOfAPump(const std::vector<double>& delivery, double volume,
                                              std::uint64_t seed, double ambient_k = 293.15,
                                              double noise_pa = 200.0) {
  calibration::Dataset dataset;
  dataset.name = "pump";
  for (std::size_t i = 0; i < kPumpPa.size(); ++i)
    dataset.measured.push_back(
        {"p", "free_air", calibration::MeasuredNumber::Kind::kDelivery,
         kPumpDelivery[i] - (i + 1 < kPumpPa.size() ? kPumpDelivery[i + 1] : 0.0), kPumpPa[i]});
  using calibration::Declared;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] =
      kBottleUncertainty;
  for (int k = 0; k < 2; ++k) {
    calibration::Run run;
    run.id = "fill " + std::to_string(k + 1);
    run.chamber = {.rest_volume_m3 = kBottleM3,
                   .expansion_ratio = 1.0,
                   .operating_pressure_pa = 3e5,
                   .volume_curve = {}};
    const model::FlowElement pair{0.4e-8, 0.3};
    run.line = {{pair, pair, {}}};
    run.supply = calibration::Supply::kCompressor;
    run.source_pressure_pa = 1e5;
    run.reservoir_volume_m3 = 1e-4;
    run.compressor.free_air_m3_per_s = model::MonotoneCurve(kPumpPa, kPumpDelivery);
    run.compressor.pressure_max_pa = kPumpPa.back();
    run.initial_pressure_pa = 1e5;
    run.valve = {{0.0, model::ValveState::kInflate}, {45.0, model::ValveState::kHold}};
    for (std::size_t i = 0; i < kPumpPa.size(); ++i) run.measured.delivery.push_back(i);
    for (int i = 0; i <= 500; ++i) run.t_s.push_back(0.1 * i);

    EffectRig rig;
    rig.rest_volume_m3 = kBottleM3 * volume;
    rig.expansion_ratio = 1.0;
    rig.operating_pa = 3e5;
    rig.ambient_k = ambient_k;
    rig.source = EffectRig::Source::kReservoir;
    rig.source_pa = 1e5;
    rig.reservoir_m3 = 1e-4;
    rig.fill = rig.exhaust = {{0.4e-8, 0.3}};
    // Straight between many points of the same monotone curve.
    const model::MonotoneCurve curve(kPumpPa, delivery);
    for (int i = 0; i <= 400; ++i) {
      const double pa = kPumpPa.front() + (kPumpPa.back() - kPumpPa.front()) * i / 400.0;
      rig.delivery.emplace_back(pa, curve(pa));
    }
    rig.schedule = {{0.0, 1}, {45.0, 0}};
    run.pressure_pa = SimulateEffects(rig, run.t_s, 1e-3).measured_pa;
    const auto noise =
        WhiteNoise(100 * seed + static_cast<std::uint64_t>(k), run.t_s.size(), noise_pa);
    for (std::size_t i = 0; i < noise.size(); ++i) run.pressure_pa[i] += noise[i];
    dataset.runs.push_back(std::move(run));
  }
  return dataset;
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_CALIBRATION_BOTTLE_H_
