// The ranked list of a designs/1 answer as tables for a terminal.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_RANKED_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_RANKED_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// What each design is first (source, valves, battery, tank), then its mass, what else is minimised,
// cost where that counts, the requirement that it meets most closely and the share of its mass that
// is estimated: at most 100 characters wide.
std::string RankedTable(const api::Json& answer);
// The same with all figures, as wide as it gets.
std::string WideTable(const api::Json& designs);

// The best design of each configuration, and of products that one can order, or why there is none;
// empty where the answer has nothing of it that the list does not show.
std::string BestsText(const api::Json& answer);

// "2× JSG BD-03AB, 6× ASCO pair of RHB20xx80x": what a design is first.
std::string SourceAndValves(const api::Json& design);

// What else there is of the design's kind; empty where nobody looked.
std::string VariantsText(const api::Json& design);

// How far the best design can be trusted: the first line that people read.
std::string QualityLine(const api::Json& answer);

// The cost of a design's totals, €; "≥ 49.0" where some price is unknown, "–" where all are.
std::string CostText(const api::Json& totals);

// The requirement that is met most closely; nullptr without any.
const api::Json* Tightest(const api::Json& design);

std::string Percent(const api::Json& share);
std::string Times(const api::Json& part);  // of how many pieces or metres

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_RANKED_H_
