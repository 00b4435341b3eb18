// Effects in the contract's units: { "id", "parameters": { … } }, with "law" among the parameters
// of an effect that has several. A parameter's name and unit follow from the model's by its ending.
#ifndef PLENUM_API_SIMULATE_EFFECTS_H_
#define PLENUM_API_SIMULATE_EFFECTS_H_

#include <span>
#include <string>
#include <vector>

#include "api/json/reader.h"
#include "model/effects/effect.h"

namespace plenum::api {

// The list "effects" of the owner (a request or a group), each id once and none of those of
// `others`, with which they act together; empty where missing. An entry with an error is left out.
std::vector<model::Effect> ReadEffects(Reader& owner, std::span<const model::Effect> others = {});

// A parameter's name in the contract, with its unit, and that unit in the model's.
struct ContractParameter {
  std::string name;
  double factor = 1.0;  // value in the contract = value in the model / factor
};
ContractParameter InContract(const model::ParameterSpec& spec);

// The same form again.
Json RenderEffects(std::span<const model::Effect> effects);

}  // namespace plenum::api

#endif  // PLENUM_API_SIMULATE_EFFECTS_H_
