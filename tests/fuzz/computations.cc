#include "tests/fuzz/computations.h"

#include <atomic>
#include <memory>
#include <optional>

#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/verification.h"
#include "api/json/json.h"
#include "api/measure/csv/measurement_csv.h"
#include "api/measure/diagnose_request.h"
#include "api/simulate/simulation.h"
#include "catalog/fields/csv.h"
#include "catalog/fields/fields.h"
#include "optimizer/problem/problem.h"
#include "tests/api/support.h"
#include "tests/fuzz/targets.h"

namespace plenum::fuzz {
namespace {

constexpr double kSeconds = 0.05;
constexpr int kLooks = 200;          // at whether to stop
constexpr int kLooksOfVerify = 100;  // a look may come after many steps of the simulator
constexpr int kDraws = 4;

const std::vector<catalog::Part>& Parts() {
  static const std::vector<catalog::Part> parts = api::SmallCatalogueWithVacuum();
  return parts;
}

std::optional<api::Json> DocumentOf(std::string_view text) {
  auto json = api::ParseJson(text);
  if (auto* document = std::get_if<api::Json>(&json)) return std::move(*document);
  return std::nullopt;
}

// Several threads may ask.
std::function<bool()> AfterLooks(int looks) {
  return [left = std::make_shared<std::atomic<int>>(looks)] { return --*left < 0; };
}

void RequireSound(const api::Json& answer) {
  Require(!answer.dump(-1, ' ', false, api::Json::error_handler_t::replace).empty());
}

void RequireSound(const api::Parsed<api::Json>& answer) {
  if (const auto* json = std::get_if<api::Json>(&answer)) return RequireSound(*json);
  const auto& errors = std::get<api::Errors>(answer);
  Require(!errors.empty());
  for (const api::Error& error : errors) Require(!error.detail.empty());
}

// Searches within the limits.
void Run(api::DesignRequest request, const std::vector<catalog::Part>& parts) {
  request.time_limit_s = std::min(request.time_limit_s, kSeconds);
  if (request.robust)
    request.robust->options.draws = std::min(request.robust->options.draws, kDraws);
  if (request.explain)
    request.explain->time_limit_s = std::min(request.explain->time_limit_s, kSeconds);
  optimizer::SearchOptions options;
  options.cancelled = AfterLooks(kLooks);
  RequireSound(api::AnswerRequest(request, options, parts));
}

}  // namespace

void Design(std::string_view text) {
  const auto document = DocumentOf(text);
  if (!document) return;
  auto parsed = api::ParseRequirements(*document, Parts());
  if (auto* request = std::get_if<api::DesignRequest>(&parsed)) Run(std::move(*request), Parts());
}

void Evaluation(std::string_view text) {
  if (const auto document = DocumentOf(text))
    RequireSound(api::RunEvaluation(*document, Parts(), {}, kSeconds));
}

void Simulation(std::string_view text) {
  if (const auto document = DocumentOf(text))
    RequireSound(api::RunSimulation(*document, Parts(), kSeconds));
}

void Diagnosis(std::string_view text) {
  const auto document = DocumentOf(text);
  if (!document) return;
  auto parsed = api::ParseMeasurement(*document);
  auto* dataset = std::get_if<calibration::Dataset>(&parsed);
  if (dataset == nullptr) return;
  api::DiagnosisRequest request;
  request.dataset = std::move(*dataset);
  request.time_limit_s = kSeconds;
  RequireSound(api::RunDiagnosis(request, {}).answer);
}

void Recording(std::string_view text) {
  static const api::Json kRig = api::Json::parse(R"({
    "actuator": { "rest_volume_ml": 50, "expansion_ratio": 1, "operating_pressure_kpa_gauge": 100 },
    "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
    "supply": { "kind": "regulated", "source_pressure_kpa_gauge": 200 } })");
  const api::CsvReading reading = api::ReadMeasurementCsv(text, kRig);
  Require(reading.document.is_null() || reading.errors.empty());
  Require(!reading.document.is_null() || !reading.errors.empty() || !reading.questions.empty());
  if (!reading.document.is_null()) Diagnosis(reading.document.dump());
}

void Import(std::string_view text) {
  if (text.empty()) return;
  const auto families = catalog::Families();
  const std::string family(families[static_cast<unsigned char>(text[0]) % families.size()].name);
  const auto csv = catalog::ReadCsv(family, text.substr(1));
  if (!csv.errors.empty() || csv.parts.empty()) return;
  std::vector<catalog::Part> parts;
  for (const catalog::Part& part : Parts())
    if (part.family != family) parts.push_back(part);
  parts.insert(parts.end(), csv.parts.begin(), csv.parts.end());
  api::Json asked = api::Requirements();
  asked.erase("require");
  asked.erase("exclude");
  auto parsed = api::ParseRequirements(asked, parts);
  if (auto* request = std::get_if<api::DesignRequest>(&parsed)) Run(std::move(*request), parts);
}

api::Parsed<api::Json> VerifyWithinLimit(const api::Json& answer) {
  // The revision that the answer names is the one on the table.
  catalog::Revision revision;
  const auto hash = answer.contains("/catalogue_revision/hash"_json_pointer)
                        ? answer.at("/catalogue_revision/hash"_json_pointer)
                        : api::Json();
  if (hash.is_string()) revision.hash = hash.get<std::string>();
  return api::VerifyAnswer(answer, Parts(), revision, {}, AfterLooks(kLooksOfVerify));
}

void Verify(std::string_view text) {
  if (const auto document = DocumentOf(text)) RequireSound(VerifyWithinLimit(*document));
}

}  // namespace plenum::fuzz
