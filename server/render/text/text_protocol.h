// protocol/1 and measured numbers of parts for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_PROTOCOL_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_PROTOCOL_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

std::string ProtocolText(const api::Json& protocol);

// What was written into a part, or why not: "saved_part" of an answer.
std::string SavedPartText(const api::Json& answer);

// Of a diagnosis: what was measured, and what was written into the catalogue; "" without either.
std::string MeasuredText(const api::Json& answer);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_PROTOCOL_H_
