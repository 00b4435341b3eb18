// Parts and revisions as JSON.
#ifndef PLENUM_API_CATALOGUE_PART_DOCUMENT_H_
#define PLENUM_API_CATALOGUE_PART_DOCUMENT_H_

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "catalog/store/revision.h"
#include "catalog/store/store.h"

namespace plenum::api {

Json RenderPart(const catalog::Part& part);
// `request` is what RenderPart gives, or a part of a user's own; what answers add (origin,
// understood, warnings) is accepted and ignored. A RemarkRecorder hears what was given with a unit
// or as it is printed.
Parsed<catalog::Part> ParsePart(const Json& request);
// { number, hash }: `catalogue_revision` of an answer, which names the parts it was computed from.
Json RenderRevisionName(const catalog::Revision& revision);
// { number, hash, at, who, what }.
Json RenderRevision(const catalog::Revision& revision);
// { id, before, after }, each a part or null.
Json RenderChange(const catalog::Change& change);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_DOCUMENT_H_
