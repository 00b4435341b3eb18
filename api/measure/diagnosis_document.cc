#include "api/measure/diagnosis_document.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "api/json/units.h"
#include "api/json/version.h"
#include "api/measure/fitted/fitted_numbers.h"
#include "api/measure/fitted/specimens_document.h"
#include "api/measure/measured_document.h"
#include "api/measure/rig/chamber_words.h"
#include "api/measure/stated_document.h"
#include "api/measure/words/effect_words.h"
#include "api/simulate/effects.h"
#include "calibration/noise/phases.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::Diagnosis;
using calibration::Phase;
using calibration::Run;

const char* Name(calibration::Verdict verdict) {
  switch (verdict) {
    case calibration::Verdict::kAdequate:
      return "adequate";
    case calibration::Verdict::kExplained:
      return "explained";
    case calibration::Verdict::kTie:
      return "tie";
    case calibration::Verdict::kUnexplained:
      return "unexplained";
    case calibration::Verdict::kUndecided:
      break;
  }
  return "undecided";
}

const char* Name(model::EffectPlace place) {
  switch (place) {
    case model::EffectPlace::kValve:
      return "valve";
    case model::EffectPlace::kLine:
      return "line";
    case model::EffectPlace::kVolume:
      return "volume";
    case model::EffectPlace::kEnergy:
      return "energy";
    case model::EffectPlace::kSupply:
      return "supply";
    case model::EffectPlace::kSensor:
      return "sensor";
    case model::EffectPlace::kChamber:
      break;
  }
  return "chamber";
}

const char* Name(model::ValveState state) {
  if (state == model::ValveState::kInflate) return "inflate";
  return state == model::ValveState::kDeflate ? "deflate" : "hold";
}

Json Kpa(double pa) { return Number(pa / kPaPerKpa); }
Json Kpa(const std::optional<double>& pa) { return pa ? Kpa(*pa) : Json(nullptr); }

Json RenderError(const calibration::ErrorReport& error) {
  Json runs = Json::object();
  for (const auto& [run, rms_pa] : error.run_rms_pa) runs[run] = Kpa(rms_pa);
  return {{"rms_kpa", Kpa(error.rms_pa)},
          {"rms_percent", Number(100.0 * error.rms_share)},
          {"peak_kpa", Kpa(error.peak_pa)},
          {"holdout_rms_kpa", Kpa(error.holdout_rms_pa)},
          {"runs", std::move(runs)}};
}

// The parameters of the effect, where it has no estimates (a learned term) with no interval.
Json RenderEffect(const calibration::FittedEffect& fitted, const Dataset& dataset) {
  const model::EffectSpec& spec = *fitted.effect.spec;
  Json parameters = Json::object();
  if (!spec.law.empty()) parameters["law"] = spec.law;
  for (std::size_t i = 0; i < spec.parameters.size() && i < fitted.parameters.size(); ++i) {
    const ContractParameter parameter = InContract(spec.parameters[i]);
    parameters[parameter.name] = RenderEstimate(fitted.parameters[i], parameter.factor);
  }
  Json effect = {{"id", spec.id},
                 {"parameters", std::move(parameters)},
                 {"words", EffectInWords(fitted.effect, ScaleOf(dataset, fitted.effect))}};
  PutChamber(spec, dataset, effect);
  return effect;
}

// "leak:porous" as id and law; "number:source_pressure" is an id.
std::pair<std::string, std::string> IdAndLaw(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos || name.starts_with("number:")) return {name, ""};
  return {name.substr(0, colon), name.substr(colon + 1)};
}

Json Ids(const std::vector<std::string>& names) {
  Json ids = Json::array();
  for (const std::string& name : names) ids.push_back(IdAndLaw(name).first);
  return ids;
}

Json Laws(const std::vector<std::string>& names) {
  Json laws = Json::object();
  for (const std::string& name : names)
    if (const auto [id, law] = IdAndLaw(name); !law.empty()) laws[id] = law;
  return laws;
}

Json RenderCandidate(const calibration::Candidate& candidate) {
  return {{"effects", Ids(candidate.effects)},
          {"bic", Number(candidate.bic)},
          {"delta_bic", Number(candidate.delta_bic)},
          {"rms_kpa", Kpa(candidate.rms_pa)},
          {"holdout_rms_kpa", Kpa(candidate.holdout_rms_pa)},
          {"laws", Laws(candidate.effects)},
          {"parameters", candidate.parameters},
          {"converged", candidate.converged},
          {"starts", candidate.starts},
          {"found_again", candidate.found_again},
          {"reason", candidate.reason.empty() ? Json(nullptr) : Json(candidate.reason)}};
}

Json RenderResidual(const calibration::ResidualReport& residual) {
  Json phases = Json::array();
  for (const calibration::PhaseResidual& phase : residual.phases)
    phases.push_back({{"run", phase.run},
                      {"phase", Name(phase.phase)},
                      {"mean_kpa", Kpa(phase.mean_pa)},
                      {"trend_kpa_per_s", Kpa(phase.trend_pa_per_s)},
                      {"rms_kpa", Kpa(phase.rms_pa)},
                      {"cycle", phase.cycle},
                      {"start_s", Number(phase.start_s)},
                      {"end_s", Number(phase.end_s)},
                      {"samples", phase.samples}});
  const auto tested = [&](bool passed) { return residual.tested ? Json(passed) : Json(nullptr); };
  return {{"white", tested(residual.white)},
          {"independent_of_inputs", tested(residual.independent_of_inputs)},
          {"phases", std::move(phases)},
          {"portmanteau", Number(residual.portmanteau)},
          {"portmanteau_limit", Number(residual.portmanteau_limit)},
          {"cross", Number(residual.cross)},
          {"cross_limit", Number(residual.cross_limit)},
          {"lack_of_fit", Number(residual.lack_of_fit)},
          {"lack_of_fit_limit", Number(residual.lack_of_fit_limit)}};
}

Json RenderStability(const calibration::StabilityChange& change) {
  return {{"change", change.change},
          {"delta_bic", change.delta_bic ? Number(*change.delta_bic) : Json(nullptr)},
          {"holds", change.holds}};
}

// As a measurement's run, with what to measure and what to expect; the samples are even.
Json RenderExperiment(const calibration::Experiment& experiment, const Dataset& dataset) {
  const Run& run = experiment.run;
  Json document = {{"id", run.id}, {"blocked", run.blocked}};
  if (!dataset.specimens.empty())
    document[dataset.several ? "chamber" : "specimen"] =
        SpecimenName(dataset.specimens[run.specimen]);
  if (run.source_pressure_pa > 0.0)
    document["source_pressure_kpa_gauge"] =
        Number(KpaGaugeFromPa(run.source_pressure_pa, run.ambient));
  if (run.initial_pressure_pa) {
    document["initial"] = {
        {"pressure_kpa_gauge", Number(KpaGaugeFromPa(*run.initial_pressure_pa, run.ambient))}};
    if (run.initial_temperature_k)
      document["initial"]["temperature_k"] = Number(*run.initial_temperature_k);
  }
  Json valve = Json::array();
  for (const model::ValveCommand& command : run.valve)
    valve.push_back({{"t_s", Number(command.time_s)}, {"state", Name(command.state)}});
  document["valve"] = std::move(valve);
  if (run.t_s.size() > 1) {
    document["t_end_s"] = Number(run.t_s.back());
    document["sample_hz"] =
        Number(static_cast<double>(run.t_s.size() - 1) / (run.t_s.back() - run.t_s.front()));
    document["t_s"] = Json::array();
    for (const double t : run.t_s) document["t_s"].push_back(Number(std::round(t * 1e6) / 1e6));
  }
  Json measure = {"pressure_kpa_gauge"};
  for (const std::string& channel : experiment.measure) measure.push_back(channel);
  document["measure"] = std::move(measure);
  document["expected_difference_kpa"] = Kpa(experiment.expected_difference_pa);
  document["expected_delta_bic"] = Number(experiment.expected_delta_bic);
  document["why"] = experiment.why;
  return document;
}

// Effects and fitted numbers beside a learned term are not those without it.
Json RenderDiscrepancy(const calibration::Discrepancy& discrepancy, const Dataset& dataset) {
  Json places = Json::array();
  for (const auto& place : discrepancy.places)
    places.push_back(
        {{"axis", place.axis}, {"where", place.where}, {"share", Number(place.share)}});
  Json effects = Json::array();
  for (std::size_t i = 0; i + 1 < discrepancy.beside.effects.size(); ++i)
    effects.push_back(RenderEffect(discrepancy.beside.effects[i], dataset));
  return {{"equation", Name(discrepancy.equation)},
          {"features", discrepancy.features},
          {"learned",
           discrepancy.learned ? RenderEffect(*discrepancy.learned, dataset) : Json(nullptr)},
          {"effects", std::move(effects)},
          {"fitted", RenderFitted(discrepancy.beside.fitted, dataset)},
          {"rms_before_kpa", Kpa(discrepancy.rms_before_pa)},
          {"rms_after_kpa", Kpa(discrepancy.rms_after_pa)},
          {"holdout_before_kpa", Kpa(discrepancy.holdout_before_pa)},
          {"holdout_after_kpa", Kpa(discrepancy.holdout_after_pa)},
          {"places", std::move(places)}};
}

// Pressures to 0.1 Pa and times to 1 µs: below what any sensor shows.
Json RenderSeries(const calibration::Series& series, const Dataset& dataset) {
  const auto run = std::find_if(dataset.runs.begin(), dataset.runs.end(),
                                [&](const Run& one) { return one.id == series.run; });
  const double ambient =
      run == dataset.runs.end() ? model::kReferencePressurePa : run->ambient.pressure_pa;
  const auto gauge = [&](const std::vector<double>& pressure_pa) {
    Json list = Json::array();
    for (const double pa : pressure_pa)
      list.push_back(Number(std::round((pa - ambient) * 10) / 1e4));
    return list;
  };
  Json phase = Json::array(), t_s = Json::array();
  for (const Phase one : series.phase) phase.push_back(Name(one));
  for (const double t : series.t_s) t_s.push_back(Number(std::round(t * 1e6) / 1e6));
  return {{"run", series.run},
          {"held_out", series.held_out},
          {"phase", std::move(phase)},
          {"t_s", std::move(t_s)},
          {"measured_kpa", gauge(series.measured_pa)},
          {"declared_kpa", gauge(series.declared_pa)},
          {"before_kpa", gauge(series.before_pa)},
          {"after_kpa", gauge(series.after_pa)}};
}

Json RenderProvenance(const Provenance& provenance) {
  Json files = Json::array();
  for (const Provenance::File& file : provenance.files)
    files.push_back({{"name", file.name}, {"sha256", file.sha256}});
  return {{"files", std::move(files)},
          {"seed", provenance.seed},
          {"units", "kPa above ambient, s, dm³/(s·bar), ml, l/min ANR (100 kPa, 20 °C)"}};
}

template <typename T, typename Render>
Json List(const std::vector<T>& values, Render render) {
  Json list = Json::array();
  for (const T& value : values) list.push_back(render(value));
  return list;
}

}  // namespace

Json RenderDiagnosis(const Diagnosis& diagnosis, const Dataset& dataset,
                     const Provenance& provenance) {
  Json document = AnswerDocument("diagnosis/1");
  document.update({{"name", dataset.name},
                   {"verdict", Name(diagnosis.verdict)},
                   {"sentence", diagnosis.sentence},
                   {"noise_kpa", Kpa(diagnosis.noise_pa)},
                   {"declared", RenderError(diagnosis.declared)},
                   {"before", RenderError(diagnosis.before)},
                   {"after", RenderError(diagnosis.after)},
                   {"learned", diagnosis.learned ? RenderError(*diagnosis.learned) : Json()}});
  const auto effect_of = [&](const auto& effect) { return RenderEffect(effect, dataset); };
  const auto wrong_of = [&](const auto& wrong) { return RenderWrong(wrong, dataset); };
  document["effects"] = List(diagnosis.effects, effect_of);
  document["numbers"] = List(diagnosis.numbers, wrong_of);
  document["stability"] = List(diagnosis.stability, RenderStability);
  document["slips"] = List(diagnosis.slips, [](const auto& slip) {
    return Json{{"what", slip.what}, {"assume", slip.assume}};
  });
  document["candidates"] = List(diagnosis.candidates, RenderCandidate);
  document["tied"] = List(diagnosis.tied, Ids);
  document["tied_laws"] = List(diagnosis.tied, Laws);
  document["tied_sets"] = List(diagnosis.tied_sets, [&](const calibration::TiedSet& set) {
    return Json{{"effects", List(set.effects, effect_of)},
                {"numbers", List(set.numbers, wrong_of)}};
  });
  document["next_experiment"] = diagnosis.next_experiment
                                    ? RenderExperiment(*diagnosis.next_experiment, dataset)
                                    : Json(nullptr);
  document["reason"] =
      diagnosis.no_experiment.empty() ? Json(nullptr) : Json(diagnosis.no_experiment);
  document["residual"] = RenderResidual(diagnosis.residual);
  document["fitted"] = RenderFitted(diagnosis.fitted, dataset);
  document["discrepancy"] =
      diagnosis.discrepancy ? RenderDiscrepancy(*diagnosis.discrepancy, dataset) : Json(nullptr);
  document["unexplained_fraction"] = Number(diagnosis.unexplained_fraction);
  document["warnings"] = diagnosis.warnings;
  NameChambers(dataset, document);
  document["series"] =
      List(diagnosis.series, [&](const auto& series) { return RenderSeries(series, dataset); });
  document["provenance"] = RenderProvenance(provenance);
  AddSpecimens(diagnosis, dataset, document);
  AddMeasured(diagnosis, dataset, document);
  AddStatedModels(diagnosis, dataset, document);
  return document;
}

}  // namespace plenum::api
