// Valid parts for tests of the catalogue.
#ifndef PLENUM_TESTS_CATALOG_SAMPLES_H_
#define PLENUM_TESTS_CATALOG_SAMPLES_H_

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "catalog/fields/fields.h"
#include "catalog/fields/price.h"
#include "catalog/store/store.h"

namespace plenum::catalog {

inline Provenance AnyProvenance(std::mt19937& random) {
  return static_cast<Provenance>(std::uniform_int_distribution(0, 4)(random));
}

inline std::optional<double> AnyUncertainty(std::mt19937& random) {
  if (random() % 2 == 0) return std::nullopt;
  return std::uniform_real_distribution(1e-6, 1.0)(random);
}

// Text that trips up careless quoting.
inline std::string AnyText(std::mt19937& random) {
  static const char* const kPieces[] = {"a", "\"",     ",", "\n", "\r\n",
                                        "µ", "Ø 4 mm", ";", " ",  "漢"};
  std::string text = "x";
  for (int i = std::uniform_int_distribution(0, 8)(random); i > 0; --i)
    text += kPieces[std::uniform_int_distribution(0, 9)(random)];
  return text;
}

// Doubles of all magnitudes inside the range, the ends and awkward ones included.
inline double AnyNumber(const NumberField& field, std::mt19937& random) {
  if (field.name == "channels" || field.name == "cells_series" || field.name == "stations")
    return std::uniform_int_distribution(1, 8)(random);
  switch (random() % 6) {
    case 0:
      return field.min;
    case 1:
      return field.max;
    case 2:
      return std::clamp(0.1, field.min, field.max);
    case 3:
      return std::clamp(1e-300, field.min, field.max);
    case 4:
      return std::clamp(4.9406564584124654e-324, field.min, field.max);
    default:
      return std::uniform_real_distribution(field.min, field.max)(random);
  }
}

inline Curve AnyCurve(CurveKind kind, std::mt19937& random) {
  Curve curve{{}, AnyProvenance(random), AnyText(random), AnyProvenance(random), AnyText(random)};
  curve.free_air_uncertainty = AnyUncertainty(random);
  curve.current_uncertainty = AnyUncertainty(random);
  double pressure = 0.0, flow = 50.0;
  std::uniform_real_distribution<double> step(1e-3, 10.0);
  for (int i = std::uniform_int_distribution(1, 64)(random); i > 0; --i) {
    curve.points.push_back({pressure, flow, step(random)});
    pressure += step(random);
    flow *= 0.97;
  }
  if (kind == CurveKind::kSuction) {
    for (CurvePoint& point : curve.points) point.pressure_kpa_gauge *= -0.1;
    std::reverse(curve.points.begin(), curve.points.end());
  }
  return curve;
}

// Series, aliases, offers and documents, each there or not.
inline void AddAnyDetails(Part& part, std::mt19937& random) {
  const auto some = [&] { return std::uniform_int_distribution(0, 2)(random); };
  if (some() > 0) part.series = AnyText(random);
  if (const int known = some(); known > 0) part.orderable = known == 1;
  for (int i = some(); i > 0; --i) part.aliases.push_back(std::to_string(i) + AnyText(random));
  static const char* const kDates[] = {"", "1999", "2024-02", "2024-02-29"};
  for (int i = some(); i > 0; --i) {
    const auto currencies = Currencies();
    part.offers.push_back({AnyText(random), std::uniform_real_distribution(0.0, 1e3)(random),
                           std::string(currencies[random() % currencies.size()]),
                           random() % 2 == 0 ? 1.0 : 12.5, kDates[random() % 4],
                           random() % 2 == 0 ? "" : "https://example.org/?a=\"b\\c\""});
  }
  for (int i = some(); i > 0; --i)
    part.documents.push_back({AnyText(random), random() % 2 == 0 ? "" : std::string(64, 'e')});
}

// A valid part of the family with random content; optional fields come and go.
inline Part AnyPart(const Family& family, const std::string& id, std::mt19937& random) {
  Part part;
  part.id = id;
  part.family = family.name;
  part.manufacturer = AnyText(random);
  part.part_number = AnyText(random);
  part.notes = AnyText(random);
  for (const NumberField& field : family.numbers)
    if (field.required || random() % 2 == 0)
      part.numbers[std::string(field.name)] = {AnyNumber(field, random), AnyProvenance(random),
                                               AnyText(random), AnyUncertainty(random)};
  for (const TextField& field : family.texts)
    if (field.required || random() % 2 == 0)
      part.texts[std::string(field.name)] = {
          field.allowed.empty() ? AnyText(random)
                                : std::string(field.allowed[random() % field.allowed.size()]),
          AnyProvenance(random), AnyText(random)};
  if (family.has_curve()) part.curve = AnyCurve(family.curve, random);
  AddAnyDetails(part, random);
  DerivePrice(part);
  // Pairs that must be in order.
  if (family.name == "tubing") {
    part.numbers["inner_diameter_mm"].value = 2.5;
    part.numbers["outer_diameter_mm"].value = 4.0;
  }
  if (family.name == "relief_valve") {
    part.numbers["relief_pressure_min_kpa_gauge"].value = 1.0;
    part.numbers["relief_pressure_max_kpa_gauge"].value = 700.0;
  }
  if (family.name == "regulator")
    for (const std::string side : {"inlet", "outlet"}) {
      double& low = part.numbers[side + "_pressure_min_kpa_gauge"].value;
      double& high = part.numbers[side + "_pressure_max_kpa_gauge"].value;
      if (low > high) std::swap(low, high);
    }
  return part;
}

inline Part Reservoir(const std::string& id) {
  Part part;
  part.id = id;
  part.family = "reservoir";
  part.manufacturer = "Maker";
  part.part_number = "R-" + id;
  for (const char* field :
       {"internal_volume_ml", "mass_kg", "body_volume_ml", "pressure_max_kpa_gauge"})
    part.numbers[field] = {500.0, Provenance::kDatasheet, "page 1"};
  part.numbers["mass_kg"].value = 0.2;
  return part;
}

// What an import takes.
inline PartSource EachOf(std::vector<Part> parts) {
  return [parts = std::move(parts)](const TakeEach& take) {
    for (const Part& part : parts) take(part);
  };
}

}  // namespace plenum::catalog

#endif  // PLENUM_TESTS_CATALOG_SAMPLES_H_
