// What an answer says of its request, for a person: units understood, values that look like another
// unit, notes.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_REMARKS_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_REMARKS_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// One line each; empty where there is nothing to say.
std::string RemarksText(const api::Json& answer);

// What was understood of CSV recordings, in the answer of a diagnosis; empty: there are none.
std::string RecordingText(const api::Json& diagnosis);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_REMARKS_H_
