#include "bench/search/base_rows.h"

#include <algorithm>

namespace plenum::bench {
namespace {

constexpr double kLitre = 1e-3, kMegapascal = 1e6;

// As many of one family as of another in each class.
void AddClasses(const BaseInstance& base, int family, const std::vector<int>& classes, int other,
                const std::vector<int>& other_classes, std::vector<Row>& rows) {
  int count = 0;
  for (const std::vector<int>& all : {classes, other_classes})
    for (int one : all) count = std::max(count, one + 1);
  for (int one = 0; one < count; ++one) {
    Row row;
    for (int i = 0; i < base.size; ++i) {
      if (classes[i] == one) {
        row.columns.push_back(ColumnOf(base, family, i));
        row.values.push_back(1.0);
      }
      if (other_classes[i] == one) {
        row.columns.push_back(ColumnOf(base, other, i));
        row.values.push_back(-1.0);
      }
    }
    if (!row.columns.empty()) rows.push_back(std::move(row));
  }
}

// Σ more·x of one family ≥ Σ less·x of another.
Row AtLeast(const BaseInstance& base, int family, const std::vector<double>& more, int other,
            const std::vector<double>& less, double unit) {
  Row row;
  for (int i = 0; i < base.size; ++i) {
    row.columns.push_back(ColumnOf(base, family, i));
    row.values.push_back(more[i] / unit);
    row.columns.push_back(ColumnOf(base, other, i));
    row.values.push_back(-less[i] / unit);
  }
  row.high = optimizer::kUnlimited;
  return row;
}

}  // namespace

std::vector<Row> LinearRows(const BaseInstance& base) {
  std::vector<Row> rows;
  for (int family = 0; family < kBaseFamilies; ++family) {
    Row row;
    row.low = row.high = 1.0;
    for (int i = 0; i < base.size; ++i) {
      row.columns.push_back(ColumnOf(base, family, i));
      row.values.push_back(1.0);
    }
    rows.push_back(std::move(row));
  }
  AddClasses(base, kTubes, base.tube_class, kFittings, base.fitting_class, rows);
  AddClasses(base, kFittings, base.fitting_thread, kValves, base.valve_thread, rows);
  rows.push_back(AtLeast(base, kCylinders, base.gas_m3, kTubes, base.need_m3, kLitre));
  rows.push_back(
      AtLeast(base, kRegulators, base.inlet_max_pa, kCylinders, base.fill_pa, kMegapascal));
  return rows;
}

Row RowOf(const BaseInstance& base, const Cut& cut) {
  Row row;
  row.low = -optimizer::kUnlimited;
  row.high = -1.0;
  for (int family = 0; family < kBaseFamilies; ++family) {
    row.high += !cut[family].empty();
    for (int i : cut[family]) {
      row.columns.push_back(ColumnOf(base, family, i));
      row.values.push_back(1.0);
    }
  }
  return row;
}

Selection SelectionOf(const BaseInstance& base, const double* x) {
  Selection s{};
  for (int family = 0; family < kBaseFamilies; ++family)
    s[family] =
        static_cast<int>(std::max_element(x + family * base.size, x + (family + 1) * base.size) -
                         (x + family * base.size));
  return s;
}

}  // namespace plenum::bench
