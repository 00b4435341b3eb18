// designs/1 and evaluation_answer/1 for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_DESIGN_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_DESIGN_H_

#include <string>

#include "api/design/answer.h"
#include "api/json/json.h"

namespace plenum::server {

// The ranked table (`wide`: with all figures), the best design in full, the proof in words; for an
// infeasible problem the conflict in words.
std::string DesignText(const api::Json& answer, bool wide = false);

// evaluation_answer/1: what the parts stand and, where the design works, its figures and margins.
std::string EvaluationText(const api::Json& answer);

// One line without its end.
std::string ProgressText(const optimizer::Progress& progress);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_DESIGN_H_
