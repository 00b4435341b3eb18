#include "api/design/given/exchanges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "api/design/read/combination.h"
#include "api/design/read/stock_volume.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/joints.h"
#include "optimizer/sizing/report.h"

namespace plenum::api {
namespace {

using optimizer::Choice;
using optimizer::Design;

bool Joins(const Choice& row) { return optimizer::SpecOf(row.family).joins; }

// There may be several joints.
bool SamePlace(const Choice& a, const Choice& b) {
  return a.family == b.family && a.group == b.group && (!Joins(a) || a.id == b.id);
}

const Choice* RowAt(const Design& design, const Choice& place) {
  const auto found = std::find_if(design.parts.begin(), design.parts.end(),
                                  [&](const Choice& row) { return SamePlace(row, place); });
  return found == design.parts.end() ? nullptr : &*found;
}

bool SameAmounts(const Choice& a, const Choice& b) {
  constexpr double kRounding = 1e-9;
  const auto near = [](double x, double y) { return std::abs(x - y) <= kRounding * std::abs(y); };
  return near(a.mass_kg, b.mass_kg) && near(a.volume_m3, b.volume_m3);
}

int GroupOf(const RowPair& pair) { return pair.place().group; }

bool HasReservoir(const RowPair& pair) {
  return pair.other && optimizer::SpecOf(pair.other->family).made_to_measure;
}

// Joints as the other rows ask, where the design has any.
void JoinAnew(const optimizer::Problem& problem, Design& design) {
  if (std::erase_if(design.parts, Joins) == 0) return;
  for (const optimizer::Joint& joint : optimizer::JointsOf(problem, design.parts)) {
    Choice row;
    row.family = joint.family;
    row.id = optimizer::BasicsOf(problem.parts, joint.family, joint.part).id;
    row.quantity = joint.quantity;
    design.parts.push_back(std::move(row));
  }
}

Design Exchanged(const optimizer::Problem& problem, Design design, const Design& other,
                 const std::vector<RowPair>& rows) {
  for (const RowPair& pair : rows) {
    std::erase_if(design.parts, [&](const Choice& row) { return SamePlace(row, pair.place()); });
    if (pair.other) design.parts.push_back(*pair.other);
    if (HasReservoir(pair))
      design.settings.reservoir_volume_m3 = other.settings.reservoir_volume_m3;
  }
  JoinAnew(problem, design);
  return design;
}

}  // namespace

bool SamePart(const RowPair& pair) {
  return pair.given && pair.other && optimizer::SameRow(*pair.given, *pair.other);
}

std::vector<RowPair> Differences(const Design& given, const Design& other) {
  std::vector<RowPair> pairs;
  for (const Choice& row : given.parts) {
    const Choice* beside = RowAt(other, row);
    if (!beside || !optimizer::SameRow(row, *beside) || !SameAmounts(row, *beside))
      pairs.push_back({&row, beside});
  }
  for (const Choice& row : other.parts)
    if (!RowAt(given, row)) pairs.push_back({nullptr, &row});
  return pairs;
}

std::vector<Exchange> Exchanges(const optimizer::Problem& problem,
                                const std::vector<catalog::Part>& catalogue, const Design& given,
                                const Design& other, const std::function<bool()>& stop) {
  std::vector<RowPair> differing = Differences(given, other);
  std::erase_if(differing,
                [](const RowPair& pair) { return SamePart(pair) || Joins(pair.place()); });
  const auto fits = [&](const std::vector<RowPair>& rows) {
    Errors errors;
    CheckCombination(Exchanged(problem, given, other, rows), problem, catalogue, "", errors);
    return errors.empty();
  };
  std::vector<std::vector<RowPair>> tries;
  std::set<int> bundled;
  for (const RowPair& pair : differing) {
    if (fits({pair})) {
      tries.push_back({pair});
      continue;
    }
    if (!bundled.insert(GroupOf(pair)).second) continue;
    std::vector<RowPair> place;
    std::copy_if(differing.begin(), differing.end(), std::back_inserter(place),
                 [&](const RowPair& one) { return GroupOf(one) == GroupOf(pair); });
    if (fits(place)) tries.push_back(std::move(place));
  }
  std::vector<Exchange> exchanges;
  exchanges.reserve(tries.size());
  for (std::vector<RowPair>& rows : tries) {
    const Design design = WithReservoirVolume(Exchanged(problem, given, other, rows), problem);
    exchanges.push_back({std::move(rows), {}});
    if (!stop())
      exchanges.back().made =
          optimizer::AtBestSettings(optimizer::WithPartsOf(problem, design), design, stop);
  }
  return exchanges;
}

}  // namespace plenum::api
