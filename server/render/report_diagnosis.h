// diagnosis/1 as one HTML file that needs nothing else: no script, no font, no link.
#ifndef PLENUM_SERVER_RENDER_REPORT_DIAGNOSIS_H_
#define PLENUM_SERVER_RENDER_REPORT_DIAGNOSIS_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// The verdict in one sentence, error before and after, effects with intervals, measured against
// model for each run, residuals in time and by phase, the candidates, and what the answer was made
// from. Light or dark as the reader's system is.
std::string DiagnosisReport(const api::Json& answer);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_REPORT_DIAGNOSIS_H_
