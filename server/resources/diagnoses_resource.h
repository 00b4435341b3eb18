// POST /v1/diagnoses: a diagnosis as a job.
#ifndef PLENUM_SERVER_RESOURCES_DIAGNOSES_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_DIAGNOSES_RESOURCE_H_

#include "server/call/shared_catalog.h"
#include "server/resources/jobs_resource.h"

namespace plenum::server {

// Diagnoses an order.
Work DiagnosisWork(SharedCatalog& catalog);

// The body is measurement/1, in which "model" may name the saved model that predicts and "save" the
// name under which the revised model is kept, signed like every write. With "save" the result has
// "saved": { name, version, at, who, hash }, null where the diagnosis settled on no model or, with
// "not_saved": { detail, name, model } beside it, where the model could not be written.
Reply PostDiagnosis(SharedCatalog& catalog, const JobsResource& diagnoses, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_DIAGNOSES_RESOURCE_H_
