#include "api/measure/stated_document.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "api/json/reader.h"
#include "api/json/request_limits.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/rig/chamber_words.h"
#include "calibration/judge/verdict.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::Factors;
using calibration::Run;
using calibration::StatedModel;
using calibration::StatedRun;

constexpr double kMeasuredMax = 1e3;
constexpr double kStatedFactorMax = 1e6, kAnySeconds = 1e9, kAnyKpa = 1e9;

Json RenderFactors(const Factors& factors) {
  Json document = Json::object();
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (factors[i] != 1.0)
      document[std::string(calibration::Name(static_cast<calibration::Declared>(i)))] =
          Number(factors[i]);
  return document;
}

Factors ReadFactors(Reader& owner) {
  Factors factors;
  factors.fill(1.0);
  auto reader = owner.OptionalObject("factors");
  if (!reader) return factors;
  for (std::size_t i = 0; i < factors.size(); ++i)
    factors[i] = reader->Number(calibration::Name(static_cast<calibration::Declared>(i)),
                                Above(0, kStatedFactorMax), 1.0);
  reader->Finish();
  return factors;
}

// By Dataset::measured, in SI; of a pump what its delivery falls by from point to point.
Json RenderMeasured(const std::vector<double>& measured) {
  Json list = Json::array();
  for (const double value : measured) list.push_back(Number(value));
  return list;
}

std::vector<double> ReadMeasured(Reader& owner, const Dataset& dataset) {
  const std::size_t count = dataset.measured.size();
  if (count == 0) return {};
  std::vector<double> measured = owner.Numbers("measured_si", count, {0, kMeasuredMax});
  if (measured.size() != count)
    owner.Fail("measured_si", "must have a value for each of the " + std::to_string(count) +
                                  " numbers that the rigs measure");
  measured.resize(count);
  return measured;
}

Json RenderOwn(const StatedModel& model, std::size_t index, const Run& run) {
  const calibration::ModelState& state = model.state;
  Json own = {{"initial_pressure_kpa_gauge",
               Number(KpaGaugeFromPa(state.initial_pressure_pa[index], run.ambient))},
              {"initial_temperature_k", Number(state.initial_temperature_k[index])},
              {"clock_s", Number(state.clock_s[index])}};
  if (state.phase_rad[index] != 0.0) own["phase_rad"] = Number(state.phase_rad[index]);
  for (const double late_s : state.late_s[index]) own["late_s"].push_back(Number(late_s));
  for (std::size_t k = 0; k < state.moved_s[index].size(); ++k)
    own["valve_s"].push_back(
        Number(run.valve[k].time_s + calibration::MovedBy(run, index, k, state)));
  if (model.run_factor[index] != state.factor)
    own["factors"] = RenderFactors(model.run_factor[index]);
  if (!model.fitted_alone[index].empty()) own["fitted_alone"] = model.fitted_alone[index];
  return own;
}

// By how much the commands come after the recorded instants, where those are not exact.
std::vector<double> ReadInstants(Reader& own, const Run& run) {
  const std::size_t count = run.valve_uncertainty_s.size();
  if (count == 0) return {};
  std::vector<double> moved_s = own.Numbers("valve_s", count, {-kAnySeconds, kAnySeconds});
  if (moved_s.size() != count)
    own.Fail("valve_s",
             "must have a time for each of the run's " + std::to_string(count) + " commands");
  moved_s.resize(count);
  for (std::size_t k = 0; k < count; ++k) moved_s[k] -= run.valve[k].time_s;
  return moved_s;
}

void ReadOwn(Reader own, const Run& run, std::size_t index, StatedModel& model) {
  calibration::ModelState& state = model.state;
  const double kpa = own.Number("initial_pressure_kpa_gauge", {-kAnyKpa, kAnyKpa});
  state.initial_pressure_pa[index] = PaFromKpaGauge(kpa, run.ambient);
  state.initial_temperature_k[index] = own.Number("initial_temperature_k", Above(0, 1e6));
  state.clock_s[index] = own.Number("clock_s", {-kAnySeconds, kAnySeconds});
  state.phase_rad[index] = own.Number("phase_rad", {-kAnySeconds, kAnySeconds}, 0.0);
  if (own.Has("late_s"))
    state.late_s[index] = own.Numbers("late_s", kCommandsMax, {-kAnySeconds, kAnySeconds});
  if (!state.late_s[index].empty() && state.late_s[index].size() != run.valve.size())
    own.Fail("late_s", "must have a time for each of the run's " +
                           std::to_string(run.valve.size()) + " commands");
  state.moved_s[index] = ReadInstants(own, run);
  model.run_factor[index] = own.Has("factors") ? ReadFactors(own) : state.factor;
}

Json RenderLeftOut(const std::vector<std::size_t>& left_out) {
  Json list = Json::array();
  for (const std::size_t i : left_out) list.push_back(static_cast<std::uint64_t>(i));
  return list;
}

StatedRun ReadHow(Reader& reader, const Dataset& dataset, const Run& run) {
  StatedRun how;
  const std::string original = reader.Text("copy_of", "");
  for (std::size_t i = 0; i < dataset.runs.size(); ++i)
    if (dataset.runs[i].id == original) how.copy_of = i;
  how.relative_tolerance = reader.Number("relative_tolerance", Above(0, 1));
  if (!reader.Has("left_out") || reader.Raw("left_out")->empty()) return how;
  const Range indices{0, static_cast<double>(run.t_s.size()) - 1};
  for (const double i : reader.Numbers("left_out", run.t_s.size(), indices))
    if (!std::isnan(i)) how.left_out.push_back(static_cast<std::size_t>(i));
  std::sort(how.left_out.begin(), how.left_out.end());
  return how;
}

// The models that a diagnosis states, by name.
std::vector<std::pair<const char*, const StatedModel*>> ModelsOf(
    const calibration::Diagnosis& diagnosis) {
  const calibration::StatedModels& models = diagnosis.models;
  std::vector<std::pair<const char*, const StatedModel*>> named = {
      {"declared", &models.declared}, {"before", &models.before}, {"after", &models.after}};
  if (models.learned) named.emplace_back("learned", &*models.learned);
  return named;
}

// Whether `after` predicts runs that no fit saw better than `before`: null where it is the same
// model or no run was left for that.
Json PredictsBetter(const calibration::Diagnosis& diagnosis) {
  const bool named =
      !diagnosis.effects.empty() || !diagnosis.numbers.empty() || !diagnosis.tied.empty();
  const auto better =
      calibration::PredictsBetter(diagnosis.before.holdout_rms_pa, diagnosis.after.holdout_rms_pa);
  return named && better ? Json(*better) : Json(nullptr);
}

}  // namespace

void AddStatedModels(const calibration::Diagnosis& diagnosis, const Dataset& dataset,
                     Json& answer) {
  answer["predicts_better"] = PredictsBetter(diagnosis);
  answer["runs"] = answer["held_out_fitted"] = Json::array();
  const auto models = ModelsOf(diagnosis);
  for (const auto& [name, model] : models) {
    answer[name]["effects"] = RenderPlaced(model->state.effects, dataset);
    answer[name]["factors"] = RenderFactors(model->state.factor);
    if (!dataset.measured.empty())
      answer[name]["measured_si"] = RenderMeasured(model->state.measured);
    if (dataset.several)
      answer[name]["chamber_factors"] = RenderChamberFactors(model->state, dataset);
  }
  for (std::size_t i = 0; i < diagnosis.models.runs.size(); ++i) {
    const Run& run = dataset.runs[i];
    const bool held_out =
        std::find(dataset.holdout.begin(), dataset.holdout.end(), run.id) != dataset.holdout.end();
    Json document = {{"id", run.id},
                     {"held_out", held_out},
                     {"relative_tolerance", Number(diagnosis.models.runs[i].relative_tolerance)},
                     {"left_out", RenderLeftOut(diagnosis.models.runs[i].left_out)}};
    if (const auto original = diagnosis.models.runs[i].copy_of)
      document["copy_of"] = dataset.runs[*original].id;
    for (const auto& [name, model] : models) document[name] = RenderOwn(*model, i, run);
    answer["runs"].push_back(std::move(document));
    const std::vector<std::string>& alone = diagnosis.models.after.fitted_alone[i];
    if (!alone.empty()) answer["held_out_fitted"].push_back({{"run", run.id}, {"numbers", alone}});
  }
}

Parsed<StatedAnswer> ParseStatedModel(const Json& answer, const std::string& model,
                                      const Dataset& dataset) {
  Errors errors;
  StatedAnswer stated;
  Reader reader(answer, "", errors);
  if (!reader.Has(model)) return Errors{{"/" + model, "the diagnosis has no such model"}};
  Reader of_all = reader.Object(model);
  const std::size_t count = dataset.runs.size();
  calibration::ModelState& state = stated.model.state;
  state.effects = ReadPlaced(of_all, dataset);
  state.factor = ReadFactors(of_all);
  stated.model.several = dataset.several;
  ReadChamberFactors(of_all, dataset, state);
  state.measured = ReadMeasured(of_all, dataset);
  state.initial_pressure_pa.resize(count);
  state.initial_temperature_k.resize(count);
  state.clock_s.resize(count);
  state.phase_rad.resize(count);
  state.late_s.resize(count);
  state.moved_s.resize(count);
  stated.model.run_factor.resize(count);
  stated.model.fitted_alone.resize(count);
  const std::vector<Element> runs = reader.List("runs", count, count);
  for (std::size_t i = 0; i < runs.size() && i < count; ++i) {
    Reader run(runs[i], errors);
    if (const std::string id = run.Text("id"); id != dataset.runs[i].id)
      run.Fail("id", "must be " + Quoted(dataset.runs[i].id) + ", as in the measurement");
    stated.runs.push_back(ReadHow(run, dataset, dataset.runs[i]));
    ReadOwn(run.Object(model), dataset.runs[i], i, stated.model);
  }
  if (errors.empty() && !dataset.several)  // of each chamber when it is simulated
    if (const std::string why = model::WhyInvalid(state.effects); !why.empty())
      errors.push_back({"/" + model + "/effects", why});
  if (!errors.empty()) return errors;
  return stated;
}

}  // namespace plenum::api
