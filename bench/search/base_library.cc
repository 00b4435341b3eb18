// The base instance for Python: a flat C interface.
#include "bench/search/base_rows.h"

using plenum::bench::BaseInstance;
using plenum::bench::Selection;

namespace {

Selection Of(const int* choice) {
  Selection s{};
  for (int f = 0; f < plenum::bench::kBaseFamilies; ++f) s[f] = choice[f];
  return s;
}

// Appends a row as (row number, column, value) and its sides; the number of entries.
long AddRow(const plenum::bench::Row& row, double* low, double* high, int* columns,
            double* values) {
  *low = row.low;
  *high = row.high;
  for (std::size_t k = 0; k < row.columns.size(); ++k) {
    columns[k] = row.columns[k];
    values[k] = row.values[k];
  }
  return static_cast<long>(row.columns.size());
}

}  // namespace

extern "C" {

BaseInstance* base_open(unsigned long catalogue, unsigned long requirements, int size) {
  return new BaseInstance(plenum::bench::MakeBaseInstance(catalogue, requirements, size));
}
void base_close(BaseInstance* base) { delete base; }

// Mass and 0/1 "stands the pressure" of every column.
void base_columns(const BaseInstance* base, double* mass, double* stands) {
  for (int f = 0; f < plenum::bench::kBaseFamilies; ++f)
    for (int i = 0; i < base->size; ++i) {
      const int column = plenum::bench::ColumnOf(*base, f, i);
      mass[column] = base->mass_kg[f][i];
      stands[column] = base->stands[f][i] ? 1.0 : 0.0;
    }
}

int base_rows(const BaseInstance* base) {
  return static_cast<int>(plenum::bench::LinearRows(*base).size());
}
long base_row(const BaseInstance* base, int row, double* low, double* high, int* columns,
              double* values) {
  return AddRow(plenum::bench::LinearRows(*base)[row], low, high, columns, values);
}

double base_rise(const BaseInstance* base, const int* choice) {
  return base->Rise(base->AttributesOf(Of(choice)));
}
double base_fall(const BaseInstance* base, const int* choice) {
  return base->Fall(base->AttributesOf(Of(choice)));
}
int base_linear_ok(const BaseInstance* base, const int* choice) {
  return base->LinearOk(Of(choice));
}
long base_cut(const BaseInstance* base, int rise, int lifted, const int* choice, double* low,
              double* high, int* columns, double* values) {
  const plenum::bench::Cut cut =
      rise ? base->RiseCut(Of(choice), lifted) : base->FallCut(Of(choice), lifted);
  return AddRow(plenum::bench::RowOf(*base, cut), low, high, columns, values);
}

}  // extern "C"
