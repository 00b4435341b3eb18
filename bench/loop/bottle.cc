#include "bench/loop/bottle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "api/measure/time_limit.h"
#include "model/physics/monotone_curve.h"
#include "tests/support/bench/bench_rig.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::bench {
namespace {

constexpr double kAmbientPa = 1e5, kRoomK = 293.15;
constexpr double kRoomDeviationK = 2.0, kVolumeDeviation = 0.002, kSourceDeviation = 0.005;
constexpr double kAirCvOverR = 2.5;
constexpr double kStepS = 1e-3;
// The space behind a pump follows its flow in 0.04 ms where the hose passes it nearly without a
// loss, once flow falls in a straight line above this ratio, which moves that loss by 0.1 %.
constexpr double kPumpStepS = 5e-5, kPumpLinearRatio = 0.995;
constexpr int kCurvePoints = 400;

double NumberOf(const catalog::Part& part, const std::string& field) {
  return part.numbers.at(field).value;
}

test::MassElement PairOf(const catalog::Part& part, const std::string& way) {
  return {1e-8 * NumberOf(part, "sonic_conductance" + way + "_dm3_per_s_bar"),
          NumberOf(part, "critical_ratio" + way)};
}

void AddTube(const api::Json& tube, test::EffectRig& rig) {
  const test::LineDynamics bore{1e-3 * tube.at("inner_diameter_mm").get<double>(),
                                tube.at("length_m").get<double>()};
  rig.fill.push_back(test::TubeAsElement(bore));
  rig.exhaust.push_back(test::TubeAsElement(bore));
  rig.dead_volume_m3 +=
      std::numbers::pi / 4.0 * bore.inner_diameter_m * bore.inner_diameter_m * bore.length_m;
}

void AddPart(const catalog::Part& part, test::EffectRig& rig) {
  const bool valve = part.family == "valve";
  rig.fill.push_back(PairOf(part, valve ? "_fill" : ""));
  rig.exhaust.push_back(PairOf(part, valve ? "_exhaust" : ""));
}

// Straight between many points of the monotone curve through those of the table.
void AddPump(const catalog::Part& part, const api::Json& supply, test::EffectRig& rig) {
  rig.source = test::EffectRig::Source::kReservoir;
  rig.linear_ratio = kPumpLinearRatio;
  rig.source_pa = kAmbientPa;
  rig.reservoir_m3 = 1e-6 * std::stod(supply.at("reservoir_volume_ml").get<std::string>());
  std::vector<double> pa, m3_per_s;
  for (const catalog::CurvePoint& point : part.curve->points) {
    pa.push_back(kAmbientPa + 1e3 * point.pressure_kpa_gauge);
    m3_per_s.push_back(point.free_air_l_per_min / 6e4);
  }
  const double low_pa = pa.front(), high_pa = pa.back();
  const model::MonotoneCurve curve(std::move(pa), std::move(m3_per_s));
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double at_pa = std::lerp(low_pa, high_pa, static_cast<double>(i) / kCurvePoints);
    rig.delivery.emplace_back(at_pa, curve(at_pa));
  }
}

test::EffectRig RigOf(const api::Json& measurement, const catalog::Part& truth,
                      const HiddenBench& bench) {
  const api::Json& declared = measurement.at("rig");
  const api::Json& actuator = declared.at("actuator");
  test::EffectRig rig;
  rig.rest_volume_m3 = 1e-6 * bench.volume * actuator.at("rest_volume_ml").get<double>();
  rig.expansion_ratio = 1.0;
  rig.operating_pa = kAmbientPa + 1e3 * actuator.at("operating_pressure_kpa_gauge").get<double>();
  rig.ambient_pa = rig.initial_pa = kAmbientPa;
  rig.ambient_k = bench.room_k;
  for (const api::Json& element : declared.at("line").at("elements")) {
    if (element.contains("tube")) AddTube(element.at("tube"), rig);
    if (element.contains("part")) AddPart(truth, rig);
  }
  if (declared.at("supply").at("kind") == "compressor") AddPump(truth, declared.at("supply"), rig);
  rig.heat_time_constant_s =
      kAirCvOverR * rig.operating_pa * rig.rest_volume_m3 / (bench.room_k * bench.wall_w_per_k);
  return rig;
}

// A pump that delivers less than its table takes longer: the engineer records until the bottle is
// as full as the test asks for, and writes those times into the template. Filling at constant
// temperature takes ∫V/(P0·q) dp.
constexpr double kFull = 0.97, kLongest = 15.0;
double Stretch(const test::EffectRig& rig, const api::Json& run) {
  const double end_pa = kAmbientPa + kFull * (rig.operating_pa - kAmbientPa);
  double seconds = 0.0;
  for (std::size_t i = 0; i + 1 < rig.delivery.size() && rig.delivery[i].first < end_pa; ++i)
    seconds += rig.rest_volume_m3 * (rig.delivery[i + 1].first - rig.delivery[i].first) /
               (kAmbientPa * rig.delivery[i].second);
  return std::clamp(seconds / run.at("valve").back().at("t_s").get<double>(), 1.0, kLongest);
}

std::vector<test::MassCommand> ScheduleOf(const api::Json& run) {
  std::vector<test::MassCommand> schedule;
  for (const api::Json& command : run.at("valve")) {
    const auto state = command.at("state").get<std::string>();
    schedule.push_back({command.at("t_s").get<double>(), state == "inflate"   ? 1
                                                         : state == "deflate" ? -1
                                                                              : 0});
  }
  return schedule;
}

}  // namespace

// 5 W/(m²·K) on six squares, within a factor of 1.6.
HiddenBench DrawBench(double bottle_l, test::Random& random) {
  HiddenBench bench;
  bench.volume += kVolumeDeviation * random.Normal();
  bench.source += kSourceDeviation * random.Normal();
  bench.room_k = kRoomK + kRoomDeviationK * random.Normal();
  const double edge_m = std::cbrt(1e-3 * bottle_l);
  bench.wall_w_per_k = random.LogUniform(5.0 / 1.6, 5.0 * 1.6) * 6.0 * edge_m * edge_m;
  return bench;
}

// The loop's engineer has one bottle, and weighs it.
static api::Json WithoutCheck(api::Json measurement) {
  measurement.erase(api::kTimeLimitField);
  api::Json runs = api::Json::array();
  for (api::Json& run : measurement["runs"])
    if (!run.contains("rig")) {
      run.erase("specimen");
      runs.push_back(std::move(run));
    }
  measurement["runs"] = std::move(runs);
  return measurement;
}

api::Json RecordBottleTest(const api::Json& test, const catalog::Part& truth,
                           test::Random& random) {
  const api::Json& equipment = test.at("equipment");
  const HiddenBench bench = DrawBench(equipment.at("bottle_l").get<double>(), random);
  api::Json measurement = WithoutCheck(test.at("recording").at("template"));
  test::EffectRig rig = RigOf(measurement, truth, bench);
  const bool pump = rig.source == test::EffectRig::Source::kReservoir;
  const double stretch = pump ? Stretch(rig, measurement.at("runs").front()) : 1.0;
  const double sampling_hz = equipment.at("sampling_hz").get<double>() / stretch;
  std::vector<double> t_s;
  for (std::size_t k = 0; k < equipment.at("samples").get<std::size_t>(); ++k)
    t_s.push_back(static_cast<double>(k) / sampling_hz);
  // All repeats are alike but for the sensor's noise.
  const api::Json first = measurement.at("runs").front();
  rig.schedule = ScheduleOf(first);
  for (test::MassCommand& command : rig.schedule) command.time_s *= stretch;
  if (!pump)
    rig.source_pa =
        kAmbientPa + 1e3 * bench.source * first.at("source_pressure_kpa_gauge").get<double>();
  const std::vector<double> bottle_pa =
      test::SimulateEffects(rig, t_s, pump ? kPumpStepS : kStepS).measured_pa;
  for (api::Json& run : measurement.at("runs")) {
    for (api::Json& command : run.at("valve"))
      command["t_s"] = stretch * command.at("t_s").get<double>();
    api::Json readings = api::Json::array();
    for (const double pa : bottle_pa) {
      const double read_pa = pa - kAmbientPa + bench.noise_pa * random.Normal();
      readings.push_back(1e-3 * bench.resolution_pa * std::round(read_pa / bench.resolution_pa));
    }
    run["t_s"] = t_s;
    run["pressure_kpa_gauge"] = std::move(readings);
  }
  return measurement;
}

}  // namespace plenum::bench
