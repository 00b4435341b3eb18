#include "api/measure/rig/chamber_words.h"

#include <algorithm>
#include <utility>

#include "api/json/words.h"
#include "api/simulate/effects.h"
#include "calibration/values/placed_leaks.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::Declared;

constexpr double kFactorMax = 1e6;

void Replace(const std::string& old, const std::string& with, std::string& text) {
  for (std::size_t at = text.find(old); at != std::string::npos;
       at = text.find(old, at + with.size()))
    text.replace(at, old.size(), with);
}

}  // namespace

void NameChambers(const Dataset& dataset, Json& document) {
  if (!dataset.several) return;
  if (document.is_string()) {
    auto text = document.get<std::string>();
    for (const std::string name : {"leak", "rest_volume", "expansion_ratio"})
      for (std::size_t i = 0; i < dataset.specimens.size(); ++i)
        Replace(name + "[" + std::to_string(i + 1) + "]", name + "[" + dataset.specimens[i] + "]",
                text);
    if (text != document.get_ref<const std::string&>()) document = std::move(text);
  } else if (document.is_object() &&
             std::any_of(document.items().begin(), document.items().end(),
                         [](const auto& item) { return item.key().starts_with("leak["); })) {
    Json renamed = Json::object();
    for (auto& [key, value] : document.items()) {
      Json name = key;
      NameChambers(dataset, name);
      renamed[name.get<std::string>()] = std::move(value);
    }
    document = std::move(renamed);
  } else if (document.is_structured()) {
    for (Json& inner : document) NameChambers(dataset, inner);
  }
}

void PutChamber(const model::EffectSpec& spec, const Dataset& dataset, Json& effect) {
  const auto chamber = calibration::ChamberOfLeak(spec);
  if (!chamber) return;
  const std::string& name = dataset.specimens[*chamber];
  effect["id"] = calibration::WithoutChamber(spec).id;
  effect["chamber"] = name;
  if (effect.contains("words")) effect["words"] = name + ": " + effect["words"].get<std::string>();
}

Json RenderPlaced(std::span<const model::Effect> effects, const Dataset& dataset) {
  Json list = RenderEffects(effects);
  for (std::size_t i = 0; i < effects.size(); ++i) PutChamber(*effects[i].spec, dataset, list[i]);
  return list;
}

std::vector<model::Effect> ReadPlaced(Reader& owner, const Dataset& dataset) {
  if (!dataset.several) return ReadEffects(owner);
  std::vector<model::Effect> effects;
  for (const Element& element : owner.List("effects", 0, 100)) {
    Json one = *element.value;
    const std::string chamber = one.is_object() ? one.value("chamber", Json("")).dump() : "";
    if (one.is_object()) one.erase("chamber");
    const Json alone = {{"effects", Json::array({one})}};
    Reader reader(alone, element.pointer, owner.errors());
    std::vector<model::Effect> read = ReadEffects(reader);
    if (read.empty()) continue;
    for (std::size_t i = 0; i < dataset.specimens.size(); ++i)
      if (Json(dataset.specimens[i]).dump() == chamber)
        read.front().spec = &calibration::InChamber(*read.front().spec, i);
    effects.push_back(std::move(read.front()));
  }
  return effects;
}

Json RenderChamberFactors(const calibration::ModelState& state, const Dataset& dataset) {
  Json document = Json::object();
  for (std::size_t i = 0; i < dataset.specimens.size(); ++i)
    for (std::size_t k = 0; k < state.specimen_factor.size(); ++k)
      if (const std::vector<double>& factors = state.specimen_factor[k];
          i < factors.size() && factors[i] != 1.0)
        document[dataset.specimens[i]][std::string(calibration::Name(static_cast<Declared>(k)))] =
            Number(factors[i]);
  return document;
}

void ReadChamberFactors(Reader& owner, const Dataset& dataset, calibration::ModelState& state) {
  if (!dataset.several) return;
  for (std::vector<double>& factors : state.specimen_factor)
    factors.assign(dataset.specimens.size(), 1.0);
  auto chambers = owner.OptionalObject("chamber_factors");
  if (!chambers) return;
  for (std::size_t i = 0; i < dataset.specimens.size(); ++i) {
    auto chamber = chambers->OptionalObject(dataset.specimens[i]);
    if (!chamber) continue;
    for (std::size_t k = 0; k < state.specimen_factor.size(); ++k)
      state.specimen_factor[k][i] =
          chamber->Number(calibration::Name(static_cast<Declared>(k)), Above(0, kFactorMax), 1.0);
    chamber->Finish();
  }
  chambers->Finish();
}

}  // namespace plenum::api
