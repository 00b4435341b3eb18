#include "api/protocol/protocol_document.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "api/json/units.h"
#include "api/json/version.h"
#include "api/measure/measurement.h"
#include "api/measure/rig_parts.h"
#include "api/protocol/bottle_test.h"
#include "api/protocol/protocols.h"
#include "api/protocol/test_steps.h"
#include "calibration/experiment/test_precision.h"
#include "calibration/names/measured_numbers.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::MeasuredEstimate;

constexpr double kRigShare = 0.8;  // of the variance: the rig decides how precise the number is

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
  return text;
}

// The runs as they will be recorded, with readings only so that they can be read.
Dataset DatasetOf(const BottleTest& test, const catalog::Part& part) {
  Json document = test.measurement;
  Json times = Json::array(), readings = Json::array();
  for (const double t : test.t_s) {
    times.push_back(t);
    readings.push_back(readings.size() % 2 == 0 ? 0.0 : 1.0);
  }
  for (Json& run : document["runs"]) {
    run["t_s"] = times;
    run["pressure_kpa_gauge"] = readings;
  }
  Errors errors;
  const Json filled = WithParts(std::move(document), {part}, errors);
  if (!errors.empty()) return {};
  Parsed<Dataset> dataset = ParseMeasurement(filled);
  return std::holds_alternative<Dataset>(dataset) ? std::get<Dataset>(std::move(dataset))
                                                  : Dataset();
}

struct Precision {
  Json rows = Json::array(), warnings = Json::array();
  std::vector<std::string> by_rig;  // numbers that are as precise as the rig is known
};

void Warn(const std::string& name, double uncertainty, double from_noise, bool told,
          Precision& precision) {
  if (!told)
    precision.warnings.push_back("This test cannot tell " + name +
                                 (uncertainty < kNothingTold
                                      ? ": it would be known to " + Percent(uncertainty) + " only."
                                      : ".") +
                                 " Take a faster or finer sensor, or a larger bottle.");
  else if (std::pow(from_noise / uncertainty, 2) < 1.0 - kRigShare)
    precision.by_rig.push_back(name);
}

// One sentence for all: a curve has a dozen.
void WarnOfRig(const BottleTest& test, Precision& precision) {
  if (precision.by_rig.empty()) return;
  const Json& volume = test.measurement["relative_uncertainty"]["rest_volume"];
  std::string names;
  for (const std::string& name : precision.by_rig) names += (names.empty() ? "" : ", ") + name;
  precision.warnings.push_back(names +
                               ": as precise as the bottle's volume, the source and the room's "
                               "temperature are known. What the volume is wrong by, so is the "
                               "number; here the volume is taken to be known to " +
                               Percent(volume.get<double>()) + ".");
}

Precision PrecisionOfTest(const BottleTest& test, const catalog::Part& part,
                          const TestSensor& sensor) {
  Precision precision;
  const Dataset dataset = DatasetOf(test, part);
  if (dataset.runs.empty()) {
    precision.warnings.push_back("How precise it will be cannot be computed for this part.");
    return precision;
  }
  const double highest_kpa =
      test.measurement["rig"]["actuator"]["operating_pressure_kpa_gauge"].get<double>();
  const auto found = calibration::PrecisionOf(dataset, test.effects,
                                              ReadingNoisePa(sensor, kPaPerKpa * highest_kpa));
  if (!found) {
    precision.warnings.push_back("How precise it will be cannot be computed for this part.");
    return precision;
  }
  for (std::size_t i = 0; i < found->numbers.size(); ++i) {
    const MeasuredEstimate& estimate = found->numbers[i];
    const calibration::MeasuredNumber& number = dataset.measured[estimate.number];
    if (!(estimate.value > 0.0)) continue;  // a pump's table ends where nothing is delivered
    const double uncertainty = estimate.deviation / estimate.value;
    const double from_noise = std::min(found->from_noise[i] / estimate.value, uncertainty);
    const bool told = uncertainty <= calibration::kMostUncertain;
    Json row = {
        {"field", FieldOfMeasured(number.name)},
        {"uncertainty", Number(uncertainty)},
        {"from_noise", Number(from_noise)},
        {"from_rig", Number(std::sqrt(uncertainty * uncertainty - from_noise * from_noise))},
        {"told", told},
        {"how", "fitted to the recording"}};
    std::string name = number.name;
    if (number.kind == calibration::MeasuredNumber::Kind::kDelivery) {
      const double kpa = KpaGaugeFromPa(number.pressure_pa, dataset.runs.front().ambient);
      row["pressure_kpa_gauge"] = Number(kpa);
      char text[32];
      std::snprintf(text, sizeof text, " at %.4g kPa", kpa);
      name += text;
    }
    Warn(name, uncertainty, from_noise, told, precision);
    precision.rows.push_back(std::move(row));
  }
  WarnOfRig(test, precision);
  return precision;
}

Json Equipment(const BottleTest& test) {
  const double duration_s = test.t_s.back();
  return {{"bottle_l", Number(test.bottle_l)},
          {"source_pressure_kpa_gauge",
           test.source_kpa_gauge > 0.0 ? Number(test.source_kpa_gauge) : Json(nullptr)},
          {"sampling_hz", Number(test.sampling_hz)},
          {"duration_s", Number(duration_s)},
          {"samples", test.t_s.size()},
          {"repeats", test.repeats},
          {"check_bottle_l", Number(test.check_bottle_l)}};
}

Json Recording(const BottleTest& test, const catalog::Part& part) {
  return {{"template", TemplateOf(test)},
          {"columns", {"run", "t_s", "valve", "pressure_kpa_gauge"}},
          {"command", "plenum diagnose recording.csv --rig template.json --save-part " + part.id}};
}

void AddByHand(const Protocol& protocol, const catalog::Part& part, const TestSensor& sensor,
               Json& rows) {
  for (const ReadNumber& number : ReadByHand(protocol.name, part, sensor))
    rows.push_back({{"field", number.field},
                    {"uncertainty", Number(number.uncertainty)},
                    {"from_noise", Number(number.uncertainty)},
                    {"from_rig", 0.0},
                    {"told", number.uncertainty <= calibration::kMostUncertain},
                    {"how", number.how}});
}

Json RenderTest(const Protocol& protocol, const catalog::Part& part, const TestSensor& sensor) {
  Json test = {{"protocol", protocol.name},
               {"numbers", Json::array()},
               {"steps", StepsOf(protocol.name, part.family)},
               {"equipment", nullptr},
               {"recording", nullptr},
               {"precision", Json::array()},
               {"warnings", Json::array()}};
  for (const std::string_view number : protocol.numbers) test["numbers"].push_back(number);
  if (protocol.name == "bottle_test")
    if (const std::optional<BottleTest> bottle = MakeBottleTest(part, sensor)) {
      Precision precision = PrecisionOfTest(*bottle, part, sensor);
      test["precision"] = std::move(precision.rows);
      test["warnings"] = std::move(precision.warnings);
      test["equipment"] = Equipment(*bottle);
      test["recording"] = Recording(*bottle, part);
    }
  AddByHand(protocol, part, sensor, test["precision"]);
  return test;
}

// Of every part with a mass: no recording tells it.
Json RenderWeighing(const catalog::Part& part, const std::string& field) {
  Json rows = Json::array();
  for (const ReadNumber& number : WeighingOf(part, field))
    rows.push_back({{"field", number.field},
                    {"uncertainty", Number(number.uncertainty)},
                    {"from_noise", Number(number.uncertainty)},
                    {"from_rig", 0.0},
                    {"told", true},
                    {"how", number.how}});
  return {{"protocol", "weighing"},
          {"numbers", Json::array({field})},
          {"steps", WeighingSteps(part, field)},
          {"equipment", nullptr},
          {"recording", nullptr},
          {"precision", std::move(rows)},
          {"warnings", Json::array()}};
}

}  // namespace

Json RenderProtocol(const catalog::Part& part, const TestSensor& sensor) {
  Json document = AnswerDocument("protocol/1");
  document.update({{"part", part.id},
                   {"family", part.family},
                   {"sensor",
                    {{"noise_kpa", Number(sensor.noise_kpa)},
                     {"resolution_kpa", Number(sensor.resolution_kpa)},
                     {"sampling_hz", Number(sensor.sampling_hz)}}},
                   {"tests", Json::array()}});
  for (const Protocol& protocol : Protocols())
    if (protocol.family == part.family)
      document["tests"].push_back(RenderTest(protocol, part, sensor));
  for (const char* field : {"mass_kg", "mass_kg_per_m"})
    if (NumberOf(part, field) > 0.0) document["tests"].push_back(RenderWeighing(part, field));
  return document;
}

}  // namespace plenum::api
