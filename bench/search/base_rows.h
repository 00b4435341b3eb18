// The linear part of the instance, in binaries of choices: column = family · size + part.
#ifndef PLENUM_BENCH_SEARCH_BASE_ROWS_H_
#define PLENUM_BENCH_SEARCH_BASE_ROWS_H_

#include <vector>

#include "bench/search/base_instance.h"

namespace plenum::bench {

struct Row {
  std::vector<int> columns;
  std::vector<double> values;
  double low = 0.0, high = 0.0;
};

inline int ColumnOf(const BaseInstance& base, int family, int part) {
  return family * base.size + part;
}

// One part of each family; as many tubes as fittings of each diameter, fittings as valves of each
// thread; gas for the air that the tube's strokes need; a regulator that stands the cylinder.
std::vector<Row> LinearRows(const BaseInstance& base);
Row RowOf(const BaseInstance& base, const Cut& cut);

Selection SelectionOf(const BaseInstance& base, const double* x);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_SEARCH_BASE_ROWS_H_
