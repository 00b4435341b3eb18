// The numbers of a corner, each bound to the field that it comes from: what Widen(), SplitKeys()
// and SetNumbers() of a family do follows from its rows. A family has one tuple of rows.
#ifndef PLENUM_OPTIMIZER_CHOICES_PLANT_CORNER_TABLE_H_
#define PLENUM_OPTIMIZER_CHOICES_PLANT_CORNER_TABLE_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "optimizer/problem/part_fields.h"

namespace plenum::optimizer::corner_table {

// kMore, kLess, kRating.
template <typename Corner>
struct Best {
  PartField field;
  double Corner::*at;
};

// kBoth.
template <typename Corner>
struct Ends {
  PartField field;
  double Corner::*low, Corner::*high;
};

// kFlow, kSharedFlow.
template <typename Corner>
struct Flow {
  PartField field;
  model::FlowElement Corner::*at;
};

// Of what choices mate with; set by a rule of the family.
template <typename Corner>
struct Mates {
  std::uint64_t Corner::*at;
};

// A number that a rule of the family finds.
template <typename Corner>
struct Ruled {
  Use use;  // kMore or kLess
  double weight;
  double Corner::*at;
};

// Clang 14 does not deduce an aggregate's arguments without these.
template <typename Corner>
Best(PartField, double Corner::*) -> Best<Corner>;
template <typename Corner>
Ends(PartField, double Corner::*, double Corner::*) -> Ends<Corner>;
template <typename Corner>
Flow(PartField, model::FlowElement Corner::*) -> Flow<Corner>;
template <typename Corner>
Mates(std::uint64_t Corner::*) -> Mates<Corner>;
template <typename Corner>
Ruled(Use, double, double Corner::*) -> Ruled<Corner>;

inline double Log(double value) { return std::log(std::max(value, 1e-300)); }
inline double Weighted(const PartField& field, double value) {
  return field.weight * Log(value + field.weight_offset);
}
inline void ToLeast(double& a, double b) { a = std::min(a, b); }
inline void ToMost(double& a, double b) { a = std::max(a, b); }
inline void ToBest(Use use, double& a, double b) {
  use == Use::kLess ? ToLeast(a, b) : ToMost(a, b);
}
inline void ToMostFlow(model::FlowElement& a, const model::FlowElement& b) {
  ToMost(a.sonic_conductance_m3_per_s_pa, b.sonic_conductance_m3_per_s_pa);
  ToMost(a.critical_ratio, b.critical_ratio);
  ToLeast(a.subsonic_index, b.subsonic_index);
}
inline void ToLeastFlow(model::FlowElement& a, const model::FlowElement& b) {
  ToLeast(a.sonic_conductance_m3_per_s_pa, b.sonic_conductance_m3_per_s_pa);
  ToLeast(a.critical_ratio, b.critical_ratio);
  ToMost(a.subsonic_index, b.subsonic_index);
}

template <typename Corner>
void Widen(const Best<Corner>& row, Corner& a, const Corner& b) {
  ToBest(row.field.use, a.*row.at, b.*row.at);
}
template <typename Corner>
void Widen(const Ends<Corner>& row, Corner& a, const Corner& b) {
  ToLeast(a.*row.low, b.*row.low);
  ToMost(a.*row.high, b.*row.high);
}
template <typename Corner>
void Widen(const Flow<Corner>& row, Corner& a, const Corner& b) {
  ToMostFlow(a.*row.at, b.*row.at);
}
template <typename Corner>
void Widen(const Mates<Corner>& row, Corner& a, const Corner& b) {
  a.*row.at |= b.*row.at;
}
template <typename Corner>
void Widen(const Ruled<Corner>& row, Corner& a, const Corner& b) {
  ToBest(row.use, a.*row.at, b.*row.at);
}

// KeyCount(row): by how many keys of the row trees divide; AddKeys(row, corner, add) calls `add`
// with each.
template <typename Corner>
constexpr std::size_t KeyCount(const Best<Corner>& row) {
  return row.field.weight > 0.0;
}
template <typename Corner, typename Add>
void AddKeys(const Best<Corner>& row, const Corner& c, const Add& add) {
  if (row.field.weight > 0.0) add(Weighted(row.field, c.*row.at));
}
template <typename Corner>
constexpr std::size_t KeyCount(const Ends<Corner>& row) {
  return row.field.weight > 0.0;
}
template <typename Corner, typename Add>
void AddKeys(const Ends<Corner>& row, const Corner& c, const Add& add) {
  if (row.field.weight > 0.0) add(Weighted(row.field, c.*row.high));
}
template <typename Corner>
constexpr std::size_t KeyCount(const Flow<Corner>& row) {
  return (row.field.weight > 0.0) + (row.field.ratio_weight > 0.0);
}
template <typename Corner, typename Add>
void AddKeys(const Flow<Corner>& row, const Corner& c, const Add& add) {
  const model::FlowElement& flow = c.*row.at;
  if (row.field.weight > 0.0) add(Weighted(row.field, flow.sonic_conductance_m3_per_s_pa));
  if (row.field.ratio_weight > 0.0) add(row.field.ratio_weight * flow.critical_ratio);
}
template <typename Corner>
constexpr std::size_t KeyCount(const Mates<Corner>&) {
  return 0;
}
template <typename Corner, typename Add>
void AddKeys(const Mates<Corner>&, const Corner&, const Add&) {}
template <typename Corner>
constexpr std::size_t KeyCount(const Ruled<Corner>& row) {
  return row.weight > 0.0;
}
template <typename Corner, typename Add>
void AddKeys(const Ruled<Corner>& row, const Corner& c, const Add& add) {
  if (row.weight > 0.0) add(row.weight * Log(c.*row.at));
}

// SetNumber(row, reading, corner): what a choice has, as the table says it. `reading` is a
// PartNumbers (part_numbers.h).
template <typename Corner, typename Reading>
void SetNumber(const Best<Corner>& row, const Reading& reading, Corner& c) {
  c.*row.at = reading.Number(row.field);
}
template <typename Corner, typename Reading>
void SetNumber(const Ends<Corner>& row, const Reading& reading, Corner& c) {
  c.*row.low = c.*row.high = reading.Number(row.field);
}
template <typename Corner, typename Reading>
void SetNumber(const Flow<Corner>& row, const Reading& reading, Corner& c) {
  c.*row.at = reading.Flow(row.field);
}
template <typename Corner, typename Reading>
void SetNumber(const Mates<Corner>&, const Reading&, Corner&) {}
template <typename Corner, typename Reading>
void SetNumber(const Ruled<Corner>&, const Reading&, Corner&) {}

template <typename Corner, typename... Rows>
void WidenBy(const std::tuple<Rows...>& rows, Corner& a, const Corner& b) {
  ToLeast(a.amounts.mass_kg, b.amounts.mass_kg);
  ToLeast(a.amounts.mass_slack_kg, b.amounts.mass_slack_kg);
  ToLeast(a.amounts.volume_slack_m3, b.amounts.volume_slack_m3);
  ToLeast(a.amounts.volume_m3, b.amounts.volume_m3);
  ToLeast(a.amounts.cost_eur, b.amounts.cost_eur);
  ToLeast(a.objective, b.objective);
  std::apply([&](const auto&... row) { (Widen(row, a, b), ...); }, rows);
}

// Of all rows, and the objective's.
template <typename... Rows>
constexpr std::size_t KeyCountOf(const std::tuple<Rows...>& rows) {
  return std::apply([](const auto&... row) { return (std::size_t{1} + ... + KeyCount(row)); },
                    rows);
}

template <std::size_t count, typename Corner, typename... Rows>
std::array<double, count> KeysBy(const std::tuple<Rows...>& rows, const Corner& c) {
  std::array<double, count> keys{Log(c.objective)};
  std::size_t next = 1;
  const auto add = [&](double key) { keys[next++] = key; };
  std::apply([&](const auto&... row) { (AddKeys(row, c, add), ...); }, rows);
  return keys;
}

template <typename Corner, typename Reading, typename... Rows>
void SetNumbersBy(const std::tuple<Rows...>& rows, const Reading& reading, Corner& c) {
  std::apply([&](const auto&... row) { (SetNumber(row, reading, c), ...); }, rows);
}

}  // namespace plenum::optimizer::corner_table

#endif  // PLENUM_OPTIMIZER_CHOICES_PLANT_CORNER_TABLE_H_
