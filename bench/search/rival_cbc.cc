// CBC on the linear part with cuts where its answer is too slow, until it is fast enough.
#include <coin/Cbc_C_Interface.h>

#include <chrono>

#include "bench/search/base_rows.h"
#include "bench/search/rival.h"

namespace plenum::bench {
namespace {

using Clock = ProcessorClock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void Add(Cbc_Model* model, const Row& row) {
  const int size = static_cast<int>(row.columns.size());
  const auto add = [&](char sense, double side) {
    Cbc_addRow(model, "row", size, row.columns.data(), row.values.data(), sense, side);
  };
  if (row.low == row.high) {
    add('E', row.low);
  } else {
    if (row.low > -optimizer::kUnlimited) add('G', row.low);
    if (row.high < optimizer::kUnlimited) add('L', row.high);
  }
}

// One run on the rows so far. False: not solved to optimality.
bool Solve(const BaseInstance& base, const std::vector<Row>& rows, double time_limit_s,
           Selection& best) {
  Cbc_Model* model = Cbc_newModel();
  Cbc_setLogLevel(model, 0);
  for (int family = 0; family < kBaseFamilies; ++family)
    for (int i = 0; i < base.size; ++i)
      Cbc_addCol(model, "x", 0.0, base.stands[family][i] ? 1.0 : 0.0, base.mass_kg[family][i], 1, 0,
                 nullptr, nullptr);
  for (const Row& row : rows) Add(model, row);
  Cbc_setParameter(model, "sec", std::to_string(time_limit_s).c_str());
  Cbc_setParameter(model, "ratioGap", "0");
  Cbc_setParameter(model, "allowableGap", "1e-9");
  Cbc_solve(model);
  const bool optimal = Cbc_isProvenOptimal(model) != 0;
  if (optimal) best = SelectionOf(base, Cbc_getColSolution(model));
  Cbc_deleteModel(model);
  return optimal;
}

Outcome Run(const BaseInstance& base, bool lifted, double time_limit_s) {
  const Clock::time_point start = Clock::now();
  std::vector<Row> rows = LinearRows(base);
  Outcome outcome;
  int rounds = 0;
  for (double left_s = time_limit_s; left_s > 0.0; left_s = time_limit_s - Since(start)) {
    ++rounds;
    Selection s;
    if (!Solve(base, rows, left_s, s)) break;
    const BaseAttributes attributes = base.AttributesOf(s);
    const bool falls = base.Fall(attributes) <= 1.0, rises = base.Rise(attributes) <= 1.0;
    if (falls && rises) {
      outcome.found = outcome.claimed = true;
      outcome.best = s;
      break;
    }
    if (!falls) rows.push_back(RowOf(base, base.FallCut(s, lifted)));
    if (!rises) rows.push_back(RowOf(base, base.RiseCut(s, lifted)));
  }
  outcome.find_s = outcome.total_s = Since(start);
  outcome.note = std::to_string(rounds) + " rounds";
  return outcome;
}

}  // namespace

Rival Cbc(bool lifted) {
  const auto solve = [lifted](const BaseInstance& base, std::uint64_t, double time_limit_s) {
    return Run(base, lifted, time_limit_s);
  };
  return {lifted ? "CBC, lifted cuts" : "CBC, monotone cuts",
          std::string("binaries of choices; a combination that is too slow is cut off with all ") +
              (lifted ? "that are no better than the best still too slow, round by round"
                      : "that it dominates, round by round"),
          "one thread, ratioGap 0, allowableGap 1e-9", solve};
}

}  // namespace plenum::bench
