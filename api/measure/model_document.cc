#include "api/measure/model_document.h"

#include <algorithm>
#include <limits>

#include "api/json/reader.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/simulate/effects.h"

namespace plenum::api {
namespace {

constexpr std::size_t kDataMax = 10'000;
constexpr std::size_t kParametersMax = 1'000;
constexpr std::size_t kSetsMax = 1'000;

Json Rows(const std::vector<std::vector<double>>& rows) {
  Json list = Json::array();
  for (const std::vector<double>& row : rows) {
    Json numbers = Json::array();
    for (const double value : row) numbers.push_back(Number(value));
    list.push_back(std::move(numbers));
  }
  return list;
}

void ReadFactors(Reader& reader, SavedModel& model) {
  auto factors = reader.OptionalObject("factors");
  if (!factors) return;
  for (int i = 0; i < calibration::kDeclaredCount; ++i) {
    const auto number = static_cast<calibration::Declared>(i);
    if (const auto factor = factors->OptionalNumber(calibration::Name(number), Above(0, 1e6)))
      model.factors.emplace_back(number, *factor);
  }
  factors->Finish();
}

void ReadCovariance(Reader& reader, SavedModel::Covariance& covariance) {
  auto object = reader.OptionalObject("covariance");
  if (!object) return;
  object->Describe("parameters", {{"type", "array"}, {"items", {{"type", "string"}}}});
  object->Describe("matrix", {{"type", "array"},
                              {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}});
  for (const Element& name : object->List("parameters", 0, kParametersMax)) {
    if (name.value->is_string())
      covariance.parameters.push_back(name.value->get<std::string>());
    else
      object->FailAt("parameters", "must hold texts");
  }
  bool square = true;
  for (const Element& row : object->List("matrix", 0, kParametersMax)) {
    std::vector<double>& numbers = covariance.rows.emplace_back();
    if (row.value->is_array())
      for (const Json& value : *row.value)
        numbers.push_back(value.is_number() ? value.get<double>()
                                            : std::numeric_limits<double>::quiet_NaN());
    square = square && numbers.size() == covariance.parameters.size();
  }
  if (!square || covariance.rows.size() != covariance.parameters.size())
    object->Fail("matrix", "must have a row and a column for each of the parameters");
  object->Finish();
}

void ReadData(Reader& reader, SavedModel& model) {
  if (!reader.Has("data")) return;
  for (const Element& element : reader.List("data", 0, kDataMax)) {
    Reader data(element, reader.errors());
    model.data.push_back({data.Text("name", ""), data.Text("sha256")});
    data.Finish();
  }
}

void ReadTied(Reader& reader, SavedModel& model) {
  reader.Describe(
      "tied", {{"type", "array"}, {"items", {{"type", "array"}, {"items", {{"type", "string"}}}}}});
  if (!reader.Has("tied")) return;
  for (const Element& set : reader.List("tied", 0, kSetsMax)) {
    std::vector<std::string>& ids = model.tied.emplace_back();
    if (!set.value->is_array()) {
      reader.FailAt("tied", "must hold lists of effects");
      continue;
    }
    for (const Json& id : *set.value)
      if (id.is_string())
        ids.push_back(id.get<std::string>());
      else
        reader.FailAt("tied", "must hold lists of texts");
  }
}

}  // namespace

Json RenderModel(const SavedModel& model) {
  Json factors = Json::object();
  for (const auto& [number, factor] : model.factors)
    factors[std::string(calibration::Name(number))] = Number(factor);
  Json data = Json::array();
  for (const SavedModel::Data& file : model.data)
    data.push_back({{"name", file.name}, {"sha256", file.sha256}});
  Json document = {
      {"schema", "model/1"},
      {"effects", RenderEffects(model.effects)},
      {"factors", std::move(factors)},
      {"covariance",
       {{"parameters", model.covariance.parameters}, {"matrix", Rows(model.covariance.rows)}}},
      {"data", std::move(data)},
      {"noise_kpa", Number(model.noise_pa / kPaPerKpa)},
      {"before_rms_kpa", Number(model.before_rms_pa / kPaPerKpa)},
      {"after_rms_kpa", Number(model.after_rms_pa / kPaPerKpa)},
      {"holdout_rms_kpa",
       model.holdout_rms_pa ? Number(*model.holdout_rms_pa / kPaPerKpa) : Json()}};
  if (!model.tied.empty()) document["tied"] = model.tied;
  return document;
}

Parsed<SavedModel> ParseModel(const Json& document) {
  Errors errors;
  SavedModel model;
  Reader reader(document, "", errors);
  reader.Schema("model/1");
  model.effects = ReadEffects(reader);
  ReadFactors(reader, model);
  ReadCovariance(reader, model.covariance);
  ReadData(reader, model);
  ReadTied(reader, model);
  const auto error = [&](const char* name) { return reader.OptionalNumber(name, {0, 1e9}); };
  model.noise_pa = error("noise_kpa").value_or(0.0) * kPaPerKpa;
  model.before_rms_pa = error("before_rms_kpa").value_or(0.0) * kPaPerKpa;
  model.after_rms_pa = error("after_rms_kpa").value_or(0.0) * kPaPerKpa;
  if (const auto holdout = error("holdout_rms_kpa")) model.holdout_rms_pa = *holdout * kPaPerKpa;
  reader.Finish();
  if (errors.empty())
    if (const std::string why = model::WhyInvalid(model.effects); !why.empty())
      errors.push_back({"/effects", why});
  if (!errors.empty()) return errors;
  return model;
}

Parsed<SavedModel> FindModel(const std::string& name,
                             const std::vector<catalog::ModelRevision>& models,
                             const std::string& pointer) {
  const auto found = std::find_if(models.begin(), models.end(),
                                  [&](const catalog::ModelRevision& m) { return m.name == name; });
  if (found == models.end()) {
    std::string known = "nominal";
    for (const catalog::ModelRevision& model : models) known += ", " + model.name;
    return Errors{{pointer, "no model revision is named " + Quoted(name) +
                                "; available: " + Clip(known, 500)}};
  }
  const auto json = ParseJson(found->document);
  if (std::holds_alternative<Json>(json)) {
    auto model = ParseModel(std::get<Json>(json));
    if (std::holds_alternative<SavedModel>(model)) return model;
  }
  return Errors{{pointer, "the model revision " + Quoted(name) +
                              " cannot be read by this program: save it again"}};
}

Json RenderModelRevision(const catalog::ModelRevision& revision, bool with_document) {
  Json json = {{"name", revision.name},
               {"version", revision.version},
               {"at", revision.at},
               {"who", revision.who},
               {"hash", revision.hash}};
  if (!with_document) return json;
  auto document = ParseJson(revision.document);
  json["model"] =
      std::holds_alternative<Json>(document) ? std::get<Json>(std::move(document)) : Json();
  return json;
}

}  // namespace plenum::api
