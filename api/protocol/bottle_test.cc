#include "api/protocol/bottle_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "api/json/units.h"
#include "api/measure/measurement.h"
#include "api/measure/time_limit.h"
#include "model/effects/registry.h"

namespace plenum::api {
namespace {

constexpr std::array kBottlesL = {0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};
constexpr double kSourceKpa = 600.0;    // of the usual wall supply
constexpr double kOfRating = 0.9;       // at most, of what the part stands
constexpr double kSourceShare = 0.005;  // of a regulator's setting, read by the same sensor
constexpr double kRestS = 1.0, kSettleS = 5.0;
constexpr double kSamplesMost = 4'000.0;  // of a run: more tell little more
constexpr int kRepeats = 3;
constexpr double kDiagnosisS = 300.0;  // a pump's dozen numbers take a minute of a slow core
constexpr const char* kAssumed =
    "rest_volume is assumed: weigh the bottle empty and full of water, write its volume into "
    "rest_volume_ml, and 0.002 here";
constexpr const char* kBehindPump = "2 mL";  // between the pump's valve and the hose
constexpr double kPumpS = 60.0;              // that a pump should take for its bottle
constexpr double kPumpReach = 0.95;          // of the last pressure at which it delivers
constexpr double kRegulatorOpen = 0.7;       // of its highest setting: a source that keeps it open
constexpr double kRegulatorReach = 0.6;      // of its highest setting, below which it is open
// Time constant of a bare plastic bottle of 1 L at 200 kPa: 5 W/(m²·K) on 0.06 m² of wall.
constexpr double kBottleHeatS = 5.0;

struct Strokes {
  double fill_s = 0.0, empty_s = 0.0;  // 0: none
};

double BottleFor(const TestSensor& sensor, double litres_least) {
  if (sensor.bottle_l) return *sensor.bottle_l;
  const auto bottle = std::lower_bound(kBottlesL.begin(), kBottlesL.end(), litres_least);
  return bottle == kBottlesL.end() ? kBottlesL.back() : *bottle;
}

// The least volume, L, in which one stroke through C, dm³/(s·bar), lasts long enough: its time
// constant is V/(C·P0), and 1 dm³/(s·bar) at P0 = 1 bar is 1 L/s.
double LeastBottleL(double conductance, const TestSensor& sensor) {
  return conductance * std::max(kStrokeLeastS, kStrokeSamples / sensor.sampling_hz);
}

std::vector<double> SampleTimes(double end_s, double& sampling_hz) {
  sampling_hz = std::min(sampling_hz, kSamplesMost / end_s);
  std::vector<double> t_s;
  const auto count = static_cast<std::size_t>(end_s * sampling_hz);
  t_s.reserve(count + 1);
  for (std::size_t i = 0; i <= count; ++i) t_s.push_back(static_cast<double>(i) / sampling_hz);
  return t_s;
}

double Tenths(double seconds) { return std::ceil(10.0 * seconds) / 10.0; }

// Rest, fill, settle, empty, rest.
Json Schedule(const Strokes& strokes, double rest_s, double& end_s) {
  Json valve = Json::array();
  const auto add = [&](const char* state, double lasts_s) {
    valve.push_back({{"t_s", Number(end_s)}, {"state", state}});
    end_s = Tenths(end_s + lasts_s);
  };
  end_s = 0.0;
  if (rest_s > 0.0) add("hold", rest_s);
  add("inflate", strokes.fill_s);
  add("hold", kSettleS);
  if (strokes.empty_s > 0.0) {
    add("deflate", strokes.empty_s);
    add("hold", kRestS);
  }
  return valve;
}

Json Uncertainties(const TestSensor& sensor) {
  Json uncertainty = {
      {"rest_volume", Number(sensor.bottle_uncertainty.value_or(kAssumedVolumeShare))}};
  if (!sensor.bottle_uncertainty) uncertainty["note"] = kAssumed;
  return uncertainty;
}

Json Measurement(const catalog::Part& part, const TestSensor& sensor, double bottle_l,
                 double highest_kpa) {
  return {{"schema", "measurement/1"},
          {"name", "bottle test of " + part.id},
          {"rig",
           {{"actuator",
             {{"rest_volume_ml", Number(1e3 * bottle_l)},
              {"expansion_ratio", 1.0},
              {"operating_pressure_kpa_gauge", Number(highest_kpa)}}},
            {"ambient", {{"pressure_kpa_abs", 100.0}, {"temperature_k", 293.15}}}}},
          {"relative_uncertainty", Uncertainties(sensor)},
          {"runs", Json::array()}};
}

// The usual bottle below, or above the smallest one.
double OtherBottle(double bottle_l) {
  const auto* bottle = std::lower_bound(kBottlesL.begin(), kBottlesL.end(), bottle_l);
  return bottle == kBottlesL.begin() ? kBottlesL[1] : *(bottle - 1);
}

// Strokes last as the volume is.
void AddCheck(const Strokes& strokes, double rest_s, BottleTest& test) {
  test.check_bottle_l = OtherBottle(test.bottle_l);
  const double ratio = test.check_bottle_l / test.bottle_l;
  double end_s = 0.0;
  test.check_run = test.measurement["runs"].front();
  test.check_run["id"] = "check";
  test.check_run["specimen"] = "second bottle";
  test.check_run["rig"] = {{"actuator", {{"rest_volume_ml", Number(1e3 * test.check_bottle_l)}}}};
  test.check_run["valve"] =
      Schedule({ratio * strokes.fill_s, ratio * strokes.empty_s}, rest_s, end_s);
}

void AddRuns(const Strokes& strokes, double rest_s, double sampling_hz, BottleTest& test) {
  double end_s = 0.0;
  const Json valve = Schedule(strokes, rest_s, end_s);
  test.sampling_hz = sampling_hz;
  test.t_s = SampleTimes(end_s, test.sampling_hz);
  test.repeats = kRepeats;
  for (int k = 1; k <= kRepeats; ++k) {
    Json run = {{"id", "test " + std::to_string(k)},
                {"initial", {{"pressure_kpa_gauge", 0.0}}},
                {"valve", valve}};
    if (test.source_kpa_gauge > 0.0)
      run["source_pressure_kpa_gauge"] = Number(test.source_kpa_gauge);
    test.measurement["runs"].push_back(std::move(run));
  }
  AddCheck(strokes, rest_s, test);
}

// τ goes with the pressure and the ratio of volume to wall.
void AddHeat(double highest_kpa, BottleTest& test) {
  const double tau_s = kBottleHeatS * (highest_kpa + 100.0) / 200.0 * std::cbrt(test.bottle_l);
  test.effects = {{model::FindEffect("heat_transfer"), {tau_s}}};
}

BottleTest FlowTest(const catalog::Part& part, const TestSensor& sensor, double fill_c,
                    double exhaust_c, std::vector<std::string> measure) {
  BottleTest test;
  test.bottle_l = BottleFor(sensor, LeastBottleL(std::max(fill_c, exhaust_c), sensor));
  test.source_kpa_gauge =
      std::floor(std::min(kSourceKpa, kOfRating * NumberOf(part, "pressure_max_kpa_gauge")));
  const double ratio = (test.source_kpa_gauge + 100.0) / 100.0;
  const Strokes strokes{1.7 * test.bottle_l / fill_c,
                        (std::log(ratio) + 2.0) * test.bottle_l / exhaust_c};
  test.measurement = Measurement(part, sensor, test.bottle_l, test.source_kpa_gauge);
  Json& rig = test.measurement["rig"];
  rig["line"] = {{"elements", Json::array({{{"part", part.id}, {"measure", measure}}})}};
  rig["supply"] = {{"kind", "regulated"}};
  test.measurement["relative_uncertainty"]["source_pressure"] = kSourceShare;
  AddRuns(strokes, kRestS, sensor.sampling_hz, test);
  AddHeat(test.source_kpa_gauge, test);
  return test;
}

BottleTest ValveTest(const catalog::Part& part, const TestSensor& sensor) {
  return FlowTest(part, sensor, NumberOf(part, "sonic_conductance_fill_dm3_per_s_bar"),
                  NumberOf(part, "sonic_conductance_exhaust_dm3_per_s_bar"),
                  {"sonic_conductance_fill", "critical_ratio_fill", "sonic_conductance_exhaust",
                   "critical_ratio_exhaust"});
}

BottleTest FittingTest(const catalog::Part& part, const TestSensor& sensor) {
  const double conductance = NumberOf(part, "sonic_conductance_dm3_per_s_bar");
  return FlowTest(part, sensor, conductance, conductance, {"sonic_conductance", "critical_ratio"});
}

// Filled through it while it is open; what empties the bottle is not recorded. A source below its
// highest setting keeps it open to the end, and shows the knee; one that the regulator needs above
// that is recorded up to a share of the setting.
BottleTest RegulatorTest(const catalog::Part& part, const TestSensor& sensor) {
  const double conductance = NumberOf(part, "sonic_conductance_dm3_per_s_bar");
  const double setting_kpa = NumberOf(part, "outlet_pressure_max_kpa_gauge");
  const double least_kpa = NumberOf(part, "inlet_pressure_min_kpa_gauge");
  const double open_kpa = std::floor(kRegulatorOpen * setting_kpa);
  const bool stays_open = open_kpa >= least_kpa;
  BottleTest test;
  test.bottle_l = BottleFor(sensor, LeastBottleL(conductance, sensor));
  test.source_kpa_gauge =
      std::min({kSourceKpa, kOfRating * NumberOf(part, "inlet_pressure_max_kpa_gauge"),
                stays_open ? open_kpa : std::max(least_kpa, setting_kpa)});
  const double reach_kpa =
      stays_open ? test.source_kpa_gauge
                 : std::min(kRegulatorReach * setting_kpa, 0.9 * test.source_kpa_gauge);
  const double time_constants = stays_open ? 1.7 : reach_kpa / (test.source_kpa_gauge + 100.0);
  test.measurement = Measurement(part, sensor, test.bottle_l, test.source_kpa_gauge);
  Json& rig = test.measurement["rig"];
  rig["line"] = {
      {"elements",
       Json::array({{{"part", part.id}, {"measure", {"sonic_conductance", "critical_ratio"}}}})}};
  rig["supply"] = {{"kind", "regulated"}};
  test.measurement["relative_uncertainty"]["source_pressure"] = kSourceShare;
  AddRuns({time_constants * test.bottle_l / conductance, 0.0}, kRestS, sensor.sampling_hz, test);
  AddHeat(reach_kpa, test);
  return test;
}

// Time to fill 1 L from ambient to `end_kpa`, s: ∫ dp/(P0·q), trapezoids over the table.
double FillSecondsPerL(const catalog::Curve& curve, double end_kpa) {
  const auto flow_at = [&](double kpa) {
    const auto& points = curve.points;
    if (kpa <= points.front().pressure_kpa_gauge) return points.front().free_air_l_per_min;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (kpa <= points[i].pressure_kpa_gauge)
        return std::lerp(points[i - 1].free_air_l_per_min, points[i].free_air_l_per_min,
                         (kpa - points[i - 1].pressure_kpa_gauge) /
                             (points[i].pressure_kpa_gauge - points[i - 1].pressure_kpa_gauge));
    return 0.0;
  };
  constexpr int kSteps = 200;
  const double step_kpa = end_kpa / kSteps;
  double seconds = 0.0;
  for (int k = 0; k < kSteps; ++k)
    seconds += step_kpa / 100.0 * 60.0 / flow_at((k + 0.5) * step_kpa);
  return seconds;
}

// The last pressure of the table at which the pump still delivers, or near the stall between.
double LastDelivering(const catalog::Curve& curve) {
  double last_kpa = 0.0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (curve.points[i].free_air_l_per_min > 0.0)
      last_kpa = curve.points[i].pressure_kpa_gauge;
    else if (i > 0)
      return kPumpReach * curve.points[i].pressure_kpa_gauge;
  }
  return last_kpa;
}

std::optional<BottleTest> PumpTest(const catalog::Part& part, const TestSensor& sensor) {
  if (!part.curve || !(part.curve->points.front().free_air_l_per_min > 0.0)) return {};
  const double end_kpa = LastDelivering(*part.curve);
  if (!(end_kpa > 0.0)) return {};
  const double seconds_per_l = FillSecondsPerL(*part.curve, end_kpa);
  BottleTest test;
  test.bottle_l = BottleFor(sensor, kPumpS / seconds_per_l);
  test.measurement = Measurement(part, sensor, test.bottle_l, std::ceil(end_kpa));
  Json& rig = test.measurement["rig"];
  rig["line"] = {
      {"elements", Json::array({{{"tube", {{"inner_diameter_mm", 4.0}, {"length_m", 0.3}}}}})}};
  rig["supply"] = {{"kind", "compressor"},
                   {"part", part.id},
                   {"measure", {"free_air"}},
                   {"reservoir_volume_ml", kBehindPump}};
  AddRuns({seconds_per_l * test.bottle_l, 0.0}, 0.0, sensor.sampling_hz, test);
  AddHeat(end_kpa, test);
  return test;
}

std::optional<BottleTest> TestOfFamily(const catalog::Part& part, const TestSensor& sensor) {
  if (part.family == "valve") return ValveTest(part, sensor);
  if (part.family == "fitting") return FittingTest(part, sensor);
  if (part.family == "regulator") return RegulatorTest(part, sensor);
  if (part.family == "compressor") return PumpTest(part, sensor);
  return {};
}

}  // namespace

// The template states what the sensor's data sheet says, so that the diagnosis knows its steps.
std::optional<BottleTest> MakeBottleTest(const catalog::Part& part, const TestSensor& sensor) {
  std::optional<BottleTest> test = TestOfFamily(part, sensor);
  if (test && sensor.resolution_kpa > 0.0)
    test->measurement["rig"]["sensor"] = {{"resolution_kpa", Number(sensor.resolution_kpa)}};
  return test;
}

Json TemplateOf(const BottleTest& test) {
  Json document = test.measurement;
  for (Json& run : document["runs"]) run["specimen"] = "first bottle";
  document["runs"].push_back(test.check_run);
  document[kTimeLimitField] = kDiagnosisS;
  return document;
}

}  // namespace plenum::api
