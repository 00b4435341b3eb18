// Chambers of several in an answer and back: leaks carry the chamber that they are of by its name,
// and models what each chamber has of its own.
#ifndef PLENUM_API_MEASURE_RIG_CHAMBER_WORDS_H_
#define PLENUM_API_MEASURE_RIG_CHAMBER_WORDS_H_

#include <span>
#include <string>
#include <vector>

#include "api/json/reader.h"
#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"

namespace plenum::api {

// Puts names in place of numbers, "leak[tip]" for "leak[2]", in every text of the document.
void NameChambers(const calibration::Dataset& dataset, Json& document);

// Of an effect that is rendered: "id": "leak", "chamber": "tip".
void PutChamber(const model::EffectSpec& spec, const calibration::Dataset& dataset, Json& effect);

// Effects of a model with their chambers, and back.
Json RenderPlaced(std::span<const model::Effect> effects, const calibration::Dataset& dataset);
std::vector<model::Effect> ReadPlaced(Reader& owner, const calibration::Dataset& dataset);

// { name: { "rest_volume": factor } } of what differs from what was declared, and back into
// specimen_factor.
Json RenderChamberFactors(const calibration::ModelState& state,
                          const calibration::Dataset& dataset);
void ReadChamberFactors(Reader& owner, const calibration::Dataset& dataset,
                        calibration::ModelState& state);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_RIG_CHAMBER_WORDS_H_
