#include "api/simulate/effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/units.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

struct ParameterUnit {
  std::string_view model, contract;  // endings of a parameter's name
  double factor;                     // of the contract's unit in the model's
};

// The first that fits counts; what none fits keeps its name.
constexpr auto kParameterUnits = std::to_array<ParameterUnit>({
    {"sonic_conductance_m3_per_s_pa", "sonic_conductance_dm3_per_s_bar", kM3PerSPaPerDm3PerSBar},
    {"conductance_m3_per_s_pa", "conductance_l_per_min_bar", kM3PerSPerLPerMin / 1e5},
    {"flow_m3_per_s", "flow_l_per_min_anr", kM3PerSPerLPerMin},
    {"diameter_m", "diameter_mm", kMPerMm},
    {"_m3", "_ml", kM3PerMl},
    {"_pa", "_kpa", kPaPerKpa},
});

// A parameter as the contract has it.
struct DescribedParameter {
  std::string name;
  double factor = 1.0;
  Range range;
};

DescribedParameter ParameterOf(const model::ParameterSpec& spec) {
  DescribedParameter parameter{std::string(spec.name), 1.0, {}};
  for (const ParameterUnit& unit : kParameterUnits) {
    if (!spec.name.ends_with(unit.model)) continue;
    parameter.name = std::string(spec.name.substr(0, spec.name.size() - unit.model.size()));
    parameter.name += unit.contract;
    parameter.factor = unit.factor;
    break;
  }
  parameter.range = {Rounded(spec.low / parameter.factor), Rounded(spec.high / parameter.factor)};
  return parameter;
}

std::vector<std::string> LawsOf(std::string_view id) {
  std::vector<std::string> laws;
  for (const model::EffectSpec* spec : model::Effects()) {
    if (spec->id == id && !spec->law.empty()) laws.emplace_back(spec->law);
  }
  return laws;
}

bool Holds(std::span<const model::Effect> effects, std::string_view id) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const model::Effect& effect) { return effect.spec->id == id; });
}

// The id of a known effect, or empty after an error.
std::string ReadId(Reader& effect) {
  std::string id = effect.Text("id");
  if (id.empty() || model::FindEffect(id)) return id;
  std::vector<std::string> ids;
  for (const model::EffectSpec* spec : model::Effects()) ids.emplace_back(spec->id);
  effect.Fail("id", "no effect " + Quoted(id) + "; nearest id: " + Nearest(id, ids));
  return "";
}

model::Effect ReadParameters(Reader parameters, const std::string& id) {
  const std::vector<std::string> laws = LawsOf(id);
  const std::string law = laws.empty() ? "" : parameters.Choice("law", laws, laws.front());
  const auto missing = [&](const model::ParameterSpec& spec) {
    return !parameters.Has(ParameterOf(spec).name);
  };
  if (laws.size() > 1 && !parameters.Has("law")) {
    const auto specs = model::FindEffect(id, laws.front())->parameters;
    if (std::any_of(specs.begin(), specs.end(), missing))
      parameters.Fail(
          "law", "must be named where the parameters are not those of \"" + laws.front() + "\"");
  }
  if (law.empty() && !laws.empty()) return {};  // which parameters belong there is not known
  model::Effect effect{model::FindEffect(id, law), {}};
  for (const model::ParameterSpec& spec : effect.spec->parameters) {
    const DescribedParameter parameter = ParameterOf(spec);
    const double value = parameters.Number(parameter.name, parameter.range) * parameter.factor;
    effect.parameters.push_back(std::clamp(value, spec.low, spec.high));
  }
  parameters.Finish();
  return effect;
}

}  // namespace

Json EffectsForm() {
  Json forms = Json::array();
  for (const model::EffectSpec* spec : model::Effects()) {
    Json parameters = {{"type", "object"}, {"properties", Json::object()}};
    Json required = Json::array();
    if (!spec->law.empty()) parameters["properties"]["law"] = {{"const", spec->law}};
    // The first law of an effect is the one that need not be named.
    if (!spec->law.empty() && spec->law != LawsOf(spec->id).front()) required.push_back("law");
    for (const model::ParameterSpec& number : spec->parameters) {
      const DescribedParameter parameter = ParameterOf(number);
      parameters["properties"][parameter.name] =
          NumberOrQuantityForm(parameter.name, parameter.range);
      required.push_back(parameter.name);
    }
    parameters["properties"]["note"] = NoteForm();
    parameters["required"] = std::move(required);
    parameters["additionalProperties"] = false;
    forms.push_back(
        {{"type", "object"},
         {"properties",
          {{"id", {{"const", spec->id}}}, {"parameters", parameters}, {"note", NoteForm()}}},
         {"required", {"id", "parameters"}},
         {"additionalProperties", false}});
  }
  return {{"type", "array"}, {"maxItems", kEffectsMax}, {"items", {{"anyOf", forms}}}};
}

std::vector<model::Effect> ReadEffects(Reader& owner, std::span<const model::Effect> others) {
  if (SchemaRecorder::Current()) owner.Describe("effects", EffectsForm());
  std::vector<model::Effect> effects;
  for (const Element& element : owner.List("effects", 0, kEffectsMax)) {
    const std::size_t errors_before = owner.errors().size();
    Reader reader(element, owner.errors());
    const std::string id = ReadId(reader);
    if (id.empty()) {
      reader.Raw("parameters");
      reader.Finish();
      continue;
    }
    if (Holds(effects, id)) reader.Fail("id", Quoted(id) + " stands in the list already");
    if (Holds(others, id))
      reader.Fail("id", Quoted(id) + " stands in the effects of the whole request already");
    model::Effect effect = ReadParameters(reader.Object("parameters"), id);
    reader.Finish();
    if (owner.errors().size() == errors_before) effects.push_back(std::move(effect));
  }
  return effects;
}

ContractParameter InContract(const model::ParameterSpec& spec) {
  DescribedParameter parameter = ParameterOf(spec);
  return {std::move(parameter.name), parameter.factor};
}

Json RenderEffects(std::span<const model::Effect> effects) {
  Json list = Json::array();
  for (const model::Effect& effect : effects) {
    Json parameters = Json::object();
    if (!effect.spec->law.empty()) parameters["law"] = effect.spec->law;
    for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
      const DescribedParameter parameter = ParameterOf(effect.spec->parameters[i]);
      parameters[parameter.name] = Number(effect.parameters[i] / parameter.factor);
    }
    list.push_back({{"id", effect.spec->id}, {"parameters", std::move(parameters)}});
  }
  return list;
}

}  // namespace plenum::api
