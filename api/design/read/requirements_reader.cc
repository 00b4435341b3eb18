#include "api/design/read/requirements_reader.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/actuators/actuators_reader.h"
#include "api/design/read/actuators/gait_reader.h"
#include "api/design/read/design_reader.h"
#include "api/design/read/joint_rows.h"
#include "api/design/read/objective_reader.h"
#include "api/design/read/selection.h"
#include "api/design/read/supply/own_pumps.h"
#include "api/design/read/supply/power.h"
#include "api/design/read/supply/regulation.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/design/read/supply/vacuum_reader.h"
#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/model_document.h"
#include "catalog/units/quantity.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;

const Range kAmount = Above(0, 1e6);  // kg, L, EUR

constexpr auto& kAllConfigurations = optimizer::kPressureConfigurations;

constexpr int kActuationsMax = 1'000'000'000;

// A whole number, or for how long: "2 h" is as many as begin in that time.
int ReadActuations(Reader& duty, double frequency_hz) {
  const Json* given = duty.Raw("actuations");
  if (given == nullptr || !given->is_string()) {
    const int actuations = duty.Integer("actuations", 1, kActuationsMax);
    const Json whole = {{"type", "integer"}, {"minimum", 1}, {"maximum", kActuationsMax}};
    duty.Describe("actuations", {{"anyOf", {whole, {{"type", "string"}}}}});
    return actuations;
  }
  const std::string& text = given->get_ref<const std::string&>();
  const catalog::Quantity time = catalog::ParseQuantity(text, "run_time_s", {.needs_unit = true});
  const double actuations = std::ceil(Rounded(time.value.value_or(0.0) * frequency_hz));
  if (!(actuations >= 1.0 && actuations <= kActuationsMax)) {
    duty.Fail(
        "actuations",
        "must be a whole number ≥ 1 and ≤ 1e9, or for how long, as \"2 h\", not " + Quoted(text));
    return 1;
  }
  if (RemarkRecorder* remarks = RemarkRecorder::Current())
    remarks->Understood(duty.Pointer("actuations"),
                        {{"given", text}, {"value", actuations}, {"unit", "actuations"}});
  return static_cast<int>(actuations);
}

void ReadDuty(Reader& request, optimizer::Problem& problem) {
  Reader duty = request.Object("duty");
  problem.frequency_hz = duty.Number("frequency_hz", FrequencyRange());
  problem.actuations = ReadActuations(duty, problem.frequency_hz);
  problem.simultaneous = duty.Bool("simultaneous", true);
  duty.Finish();
}

// A request that names none asks for all but tanks, which have to be filled somewhere, and pumps
// without a reservoir, and for the mains only if it has them.
void ReadConfigurations(Reader& supply, bool has_mains, optimizer::Problem& problem) {
  if (!supply.Has("configurations")) {
    for (const Configuration configuration : kAllConfigurations)
      if (!optimizer::HasTank(configuration) && configuration != Configuration::kDirectPump &&
          (configuration != Configuration::kMains || has_mains))
        problem.configurations.insert(configuration);
    return;
  }
  std::vector<std::string> names;
  for (const Configuration configuration : kAllConfigurations)
    names.emplace_back(optimizer::Name(configuration));
  const std::vector<std::string> given = supply.Texts("configurations", 1, std::size(names));
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), given[i]);
    if (found != names.end())
      problem.configurations.insert(kAllConfigurations[found - names.begin()]);
    else if (!given[i].empty())
      supply.FailAt("configurations/" + std::to_string(i),
                    "must be " + OneOf(names) + ", not " + Quoted(given[i]));
  }
  if (problem.configurations.contains(Configuration::kMains) && !has_mains)
    supply.Fail("mains", "is required by the configuration mains");
}

void ReadSupply(Reader& request, optimizer::Problem& problem) {
  static const Json kNothing = Json::object();
  auto given = request.OptionalObject("supply");
  Reader supply = given ? *given : Reader(kNothing, request.Pointer("supply"), request.errors());
  auto mains = supply.OptionalObject("mains");
  if (mains) {
    problem.mains.pressure_pa = PaFromKpaGauge(
        mains->Number("pressure_kpa_gauge", {1, kOperatingGaugeMaxKpa}), problem.ambient);
    const auto flow = mains->OptionalNumber("flow_l_per_min_anr_max", Above(0, 1e6));
    if (flow) problem.mains.flow_max_m3_per_s = M3PerSFromLPerMin(*flow);
    mains->Finish();
  }
  ReadConfigurations(supply, mains.has_value(), problem);
  ReadRegulation(supply, problem);
  ReadPower(supply, problem);
  ReadVacuum(supply, problem);
  ReadPumps(supply, problem);
  ReadHoldOn(supply, problem);
  const auto source = supply.OptionalNumber("source_pressure_kpa_gauge_max", {1, kGaugeMaxKpa});
  if (source && !optimizer::Evacuated(problem))
    problem.source_pressure_max_pa = PaFromKpaGauge(*source, problem.ambient);
  const auto fill = supply.OptionalNumber("tank_fill_kpa_gauge_max", {1, kGaugeMaxKpa});
  if (fill) problem.tank_fill_max_pa = PaFromKpaGauge(*fill, problem.ambient);
  if (fill && !problem.configurations.contains(Configuration::kTank) &&
      !problem.configurations.contains(Configuration::kTankAndPump))
    supply.Fail("tank_fill_kpa_gauge_max",
                "is for the configurations tank and tank_and_pump, of which "
                "supply.configurations names none");
  const auto limit = [&](const char* name) {
    return supply.OptionalNumber(name, kAmount).value_or(optimizer::kUnlimited);
  };
  problem.mass_max_kg = limit("mass_kg_max");
  problem.volume_max_l = limit("volume_l_max");
  problem.cost_max_eur = limit("cost_eur_max");
  if (supply.Has("parts"))
    problem.orderable_only = supply.Choice("parts", {"any", "orderable"}) == "orderable";
  supply.Finish();
}

// Only one supply from the wall or the robot is there.
void CheckPower(Reader& request, optimizer::Problem& problem) {
  if (!HasOutsidePower(problem)) return;
  problem.limits.batteries = 1;
  if (problem.require.contains(optimizer::Family::kBattery))
    request.FailAt("require/battery", std::string("is no choice where /supply/power is the ") +
                                          optimizer::Name(problem.power.kind) + "'s");
}

// A source must reach the operating pressure of every group: what no choice of parts can mend is an
// error of the request.
void CheckPressures(const optimizer::Problem& problem, Errors& errors) {
  if (optimizer::Evacuated(problem)) return CheckVacuum(problem, errors);
  const bool only_mains = problem.configurations == std::set<Configuration>{Configuration::kMains};
  const auto kpa = [&](double pa) { return Rounded(KpaGaugeFromPa(pa, problem.ambient)); };
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const double operating_pa = problem.groups[g].chamber.operating_pressure_pa;
    const std::string pointer =
        optimizer::GroupPointer(problem, g) + "/operating_pressure_kpa_gauge";
    const std::string is = "is " + Decimal(kpa(operating_pa)) + ", above ";
    if (operating_pa > problem.source_pressure_max_pa)
      errors.push_back({pointer, is +
                                     "the highest source pressure allowed: "
                                     "/supply/source_pressure_kpa_gauge_max is " +
                                     Decimal(kpa(problem.source_pressure_max_pa))});
    else if (only_mains && problem.mains.pressure_pa > 0.0 &&  // else that is missing
             operating_pa > problem.mains.pressure_pa)
      errors.push_back({pointer, is + "the only source: /supply/mains/pressure_kpa_gauge is " +
                                     Decimal(kpa(problem.mains.pressure_pa))});
  }
}

// A list by one objective is one of kinds, unless it must reach a probability or the model is a
// revised one.
void ChooseList(Reader& request, bool probability_min, DesignRequest& parsed) {
  const bool combinations = !parsed.pareto.empty() || probability_min || parsed.model;
  const Json* ranking = request.Raw("ranking");
  const bool chosen = ranking && ranking->is_object() && ranking->contains("list");
  if (!chosen && !combinations) parsed.problem.list = optimizer::ListOf::kKinds;
  if (combinations && parsed.problem.list == optimizer::ListOf::kKinds)
    request.FailAt("ranking/list",
                   "must be combinations for a front, with probability_min and with a model");
}

// Gives the least probability, if one is asked for.
std::optional<double> ReadRanking(Reader& request, DesignRequest& parsed) {
  auto ranking = request.OptionalObject("ranking");
  if (!ranking) return std::nullopt;
  parsed.problem.count = ranking->Integer("count", 1, kDesignsMax, 20);
  parsed.time_limit_s = ranking->Number("time_limit_s", {0.01, kDesignSecondsMax}, 30.0);
  const auto probability_min = ranking->OptionalNumber("probability_min", {0, 1});
  if (ranking->Has("list"))
    parsed.problem.list = ReadEnum<optimizer::ListOf>(
        *ranking, "list", {optimizer::ListOf::kKinds, optimizer::ListOf::kCombinations});
  parsed.problem.limits.per_source = ranking->Integer("per_source", 1, kDesignsMax, 3);
  parsed.proof = ranking->Bool("proof", false);
  if (ranking->Has("solver"))
    parsed.problem.solver = ReadEnum<optimizer::NlpSolver>(
        *ranking, "solver", {optimizer::NlpSolver::kIpopt, optimizer::NlpSolver::kNlopt});
  ranking->Finish();
  return probability_min;
}

void ReadLimits(Reader& request, optimizer::Limits& limits) {
  auto reader = request.OptionalObject("limits");
  if (!reader) return;
  const auto read = [&](const char* name, int& limit) {
    limit = reader->Integer(name, 1, 16, limit);
  };
  read("compressors_max", limits.compressors);
  read("batteries_max", limits.batteries);
  read("cylinders_max", limits.cylinders);
  read("co2_max", limits.co2);
  read("reservoirs_max", limits.reservoirs);
  reader->Finish();
}

// How many pieces and which parts there may be.
void ReadChoices(Reader& request, const std::vector<catalog::Part>& parts,
                 optimizer::Problem& problem) {
  ReadLimits(request, problem.limits);
  ReadSelection(request, parts, problem);
  CheckPower(request, problem);
}

void WarnOfTie(const Reader& request, const std::string& name, const SavedModel& model) {
  RemarkRecorder* recorder = RemarkRecorder::Current();
  if (!recorder || model.tied.empty()) return;
  std::string others;
  for (std::size_t i = 1; i < model.tied.size(); ++i) {
    std::string set;
    for (const std::string& id : model.tied[i]) set += (set.empty() ? "" : " and ") + id;
    others += (others.empty() ? "" : ", or ") + set;
  }
  recorder->Warn(request.Pointer("model"),
                 name + " is the first of a tie: " + others + " would explain its data as well");
}

// Effects of the revision go to every group; those of its sensor change no actuator.
void ReadModel(Reader& request, const std::vector<catalog::ModelRevision>& models,
               DesignRequest& parsed) {
  const std::string name = request.Text("model", "nominal");
  if (name.empty() || name == "nominal") return;
  auto found = FindModel(name, models, request.Pointer("model"));
  if (const auto* errors = std::get_if<Errors>(&found)) {
    request.errors().insert(request.errors().end(), errors->begin(), errors->end());
    return;
  }
  WarnOfTie(request, name, std::get<SavedModel>(found));
  for (const model::Effect& effect : std::get<SavedModel>(found).effects) {
    if (effect.spec->place == model::EffectPlace::kSensor) continue;
    for (optimizer::ActuatorGroup& group : parsed.problem.groups) group.effects.push_back(effect);
  }
  parsed.model = *std::find_if(models.begin(), models.end(),
                               [&](const auto& model) { return model.name == name; });
  if (parsed.problem.regulation != optimizer::Regulation::kShared)
    request.FailAt("supply/regulation",
                   "must be shared where a model is named, whose effects are judged behind one "
                   "regulator");
  if (optimizer::Evacuated(parsed.problem))
    request.Fail("model",
                 "is for actuators under pressure: effects of evacuated ones are not known");
  if (HasVacuumRail(parsed.problem))
    request.Fail(
        "model",
        "is for actuators that stay above ambient: effects below it are not known, and one "
        "has a low_pressure_kpa_gauge");
  for (const Configuration tank : {Configuration::kTank, Configuration::kTankAndPump})
    if (parsed.problem.configurations.contains(tank))
      request.FailAt("supply/configurations",
                     "must be without " + std::string(optimizer::Name(tank)) +
                         " where a model is named, whose effects are judged in a cycle that "
                         "repeats");
  if (parsed.problem.configurations.contains(Configuration::kDirectPump))
    request.FailAt("supply/configurations",
                   "must be without direct_pump where a model is named, whose effects are judged "
                   "on a source with a pressure of its own");
}

// What a front cannot have, and what one of two things asked for excludes.
void CheckTogether(Reader& request, const DesignRequest& parsed, bool probability_min) {
  if (!parsed.pareto.empty() && parsed.proof)
    request.FailAt("ranking/proof", "is for a list by one objective");
  if (!parsed.pareto.empty() && probability_min)
    request.FailAt("ranking/probability_min", "is for a list by one objective");
  if (parsed.explain && !parsed.pareto.empty())
    request.Fail("explain", "explains a list by one objective, not a front");
  if (parsed.explain && parsed.explain->ranks > 0 && probability_min)
    request.FailAt("explain/ranks", "must be 0 with /ranking/probability_min");
}

void CheckGuarantee(Reader& request, const DesignRequest& parsed) {
  if (!parsed.guarantee) return;
  std::string why = WhyNotGuaranteed(parsed.problem, *parsed.guarantee);
  if (!parsed.pareto.empty()) why = "is for a list by one objective, not a front";
  if (parsed.model) why = "is for the nominal model";
  if (parsed.robust)
    why =
        "stands alone: draws and probability_min are for a list on paper; what is guaranteed "
        "meets its requirements in each of them";
  if (!why.empty()) request.Fail("guarantee", why);
}

bool HasErrorIn(const Errors& errors, std::initializer_list<std::string_view> places) {
  return std::any_of(errors.begin(), errors.end(), [&](const Error& error) {
    return std::any_of(places.begin(), places.end(),
                       [&](std::string_view place) { return error.pointer.starts_with(place); });
  });
}

}  // namespace

Parsed<DesignRequest> ParseRequirements(const Json& request,
                                        const std::vector<catalog::Part>& parts,
                                        const std::vector<catalog::ModelRevision>& models) {
  Errors errors;
  DesignRequest parsed;
  RemarkRecorder recorder;
  optimizer::Problem& problem = parsed.problem;
  Reader reader(request, "", errors);
  reader.Schema("requirements/1");
  parsed.name = reader.Text("name", "");
  problem.ambient = ReadAmbient(reader);

  std::vector<GroupUncertainty> uncertainties = ReadActuators(reader, problem);
  ReadDuty(reader, problem);
  AlternateSides(problem);
  const Fractions fractions = ReadFractions(reader);
  problem.rise_fraction = fractions.rise;
  problem.fall_fraction = fractions.fall;
  ReadSupply(reader, problem);
  CheckGaits(reader, problem);
  CheckPressures(problem, errors);
  ReadObjective(reader, problem.objective, parsed.pareto);
  problem.joints_by = problem.objective;
  const std::optional<double> probability_min = ReadRanking(reader, parsed);
  parsed.robust = ReadRobust(reader, probability_min);
  parsed.guarantee = ReadGuarantee(reader, std::move(uncertainties));
  parsed.explain = ReadExplain(reader);
  CheckTogether(reader, parsed, probability_min.has_value());
  ReadChoices(reader, parts, problem);
  ReadModel(reader, models, parsed);
  if (reader.Has("prices") && reader.Choice("prices", {"known", "lower_bound"}) == "lower_bound")
    optimizer::AllowUnpriced(problem);
  const bool front_of_cost = std::find(parsed.pareto.begin(), parsed.pareto.end(),
                                       optimizer::Amount::kCost) != parsed.pareto.end();
  if (problem.unpriced_allowed && front_of_cost)
    reader.Fail("prices", "must be known for a front with cost_eur");
  ChooseList(reader, probability_min.has_value(), parsed);
  CheckGuarantee(reader, parsed);
  if (parsed.model && parsed.proof)
    reader.FailAt("ranking/proof", "is for the nominal model: its record cannot be verified");
  reader.Finish();

  const bool needs_fittings =
      std::any_of(problem.groups.begin(), problem.groups.end(),
                  [](const auto& group) { return group.fittings_per_line > 0; });
  if (!HasErrorIn(errors, {"/supply", "/require", "/exclude"}))
    CheckFamilies(parts, problem, needs_fittings, errors);
  if (!errors.empty()) return errors;
  SetJoints(problem);
  problem.parts = AllowedModelParts(parts, problem);
  if (std::string why = WhyNoPumps(problem); !why.empty())
    return Errors{{"/supply/pumps", std::move(why)}};
  if (std::any_of(parts.begin(), parts.end(), IsJoint)) WarnOfJoints(problem);
  WarnOfRegulation(problem);
  WarnOfTurns(problem);
  parsed.request = request;
  parsed.remarks = recorder.Take();
  return parsed;
}

}  // namespace plenum::api
