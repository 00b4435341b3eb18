// Effects: what real rigs show beyond the base model.
//
// An effect is a value: which one, and its parameters (SI). Each effect is one header in this
// folder with its equation, parameters, ranges and source, and one line in registry.cc. Any subset
// may act on one group at once; they are applied in the order of the registry.
#ifndef PLENUM_MODEL_EFFECTS_EFFECT_H_
#define PLENUM_MODEL_EFFECTS_EFFECT_H_

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::model {

// The equation that an effect changes.
enum class EffectPlace { kValve, kLine, kVolume, kEnergy, kChamber, kSupply, kSensor };

struct ParameterSpec {
  std::string_view name;  // with its SI unit, e.g. "time_constant_s"
  double low, high;       // allowed, both ends included
};

struct EffectSpec {
  std::string_view id;   // as in the contract, e.g. "leak"
  std::string_view law;  // where one id has several laws, e.g. "orifice"; else empty
  EffectPlace place;
  std::span<const ParameterSpec> parameters;
};

struct Effect {
  const EffectSpec* spec = nullptr;  // one of Effects()
  std::vector<double> parameters;    // in the order of the spec
  bool operator==(const Effect&) const = default;
};

// Every known effect, in the order of application.
std::span<const EffectSpec* const> Effects();

// The spec of that id and law; null if there is none. An empty law finds the first.
const EffectSpec* FindEffect(std::string_view id, std::string_view law = {});

// The first reason why the effects cannot act together on one group — a parameter missing or out of
// its range, the same id twice — or empty.
std::string WhyInvalid(std::span<const Effect> effects);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_EFFECT_H_
