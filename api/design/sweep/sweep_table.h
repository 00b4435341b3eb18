// The answers of a sweep side by side: one row for each patch, in their order.
#ifndef PLENUM_API_DESIGN_SWEEP_SWEEP_TABLE_H_
#define PLENUM_API_DESIGN_SWEEP_SWEEP_TABLE_H_

#include <string>
#include <vector>

#include "api/json/json.h"

namespace plenum::api {

// What a row says of an answer, designs/1: { outcome, configuration, objective, mass_kg, volume_l,
// cost_eur, energy_wh, parts, lower_bound, gap, conflict, seconds }. `outcome` is the status of the
// answer; what it says of a design is that of the first one, null without any; `parts` are texts;
// `conflict` is a text where no design is possible.
Json SweepRow(const Json& answer);

// What became of one patch.
struct SweptAnswer {
  std::string status;   // of its job: queued, running, done, cancelled, failed; empty: not kept
  Json row;             // SweepRow of the answer; null where there is none
  std::string failure;  // of a failed one
  std::string link;     // to its job; empty without one
};

// sweep_table/1: { name, objective, varied, rows: [{ name, status, values, what SweepRow says,
// detail, link }] }. `plan` is that of the request; there is an answer for each of its patches.
Json RenderSweepTable(const Json& plan, const std::vector<SweptAnswer>& answers);

// The same as CSV (RFC 4180, UTF-8): a header, then a line for each row, a column for each varied
// value. A text that a spreadsheet would take for a formula has an apostrophe before it.
std::string SweepCsv(const Json& table);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_SWEEP_SWEEP_TABLE_H_
