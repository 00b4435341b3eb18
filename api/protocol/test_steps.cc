#include "api/protocol/test_steps.h"

#include <cmath>
#include <cstdio>

namespace plenum::api {
namespace {

constexpr double kScaleG = 1.0;              // least step of a kitchen scale
constexpr double kWaterShare = 0.002;        // density with temperature, bubbles, drops left
constexpr double kMeterShare = 0.01;         // of a multimeter: current, voltage
constexpr double kClockShare = 0.002;        // of hours of discharge, where its end is seen
constexpr double kGaugeShare = 0.016;        // of a filling station's gauge, class 1.6
constexpr double kKnownVolumeShare = 0.002;  // uncertainty of the known volume
constexpr double kSharedKpa = 400.0;         // in the known volume before it is opened
constexpr double kReadings = 10.0;           // that are averaged: more share their error

constexpr std::string_view kWeigh =
    "Weigh the bottle empty and full of water, with what lies between it and the part: its volume "
    "is the difference, 1 g for 1 mL. Write it into rest_volume_ml of the template, and how well "
    "it "
    "is known into relative_uncertainty.rest_volume: 0.002 for a litre on a scale of 1 g. What the "
    "volume is wrong by, the part's numbers are wrong by, and no reading shows it: without a "
    "weighing 2 % are assumed.";
constexpr std::string_view kCheck =
    "Record one more run (check) with a second bottle, weighed by itself: its volume is in that "
    "run's rig. Both bottles must give the same numbers, else one of the volumes is wrong and "
    "nothing is saved. Without a second bottle leave that run out of the template.";
constexpr std::string_view kValve =
    "Connect in this order: regulated source, the part, bottle. Mount the sensor on the bottle "
    "itself, on a port of its own. Keep what lies between part and bottle short and wide, and "
    "leave the exhaust port open, without a silencer.";
constexpr std::string_view kFitting =
    "Connect in this order: regulated source, a ball valve that is wide against the part, the "
    "part, "
    "bottle. Mount the sensor on the bottle itself.";
constexpr std::string_view kRegulator =
    "Connect in this order: source, ball valve, regulator, bottle, and turn the regulator to its "
    "highest outlet pressure: the source of this test lies below it where it can, so that the "
    "regulator stays open to the end.";
constexpr std::string_view kSource =
    "Set the source, read it with the same sensor, and write it into source_pressure_kpa_gauge. A "
    "source that sags while the bottle fills looks like another critical ratio: if it moves by "
    "more than 1 %, record it too (column source_pressure_kpa_gauge, supply kind measured).";
constexpr std::string_view kWatch =
    "Close the bottle under pressure and watch it for a minute: a fall that goes on after the gas "
    "has cooled is a leak, to be sealed first. Write the room's temperature and air pressure into "
    "ambient.";
constexpr std::string_view kRecord =
    "Record: rest, fill, close, empty, rest, at the times of the template, and note the valve's "
    "state in each row. Repeat from ambient pressure and temperature.";
constexpr std::string_view kRecordFilling =
    "Open the ball valve and record the filling at the times of the template. Empty the bottle "
    "unrecorded. Repeat from ambient pressure and temperature.";
constexpr std::string_view kPump =
    "Connect the pump to the bottle by 0.3 m of 4 mm tube (or write the one that you use into the "
    "template), and mount the sensor on the bottle. Run the pump from a supply at the voltage of "
    "its "
    "curve.";
constexpr std::string_view kPumpRecord =
    "Start pump and recording together; stop when the template's time is over, or when the "
    "pressure no longer rises. A pump that stalls earlier than its table ends is recorded up to "
    "there. A pump that delivers less than its table takes longer: go on until the pressure hardly "
    "rises, and write those times into the template.";
constexpr std::string_view kPumpHold =
    "With the pump off record the template's hold: what the pressure falls by, once the gas has "
    "cooled, is what the pump lets back or the bottle leaks.";
constexpr std::string_view kPumpRead =
    "Note the current at the pressures of the table, and the pressure at which the pump stalls. "
    "Let "
    "the pump cool down before each repeat.";
constexpr std::string_view kWater =
    "Weigh the reservoir dry, fill it with water to the port without bubbles, weigh it again: the "
    "difference is its volume, 1 g for 1 mL (0.998 g at 20 °C).";
constexpr std::string_view kShareStep =
    "Where no water may come in: pressurise a bottle of known volume V1 to p1, connect it to the "
    "vessel at ambient pressure, wait until the reading stands, read p2 (gauge): "
    "V2 = V1·(p1 − p2)/p2.";
constexpr std::string_view kReservoirMean = "Repeat twice; write the mean into internal_volume_ml.";
constexpr std::string_view kCylinder =
    "Weigh the cylinder empty and, with its valve removed, full of water, if its inspection allows "
    "it.";
constexpr std::string_view kCylinderMean = "Repeat twice; write the mean into water_volume_l.";
constexpr std::string_view kCylinderFill =
    "Fill it as for a mission, let it cool down to the room's temperature, and read its pressure: "
    "the least of what your filling station gives is fill_pressure_kpa_gauge.";
constexpr std::string_view kDuty =
    "Run the pump at its worst pressure in a cycle of five minutes, first half on, half off.";
constexpr std::string_view kDutyHeat =
    "Measure the temperature of the motor's body at the end of each on-time until two cycles "
    "differ "
    "by less than 1 K.";
constexpr std::string_view kDutyMost =
    "Lengthen the on-time until that temperature is the highest that its maker allows (60 °C on "
    "the "
    "body where nothing is said): on-time over cycle is duty_max.";
constexpr std::string_view kSwitching =
    "Lower the inlet pressure in steps of 10 kPa and switch ten times at each: the lowest pressure "
    "at which all ten switch is pressure_min_kpa_gauge.";
constexpr std::string_view kCoil =
    "Measure voltage and current of one coil after a minute energised: their product is "
    "coil_power_w.";
constexpr std::string_view kDischarge =
    "Charge to the full voltage and discharge at the current that the pump draws, down to the "
    "cut-off voltage of the pack.";
constexpr std::string_view kCapacity =
    "Current times hours is capacity_ah; the largest current at which the pack stays below its "
    "temperature limit to the end is current_max_a.";

struct Steps {
  std::string_view protocol, family;
  std::vector<std::string_view> steps;
};

const std::vector<Steps>& AllSteps() {
  static const std::vector<Steps> kAll = {
      {"bottle_test", "valve", {kWeigh, kValve, kSource, kWatch, kRecord, kCheck}},
      {"bottle_test", "fitting", {kWeigh, kFitting, kSource, kWatch, kRecord, kCheck}},
      {"bottle_test", "regulator", {kWeigh, kRegulator, kSource, kWatch, kRecordFilling, kCheck}},
      {"bottle_test", "compressor", {kWeigh, kPump, kPumpRecord, kPumpHold, kCheck, kPumpRead}},
      {"volume_test", "reservoir", {kWater, kShareStep, kReservoirMean}},
      {"volume_test", "cylinder", {kCylinder, kShareStep, kCylinderMean, kCylinderFill}},
      {"duty_test", "compressor", {kDuty, kDutyHeat, kDutyMost}},
      {"switching_test", "valve", {kSwitching, kCoil}},
      {"discharge_test", "battery", {kDischarge, kCapacity}}};
  return kAll;
}

// Of two weighings.
double ByWater(double volume_ml) {
  return std::hypot(kScaleG * std::sqrt(2.0 / 12.0) / volume_ml, kWaterShare);
}

// Of V2 = V1·(p1 − p2)/p2 by differences of both pressures; the known volume is 1 L, or the bottle.
double BySharing(double volume_ml, const TestSensor& sensor) {
  const double known_ml = 1e3 * sensor.bottle_l.value_or(1.0);
  const double shared_kpa = kSharedKpa * known_ml / (known_ml + volume_ml);
  const double noise_kpa = ReadingNoisePa(sensor, 1e3 * kSharedKpa) / 1e3 / std::sqrt(kReadings);
  const auto volume = [&](double before_kpa, double after_kpa) {
    return known_ml * (before_kpa - after_kpa) / after_kpa;
  };
  const double by_before = volume(kSharedKpa + noise_kpa, shared_kpa) - volume_ml;
  const double by_after = volume(kSharedKpa, shared_kpa + noise_kpa) - volume_ml;
  return std::hypot(std::hypot(by_before, by_after) / volume_ml, kKnownVolumeShare);
}

std::vector<ReadNumber> OfVolume(const char* field, double volume_ml, const TestSensor& sensor) {
  return {{field, ByWater(volume_ml), "water, a scale that shows 1 g"},
          {field, BySharing(volume_ml, sensor),
           "gas shared with a known volume at 400 kPa, ten readings each"}};
}

}  // namespace

std::vector<std::string> StepsOf(std::string_view protocol, std::string_view family) {
  for (const Steps& one : AllSteps())
    if (one.protocol == protocol && one.family == family)
      return {one.steps.begin(), one.steps.end()};
  return {};
}

std::vector<ReadNumber> ReadByHand(std::string_view protocol, const catalog::Part& part,
                                   const TestSensor& sensor) {
  if (protocol == "volume_test" && part.family == "reservoir")
    return OfVolume("internal_volume_ml", NumberOf(part, "internal_volume_ml"), sensor);
  if (protocol == "volume_test") {
    std::vector<ReadNumber> numbers =
        OfVolume("water_volume_l", 1e3 * NumberOf(part, "water_volume_l"), sensor);
    numbers.push_back({"fill_pressure_kpa_gauge", kGaugeShare, "the filling station's gauge"});
    return numbers;
  }
  if (protocol == "bottle_test" && part.family == "compressor") {
    const double stall_kpa = NumberOf(part, "pressure_max_kpa_gauge");
    return {{"current", kMeterShare, "a multimeter at each pressure of the table"},
            {"pressure_max_kpa_gauge", ReadingNoisePa(sensor, 1e3 * stall_kpa) / (1e3 * stall_kpa),
             "the reading where the pressure no longer rises"}};
  }
  if (protocol == "duty_test")
    return {{"duty_max", 0.05, "steps of a tenth of the cycle, halved once"}};
  if (protocol == "switching_test") {
    std::vector<ReadNumber> numbers{
        {"coil_power_w", std::hypot(kMeterShare, kMeterShare), "voltage times current"}};
    const double least_kpa = NumberOf(part, "pressure_min_kpa_gauge");
    if (least_kpa > 0.0)
      numbers.push_back(
          {"pressure_min_kpa_gauge", 10.0 / std::sqrt(12.0) / least_kpa, "steps of 10 kPa"});
    return numbers;
  }
  if (protocol == "discharge_test")
    return {{"capacity_ah", std::hypot(kMeterShare, kClockShare), "current times time"},
            {"current_max_a", 0.05, "steps of a tenth"}};
  return {};
}

namespace {

// Usual steps of scales, g: kitchen, letter, jewel, laboratory.
constexpr double kScalesG[] = {1.0, 0.1, 0.01, 0.001};
constexpr double kScaleShare = 0.005;  // of the mass, that one step may be
constexpr double kScaleGain = 0.001;   // of the reading, of a scale that was checked with a weight
constexpr int kWeighings = 3;

// The coarsest that will do; the finest where none does.
double ScaleFor(double grams) {
  for (const double step_g : kScalesG)
    if (step_g <= kScaleShare * grams) return step_g;
  return kScalesG[3];
}

std::string_view WhatToWeigh(std::string_view family) {
  if (family == "valve")
    return "Weigh the valve with its coil, plug and gaskets, as it is carried; base and screws "
           "where it needs them.";
  if (family == "compressor" || family == "vacuum_pump")
    return "Weigh the pump with its check valve, leads and feet, as it is carried.";
  if (family == "battery") return "Weigh the pack with its leads and plug.";
  if (family == "cylinder") return "Weigh the cylinder empty, at ambient pressure, with its valve.";
  if (family == "co2")
    return "Weigh it full and again when it is empty: mass_kg is the empty mass, the difference "
           "is co2_mass_kg.";
  if (family == "reservoir") return "Weigh it empty, at ambient pressure, with its plugs.";
  if (family == "tubing") return "Cut 1 m of the tube at right angles, measure it, and weigh it.";
  return "Weigh it as it is carried. Of small pieces weigh ten of the same type together and "
         "divide by ten.";
}

std::string Grams(double grams) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g g", grams);
  return text;
}

}  // namespace

std::vector<std::string> WeighingSteps(const catalog::Part& part, const std::string& field) {
  const double grams = 1e3 * NumberOf(part, field.c_str());
  return {"Take a scale whose step is " + Grams(ScaleFor(grams)) + " or less (the catalogue has " +
              Grams(grams) + "), and check it with something of known mass.",
          std::string(WhatToWeigh(part.family)),
          "Weigh three times, with the scale at zero before each, and take the mean. Pieces of one "
          "type differ: weigh each that you have, and name them.",
          "Save it: plenum catalog measured " + part.id + " \"" + field +
              "=25.3 g\" --uncertainty 0.005 (your reading and its uncertainty, one standard "
              "deviation over the mean), with --specimen NAME for a piece of several."};
}

std::vector<ReadNumber> WeighingOf(const catalog::Part& part, const std::string& field) {
  const double grams = 1e3 * NumberOf(part, field.c_str());
  const double step_g = ScaleFor(grams);
  const double share = step_g / std::sqrt(12.0 * kWeighings) / grams;
  return {{field, std::hypot(share, kScaleGain),
           std::to_string(kWeighings) + " weighings on a scale with steps of " + Grams(step_g)}};
}

}  // namespace plenum::api
