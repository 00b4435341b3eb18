// A saved model revision, model/1: what a diagnosis found, as the catalogue keeps it and as ranking
// and later diagnoses read it.
//   { "schema": "model/1", "effects": [ { "id", "parameters" } ],
//     "factors": { "sonic_conductance": 1.03 },
//     "covariance": { "parameters": [ "creep.fraction", … ], "matrix": [ [ … ] ] },
//     "data": [ { "name", "sha256" } ],
//     "tied": [ [ "creep" ], [ "leak" ] ],
//     "noise_kpa", "before_rms_kpa", "after_rms_kpa", "holdout_rms_kpa" }
// Factors are those of the fit on numbers declared for the rig that was measured: they serve
// diagnoses of that rig, not the parts of other designs. `tied` stands in models of a tie alone:
// the sets that did as well, of which the model has the first.
#ifndef PLENUM_API_MEASURE_MODEL_DOCUMENT_H_
#define PLENUM_API_MEASURE_MODEL_DOCUMENT_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "catalog/store/model_revision.h"
#include "model/effects/effect.h"

namespace plenum::api {

struct SavedModel {
  std::vector<model::Effect> effects;
  std::vector<std::pair<calibration::Declared, double>> factors;
  std::vector<std::vector<std::string>> tied;  // sets of which the effects are the first
  struct Covariance {                          // of the fit, in the units that the names carry
    std::vector<std::string> parameters;       // "creep.fraction", "sonic_conductance"
    std::vector<std::vector<double>> rows;     // square
  } covariance;
  struct Data {
    std::string name, sha256;
  };
  std::vector<Data> data;
  double noise_pa = 0.0, before_rms_pa = 0.0, after_rms_pa = 0.0;
  std::optional<double> holdout_rms_pa;
};

Json RenderModel(const SavedModel& model);
Parsed<SavedModel> ParseModel(const Json& document);

// The revision of that name among `models`, read. An error, with `pointer`, that names what there
// is where the name is unknown.
Parsed<SavedModel> FindModel(const std::string& name,
                             const std::vector<catalog::ModelRevision>& models,
                             const std::string& pointer);

// { "name", "version", "at", "who", "hash" }, with the document as "model" where asked for.
Json RenderModelRevision(const catalog::ModelRevision& revision, bool with_document);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_MODEL_DOCUMENT_H_
