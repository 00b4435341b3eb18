#include "bench/loop/testing.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "api/measure/diagnose_request.h"
#include "api/measure/rig_parts.h"
#include "api/protocol/part_revision.h"
#include "api/protocol/protocol_document.h"
#include "api/protocol/test_sensor.h"
#include "api/protocol/test_steps.h"
#include "bench/loop/bottle.h"

namespace plenum::bench {
namespace {

using api::Json;

// As the command of a pump's protocol says.
constexpr double kDiagnosisS = 300.0;
constexpr double kWeighed = 0.002;  // of the bottle, full of water

Json TestOf(const catalog::Part& known, const std::string& protocol) {
  const Json document = api::RenderProtocol(known, {.bottle_uncertainty = kWeighed});
  for (const Json& test : document.at("tests"))
    if (test.at("protocol") == protocol) return test;
  throw std::runtime_error(known.id + " has no protocol " + protocol);
}

Json Diagnosed(const Json& measurement, const catalog::Part& known) {
  api::Errors errors;
  api::DiagnosisRequest request;
  request.measurement = api::WithParts(measurement, {known}, errors);
  auto dataset = api::ParseMeasurement(request.measurement);
  if (auto* wrong = std::get_if<api::Errors>(&dataset))
    errors.insert(errors.end(), wrong->begin(), wrong->end());
  if (!errors.empty())
    throw std::runtime_error(known.id + ": " + errors[0].pointer + " " + errors[0].detail);
  request.dataset = std::get<calibration::Dataset>(std::move(dataset));
  request.time_limit_s = kDiagnosisS;
  return api::RunDiagnosis(request, {}).answer;
}

double TruthOf(const catalog::Part& truth, const Json& row) {
  if (row.at("field") != "free_air")
    return truth.numbers.at(row.at("field").get<std::string>()).value;
  const double kpa = row.at("pressure_kpa_gauge").get<double>();
  const auto point = std::min_element(
      truth.curve->points.begin(), truth.curve->points.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.pressure_kpa_gauge - kpa) < std::abs(b.pressure_kpa_gauge - kpa);
      });
  return point->free_air_l_per_min;
}

bool Contradicted(const Json& told) {
  return std::any_of(told.at("numbers").begin(), told.at("numbers").end(),
                     [](const Json& number) { return !number.at("contradiction").is_null(); });
}

void SaveBottleTest(const Json& measurement, const catalog::Part& truth, Tested& tested) {
  const Json answer = Diagnosed(measurement, tested.part);
  tested.told["verdict"] = answer.at("verdict");
  tested.told["effects"] = answer.at("effects");
  tested.told["tied"] = answer.at("tied");
  const std::string text = measurement.dump();
  const std::vector files{api::FileOf(tested.part.id + ".json", text)};
  api::PartRevision revision = api::RevisePart(tested.part, answer, files, false);
  tested.told["contradicted"] = Contradicted(revision.told);
  if (!revision.part) revision = api::RevisePart(tested.part, answer, files, true);
  tested.told["refused"] = revision.told.at("refused");
  for (const Json& row : answer.at("measured")) {
    Json number;
    for (const char* field : {"field", "pressure_kpa_gauge", "declared", "fitted", "uncertainty",
                              "interval_95", "refused"})
      if (row.contains(field)) number[field] = row.at(field);
    number["truth"] = TruthOf(truth, row);
    number["saved"] = revision.part.has_value() && row.at("refused").is_null();
    tested.told["numbers"].push_back(std::move(number));
  }
  if (revision.part) tested.part = std::move(*revision.part);
}

// By every one of the ways that the protocol offers, the most precise first.
void TypeReadings(const std::string& protocol, const catalog::Part& truth, test::Random& random,
                  catalog::Part& known) {
  std::vector<api::ReadNumber> readings = api::ReadByHand(protocol, known, {});
  std::stable_sort(readings.begin(), readings.end(),
                   [](const auto& a, const auto& b) { return a.uncertainty < b.uncertainty; });
  std::set<std::string> typed;
  for (const api::ReadNumber& reading : readings) {
    if (!typed.insert(reading.field).second) continue;
    const double off = 1.0 + reading.uncertainty * random.Normal();
    if (reading.field == "current" && known.curve) {
      for (std::size_t i = 0; i < known.curve->points.size(); ++i)
        known.curve->points[i].current_a = off * truth.curve->points[i].current_a;
      known.curve->current_provenance = catalog::Provenance::kMeasured;
      known.curve->current_uncertainty = reading.uncertainty;
    } else if (const auto number = known.numbers.find(reading.field);
               number != known.numbers.end()) {
      number->second = {.value = off * truth.numbers.at(reading.field).value,
                        .provenance = catalog::Provenance::kMeasured,
                        .source = protocol,
                        .uncertainty = reading.uncertainty};
    }
  }
}

}  // namespace

Tested TestPart(const catalog::Part& known, const catalog::Part& truth, const std::string& protocol,
                test::Random& random) {
  const auto start = std::chrono::steady_clock::now();
  Tested tested{known,
                {{"part", known.id},
                 {"family", known.family},
                 {"protocol", protocol},
                 {"verdict", nullptr},
                 {"refused", Json::array()},
                 {"contradicted", false},
                 {"numbers", Json::array()}}};
  const Json test = TestOf(known, protocol);
  if (!test.at("recording").is_null())
    SaveBottleTest(RecordBottleTest(test, truth, random), truth, tested);
  TypeReadings(protocol, truth, random, tested.part);
  tested.told["seconds"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return tested;
}

}  // namespace plenum::bench
